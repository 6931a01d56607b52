#include "vtp/surface.hpp"

#include <cmath>
#include <numbers>

namespace scree {

namespace {

/// A point of a profile that is turned about the z axis.
struct ProfilePoint {
  double radius;  ///< [m]
  double height;  ///< [m]
};

// Appends an arc of the sphere about (0, centre), from one latitude [rad] to another.
void append_arc(std::vector<ProfilePoint>& profile, double centre, double radius, double from, double to, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double latitude = from + (to - from) * i / steps;
    profile.push_back({radius * std::cos(latitude), centre + radius * std::sin(latitude)});
  }
}

class Builder {
 public:
  Builder(const SurfaceOptions& options, Surface& out) : options_{options}, out_{out} {}

  void place(const Pose& pose) { pose_ = pose; }

  void quad(const std::array<Vec3, 4>& corners) {
    const std::uint32_t first = add(corners);
    out_.triangles.push_back({first, first + 1, first + 2});
    out_.triangles.push_back({first, first + 2, first + 3});
  }

  void box(const Vec3& h) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        Vec3 n{}, u{}, v{};
        n[axis] = side * h[axis];
        u[(axis + 1) % 3] = side * h[(axis + 1) % 3];
        v[(axis + 2) % 3] = h[(axis + 2) % 3];
        quad({n - u - v, n + u - v, n + u + v, n - u + v});
      }
    }
  }

  // Turns a profile, given from the bottom to the top, about the z axis.
  void revolve(const std::vector<ProfilePoint>& profile) {
    const auto n = static_cast<std::uint32_t>(options_.segments);
    const auto first = static_cast<std::uint32_t>(out_.points.size());
    for (const ProfilePoint& p : profile) {
      for (std::uint32_t s = 0; s < n; ++s) {
        const double angle = 2.0 * std::numbers::pi * s / n;
        add(Vec3{p.radius * std::cos(angle), p.radius * std::sin(angle), p.height});
      }
    }
    for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
      for (std::uint32_t s = 0; s < n; ++s) {
        const std::uint32_t a = first + row * n + s, b = first + row * n + (s + 1) % n;
        if (profile[row].radius > 0.0) out_.triangles.push_back({a, b, b + n});
        if (profile[row + 1].radius > 0.0) out_.triangles.push_back({a, b + n, a + n});
      }
    }
  }

  void sphere(const Vec3& centre, double radius) {
    const Pose outer = pose_;
    pose_.position = transform(outer, centre);
    std::vector<ProfilePoint> profile;
    append_arc(profile, 0.0, radius, -kQuarter, kQuarter, options_.segments / 2);
    close_poles(profile);
    revolve(profile);
    pose_ = outer;
  }

  void ellipsoid(const Vec3& half_axes) {
    const std::size_t first = out_.points.size();
    const Pose outer = pose_;
    pose_ = {};
    sphere({}, 1.0);
    pose_ = outer;
    for (std::size_t i = first; i < out_.points.size(); ++i) {
      out_.points[i] = transform(pose_, hadamard(half_axes, out_.points[i]));
    }
  }

  void capsule(double radius, double half_length) {
    std::vector<ProfilePoint> profile;
    append_arc(profile, -half_length, radius, -kQuarter, 0.0, options_.segments / 4);
    append_arc(profile, half_length, radius, 0.0, kQuarter, options_.segments / 4);
    close_poles(profile);
    revolve(profile);
  }

  void mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
    // Triangles index the common buffer of all shapes; a corner is added for each use.
    for (const Triangle& t : triangles) {
      const std::uint32_t first = add(vertices[t[0]]);
      add(vertices[t[1]]);
      add(vertices[t[2]]);
      out_.triangles.push_back({first, first + 1, first + 2});
    }
  }

 private:
  static constexpr double kQuarter = 0.5 * std::numbers::pi;

  // cos(pi/2) is not quite zero.
  static void close_poles(std::vector<ProfilePoint>& profile) { profile.front().radius = profile.back().radius = 0.0; }

  std::uint32_t add(const Vec3& local) {
    out_.points.push_back(transform(pose_, local));
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }
  std::uint32_t add(const std::array<Vec3, 4>& corners) {
    const std::uint32_t first = add(corners[0]);
    for (std::size_t i = 1; i < corners.size(); ++i) add(corners[i]);
    return first;
  }

  SurfaceOptions options_;
  Surface& out_;
  Pose pose_;
};

void append_primitive(const ShapeSet& shapes, const Primitive& p, const SurfaceOptions& options, Builder& build) {
  const Vec3& s = p.size;
  switch (p.kind) {
    case ShapeKind::sphere:
      return build.sphere({}, s.x);
    case ShapeKind::sphere_cluster:
      for (const Sphere& ball : shapes.spheres().subspan(p.first_sphere, p.sphere_count)) {
        build.sphere(ball.centre, ball.radius);
      }
      return;
    case ShapeKind::box:
      return build.box(s);
    case ShapeKind::cylinder:
      if (p.hollow) return build.revolve({{s.x, -s.y}, {s.x, s.y}});
      return build.revolve({{0.0, -s.y}, {s.x, -s.y}, {s.x, s.y}, {0.0, s.y}});
    case ShapeKind::capsule:
      return build.capsule(s.x, s.y);
    case ShapeKind::cone:
      return build.revolve({{0.0, -s.y}, {s.x, -s.y}, {0.0, s.y}});
    case ShapeKind::ellipsoid:
      return build.ellipsoid(s);
    case ShapeKind::plane: {
      const double h = 0.5 * options.plane_size;
      return build.quad({Vec3{-h, -h, 0}, Vec3{h, -h, 0}, Vec3{h, h, 0}, Vec3{-h, h, 0}});
    }
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh:
      return build.mesh(shapes.vertices(), shapes.triangles().subspan(p.first_triangle, p.triangle_count));
  }
}

}  // namespace

void append_surface(const ShapeSet& shapes, const Primitive& primitive, const Pose& body, const SurfaceOptions& options,
                    Surface& out) {
  Builder build{options, out};
  build.place(body * primitive.local);
  append_primitive(shapes, primitive, options, build);
}

void append_surface(const ShapeSet& shapes, const Shape& shape, const Pose& body, const SurfaceOptions& options,
                    Surface& out) {
  for (const Primitive& primitive : shapes.primitives(shape)) append_surface(shapes, primitive, body, options, out);
}

}  // namespace scree
