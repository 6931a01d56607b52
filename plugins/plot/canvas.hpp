// Canvas: a page to draw on, which becomes the bytes of an SVG or PNG file.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree::plot {

/// Red, green, blue and opacity, each in 0..1.
struct Colour {
  double red, green, blue, opacity = 1.0;
};

enum class Anchor { left, middle, right };
enum class Stroke { solid, dashed, dotted };

/// Drawing calls. The origin is the top left corner, y goes down, lengths are in px.
class Canvas {
 public:
  using Point = std::pair<double, double>;

  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void line(Point from, Point to, Colour colour, double width, Stroke stroke = Stroke::solid);
  void polyline(const std::vector<Point>& points, Colour colour, double width, Stroke stroke = Stroke::solid);
  /// A polyline back to its first point.
  void outline(const std::vector<Point>& points, Colour colour, double width, Stroke stroke = Stroke::solid);
  void fill(const std::vector<Point>& points, Colour colour);
  void disc(Point centre, double radius, Colour colour);
  /// `y` is the baseline; with `upward` the text reads from the bottom to the top.
  void text(Point at, std::string_view words, double size, Anchor anchor, bool bold = false, bool upward = false);
  [[nodiscard]] double text_width(std::string_view words, double size, bool bold = false) const;
  /// Nothing outside of the rectangle is drawn until clip_end().
  void clip(Point corner, Point opposite_corner);
  void clip_end();

  /// What `draw` draws, as the bytes of a file. @throws Error (io) when the drawing library fails.
  static std::string as_svg(int width, int height, const std::function<void(Canvas&)>& draw);
  static std::string as_png(int width, int height, const std::function<void(Canvas&)>& draw);

 private:
  struct Context;
  explicit Canvas(std::unique_ptr<Context> context);
  void set(Colour colour);
  void draw(const std::vector<Point>& points, bool closed, Colour colour, double width, Stroke stroke);
  std::unique_ptr<Context> context_;
};

}  // namespace scree::plot
