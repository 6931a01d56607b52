// The machines: a chain, a drum with grains, a table.
#pragma once

#include "rig.hpp"

namespace scree::test {

constexpr double kLink = 0.1;  // [m]

/// 100 links of 0.1 m and 0.5 kg, jointed at their ends; body 0 is the world. Level at the beginning, or hanging.
inline Rig chain(bool level, std::size_t links = 100) {
  Rig rig;
  rig.length = 0.05;
  constexpr double kMass = 0.5;
  const Vec3 along = level ? Vec3{1, 0, 0} : Vec3{0, 0, -1};
  rig.add(0.0, 0.0, {});
  for (std::size_t k = 0; k < links; ++k) {
    const Vec3 centre = (kLink * (static_cast<double>(k) + 0.5)) * along;
    const std::uint32_t body = rig.add(kMass, kMass * kLink * kLink / 12.0, centre);
    const Vec3 half = 0.5 * kLink * along;
    rig.joints.push_back({body - 1, body, k == 0 ? Vec3{} : half, -half});
  }
  return rig;
}

constexpr double kThrown = 0.2;  // forward speed of the grains [m/s]

/// A drum of 10 t on its axle along y, held by a motor, and `grains` of 1 g that are thrown on top of it.
inline Rig drum(std::size_t grains = 50) {
  Rig rig;
  constexpr double kRadius = 1.0, kGrain = 0.005;
  rig.add(0.0, 0.0, {});
  rig.add(1e4, 5e3, {});
  rig.drag = 5e4;
  for (std::size_t k = 0; k < grains; ++k) {
    const double y = 2.0 * kGrain * (static_cast<double>(k) - 0.5 * static_cast<double>(grains));
    const std::uint32_t body = rig.add(1e-3, 0.4e-3 * kGrain * kGrain, {0, y, kRadius + kGrain});
    rig.feet.push_back({1, body, kRadius, {0, 0, -kGrain}, true});
    rig.velocity[body].linear = {kThrown, 0.0, -0.5};
  }
  return rig;
}

/// A table: a plate of 20 kg, four legs fixed to it and, when `fixed`, to the floor as well: 24 rows more than needed; else they
/// stand on it.
inline Rig table(bool fixed) {
  Rig rig;
  rig.length = 0.3;
  rig.add(0.0, 0.0, {});
  const std::uint32_t plate = rig.add(20.0, 5.0, {0, 0, 0.72});
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.4, 0.4}) {
      const std::uint32_t leg = rig.add(2.0, 0.1, {x, y, 0.35});
      rig.joints.push_back({plate, leg, {x, y, -0.02}, {0, 0, 0.35}, true});
      if (fixed) {
        rig.joints.push_back({0, leg, {x, y, 0.0}, {0, 0, -0.35}, true});
      } else {
        rig.feet.push_back({0, leg, 0.0, {0, 0, -0.35}});
      }
    }
  }
  return rig;
}

}  // namespace scree::test
