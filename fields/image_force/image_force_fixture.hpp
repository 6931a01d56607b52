// What the tests of image_force share: a roll along z in a uniform field, and grains of 1 mm radius.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "image_force.hpp"
#include "scree/config/validate.hpp"
#include "support/fake_electric_field.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRollRadius = 0.16;                      // [m]
inline constexpr double kGrainRadius = 1e-3;                     // [m]
inline constexpr double kStrength = 281581.72785;                // 9.386057595 * 30 kV [V/m]
inline constexpr double kVacuumPermittivity = 8.8541878128e-12;  // [F/m]
inline constexpr double kAirPermittivity = 8.85941e-12;          // [F/m]

/// Pauthenier's limit of a grain of kGrainRadius with er = 2.5 at kStrength (eq. 13) [C].
inline const double kPauthenier =
    3.0 * kPi * kVacuumPermittivity * 4.0 * kGrainRadius * kGrainRadius * kStrength * 2.5 / 4.5;
/// Its image force (eq. 12) [N].
inline const double kImageForce =
    kPauthenier * kPauthenier / (4.0 * kPi * kAirPermittivity * 4.0 * kGrainRadius * kGrainRadius);

/// Settings with which the upper quarter of the roll, 45 to 135 degrees, charges.
inline const std::string kTopCharges =
    "charging_zone = {type = 'sector', from = '45 deg', to = '135 deg', outer_radius = '170 mm'}\n";

/// The roll is body 10, index 0, at the origin; grains come after it.
struct ImageForceScene {
  explicit ImageForceScene(const std::string& more = "", int threads = 1, const std::string& zone = kTopCharges)
      : electric{{0.0, kStrength, 0.0}},
        services{threads},
        field{options_from_text("electric_field = 'gap'\nroll = 'roll'\n" + zone + more, ImageForce::parameters())},
        bodies{services.attributes()} {
    ShapeData cylinder;
    cylinder.name = "drum";
    cylinder.primitives.emplace_back();
    cylinder.primitives[0].primitive.kind = ShapeKind::cylinder;
    cylinder.primitives[0].primitive.size = {kRollRadius, 0.15, 0.0};
    services.shapes().add(cylinder);
    services.add_electric_field("gap", electric);
    services.add_body("roll", {.id = 10, .pose = {}, .shape = "drum"});
    field.setup(services);
    bodies.add_immovable(10, {});
  }
  /// A grain at an angle on the roll [degrees], with a gap to it and a place along its axis [m].
  std::size_t add_grain(double degrees, double gap = 0.0, double along = 0.0, double radius = kGrainRadius) {
    const double distance = kRollRadius + radius + gap;
    const double angle = degrees * kPi / 180.0;
    return bodies.add_sphere(20 + bodies.id.size(), {distance * std::cos(angle), distance * std::sin(angle), along},
                             radius, 946.0);
  }
  std::span<double> column(const char* name) { return services.attributes().column(services.attributes().id(name)); }
  double& charge(std::size_t i) { return column("charge_corona")[i]; }
  Vec3 force(std::size_t i) {
    field.add_forces(bodies.view(), 0.0, bodies.wrenches());
    return bodies.force[i];
  }
  /// One step of 1 ms in which grain `touching` (0: none) is pressed against the roll with `impulse` [N s].
  void step(std::size_t touching = 0, double impulse = 1e-6) {
    Contact contact;
    contact.b = static_cast<BodyIndex>(touching);
    const Vec3 push{impulse, 0.0, 0.0};
    const Vec3 still;
    const std::size_t n = touching == 0 ? 0 : 1;
    field.advance(bodies.view(), {{&contact, n}, {&push, n}, {&still, n}, {&still, n}}, services.attributes(), 0.0,
                  1e-3);
  }

  FakeElectricField electric;
  FakeSceneServices services;
  ImageForce field;
  TestBodies bodies;
};

}  // namespace scree::test
