#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "label_places.hpp"
#include "picture.hpp"
#include "plot/axis_map.hpp"
#include "plot/palette.hpp"

namespace scree {

namespace {

using plot::Anchor;
using plot::Canvas;
using plot::Colour;
using Point = Canvas::Point;

constexpr double kLeft = 66.0, kRight = 20.0, kTop = 82.0, kBottom = 54.0;  // margins around the frame [px]
constexpr double kSmall = 12.0, kNormal = 13.0, kLarge = 16.0;              // text sizes [px]
constexpr double kLeastRadius = 0.8;                                        // of a drawn disc [px]
constexpr Colour kAir{0.985, 0.985, 0.98}, kWall{0.83, 0.84, 0.86}, kGhost{0.83, 0.84, 0.86, 0.35};
constexpr Colour kEdge{0.33, 0.35, 0.38}, kHalo{1.0, 1.0, 1.0, 0.78};

double frame_width(const Picture& picture) { return picture.width - kLeft - kRight; }
double frame_height(const Picture& picture) {
  return std::round(frame_width(picture) * picture.window.height() / picture.window.width());
}

Colour darker(Colour colour) { return {0.6 * colour.red, 0.6 * colour.green, 0.6 * colour.blue}; }

/// Draws one picture onto a canvas.
class Painter {
 public:
  Painter(const Picture& picture, Canvas& canvas) : picture_{picture}, canvas_{canvas} {}

  void paint() {
    const double w = picture_.width, h = height_of(picture_);
    canvas_.fill({{0, 0}, {w, 0}, {w, h}, {0, h}}, plot::kPaper);
    canvas_.fill(frame_corners(), kAir);
    canvas_.clip({left_, top_}, {right_, bottom_});
    for (const PlaneEdge& edge : picture_.edges) plane(edge);
    for (const WallPicture& wall : picture_.walls) {
      for (const Silhouette& part : wall.parts) wall_part(part);
    }
    for (const Turn& t : picture_.turns) turn(t);
    for (const Mark& m : picture_.marks) mark(m);
    for (const Grain& grain : picture_.grains) paint_grain(grain);
    for (const Arrow& arrow : picture_.arrows) canvas_arrow({page(arrow.from), page(arrow.to)}, plot::kInk, 1.0);
    labels();
    canvas_.clip_end();
    canvas_.outline(frame_corners(), plot::kInk, 1.0);
    axes();
    heading();
  }

 private:
  [[nodiscard]] Point page(Point2 p) const { return {x_(p.x), y_(p.y)}; }
  [[nodiscard]] Point2 world(Point p) const {
    return {picture_.window.lower.x + (p.first - left_) / scale_, picture_.window.upper.y - (p.second - top_) / scale_};
  }
  [[nodiscard]] std::vector<Point> page(const std::vector<Point2>& points) const {
    std::vector<Point> list;
    for (const Point2 p : points) list.push_back(page(p));
    return list;
  }
  [[nodiscard]] std::vector<Point> frame_corners() const {
    return {{left_, top_}, {right_, top_}, {right_, bottom_}, {left_, bottom_}};
  }
  [[nodiscard]] Colour colour_of(std::size_t material) const {
    return plot::kColours[picture_.colours[material] % plot::kColours.size()];
  }

  [[nodiscard]] std::vector<Point> corners(const Silhouette& part) const {
    if (part.radius <= 0.0) return page(part.outline);
    std::vector<Point> circle;
    arc(part.centre, part.radius, 0.0, 2.0 * std::numbers::pi, circle);
    return circle;
  }

  void wall_part(const Silhouette& part) {
    const std::vector<Point> outline = corners(part);
    if (!part.hollow) canvas_.fill(outline, part.collides ? kWall : kGhost);
    canvas_.outline(outline, kEdge, 1.2, part.collides ? plot::Stroke::solid : plot::Stroke::dashed);
  }

  void paint_grain(const Grain& grain) {
    const Colour colour = colour_of(grain.material);
    const Silhouette& shape = grain.shape;
    if (shape.radius <= 0.0) {
      canvas_.fill(page(shape.outline), colour);
      return canvas_.outline(page(shape.outline), darker(colour), 0.5);
    }
    const double radius = std::max(kLeastRadius, shape.radius * scale_);
    const bool rimmed = radius > 2.5;
    canvas_.disc(page(shape.centre), radius, rimmed ? darker(colour) : colour);
    if (rimmed) canvas_.disc(page(shape.centre), radius - 0.6, colour);
  }

