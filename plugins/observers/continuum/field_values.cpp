#include "field_values.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/require.hpp"

namespace scree {

namespace {

double trace(const Mat3& m) { return m.row0.x + m.row1.y + m.row2.z; }

template <class Value>
std::vector<Value> column(const std::vector<CoarseCell>& cells, Value CoarseCell::*field) {
  std::vector<Value> values;
  for (const CoarseCell& cell : cells) values.push_back(cell.*field);
  return values;
}

template <class Value>
DataArray array_of(const char* name, const std::vector<CoarseCell>& cells, Value CoarseCell::*field) {
  const std::vector<Value> values = column(cells, field);
  return to_array(name, std::span<const Value>{values}, Precision::double_precision);
}

const std::array<SliceField, 6>& slice_fields() {
  static const std::array<SliceField, 6> fields{{
      {"solid_fraction", "Solid fraction", "solid fraction", "1", [](const CoarseCell& c) { return c.solid_fraction; }},
      {"density", "Density", "density", "kg/m3", [](const CoarseCell& c) { return c.density; }},
      {"speed", "Speed", "speed", "m/s", [](const CoarseCell& c) { return norm(c.velocity); }},
      {"granular_temperature", "Granular temperature", "granular temperature", "m2/s2",
       [](const CoarseCell& c) { return c.temperature; }},
      {"kinetic_pressure", "Kinetic pressure", "kinetic pressure", "Pa",
       [](const CoarseCell& c) { return trace(c.kinetic_stress) / 3.0; }},
      {"contact_pressure", "Contact pressure", "contact pressure", "Pa",
       [](const CoarseCell& c) { return trace(c.contact_stress) / 3.0; }},
  }};
  return fields;
}

}  // namespace

std::array<std::size_t, 3> cell_places(const CellGrid& grid, std::size_t cell) {
  const auto& n = grid.count();
  return {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
}

std::vector<DataArray> field_arrays(const std::vector<CoarseCell>& cells, bool contact_stress) {
  std::vector<DataArray> arrays{array_of("solid_fraction", cells, &CoarseCell::solid_fraction),
                                array_of("density", cells, &CoarseCell::density),
                                array_of("velocity", cells, &CoarseCell::velocity),
                                array_of("granular_temperature", cells, &CoarseCell::temperature),
                                array_of("kinetic_stress", cells, &CoarseCell::kinetic_stress),
                                array_of("samples", cells, &CoarseCell::samples)};
  if (contact_stress) arrays.push_back(array_of("contact_stress", cells, &CoarseCell::contact_stress));
  return arrays;
}

std::vector<std::string> slice_field_names() {
  std::vector<std::string> names;
  for (const SliceField& field : slice_fields()) names.push_back(field.name);
  return names;
}

const SliceField& slice_field(const std::string& name) {
  const auto found = std::find_if(slice_fields().begin(), slice_fields().end(),
                                  [&](const SliceField& field) { return field.name == name; });
  SCREE_REQUIRE(found != slice_fields().end(), "no such field of a slice");
  return *found;
}

void LayerMean::add(const CoarseCell& cell) {
  cells_ += 1.0;
  solid_fraction_ += cell.solid_fraction;
  density_ += cell.density;
  contact_stress_ = contact_stress_ + cell.contact_stress;
  if (cell.density > 0.0) momentum_ += cell.density * cell.velocity;
  if (!std::isfinite(cell.temperature)) return;
  warm_density_ += cell.density;
  temperature_ += cell.density * cell.temperature;
  kinetic_ += trace(cell.kinetic_stress);
}

Vec3 LayerMean::velocity() const { return density_ > 0.0 ? momentum_ / density_ : Vec3{NAN, NAN, NAN}; }

double LayerMean::temperature() const { return warm_density_ > 0.0 ? temperature_ / warm_density_ : std::nan(""); }

Mat3 LayerMean::contact_stress() const {
  const double per = 1.0 / cells_;
  return {per * contact_stress_.row0, per * contact_stress_.row1, per * contact_stress_.row2};
}

}  // namespace scree
