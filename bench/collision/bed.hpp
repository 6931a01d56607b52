// A bed of grains for benchmarks: made here, or read from a file.
#pragma once

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "scree/model/body_store.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::bench {

/// Spheres with shapes of their own, on a floor.
struct Bed {
  ShapeSet shapes;
  BodyStore bodies;

  void add(const Vec3& at, double r, const Vec3& velocity) {
    ShapeData data;
    data.primitives.emplace_back();
    data.primitives[0].primitive.size.x = r;
    data.volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    NewBody body;
    body.shape = shapes.add(data);
    body.pose.position = at;
    body.velocity = velocity;
    body.radius = r;
    bodies.add(body);
  }
  void add_floor(double z) {
    ShapeData data;
    data.primitives.emplace_back();
    data.primitives[0].primitive.kind = ShapeKind::plane;
    NewBody body;
    body.motion = Motion::fixed;
    body.shape = shapes.add(data);
    body.pose.position.z = z;
    bodies.add(body);
  }
};

/// About `count` spheres of 5 mm +- 20 % at the density of a random close packing (0.64): the close-packed cubic
/// lattice, opened by 5 % and shaken, in an order without locality as after a long run. Velocities of 1 mm/s.
inline void make_bed(std::size_t count, Bed& bed) {
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> shake{-1.0, 1.0};
  const double d = 5e-3;
  const double cube = 1.05 * d * std::numbers::sqrt2;  // four spheres each
  const auto side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(count) / 4.0)));
  std::vector<Vec3> places;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        const Vec3 corner = cube * Vec3{double(x), double(y), double(z)};
        for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.5, 0, 0.5}, Vec3{0, 0.5, 0.5}}) {
          const Vec3 jitter{shake(random), shake(random), shake(random)};
          places.push_back(corner + cube * at + 0.05 * d * jitter);
        }
      }
    }
  }
  std::shuffle(places.begin(), places.end(), random);
  bed.add_floor(-0.5 * d);
  for (const Vec3& at : places) {
    const Vec3 velocity{shake(random), shake(random), shake(random)};
    bed.add(at, 0.5 * d * (1.0 + 0.2 * shake(random)), 1e-3 * velocity);
  }
}

/// A bed file: a line with the number of spheres, then x y z r vx vy vz of each [m, m/s].
inline void read_bed(const std::string& file, Bed& bed) {
  std::ifstream in{file};
  std::string header;
  if (!std::getline(in, header)) throw std::runtime_error{"cannot read the bed file " + file};
  bed.add_floor(0.0);
  Vec3 at, velocity;
  double r = 0.0;
  while (in >> at.x >> at.y >> at.z >> r >> velocity.x >> velocity.y >> velocity.z) bed.add(at, r, velocity);
}

}  // namespace scree::bench
