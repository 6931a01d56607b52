#include "two_cylinders.hpp"

#include <cmath>
#include <sstream>

#include "scree/base/require.hpp"
#include "scree/interfaces/scene_services.hpp"

namespace scree {

TwoCylinders::TwoCylinders(const Options& options)
    : roll_radius_{options.number("roll_radius")},
      electrode_radius_{options.number("electrode_radius")},
      distance_{options.number("distance")},
      voltage_{options.number("voltage")},
      centre_{options.vector("centre")},
      cos_angle_{std::cos(options.number("angle"))},
      sin_angle_{std::sin(options.number("angle"))},
      envelope_{options} {
  const double r1 = roll_radius_;
  const double r2 = electrode_radius_;
  if (distance_ <= r1 + r2) {
    std::ostringstream sentence;
    sentence << "between the axes must be larger than " << r1 + r2 << " m, or the roll (radius " << r1
             << " m) and the electrode (radius " << r2 << " m) touch; it is " << distance_ << " m";
    throw options.error("distance", sentence.str());
  }
  h1_ = (distance_ * distance_ + r1 * r1 - r2 * r2) / (2.0 * distance_);
  h2_ = distance_ - h1_;
  j_ = std::sqrt(h1_ * h1_ - r1 * r1);
  const double roll_ratio = (h1_ + j_ - r1) / (r1 + j_ - h1_);
  const double electrode_ratio = (h2_ + j_ - r2) / (r2 + j_ - h2_);
  factor_ = voltage_ / std::log(roll_ratio * electrode_ratio);
  constant_ = std::log(roll_ratio);
}

std::vector<Parameter> TwoCylinders::parameters() {
  std::vector<Parameter> all{
      Parameter::number("roll_radius", "m", "radius of the grounded roll, whose axis is z").above(0.0),
      Parameter::number("electrode_radius", "m", "radius of the electrode, parallel to the roll").above(0.0),
      Parameter::number("distance", "m", "distance of the two axes").above(0.0),
      Parameter::number("angle", "rad", "direction from roll to electrode, counter-clockwise from x").by_default(0.0),
      Parameter::number("voltage", "V", "potential of the electrode; the roll is at zero"),
      Parameter::vector("centre", "m", "point of the roll's axis in the middle of the machine").by_default(Vec3{}),
  };
  for (Parameter& parameter : SideEnvelope::parameters()) all.push_back(std::move(parameter));
  return all;
}

void TwoCylinders::setup(SceneServices& services) {
  // On the line of centres, where the roll comes nearest to the electrode, the field on it is largest.
  const double strongest = norm(field_at(to_local(centre_ + roll_radius_ * Vec3{cos_angle_, sin_angle_, 0.0})));
  std::ostringstream line;
  line << "at most " << strongest / 1e3 << " kV/m on the roll";
  services.log(line.str());
}

void TwoCylinders::evaluate(std::span<const Vec3> position, double, std::span<Vec3> field,
                            std::span<double> potential) const {
  SCREE_REQUIRE(field.size() == position.size(), "two_cylinders: field and position must have equal length");
  SCREE_REQUIRE(potential.empty() || potential.size() == position.size(),
                "two_cylinders: potential must be empty or as long as position");
  for (std::size_t i = 0; i < position.size(); ++i) field[i] = field_at(to_local(position[i]));
  for (std::size_t i = 0; i < potential.size(); ++i) potential[i] = potential_at(to_local(position[i]));
  if (envelope_.is_none()) return;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double g = envelope_(position[i].z - centre_.z);
    field[i] *= g;
    if (!potential.empty()) potential[i] *= g;
  }
}

TwoCylinders::Local TwoCylinders::to_local(const Vec3& position) const {
  const double dx = position.x - centre_.x;
  const double dy = position.y - centre_.y;
  const double x = dx * cos_angle_ + dy * sin_angle_;
  const double y = dy * cos_angle_ - dx * sin_angle_;
  const double a = j_ - h1_ + x;
  const double b = j_ + h1_ - x;
  const double to_electrode = x - distance_;
  return {a,
          b,
          y,
          a * a + y * y,
          b * b + y * y,
          x * x + y * y < roll_radius_ * roll_radius_,
          to_electrode * to_electrode + y * y < electrode_radius_ * electrode_radius_};
}

Vec3 TwoCylinders::field_at(const Local& p) const {
  // The line charges, where ra or rb vanish, lie inside the conductors.
  if (p.in_roll || p.in_electrode) return {};
  const double ex = -factor_ * (p.along_a / p.ra + p.along_b / p.rb);
  const double ey = -factor_ * (p.y / p.ra - p.y / p.rb);
  return {ex * cos_angle_ - ey * sin_angle_, ex * sin_angle_ + ey * cos_angle_, 0.0};
}

double TwoCylinders::potential_at(const Local& p) const {
  if (p.in_roll) return 0.0;
  if (p.in_electrode) return voltage_;
  return factor_ * (0.5 * std::log(p.ra / p.rb) + constant_);
}

}  // namespace scree
