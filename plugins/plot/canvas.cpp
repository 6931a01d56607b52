#include "plot/canvas.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <array>
#include <numbers>

#include "scree/base/error.hpp"

namespace scree::plot {

namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error{ErrorKind::io, std::string{"cannot draw a figure: "} + cairo_status_to_string(status) + "."};
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

// Cairo numbers its surfaces through the life of the program; the same figure shall be the same file.
std::string with_constant_name(std::string svg) {
  const std::size_t begin = svg.find("<g id=\"surface");
  if (begin != std::string::npos) svg.replace(begin, svg.find('>', begin) - begin, "<g id=\"page\"");
  return svg;
}

}  // namespace

struct Canvas::Context {
  explicit Context(cairo_surface_t* surface) : cairo{cairo_create(surface), cairo_destroy} {}
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo;
};

Canvas::Canvas(std::unique_ptr<Context> context) : context_{std::move(context)} {}
Canvas::~Canvas() = default;

void Canvas::set(Colour colour) {
  cairo_set_source_rgba(context_->cairo.get(), colour.red, colour.green, colour.blue, colour.opacity);
}

void Canvas::draw(const std::vector<Point>& points, bool closed, Colour colour, double width, Stroke stroke) {
  cairo_t* cairo = context_->cairo.get();
  constexpr std::array kDashes{5.0, 4.0}, kDots{1.5, 3.0};
  set(colour);
  cairo_set_line_width(cairo, width);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  const std::array<double, 2>& pattern = stroke == Stroke::dotted ? kDots : kDashes;
  if (stroke != Stroke::solid) cairo_set_dash(cairo, pattern.data(), static_cast<int>(pattern.size()), 0.0);
  for (const auto& [x, y] : points) cairo_line_to(cairo, x, y);
  if (closed) cairo_close_path(cairo);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0.0);
}

void Canvas::line(Point from, Point to, Colour colour, double width, Stroke stroke) {
  draw({from, to}, false, colour, width, stroke);
}

void Canvas::polyline(const std::vector<Point>& points, Colour colour, double width, Stroke stroke) {
  draw(points, false, colour, width, stroke);
}

void Canvas::outline(const std::vector<Point>& points, Colour colour, double width, Stroke stroke) {
  draw(points, true, colour, width, stroke);
}

void Canvas::fill(const std::vector<Point>& points, Colour colour) {
  cairo_t* cairo = context_->cairo.get();
  set(colour);
  for (const auto& [x, y] : points) cairo_line_to(cairo, x, y);
  cairo_close_path(cairo);
  cairo_fill(cairo);
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  cairo_t* cairo = context_->cairo.get();
  set(colour);
  cairo_new_path(cairo);
  cairo_arc(cairo, centre.first, centre.second, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(cairo);
}

double Canvas::text_width(std::string_view words, double size, bool bold) const {
  cairo_t* cairo = context_->cairo.get();
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, std::string{words}.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(Point at, std::string_view words, double size, Anchor anchor, bool bold, bool upward) {
  cairo_t* cairo = context_->cairo.get();
  const double width = text_width(words, size, bold);
  const double shift = anchor == Anchor::left ? 0.0 : (anchor == Anchor::middle ? 0.5 * width : width);
  set({0.1, 0.1, 0.1});
  cairo_save(cairo);
  cairo_translate(cairo, at.first, at.second);
  if (upward) cairo_rotate(cairo, -0.5 * std::numbers::pi);
  cairo_move_to(cairo, -shift, 0.0);
  cairo_show_text(cairo, std::string{words}.c_str());
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

void Canvas::clip(Point corner, Point opposite) {
  cairo_t* cairo = context_->cairo.get();
  cairo_save(cairo);
  cairo_rectangle(cairo, corner.first, corner.second, opposite.first - corner.first, opposite.second - corner.second);
  cairo_clip(cairo);
}

void Canvas::clip_end() { cairo_restore(context_->cairo.get()); }

std::string Canvas::as_svg(int width, int height, const std::function<void(Canvas&)>& draw) {
  std::string bytes;
  const Surface surface{cairo_svg_surface_create_for_stream(&append, &bytes, width, height), cairo_surface_destroy};
  {
    Canvas canvas{std::make_unique<Context>(surface.get())};
    draw(canvas);
    check(cairo_status(canvas.context_->cairo.get()));
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return with_constant_name(std::move(bytes));
}

std::string Canvas::as_png(int width, int height, const std::function<void(Canvas&)>& draw) {
  const Surface surface{cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy};
  {
    Canvas canvas{std::make_unique<Context>(surface.get())};
    draw(canvas);
    check(cairo_status(canvas.context_->cairo.get()));
  }
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), &append, &bytes));
  return bytes;
}

}  // namespace scree::plot
