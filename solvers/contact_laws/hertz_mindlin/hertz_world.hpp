// A law of elastic spheres and its materials, for tests.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "hertz_mindlin.hpp"
#include "scree/config/validate.hpp"
#include "support/contact_drive.hpp"
#include "support/fake_scene_services.hpp"

namespace scree::test {

/// A material by its elastic constants [Pa], [1] and density [kg/m3].
inline Material elastic(const std::string& name, double young, double poisson, double density,
                        const ContactMaterial& contact) {
  return {.name = name,
          .density = density,
          .contact = contact,
          .attributes = {},
          .young_modulus = young,
          .poisson_ratio = poisson};
}

/// Material 0 is `ball`; 1 the rigid `wall`, with the same contact parameters.
struct HertzWorld {
  HertzWorld(const std::string& toml, const Material& ball) {
    services.materials().add(ball);
    services.materials().add({.name = "wall", .density = 1.0, .contact = ball.contact, .attributes = {}});
    law = std::make_unique<HertzMindlin>(options_from_text("rigid = [\"wall\"]\n" + toml, HertzMindlin::parameters()));
    law->setup(services);
  }
  /// A ball of radius r [m] that touches the wall.
  [[nodiscard]] DrivenBall touching(double r, const Vec3& velocity) const {
    return {.position = {0, 0, r}, .velocity = velocity, .radius = r, .mass = mass(r)};
  }
  [[nodiscard]] double mass(double r) const {
    return services_materials()[0].density * 4.0 / 3.0 * std::numbers::pi * r * r * r;
  }
  /// A ball that meets the wall.
  [[nodiscard]] ContactDrive on_wall(const DrivenBall& ball) const {
    ContactDrive drive{*law, ball};
    drive.materials = 2;  // the wall is a, the ball b: 1 * 2 + 0
    return drive;
  }
  [[nodiscard]] const Materials& services_materials() const {
    return const_cast<FakeSceneServices&>(services).materials();  // the fake has no const way to them
  }

  FakeSceneServices services;
  std::unique_ptr<HertzMindlin> law;
};

}  // namespace scree::test
