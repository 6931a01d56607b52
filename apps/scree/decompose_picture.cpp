#include "decompose_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "plot/canvas.hpp"
#include "plot/palette.hpp"
#include "scree/base/error.hpp"
#include "scree/geometry/mesh_edges.hpp"
#include "scree/results/output_file.hpp"

namespace scree {
namespace {

using plot::Anchor;
using plot::Canvas;
using plot::Colour;

constexpr int kWidth = 1140, kHeight = 470;       // [px]
constexpr double kPanel = 360.0, kMargin = 15.0;  // of a square view, and around it [px]
constexpr double kTop = 62.0;                     // of the views [px]
constexpr double kSharp = 0.87;                   // cosine of the angle between faces from which on an edge shows [1]
constexpr Colour kSolid{0.80, 0.80, 0.80};
constexpr Colour kBall{0.0, 0.447, 0.698, 0.16}, kRim{0.0, 0.447, 0.698, 0.9};

/// A view along an axis: what goes to the right, upwards, and towards the eye.
struct View {
  const char* title;
  Vec3 right, up, towards;
};
constexpr std::array<View, 3> kViews{{{"along x (y to the right, z up)", {0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                                      {"along y (x to the right, z up)", {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                      {"along z (x to the right, y up)", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

/// Draws one view into its square of the page.
class Panel {
 public:
  Panel(Canvas& canvas, const View& view, const Vec3& middle, double scale, double left)
      : canvas_{canvas}, view_{view}, middle_{middle}, scale_{scale}, left_{left} {}

  [[nodiscard]] Canvas::Point at(const Vec3& p) const {
    const Vec3 d = p - middle_;
    return {left_ + 0.5 * kPanel + scale_ * dot(d, view_.right), kTop + 0.5 * kPanel - scale_ * dot(d, view_.up)};
  }

  void solid(const TriangleMesh& mesh, const std::vector<Vec3>& normals) const {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (dot(normals[t], view_.towards) <= 0.0) continue;
      std::vector<Canvas::Point> corners;
      for (const std::uint32_t v : mesh.triangles[t]) corners.push_back(at(mesh.vertices[v]));
      canvas_.fill(corners, kSolid);
      canvas_.outline(corners, kSolid, 0.6);  // else the page shows between neighbours
    }
  }

  void balls(std::span<const Sphere> spheres) const {
    std::vector<Sphere> sorted{spheres.begin(), spheres.end()};
    std::ranges::stable_sort(sorted, {}, [&](const Sphere& s) { return dot(s.centre, view_.towards); });
    for (const Sphere& s : sorted) {
      canvas_.disc(at(s.centre), scale_ * s.radius, kBall);
      std::vector<Canvas::Point> rim;
      constexpr int kPieces = 72;
      for (int k = 0; k < kPieces; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kPieces;
        rim.push_back(at(s.centre + s.radius * (std::cos(angle) * view_.right + std::sin(angle) * view_.up)));
      }
      canvas_.outline(rim, kRim, 0.8);
    }
  }

  /// Contours, where the surface turns away from the eye, and sharp edges that face it.
  void edges(const TriangleMesh& mesh, const std::vector<Vec3>& normals, std::span<const MeshSide> sides) const {
    for_each_edge(sides, [&](std::span<const MeshSide> edge) {
      const Vec3& one = normals[edge[0].triangle];
      const Vec3& other = normals[edge.back().triangle];
      const bool seen = dot(one, view_.towards) > 1e-9, also = dot(other, view_.towards) > 1e-9;
      const bool contour = edge.size() != 2 || seen != also;
      if (!contour && !(seen && dot(one, other) < kSharp)) return;
      canvas_.line(at(mesh.vertices[edge[0].low]), at(mesh.vertices[edge[0].high]), plot::kInk, contour ? 1.6 : 0.7);
    });
  }

 private:
  Canvas& canvas_;
  const View& view_;
  Vec3 middle_;
  double scale_;  // [px/m]
  double left_;   // [px]
};

/// A length of 1, 2 or 5 times a power of ten, at most a third of `extent` [m].
double bar_length(double extent) {
  const double decade = std::pow(10.0, std::floor(std::log10(extent / 3.0)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= extent / 3.0) return factor * decade;
  }
  return decade;
}

std::string length_text(double metres) {
  char text[40];
  const bool small = metres < 1.0;
  std::snprintf(text, sizeof text, "%g %s", small ? 1e3 * metres : metres, small ? "mm" : "m");
  return text;
}

void draw(Canvas& canvas, const std::string& title, const std::string& note, const TriangleMesh& mesh,
          std::span<const Sphere> spheres) {
  Aabb box = bounds_of(mesh.vertices);
  for (const Sphere& s : spheres) {
    const Vec3 reach{s.radius, s.radius, s.radius};
    box = merged(merged(box, s.centre - reach), s.centre + reach);
  }
  const Vec3 extent = box.upper - box.lower, middle = 0.5 * (box.lower + box.upper);
  const double largest = std::max({extent.x, extent.y, extent.z});
  const double scale = 0.94 * kPanel / largest;
  std::vector<Vec3> normals;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    normals.push_back(normalized(cross(b - a, c - a)));
  }
  const std::vector<MeshSide> sides = sorted_sides(mesh);

  canvas.fill({{0, 0}, {kWidth, 0}, {kWidth, kHeight}, {0, kHeight}}, plot::kPaper);
  canvas.text({kMargin, 24}, title, 16, Anchor::left, true);
  canvas.text({kMargin, 44}, note, 12, Anchor::left);
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    const double left = kMargin + static_cast<double>(i) * (kPanel + kMargin);
    const Panel panel{canvas, kViews[i], middle, scale, left};
    panel.solid(mesh, normals);
    panel.balls(spheres);
    panel.edges(mesh, normals, sides);
    canvas.text({left + 0.5 * kPanel, kTop + kPanel + 20}, kViews[i].title, 12, Anchor::middle);
  }
  const double bar = bar_length(largest), y = kHeight - 12.0;
  canvas.line({kMargin, y}, {kMargin + scale * bar, y}, plot::kInk, 2.0);
  canvas.text({kMargin + scale * bar + 8, y + 4}, length_text(bar), 12, Anchor::left);
}

}  // namespace

void draw_decomposition(const std::filesystem::path& file, const std::string& title, const std::string& note,
                        const TriangleMesh& surface, std::span<const Sphere> spheres) {
  const auto page = [&](Canvas& canvas) { draw(canvas, title, note, surface, spheres); };
  const std::string ending = file.extension().string();
  if (ending == ".svg") {
    replace_file(file, Canvas::as_svg(kWidth, kHeight, page));
  } else if (ending == ".png") {
    replace_file(file, Canvas::as_png(kWidth, kHeight, page));
  } else {
    throw Error{ErrorKind::usage, "the picture '" + file.string() + "' must end in .svg or .png"};
  }
}

}  // namespace scree
