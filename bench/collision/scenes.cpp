#include "scenes.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>

#include "bed.hpp"
#include "scree/geometry/convex_hull.hpp"

namespace scree::bench {
namespace {

constexpr double kDiameter = 5e-3;  // of a grain [m]

/// Draws numbers and adds bodies.
class Builder {
 public:
  explicit Builder(Scene& scene) : scene_{scene} {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>{from, to}(random_); }
  Vec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Quat turn() {
    std::normal_distribution<double> normal;
    return normalized(Quat{normal(random_), normal(random_), normal(random_), normal(random_)});
  }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalized(Vec3{normal(random_), normal(random_), normal(random_)});
  }

  static PrimitiveData primitive(ShapeKind kind, const Vec3& size, bool hollow = false) {
    PrimitiveData data;
    data.primitive.kind = kind;
    data.primitive.size = size;
    data.primitive.hollow = hollow;
    return data;
  }
  /// 16 points on a sphere.
  PrimitiveData hull(double r) {
    std::vector<Vec3> points(16);
    for (Vec3& p : points) p = r * direction();
    const ConvexHull made = convex_hull(points);
    PrimitiveData data = primitive(ShapeKind::convex_hull, {});
    data.vertices = made.vertices;
    data.faces = made.faces;
    data.triangles = made.triangles;
    return data;
  }
  /// Eight spheres along a bent line.
  PrimitiveData cluster(double r) {
    PrimitiveData data = primitive(ShapeKind::sphere_cluster, {});
    for (int k = 0; k < 8; ++k) {
      const double x = (k - 3.5) / 3.5;
      data.spheres.push_back({{0.65 * r * x, 0.2 * r * x * x, 0.0}, 0.35 * r});
    }
    return data;
  }

  void add(PrimitiveData part, double radius, const Pose& at, const Vec3& velocity, const Vec3& spin = {},
           Motion motion = Motion::dynamic) {
    ShapeData data;
    data.primitives.push_back(std::move(part));
    data.volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    NewBody body;
    body.motion = motion;
    body.shape = scene_.shapes.add(data);
    body.pose = at;
    body.velocity = velocity;
    body.angular_velocity = spin;
    body.radius = radius;
    scene_.bodies.add(body);
  }
  void add_sphere(double r, const Vec3& at, double speed) {
    add(primitive(ShapeKind::sphere, {r, 0, 0}), r, {at, {}}, in_cube(speed));
  }

 private:
  Scene& scene_;
  std::mt19937_64 random_{7};
};

using Grain = std::function<PrimitiveData(Builder&, double)>;

/// Grains in the places of a bed of spheres, `growth` times as large, on a floor.
void fill_bed(Scene& scene, std::size_t count, double growth, const Grain& grain) {
  Bed bed;
  make_bed(count, bed);
  Builder builder{scene};
  const BodyView places = bed.bodies.view();
  builder.add(Builder::primitive(ShapeKind::box, {1.0, 1.0, 0.01}), 1.0, {{0.5, 0.5, -0.5 * kDiameter - 0.01}, {}}, {},
              {}, Motion::fixed);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places.motion[i] != Motion::dynamic) continue;
    const double r = growth * places.radius[i];
    builder.add(grain(builder, r), r, {places.position[i], builder.turn()}, places.velocity[i], builder.in_cube(0.1));
  }
}

/// A few large spheres, more of middle size, and many small ones between them; radii from r to `ratio` r.
void fill_spread(Scene& scene, std::size_t count, double ratio) {
  Builder builder{scene};
  const double r = 5e-4;
  struct Ball {
    Vec3 at;
    double r;
  };
  std::vector<Ball> large;
  const double edge = 3.0 * std::cbrt(static_cast<double>(count)) * r;  // half
  for (const double size : {ratio * r, std::sqrt(ratio) * r}) {
    for (int k = 0; k < (size > edge ? 2 : 40); ++k) {
      // The largest ones reach into the cloud from outside.
      const Vec3 at = size > edge ? Vec3{0, 0, k == 0 ? -size - 0.5 * edge : size + 0.5 * edge} : builder.in_cube(edge);
      large.push_back({at, size});
      builder.add_sphere(size, at, 0.01);
    }
  }
  for (std::size_t k = large.size(); k < count;) {
    const Vec3 at = builder.in_cube(edge);
    const auto inside = [&](const Ball& ball) { return norm(at - ball.at) < ball.r + 0.3 * r; };
    if (std::any_of(large.begin(), large.end(), inside)) continue;
    builder.add_sphere(r * builder.uniform(0.8, 1.2), at, 0.01);
    ++k;
  }
}

