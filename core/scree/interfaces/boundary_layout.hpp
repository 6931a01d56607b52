// One number for the layout of everything that passes between the host and a plugin.
//
// Two builds that agree on the compiler may still disagree on a struct: another version of a header, another packing
// flag. The digest holds the size and alignment of every boundary struct and the offsets of the members of those that
// are read in loops, so that exchanging two members of one type shows too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "scree/ccp/problem.hpp"
#include "scree/collision/collider.hpp"
#include "scree/collision/contact.hpp"
#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"
#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/model/body_store.hpp"
#include "scree/model/material.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// Collects numbers into 64 bits (FNV-1a, Fowler, Noll and Vo).
class LayoutDigest {
 public:
  /// Size and alignment of `Record`, and where its listed members begin [byte].
  template <class Record>
  constexpr void add(std::initializer_list<std::size_t> offsets = {}) {
    add_number(sizeof(Record));
    add_number(alignof(Record));
    for (const std::size_t offset : offsets) add_number(offset);
  }
  [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

 private:
  constexpr void add_number(std::uint64_t number) {
    for (int byte = 0; byte < 8; ++byte) {
      value_ = (value_ ^ ((number >> (8 * byte)) & 0xff)) * 0x100000001b3;
    }
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// The structs of a contact problem.
constexpr void add_contact_problem(LayoutDigest& digest) {
  digest.add<CcpContact>({offsetof(CcpContact, normal), offsetof(CcpContact, arm_a), offsetof(CcpContact, arm_b),
                          offsetof(CcpContact, friction), offsetof(CcpContact, a), offsetof(CcpContact, b)});
  digest.add<CcpProblem>({offsetof(CcpProblem, inverse_mass), offsetof(CcpProblem, inverse_inertia),
                          offsetof(CcpProblem, contacts), offsetof(CcpProblem, r), offsetof(CcpProblem, compliance),
                          offsetof(CcpProblem, blocks), offsetof(CcpProblem, block_rows),
                          offsetof(CcpProblem, matrix)});
  digest.add<CcpBlock>({offsetof(CcpBlock, kind), offsetof(CcpBlock, rows), offsetof(CcpBlock, first_row),
                        offsetof(CcpBlock, a), offsetof(CcpBlock, b), offsetof(CcpBlock, friction),
                        offsetof(CcpBlock, spinning), offsetof(CcpBlock, rolling), offsetof(CcpBlock, lower),
                        offsetof(CcpBlock, upper)});
  digest.add<CcpRow>({offsetof(CcpRow, a), offsetof(CcpRow, b)});
  digest.add<CcpMatrix>({offsetof(CcpMatrix, first), offsetof(CcpMatrix, column), offsetof(CcpMatrix, value),
                         offsetof(CcpMatrix, values)});
}

/// What is made, asked for and reported once a call.
constexpr void add_rare_records(LayoutDigest& digest) {
  digest.add<Parameter>();
  digest.add<Variant>();
  digest.add<Options>();
  digest.add<Attributes>();
  digest.add<AttributeInfo>();
  digest.add<Material>();
  digest.add<Materials>();
  digest.add<NewBody>();
  digest.add<NamedBody>();
  digest.add<RemovedBody>();
  digest.add<Observation>();
  digest.add<ReportTable>();
  digest.add<RandomStream>();
  digest.add<Shape>();
  digest.add<ShapeData>();
  digest.add<PrimitiveData>();
  digest.add<ShapeSet>();
  digest.add<SolveContext>();
  digest.add<SolveSummary>();
  digest.add<StepSummary>();
}

/// The digest of the code being compiled.
constexpr std::uint64_t boundary_layout() {
  LayoutDigest digest;
  // Columns and records that loops walk over.
  digest.add<BodyView>({offsetof(BodyView, id), offsetof(BodyView, motion), offsetof(BodyView, shape),
                        offsetof(BodyView, material), offsetof(BodyView, position), offsetof(BodyView, orientation),
                        offsetof(BodyView, velocity), offsetof(BodyView, angular_velocity), offsetof(BodyView, mass),
                        offsetof(BodyView, inertia), offsetof(BodyView, radius), offsetof(BodyView, attributes)});
  digest.add<BodyState>({offsetof(BodyState, view), offsetof(BodyState, position), offsetof(BodyState, orientation),
                         offsetof(BodyState, velocity), offsetof(BodyState, angular_velocity)});
  digest.add<WrenchView>({offsetof(WrenchView, force), offsetof(WrenchView, torque)});
  digest.add<Contact>({offsetof(Contact, a), offsetof(Contact, b), offsetof(Contact, primitive_a),
                       offsetof(Contact, primitive_b), offsetof(Contact, feature), offsetof(Contact, point),
                       offsetof(Contact, normal), offsetof(Contact, gap)});
  digest.add<ContactView>({offsetof(ContactView, contact), offsetof(ContactView, impulse),
                           offsetof(ContactView, velocity_before), offsetof(ContactView, velocity_after),
                           offsetof(ContactView, angular_impulse), offsetof(ContactView, age),
                           offsetof(ContactView, work), offsetof(ContactView, loads)});
  digest.add<ContactLoad>(
      {offsetof(ContactLoad, impulse), offsetof(ContactLoad, angular_impulse), offsetof(ContactLoad, work)});
  add_contact_problem(digest);
  digest.add<ColliderView>({offsetof(ColliderView, key), offsetof(ColliderView, body),
                            offsetof(ColliderView, primitive), offsetof(ColliderView, pose),
                            offsetof(ColliderView, movable), offsetof(ColliderView, ball)});
  digest.add<BoxView>({offsetof(BoxView, key), offsetof(BoxView, box), offsetof(BoxView, movable),
                       offsetof(BoxView, owner), offsetof(BoxView, ball), offsetof(BoxView, margin)});
  digest.add<Primitive>({offsetof(Primitive, local), offsetof(Primitive, size), offsetof(Primitive, bounding_radius)});
  digest.add<ContactMaterial>({offsetof(ContactMaterial, friction), offsetof(ContactMaterial, restitution),
                               offsetof(ContactMaterial, rolling_friction),
                               offsetof(ContactMaterial, spinning_friction), offsetof(ContactMaterial, compliance),
                               offsetof(ContactMaterial, damping), offsetof(ContactMaterial, surface_energy),
                               offsetof(ContactMaterial, cohesion_energy_density)});
  digest.add<ContactBatch>({offsetof(ContactBatch, overlap), offsetof(ContactBatch, normal),
                            offsetof(ContactBatch, velocity), offsetof(ContactBatch, ahead),
                            offsetof(ContactBatch, history), offsetof(ContactBatch, force)});
  digest.add<Vec3>({offsetof(Vec3, x), offsetof(Vec3, y), offsetof(Vec3, z)});
  digest.add<Quat>({offsetof(Quat, w), offsetof(Quat, x), offsetof(Quat, y), offsetof(Quat, z)});
  digest.add<Mat3>();
  digest.add<Pose>({offsetof(Pose, position), offsetof(Pose, orientation)});
  digest.add<Aabb>();
  digest.add<ColliderPair>();
  digest.add<CandidatePair>();
  digest.add<BodyPair>();
  digest.add<NeighbourView>();
  digest.add<ContactScale>();
  add_rare_records(digest);
  return digest.value();
}

}  // namespace scree
