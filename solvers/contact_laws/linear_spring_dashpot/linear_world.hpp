// A linear law and its material, for tests.
#pragma once

#include <memory>
#include <string>

#include "linear_spring_dashpot.hpp"
#include "scree/config/validate.hpp"
#include "support/contact_drive.hpp"
#include "support/fake_scene_services.hpp"

namespace scree::test {

/// Set up for one material.
inline std::unique_ptr<LinearSpringDashpot> linear_law(const std::string& toml, const ContactMaterial& contact,
                                                       FakeSceneServices& services) {
  services.materials().add({.name = "glass", .density = 2500.0, .contact = contact, .attributes = {}});
  auto law = std::make_unique<LinearSpringDashpot>(options_from_text(toml, LinearSpringDashpot::parameters()));
  law->setup(services);
  return law;
}

inline std::unique_ptr<LinearSpringDashpot> linear_law(const std::string& toml, const ContactMaterial& contact) {
  FakeSceneServices services;
  return linear_law(toml, contact, services);
}

}  // namespace scree::test
