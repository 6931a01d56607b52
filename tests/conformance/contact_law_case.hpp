// What the suite of contact laws needs: materials, contacts of all sizes, and the same contacts seen otherwise.
#pragma once

#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "scree/interfaces/contact_law.hpp"
#include "scree/math/quat.hpp"
#include "support/fake_scene_services.hpp"

namespace scree::test {

/// One way to make a contact law.
struct ContactLawCase {
  std::string name;
  std::function<std::unique_ptr<ContactLaw>()> make;  ///< setup() not called
};

/// Two elastic materials with all kinds of friction and cohesion.
inline void add_contact_materials(FakeSceneServices& services) {
  const ContactMaterial contact{.friction = 0.4,
                                .restitution = 0.6,
                                .rolling_friction = 1e-4,
                                .spinning_friction = 5e-5,
                                .surface_energy = 0.02,
                                .cohesion_energy_density = 1e4};
  for (const auto& [name, young] : {std::pair{"soft", 1e7}, std::pair{"stiff", 1e9}}) {
    services.materials().add({.name = name,
                              .density = 2500.0,
                              .contact = contact,
                              .attributes = {},
                              .young_modulus = young,
                              .poisson_ratio = 0.3});
  }
}
constexpr std::uint32_t kContactMaterials = 2;

/// Fills contact k with a new one, drawn from `random`; `scale` 1 for grains of a millimetre.
inline void draw_contact(ContactBatch& batch, std::size_t k, std::mt19937_64& random, double scale = 1.0) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> part;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  const double radius = 1e-3 * scale * (0.5 + part(random));
  batch.radius[k] = radius;
  batch.mass[k] = 1e4 * radius * radius * radius;
  batch.overlap[k] = 0.02 * radius * part(random);
  batch.normal.set(k, normalized(any()));
  batch.velocity.set(k, 0.1 * any());
  batch.spin.set(k, 10.0 * any());
  batch.materials[k] = static_cast<std::uint32_t>(part(random) * kContactMaterials * kContactMaterials);
  batch.ahead[k] = 5e-7;
  for (ContactBatch::Lane& lane : batch.history) lane[k] = 0.0;
}

inline std::unique_ptr<ContactBatch> draw_batch(std::size_t count, unsigned seed, double scale = 1.0) {
  std::mt19937_64 random{seed};
  auto batch = std::make_unique<ContactBatch>();
  batch->count = count;
  batch->lead = 5e-7;
  for (std::size_t k = 0; k < count; ++k) draw_contact(*batch, k, random, scale);
  return batch;
}

/// Copies contact `from` of one batch to place `to` of another.
inline void copy_contact(const ContactBatch& source, std::size_t from, ContactBatch& out, std::size_t to) {
  out.overlap[to] = source.overlap[from], out.radius[to] = source.radius[from], out.mass[to] = source.mass[from];
  out.normal.set(to, source.normal[from]);
  out.velocity.set(to, source.velocity[from]);
  out.spin.set(to, source.spin[from]);
  out.materials[to] = source.materials[from];
  out.ahead[to] = source.ahead[from];
  for (std::size_t slot = 0; slot < ContactBatch::kMostHistory; ++slot)
    out.history[slot][to] = source.history[slot][from];
}

/// Makes b the first body of each contact.
inline void swap_bodies(ContactBatch& batch) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    batch.normal.set(k, -batch.normal[k]);
    batch.velocity.set(k, -batch.velocity[k]);
    batch.spin.set(k, -batch.spin[k]);
    batch.materials[k] =
        batch.materials[k] % kContactMaterials * kContactMaterials + batch.materials[k] / kContactMaterials;
  }
}

/// Turns each contact in the world.
inline void turn(ContactBatch& batch, const Quat& q) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    batch.normal.set(k, rotate(q, batch.normal[k]));
    batch.velocity.set(k, rotate(q, batch.velocity[k]));
    batch.spin.set(k, rotate(q, batch.spin[k]));
  }
}

/// Another motion for each contact, as in the step after: a little deeper or less deep, a little slower.
inline void move_on(ContactBatch& batch) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    batch.overlap[k] *= k % 2 == 0 ? 1.01 : 0.98;
    batch.velocity.set(k, 0.9 * batch.velocity[k]);
    batch.spin.set(k, 0.8 * batch.spin[k]);
  }
}

}  // namespace scree::test
