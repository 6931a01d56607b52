// ForceField: forces on bodies that do not come from contacts, such as gravity,
// drag and electrostatics.
//
// A complete field:
//
//     class Wind final : public scree::ForceField {
//      public:
//       explicit Wind(const scree::Options& o) : push_{o.vector("push")} {}
//       void add_forces(const scree::BodyView& bodies, double,
//       scree::WrenchView out) const override {
//         for (std::size_t i = 0; i < bodies.size(); ++i) out.force[i] +=
//         bodies.mass[i] * push_;
//       }
//      private:
//       scree::Vec3 push_;  // [m/s2]
//     };
#pragma once

#include "scree/collision/contact.hpp"
#include "scree/interfaces/plugin.hpp"
#include "scree/model/body.hpp"

namespace scree {

class SceneServices;

/// One force on all bodies. A call handles every body at once.
class ForceField : public Plugin {
 public:
  static constexpr const char* kKind = "force_field";
  ~ForceField() override;

  /// Called once, after all materials, shapes and electric fields exist.
  virtual void setup(SceneServices& services);

  /// Adds this field's forces [N] and torques [N m] to `out`; never sets, never
  /// reads it. Entries of bodies that do not move by forces are ignored.
  virtual void add_forces(const BodyView& bodies, double time, WrenchView out) const = 0;

  /// True when the wrench depends on neither place, motion nor time, and advance() has nothing to do: steppers that divide the
  /// outer step then ask for it once, and nobody asks for contacts on its behalf.
  [[nodiscard]] virtual bool is_steady() const { return false; }
  /// True when potential_energy() is meaningful.
  [[nodiscard]] virtual bool is_conservative() const { return false; }
  /// Potential energy of all bodies in this field [J]; force = - d/dx of it.
  [[nodiscard]] virtual double potential_energy(const BodyView& bodies, double time) const;

  /// Advances the field's own state (charges by contact, by age, ...) at the
  /// end of a step, in scene order. `time` is the end of the step [s]; the
  /// indices in `contacts` are those of `bodies`.
  virtual void advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
                       double dt);
};

}  // namespace scree
