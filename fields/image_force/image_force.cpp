#include "image_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "scree/base/require.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kChunk = 2048;  // bodies of one task
constexpr std::size_t kBatch = 256;   // points of one call of the electric field: 12 kB, within the first cache

std::vector<Zone> zones_of(const Options& options, const char* name) {
  std::vector<Zone> zones;
  if (!options.has(name)) return zones;
  for (const Options& zone : options.tables(name)) zones.emplace_back(zone);
  return zones;
}

bool in_any(const std::vector<Zone>& zones, const Vec3& point, const RollCoordinates& there) {
  return std::any_of(zones.begin(), zones.end(), [&](const Zone& zone) { return zone.contains(point, there); });
}

}  // namespace

ImageForce::ImageForce(const Options& options)
    : field_name_{options.text("electric_field")},
      roll_name_{options.text("roll")},
      charging_zones_{zones_of(options, "charging_zone")},
      discharge_zones_{zones_of(options, "discharge_zone")},
      vacuum_permittivity_{options.number("vacuum_permittivity")},
      air_permittivity_{options.number("air_permittivity")},
      reach_{options.has("reach") ? options.number("reach") : -1.0},
      discharge_contact_age_{options.has("discharge_contact_age") ? options.number("discharge_contact_age") : -1.0} {}

std::vector<Parameter> ImageForce::parameters() {
  return {
      Parameter::choice("model", {"paper"}, "how grains are charged: at once to Pauthenier's limit")
          .by_default("paper"),
      Parameter::text("electric_field", "name of the electric field of the scene"),
      Parameter::text("roll", "name of the body that the grains are held on; its shape has a cylinder"),
      Parameter::variants("charging_zone", Zone::variants(), "where the corona charges grains; one zone or a list"),
      Parameter::variants("discharge_zone", Zone::variants(), "where grains lose their charge, as under a brush")
          .optional(),
      Parameter::number("discharge_contact_age", "s",
                        "time on the roll after which a grain outside of the charging "
                        "zones loses its charge; never when absent")
          .at_least(0.0)
          .optional(),
      Parameter::number("reach", "m", "gap to the roll below which the force acts; one radius of the grain when absent")
          .at_least(0.0)
          .optional(),
      Parameter::number("vacuum_permittivity", "F/m", "permittivity in the charge")
          .above(0.0)
          .by_default(8.8541878128e-12),
      Parameter::number("air_permittivity", "F/m", "permittivity in the force").above(0.0).by_default(8.85941e-12),
  };
}

void ImageForce::setup(SceneServices& services) {
  field_ = &services.electric_field(field_name_);
  executor_ = &services.executor();
  roll_id_ = services.body(roll_name_).id;
  roll_ = find_roll(services, roll_name_);
  for (Zone& zone : charging_zones_) zone.attach(roll_);
  for (Zone& zone : discharge_zones_) zone.attach(roll_);
  charge_ = services.provide_attribute(
      {"charge_corona", "C", "charge of the non-metal part of a grain, taken from the corona", 0.0, {}});
  metal_fraction_ =
      services.optional_attribute({"metal_fraction", "1", "part of a grain that is metal, 0 to 1", 0.0, {}});
  permittivity_ =
      services.optional_attribute({"relative_permittivity", "1", "of the material over that of the vacuum", 2.5, {}});
  if (discharge_contact_age_ >= 0.0)
    contact_age_ = services.provide_attribute({"roll_contact_age", "s", "time on the roll without a break", 0.0, {}});
}

void ImageForce::add_forces(const BodyView& bodies, double, WrenchView out) const {
  SCREE_REQUIRE(field_ != nullptr, "image_force: setup() comes before add_forces()");
  const std::span<const double> charge = bodies.attribute(charge_);
  const std::span<const double> metal = bodies.attribute(metal_fraction_);
  const auto chunk = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (charge[i] == 0.0 || metal[i] >= 1.0 || bodies.motion[i] != Motion::dynamic) continue;
      const double r = bodies.radius[i];
      const RollCoordinates there = to_roll(roll_, bodies.position[i]);
      const bool near = there.distance - roll_.radius - r < (reach_ < 0.0 ? r : reach_);
      if (!near || there.distance == 0.0 || std::abs(there.along) > roll_.half_length) continue;
      // The column holds (1 - metal) Q, the force is (1 - metal) times that of Q.
      const double force = charge[i] * charge[i] / ((1.0 - metal[i]) * 4.0 * kPi * air_permittivity_ * 4.0 * r * r);
      out.force[i] -= force / there.distance * there.radial;
    }
  };
  executor_->for_chunks(bodies.size(), kChunk, std::cref(chunk));
}

void ImageForce::advance(const BodyView& bodies, const ContactView& contacts, Attributes& attributes, double time,
                         double dt) {
  if (discharge_contact_age_ >= 0.0) update_contact_age(bodies, contacts, attributes.column(contact_age_), dt);
  const auto chunk = [&](std::size_t first, std::size_t last) {
    update_charges(bodies, attributes, time, first, last);
  };
  executor_->for_chunks(bodies.size(), kChunk, std::cref(chunk));
}

void ImageForce::update_contact_age(const BodyView& bodies, const ContactView& contacts, std::span<double> age,
                                    double dt) {
  touches_roll_.assign(bodies.size(), 0);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact& contact = contacts.contact[k];
    if (contacts.impulse[k] == Vec3{}) continue;  // a contact that pulls touches too
    if (bodies.id[contact.a] == roll_id_) touches_roll_[contact.b] = 1;
    if (bodies.id[contact.b] == roll_id_) touches_roll_[contact.a] = 1;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) age[i] = touches_roll_[i] != 0 ? age[i] + dt : 0.0;
}

// Discharges and charges a range of bodies; the field is evaluated a batch of points at a time.
void ImageForce::update_charges(const BodyView& bodies, Attributes& attributes, double time, std::size_t first,
                                std::size_t last) const {
  const std::span<double> charge = attributes.column(charge_);
  const std::span<const double> metal = attributes.column(metal_fraction_);
  const std::span<const double> permittivity = attributes.column(permittivity_);
  std::array<std::size_t, kBatch> index;
  std::array<Vec3, kBatch> centre;
  std::array<Vec3, kBatch> radial;
  std::array<Vec3, kBatch> field;
  while (first < last) {
    std::size_t count = 0;
    for (; first < last && count < kBatch; ++first) {
      if (bodies.motion[first] != Motion::dynamic || metal[first] >= 1.0) continue;
      const Vec3& x = bodies.position[first];
      const RollCoordinates there = to_roll(roll_, x);
      const bool charging = in_any(charging_zones_, x, there);
      const bool too_old =
          !charging && discharge_contact_age_ >= 0.0 && attributes.column(contact_age_)[first] > discharge_contact_age_;
      if (too_old || in_any(discharge_zones_, x, there)) {
        charge[first] = 0.0;
      } else if (charging) {
        index[count] = first;
        centre[count] = x;
        radial[count++] = there.radial;
      }
    }
    field_->evaluate({centre.data(), count}, time, {field.data(), count}, {});
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = index[k];
      const double limit = (1.0 - metal[i]) * corona_charge(bodies.radius[i], permittivity[i], norm(field[k]));
      if (limit > std::abs(charge[i])) charge[i] = dot(field[k], radial[k]) > 0.0 ? -limit : limit;
    }
  }
}

// Pauthenier's limit (13) [C].
double ImageForce::corona_charge(double radius, double permittivity, double field) const {
  return 3.0 * kPi * vacuum_permittivity_ * 4.0 * radius * radius * field * permittivity / (permittivity + 2.0);
}

}  // namespace scree
