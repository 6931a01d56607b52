#include "zone.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;

double number_or_infinity(const Options& options, const char* name) {
  return options.has(name) ? options.number(name) : std::numeric_limits<double>::infinity();
}

}  // namespace

Zone::Zone(const Options& options) : is_box_{options.type() == "box"} {
  if (is_box_) {
    box_ = {options.vector("lower"), options.vector("upper")};
    for (int axis = 0; axis < 3; ++axis) {
      if (box_.lower[axis] > box_.upper[axis])
        throw options.error("upper", "must be at least 'lower' in every component, or the box is empty");
    }
    return;
  }
  from_ = options.number("from");
  width_ = options.number("to") - from_;
  inner_radius_ = options.number("inner_radius");
  outer_radius_ = number_or_infinity(options, "outer_radius");
  half_width_ = number_or_infinity(options, "half_width");
  if (width_ <= 0.0) throw options.error("to", "must be larger than 'from', as the sector runs counter-clockwise");
  if (outer_radius_ <= inner_radius_)
    throw options.error("outer_radius", "must be larger than 'inner_radius', or the sector is empty");
}

std::vector<Variant> Zone::variants() {
  return {{"box",
           "a box along the axes of the world",
           {Parameter::vector("lower", "m", "corner with the smallest coordinates"),
            Parameter::vector("upper", "m", "corner with the largest coordinates")}},
          {"sector",
           "a sector about the roll's axis",
           {Parameter::number("from", "rad", "angle at which the sector begins, counter-clockwise from x"),
            Parameter::number("to", "rad", "angle at which it ends, larger than 'from'"),
            Parameter::number("inner_radius", "m", "smallest distance from the axis").at_least(0.0).by_default(0.0),
            Parameter::number("outer_radius", "m", "largest distance from the axis; no limit when absent")
                .above(0.0)
                .optional(),
            Parameter::number("half_width", "m", "largest distance from the middle of the roll; no limit when absent")
                .above(0.0)
                .optional()}}};
}

void Zone::attach(const Roll& roll) {
  const Vec3 reference = std::abs(roll.axis.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 zero = normalized(reference - dot(reference, roll.axis) * roll.axis);
  const Vec3 quarter = cross(roll.axis, zero);
  axis_ = roll.axis;
  first_ = std::cos(from_) * zero + std::sin(from_) * quarter;
  last_ = std::cos(from_ + width_) * zero + std::sin(from_ + width_) * quarter;
}

bool Zone::contains(const Vec3& point, const RollCoordinates& there) const {
  return is_box_ ? scree::contains(box_, point) : in_sector(there);
}

bool Zone::in_sector(const RollCoordinates& there) const {
  if (there.distance < inner_radius_ || there.distance > outer_radius_ || std::abs(there.along) > half_width_)
    return false;
  if (width_ >= 2.0 * kPi) return true;
  // Sides of the two end planes instead of an arc tangent for every body.
  const bool after_first = dot(axis_, cross(first_, there.radial)) >= 0.0;
  const bool before_last = dot(axis_, cross(there.radial, last_)) >= 0.0;
  return width_ <= kPi ? after_first && before_last : after_first || before_last;
}

}  // namespace scree