  // The edge of a half space: a line across the picture, with strokes on its solid side.
  void plane(const PlaneEdge& edge) {
    constexpr double kSpacing = 9.0, kStroke = 9.0;
    const auto [x, y] = page(edge.point);
    const Point normal{edge.normal.x, -edge.normal.y}, along{edge.normal.y, edge.normal.x};
    const double middle_x = 0.5 * (left_ + right_), middle_y = 0.5 * (top_ + bottom_);
    // The point of the line nearest to the middle of the frame, and as far as its corners from there.
    const double shift = (middle_x - x) * along.first + (middle_y - y) * along.second;
    const Point start{x + shift * along.first, y + shift * along.second};
    const double reach = std::hypot(right_ - left_, bottom_ - top_);
    const auto at = [&](double t) { return Point{start.first + t * along.first, start.second + t * along.second}; };
    canvas_.line(at(-reach), at(reach), kEdge, 1.5);
    for (double t = -reach; t < reach; t += kSpacing) {
      const auto [px, py] = at(t);
      const Point into{px + kStroke * (along.first - normal.first), py + kStroke * (along.second - normal.second)};
      canvas_.line({px, py}, into, kEdge, 0.8);
    }
  }

  // Points of an arc from one angle [rad] to another, counter-clockwise as the viewer sees it.
  void arc(Point2 centre, double radius, double from, double to, std::vector<Point>& points) const {
    constexpr int kSteps = 120;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = from + (to - from) * i / kSteps;
      points.push_back(page(centre + radius * Point2{std::cos(angle), std::sin(angle)}));
    }
  }

  void turn(const Turn& t) {
    constexpr double kPlace = 0.78, kHalf = 0.5;  // of the radius; half the arc [rad]
    const double middle = 0.5 * std::numbers::pi, sense = t.counterclockwise ? 1.0 : -1.0;
    std::vector<Point> points;
    arc(t.centre, kPlace * t.radius, middle - sense * kHalf, middle + sense * kHalf, points);
    canvas_.disc(page(t.centre), 2.5, kEdge);
    canvas_arrow(points, kEdge, 2.0);
  }

  /// A polyline with a head at its end.
  void canvas_arrow(const std::vector<Point>& points, Colour colour, double width) {
    const double head = 3.0 + 3.5 * width;
    const auto [x, y] = points.back();
    // The direction over the length of the head, so that it follows an arc.
    std::size_t before = points.size() - 1;
    while (before > 0 && std::hypot(x - points[before].first, y - points[before].second) < head) --before;
    const double dx = x - points[before].first, dy = y - points[before].second, length = std::hypot(dx, dy);
    canvas_.polyline(points, colour, width);
    if (length <= 0.0) return;
    const Point u{dx / length, dy / length}, base{x - head * u.first, y - head * u.second};
    const Point side{-0.4 * head * u.second, 0.4 * head * u.first};
    canvas_.fill({{x + u.first, y + u.second},
                  {base.first + side.first, base.second + side.second},
                  {base.first - side.first, base.second - side.second}},
                 colour);
  }

  void mark(const Mark& m) {
    constexpr double kTick = 7.0;
    const auto [x, y] = page(m.from);
    const auto [to_x, to_y] = page(m.to);
    const double dx = to_x - x, dy = to_y - y, length = std::hypot(dx, dy);
    if (length <= 0.0) return;
    canvas_.line({x, y}, {to_x, to_y}, plot::kGuide, 1.2,
                 m.divisions == 1 ? plot::Stroke::dashed : plot::Stroke::solid);
    for (int k = 0; k <= m.divisions && m.divisions > 1; ++k) {
      const double px = x + dx * k / m.divisions, py = y + dy * k / m.divisions;
      canvas_.line({px, py}, {px - kTick * dy / length, py + kTick * dx / length}, plot::kGuide, 1.0);
    }
  }

