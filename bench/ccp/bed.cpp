#include "bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <unordered_map>

#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::bench {

namespace {

constexpr std::size_t kWalls = BedProblem::kWalls;
constexpr double kReach = 0.02;  // of a radius
constexpr double kStep = 1e-3;   // [s]

struct Wall {
  Vec3 normal;
  double offset;
};

std::array<Wall, kWalls> walls_of(const Bed& bed) {
  const double half = 0.5 * bed.side;
  return {{{{0, 0, 1}, 0.0}, {{1, 0, 0}, -half}, {{-1, 0, 0}, -half}, {{0, 1, 0}, -half}, {{0, -1, 0}, -half}}};
}

// Bodies 0 .. 4 are the walls, the spheres follow.
std::vector<Contact> contacts_of(const Bed& bed) {
  std::vector<Contact> out;
  const auto walls = walls_of(bed);
  for (BodyIndex w = 0; w < kWalls; ++w) {
    for (BodyIndex i = 0; i < bed.position.size(); ++i) {
      const Vec3 x = bed.position[i];
      const double gap = dot(walls[w].normal, x) - walls[w].offset - bed.radius[i];
      if (gap > kReach * bed.radius[i]) continue;
      out.push_back({w, static_cast<BodyIndex>(kWalls + i), 0, 0, 0, x - (bed.radius[i] + 0.5 * gap) * walls[w].normal,
                     walls[w].normal, gap});
    }
  }
  const double cell = 2.05 * *std::max_element(bed.radius.begin(), bed.radius.end());
  const auto key = [](std::int64_t x, std::int64_t y, std::int64_t z) {
    return (x * 73856093) ^ (y << 21) ^ (z << 42);
  };
  const auto at = [cell](double x) { return static_cast<std::int64_t>(std::floor(x / cell)) + 1000; };
  std::unordered_map<std::int64_t, std::vector<BodyIndex>> grid;
  for (BodyIndex i = 0; i < bed.position.size(); ++i) {
    const Vec3 p = bed.position[i];
    grid[key(at(p.x), at(p.y), at(p.z))].push_back(i);
  }
  for (BodyIndex i = 0; i < bed.position.size(); ++i) {
    const Vec3 p = bed.position[i];
    const std::size_t first = out.size();
    for (int n = 0; n < 27; ++n) {
      const auto found = grid.find(key(at(p.x) + n % 3 - 1, at(p.y) + n / 3 % 3 - 1, at(p.z) + n / 9 - 1));
      if (found == grid.end()) continue;
      for (const BodyIndex j : found->second) {
        if (j <= i) continue;
        const Vec3 apart = bed.position[j] - p;
        const double gap = norm(apart) - bed.radius[i] - bed.radius[j];
        if (gap > kReach * std::min(bed.radius[i], bed.radius[j])) continue;
        const Vec3 normal = normalized(apart);
        out.push_back({static_cast<BodyIndex>(kWalls + i), static_cast<BodyIndex>(kWalls + j), 0, 0, 0,
                       p + (bed.radius[i] + 0.5 * gap) * normal, normal, gap});
      }
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
              [](const Contact& a, const Contact& b) { return a.b < b.b; });
  }
  return out;
}

}  // namespace

Bed read_bed(const std::filesystem::path& file) {
  std::ifstream in{file};
  std::size_t count = 0;
  Bed bed;
  in >> count >> bed.side;
  for (std::size_t i = 0; i < count && in; ++i) {
    Vec3 p, v;
    double r = 0.0;
    in >> p.x >> p.y >> p.z >> r >> v.x >> v.y >> v.z;
    bed.position.push_back(p);
    bed.radius.push_back(r);
    bed.velocity.push_back(v);
  }
  if (!in || count == 0) throw std::runtime_error{"cannot read a bed from " + file.string()};
  return bed;
}

Bed synthetic_bed(std::size_t count) {
  const auto edge = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(count))));
  constexpr double kRadius = 5e-3;
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> jitter{-1e-3, 1e-3};
  Bed bed;
  bed.side = 2 * kRadius * static_cast<double>(edge);
  for (std::size_t z = 0; z < edge; ++z) {
    for (std::size_t y = 0; y < edge; ++y) {
      for (std::size_t x = 0; x < edge; ++x) {
        const auto along = [&](std::size_t k) { return kRadius * (2 * static_cast<double>(k) + 1 + jitter(random)); };
        bed.position.push_back({along(x) - 0.5 * bed.side, along(y) - 0.5 * bed.side, along(z)});
        bed.radius.push_back(kRadius);
        bed.velocity.push_back({});
      }
    }
  }
  return bed;
}

BedProblem::BedProblem(const Bed& bed) {
  const std::size_t n = kWalls + bed.position.size();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::vector<BodyId> id(n);
  std::vector<Motion> motion(n, Motion::fixed);
  std::vector<std::uint32_t> shape(n, 0), material(n, 0);
  std::vector<Vec3> position(n), velocity(n), angular(n), inertia(n, Vec3{kInfinite, kInfinite, kInfinite}), free(n);
  std::vector<Quat> orientation(n);
  std::vector<double> mass(n, kInfinite), radius(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    id[k] = k;
    if (k < kWalls) continue;
    const double r = bed.radius[k - kWalls];
    motion[k] = Motion::dynamic;
    position[k] = bed.position[k - kWalls];
    velocity[k] = bed.velocity[k - kWalls];
    free[k] = velocity[k] + kStep * Vec3{0, 0, -9.81};
    radius[k] = r;
    mass[k] = 1000.0 * 4.0 / 3.0 * std::numbers::pi * r * r * r;
    const double j = 0.4 * mass[k] * r * r;
    inertia[k] = {j, j, j};
  }
  Materials materials;
  materials.add({"grain", 1000.0, {.friction = 0.5}, {}});
  materials.set_pair(0, 0, {.friction = 0.5});
  Attributes attributes;
  const BodyView view{id,       motion,  shape, material, position, orientation,
                      velocity, angular, mass,  inertia,  radius,   &attributes};
  // Overlaps of a jammed bed cannot all be undone at once: asking for it makes the problem infeasible.
  assembly_.build({view, free, angular}, contacts_of(bed), materials, {.recovery_speed = 0.0}, kStep, Executor{1});
}

std::vector<std::uint32_t> BedProblem::found() const {
  std::vector<std::uint32_t> order;
  for (std::size_t k = 0; k < assembly_.contacts().size(); ++k) {
    order.push_back(static_cast<std::uint32_t>(assembly_.first_row(k) / 3));
  }
  return order;
}

}  // namespace scree::bench
