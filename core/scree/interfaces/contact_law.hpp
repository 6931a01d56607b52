// ContactLaw: the forces of soft contacts, for steppers of the discrete element method.
//
// A stepper finds contacts and hands them over in batches. A law fills in forces; which body feels them, and how they are
// summed, is the stepper's business, so that a law is arithmetic over arrays and nothing else:
//
//     void forces(ContactBatch& batch) const override {
//       for (std::size_t k = 0; k < batch.count; ++k) {
//         const double push = stiffness_ * std::max(batch.overlap[k], 0.0);
//         batch.force.set(k, push * batch.normal[k]);
//       }
//     }
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scree/interfaces/plugin.hpp"
#include "scree/math/vec3.hpp"

namespace scree {

class SceneServices;

/// Contacts side by side, up to kMost: item k of every array belongs to contact k. Components of vectors lie apart, so that a
/// loop over contacts becomes one over vector registers.
struct ContactBatch {
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kMostHistory = 12;

  using Lane = std::array<double, kMost>;
  struct Lanes3 {
    alignas(64) Lane x, y, z;

    /// The vector of contact k [its lanes' unit].
    Vec3 operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
    /// Sets it [its lanes' unit].
    void set(std::size_t k, const Vec3& v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
  };

  std::size_t count = 0;

  // What a law reads.
  alignas(64) Lane overlap;  ///< [m]; negative for bodies apart by less than ContactLaw::reach()
  alignas(64) Lane radius;   ///< effective, 1 / (1/ra + 1/rb); of one body against a flat or hollow one its own [m]
  alignas(64) Lane mass;     ///< effective, of what moves by forces [kg]
  Lanes3 normal;             ///< unit, from a to b [1], world
  Lanes3 velocity;           ///< of b's surface relative to a's where they touch [m/s], world
  Lanes3 spin;               ///< angular velocity of b relative to a [rad/s], world; filled where resists_rolling()
  std::array<std::uint32_t, kMost> materials;  ///< material of a times the number of materials, plus that of b
  /// Springs. What a law integrates over time, s' = v, it keeps half a step ahead of the bodies. At a call
  ///     s = history + ahead v   is the spring now, and   s + lead v   what it writes back,
  /// which is the trapezoidal rule with one velocity a step. `ahead` is half a step in a step; minus that when forces are
  /// asked for again without a step; and the time since the surfaces met, where the contact is new (then history is zero).
  alignas(64) Lane ahead;                  ///< [s]
  double lead = 0.0;                       ///< [s], half a step
  std::array<Lane, kMostHistory> history;  ///< ContactLaw::history_size() doubles a contact; zero where it is new

  // What a law writes.
  Lanes3 force;   ///< on b, and its opposite on a, each at its own surface [N], world
  Lanes3 torque;  ///< on b, and its opposite on a, beside the force's: resistance to rolling and spinning [N m], world
};

/// The stiffest contact of two materials in a scene, for the time step.
struct ContactScale {
  std::uint32_t material_a = 0, material_b = 0;
  double mass = 0.0;    ///< smallest effective one [kg]
  double radius = 0.0;  ///< smallest effective one [m]
  double speed = 0.0;   ///< greatest with which two bodies may meet [m/s]
};

/// A law of soft contacts.
class ContactLaw : public Plugin {
 public:
  static constexpr const char* kKind = "contact_law";
  ~ContactLaw() override;

  /// Called once, when all materials exist.
  virtual void setup(SceneServices& services);

  /// Doubles that a contact keeps from step to step, at most ContactBatch::kMostHistory. They start at zero when surfaces meet,
  /// and are forgotten when they are apart by more than reach().
  [[nodiscard]] virtual std::size_t history_size() const { return 0; }
  /// Greatest gap [m] at which a contact still acts, over all pairs with an effective radius of up to `radius` [m]: the neck
  /// of an adhesive contact. 0 for a law without tension beyond the surfaces.
  [[nodiscard]] virtual double reach([[maybe_unused]] double radius) const { return 0.0; }
  /// True when `torque` may differ from zero: ContactMaterial::rolling_friction and spinning_friction act.
  [[nodiscard]] virtual bool resists_rolling() const { return false; }
  /// True when bodies attract each other: ContactMaterial::surface_energy or cohesion_energy_density act.
  [[nodiscard]] virtual bool coheres() const { return false; }
  /// The longest step [s] that resolves this contact.
  [[nodiscard]] virtual double stable_step(const ContactScale& contact) const = 0;

  /// Fills in force and torque of the contacts 0 .. batch.count - 1. Called from several threads at once with different
  /// batches.
  virtual void forces(ContactBatch& batch) const = 0;
};

}  // namespace scree