  void labels() {
    std::vector<std::vector<Point>> obstacles;
    for (const WallPicture& wall : picture_.walls) {
      for (const Silhouette& part : wall.parts) obstacles.push_back(corners(part));
    }
    LabelPlaces places{{left_ + 2, top_ + 2, right_ - 2, bottom_ - 2}, std::move(obstacles)};
    for (const Mark& m : picture_.marks) {
      if (m.label.empty()) continue;
      const auto [x, y] = page(m.from);
      const double from = std::clamp(x, left_ + 5, right_ - 5);
      const Box box{from, y - 18, from + canvas_.text_width(m.label, kSmall), y - 4};
      places.keep(box);
      write(m.label, box);
    }
    for (const WallPicture& wall : picture_.walls) {
      if (!wall.label.empty()) label(wall, places);
    }
  }

  void label(const WallPicture& wall, LabelPlaces& places) {
    Window bounds = Window::empty();
    for (const Silhouette& part : wall.parts) include(part, bounds);
    if (bounds.is_empty()) return;
    const auto [left, bottom] = page(bounds.lower);
    const auto [right, top] = page(bounds.upper);
    if (right < left_ || left > right_ || bottom < top_ || top > bottom_) return;
    const double width = canvas_.text_width(wall.label, kNormal) + 6.0, height = 16.0;
    const double x = 0.5 * (left + right), y = 0.5 * (top + bottom) + (picture_.turns.empty() ? 0.0 : 18.0);
    const Box inside{x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height};
    const std::array box_corners{Point{inside.left, inside.top}, Point{inside.right, inside.top},
                                 Point{inside.left, inside.bottom}, Point{inside.right, inside.bottom}};
    const auto holds_box = [&](const Silhouette& part) {
      return std::all_of(box_corners.begin(), box_corners.end(), [&](Point p) { return covers(part, world(p)); });
    };
    if (std::any_of(wall.parts.begin(), wall.parts.end(), holds_box)) {
      places.keep(inside);
      return canvas_.text({x, y + 4.5}, wall.label, kNormal, Anchor::middle);
    }
    if (const auto box = places.place({left, top, right, bottom}, width, height)) write(wall.label, *box);
  }

  void write(const std::string& words, const Box& box) {
    canvas_.fill({{box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}}, kHalo);
    canvas_.text({0.5 * (box.left + box.right), box.bottom - 3.5}, words, kNormal, Anchor::middle);
  }

  void axes() {
    for (const plot::Tick& tick : x_.ticks()) {
      const double x = x_(tick.value);
      canvas_.line({x, bottom_}, {x, bottom_ + 5}, plot::kInk, 1.0);
      canvas_.text({x, bottom_ + 19}, tick.text, kSmall, Anchor::middle);
    }
    for (const plot::Tick& tick : y_.ticks()) {
      const double y = y_(tick.value);
      canvas_.line({left_ - 5, y}, {left_, y}, plot::kInk, 1.0);
      canvas_.text({left_ - 9, y + 4}, tick.text, kSmall, Anchor::right);
    }
    canvas_.text({0.5 * (left_ + right_), bottom_ + 40}, picture_.x_label, kNormal, Anchor::middle);
    canvas_.text({20, 0.5 * (top_ + bottom_)}, picture_.y_label, kNormal, Anchor::middle, false, true);
  }

  void heading() {
    canvas_.text({left_, 27}, picture_.title, kLarge, Anchor::left, true);
    canvas_.text({left_, 47}, picture_.note, kNormal, Anchor::left);
    double x = left_ + 6;
    for (const LegendEntry& entry : picture_.legend) {
      canvas_.disc({x, 65}, 5.5, colour_of(entry.material));
      canvas_.text({x + 11, 69.5}, entry.label, kNormal, Anchor::left);
      x += canvas_.text_width(entry.label, kNormal) + 40;
    }
  }

  const Picture& picture_;
  Canvas& canvas_;
  double left_ = kLeft, right_ = kLeft + frame_width(picture_);  // of the frame [px]
  double top_ = kTop, bottom_ = kTop + frame_height(picture_);
  double scale_ = frame_width(picture_) / picture_.window.width();  // [px/m]
  plot::AxisMap x_{plot::Scale::linear, {picture_.window.lower.x, picture_.window.upper.x}, left_, right_};
  plot::AxisMap y_{plot::Scale::linear, {picture_.window.lower.y, picture_.window.upper.y}, bottom_, top_};
};

}  // namespace

int height_of(const Picture& picture) { return static_cast<int>(kTop + frame_height(picture) + kBottom); }

void draw(const Picture& picture, Canvas& canvas) { Painter{picture, canvas}.paint(); }

}  // namespace scree