/// A drum of which the lower third is full of grains, turning at 2 rad/s.
void fill_drum(Scene& scene, std::size_t count) {
  Builder builder{scene};
  const double length = 0.1;
  const double volume = static_cast<double>(count) * 1.05 * kDiameter * kDiameter * kDiameter;
  const double radius = std::sqrt(3.0 * volume / length / std::numbers::pi);
  builder.add(Builder::primitive(ShapeKind::cylinder, {radius, 0.5 * length, 0}, true), radius, {}, {}, {0, 0, 2.0},
              Motion::kinematic);
  while (scene.bodies.size() < count) {
    const Vec3 at{builder.uniform(-radius, radius), builder.uniform(-radius, -0.25 * radius),
                  builder.uniform(-0.48, 0.48) * length};
    if (std::hypot(at.x, at.y) > radius - 0.5 * kDiameter) continue;
    const double r = 0.5 * kDiameter * builder.uniform(0.8, 1.2);
    builder.add(Builder::primitive(ShapeKind::sphere, {r, 0, 0}), r, {at, {}}, cross({0, 0, 2.0}, at));
  }
}

/// A jet of shavings and grains that a turning roll throws over a splitter of 1 mm, at 1 to 3 m/s: nearly nothing touches.
void fill_separator(Scene& scene, std::size_t count) {
  Builder builder{scene};
  builder.add(Builder::primitive(ShapeKind::cylinder, {0.15, 0.25, 0}), 0.15, {{0, 0, 0}, {}}, {}, {0, 0, -8.0},
              Motion::kinematic);
  builder.add(Builder::primitive(ShapeKind::box, {5e-4, 0.2, 0.25}), 0.2, {{0.4, -0.45, 0}, {}}, {}, {}, Motion::fixed);
  while (scene.bodies.size() < count) {
    const double time = builder.uniform(0.0, 0.35), speed = builder.uniform(1.0, 2.0);
    const Vec3 at{speed * time, 0.152 - 4.9 * time * time + builder.uniform(0.0, 0.02), builder.uniform(-0.25, 0.25)};
    const Vec3 velocity{speed, -9.8 * time, 0.0};
    const double r = builder.uniform(5e-4, 1.5e-3);
    const bool shaving = scene.bodies.size() % 2 == 0;
    builder.add(shaving ? builder.cluster(r) : Builder::primitive(ShapeKind::sphere, {r, 0, 0}), r,
                {at, builder.turn()}, velocity, builder.in_cube(50.0));
  }
}

const std::map<std::string, std::function<void(Scene&, std::size_t)>>& makers() {
  static const std::map<std::string, std::function<void(Scene&, std::size_t)>> all{
      {"spheres",
       [](Scene& s, std::size_t n) {
         fill_bed(s, n, 1.0, [](Builder&, double r) { return Builder::primitive(ShapeKind::sphere, {r, 0, 0}); });
       }},
      {"spread_50", [](Scene& s, std::size_t n) { fill_spread(s, n, 50.0); }},
      {"spread_10000", [](Scene& s, std::size_t n) { fill_spread(s, n, 1e4); }},
      {"hulls", [](Scene& s, std::size_t n) { fill_bed(s, n, 1.12, [](Builder& b, double r) { return b.hull(r); }); }},
      {"boxes",
       [](Scene& s, std::size_t n) {
         fill_bed(s, n, 1.1, [](Builder&, double r) {
           return Builder::primitive(ShapeKind::box, Vec3{0.8, 0.6, 0.5} * r);
         });
       }},
      {"clusters",
       [](Scene& s, std::size_t n) { fill_bed(s, n, 1.1, [](Builder& b, double r) { return b.cluster(r); }); }},
      {"drum", fill_drum},
      {"separator", fill_separator}};
  return all;
}

}  // namespace

std::vector<std::string> scene_names() {
  return {"spheres", "spread_50", "spread_10000", "hulls", "boxes", "clusters", "drum", "separator"};
}

std::unique_ptr<Scene> make_scene(const std::string& name, std::size_t count) {
  const auto maker = makers().find(name);
  if (maker == makers().end()) throw std::runtime_error{"there is no scene '" + name + "'"};
  auto scene = std::make_unique<Scene>();
  scene->name = name;
  maker->second(*scene, count);
  return scene;
}

}  // namespace scree::bench
