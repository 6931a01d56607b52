#include "metal_corona.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

#include "scree/base/require.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kChunk = 2048;  // bodies of one task
constexpr std::size_t kBatch = 256;   // points of one call of the electric field: 12 kB, within the first cache

double sign_of(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

}  // namespace

MetalCorona::MetalCorona(const Options& options)
    : field_name_{options.text("electric_field")},
      grounded_names_{options.texts("grounded")},
      permittivity_{options.number("air_permittivity")},
      force_factor_{options.number("force_factor")} {}

std::vector<Parameter> MetalCorona::parameters() {
  return {
      Parameter::choice("model", {"paper"}, "how metal is charged: at once while it touches a grounded body")
          .by_default("paper"),
      Parameter::text("electric_field", "name of the electric field of the scene"),
      Parameter::texts("grounded", "names of the grounded bodies that charge metal by contact"),
      Parameter::number("air_permittivity", "F/m", "permittivity of the air").above(0.0).by_default(8.85941e-12),
      Parameter::number("force_factor", "1", "force over charge times undisturbed field").above(0.0).by_default(0.832),
  };
}

void MetalCorona::setup(SceneServices& services) {
  field_ = &services.electric_field(field_name_);
  executor_ = &services.executor();
  grounded_.clear();
  for (const std::string& name : grounded_names_) grounded_.push_back(services.body(name).id);
  charge_ = services.provide_attribute(
      {"charge_induced", "C", "charge of the metal part of a grain, taken from grounded bodies", 0.0, {}});
  metal_fraction_ = services.require_attribute("metal_fraction", "1", "part of a grain that is metal, 0 to 1");
}

void MetalCorona::add_forces(const BodyView& bodies, double time, WrenchView out) const {
  SCREE_REQUIRE(field_ != nullptr, "metal_corona: setup() comes before add_forces()");
  const auto chunk = [&](std::size_t first, std::size_t last) { add_forces_of(bodies, time, first, last, out); };
  executor_->for_chunks(bodies.size(), kChunk, std::cref(chunk));
}

// The charged grains of a range, a batch of field points at a time.
void MetalCorona::add_forces_of(const BodyView& bodies, double time, std::size_t first, std::size_t last,
                                WrenchView out) const {
  const std::span<const double> charge = bodies.attribute(charge_);
  std::array<std::size_t, kBatch> index;
  std::array<Vec3, kBatch> centre;
  std::array<Vec3, kBatch> field;
  while (first < last) {
    std::size_t count = 0;
    for (; first < last && count < kBatch; ++first) {
      if (charge[first] == 0.0 || bodies.motion[first] != Motion::dynamic) continue;
      index[count] = first;
      centre[count++] = bodies.position[first];
    }
    field_->evaluate({centre.data(), count}, time, {field.data(), count}, {});
    for (std::size_t k = 0; k < count; ++k) out.force[index[k]] += force_factor_ * charge[index[k]] * field[k];
  }
}

void MetalCorona::advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
                          double) {
  find_grounded(bodies);
  collect_pushes(bodies, contacts);
  centre_.clear();
  for (const BodyIndex i : touching_) centre_.push_back(bodies.position[i]);
  field_there_.resize(centre_.size());
  field_->evaluate(centre_, time, field_there_, {});

  const std::span<double> charge = attributes.column(charge_);
  const std::span<const double> metal = attributes.column(metal_fraction_);
  for (std::size_t k = 0; k < touching_.size(); ++k) {
    const BodyIndex i = touching_[k];
    const double r = bodies.radius[i];
    const double sign = sign_of(dot(field_there_[k], push_[i]));
    charge[i] = metal[i] * sign * 2.0 / 3.0 * kPi * kPi * kPi * permittivity_ * r * r * norm(field_there_[k]);
    push_[i] = {};
  }
}

void MetalCorona::find_grounded(const BodyView& bodies) {
  grounded_index_.clear();
  for (const BodyId id : grounded_) {
    const auto found = std::lower_bound(bodies.id.begin(), bodies.id.end(), id);
    if (found == bodies.id.end() || *found != id) continue;  // removed from the scene meanwhile
    grounded_index_.push_back(static_cast<BodyIndex>(found - bodies.id.begin()));
  }
}

// Sums, for every grain with metal in it, the normal impulses that grounded bodies gave it.
void MetalCorona::collect_pushes(const BodyView& bodies, const ContactView& contacts) {
  const std::span<const double> metal = bodies.attribute(metal_fraction_);
  const auto grounded = [this](BodyIndex i) {
    return std::find(grounded_index_.begin(), grounded_index_.end(), i) != grounded_index_.end();
  };
  touching_.clear();
  if (push_.size() < bodies.size()) push_.resize(bodies.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double impulse = std::abs(contacts.impulse[k].x);  // cohesion pulls, and touches too
    if (impulse == 0.0) continue;
    const Contact& contact = contacts.contact[k];
    const bool a_grounded = grounded(contact.a);
    if (a_grounded == grounded(contact.b)) continue;
    const BodyIndex grain = a_grounded ? contact.b : contact.a;
    if (bodies.motion[grain] != Motion::dynamic || metal[grain] == 0.0) continue;
    if (push_[grain] == Vec3{}) touching_.push_back(grain);
    push_[grain] += (a_grounded ? impulse : -impulse) * contact.normal;
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, scree::MetalCorona>(
      "metal_corona", "Metal grains charged by grounded bodies and pulled by an electric field.",
      scree::MetalCorona::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("metal_corona", "1.0.0", &list)};
