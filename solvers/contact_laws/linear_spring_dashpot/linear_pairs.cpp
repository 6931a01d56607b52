#include "linear_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scree {

using granular::Lane;

LinearPairs::LinearPairs(const Options& options)
    : option_stiffness_{options.has("stiffness") ? options.number("stiffness") : 0.0},
      option_damping_{options.has("damping") ? options.number("damping") : -1.0},
      target_{options.number("overlap_target")},
      speed_{options.number("overlap_speed")},
      restitution_{options} {
  if (options.has("stiffness") && (options.given("overlap_target") || options.given("overlap_speed"))) {
    throw options.error("stiffness", "is given beside an overlap target, from which a stiffness follows too; keep one");
  }
}

std::vector<Parameter> LinearPairs::parameters() {
  std::vector<Parameter> list{
      Parameter::number("stiffness", "N/m", "of pairs without a compliance of their own, in place of overlap_target")
          .above(0.0)
          .optional(),
      Parameter::number("overlap_target", "1",
                        "greatest overlap of an impact with overlap_speed, in units of the effective radius: the "
                        "stiffness follows for each contact")
          .above(0.0)
          .at_most(0.5)
          .by_default(0.01),
      Parameter::number("overlap_speed", "m/s", "see overlap_target: the fastest impact to expect")
          .above(0.0)
          .by_default(1.0),
      Parameter::number("damping", "N s/m", "of pairs without a damping of their own, in place of their restitution")
          .at_least(0.0)
          .optional()};
  for (Parameter& parameter : granular::restitution_parameters()) list.push_back(std::move(parameter));
  return list;
}

void LinearPairs::add(const ContactMaterial& pair) {
  const double own = pair.compliance > 0.0 ? 1.0 / pair.compliance : option_stiffness_;
  const double rate = speed_ / target_;
  stiffness_.push_back(own);
  scaled_.push_back(own > 0.0 ? 0.0 : rate * rate);
  const bool own_damping = pair.compliance > 0.0 && pair.damping > 0.0, given = own_damping || option_damping_ >= 0.0;
  damping_.push_back(given ? (own_damping ? pair.damping : option_damping_) : 0.0);
  twice_.push_back(given ? 0.0 : 2.0 * restitution_.ratio_of(pair.restitution));
  friction_.push_back(pair.friction);
  scales_ |= own == 0.0;
  has_damping_ |= given;
}

void LinearPairs::setup(const Materials& materials) {
  for (granular::PairColumn* column : {&stiffness_, &scaled_, &damping_, &twice_, &friction_}) column->clear();
  scales_ = has_damping_ = false;
  materials_ = materials.size();
  for (std::uint32_t a = 0; a < materials.size(); ++a)
    for (std::uint32_t b = 0; b < materials.size(); ++b) add(materials.pair(a, b));
}

double LinearPairs::damping(std::size_t pair, double stiffness, double mass) const {
  return damping_[pair] + twice_[pair] * std::sqrt(stiffness * mass);
}

std::string LinearPairs::describe(const Materials& materials, std::uint32_t a, std::uint32_t b) const {
  const std::size_t pair = index(a, b);
  std::string text = fmt::format("{} on {}: ", materials[a].name, materials[b].name);
  const double zeta = 0.5 * twice_[pair], stretch = 1.0 / std::sqrt(1.0 - std::min(zeta * zeta, 0.99));
  if (stiffness_[pair] > 0.0) {
    text += fmt::format("stiffness {:.4g} N/m, contact time {:.4g} ms at 1 g, as the root of the mass",
                        stiffness_[pair], 1e3 * std::numbers::pi * std::sqrt(1e-3 / stiffness_[pair]) * stretch);
  } else {
    text += fmt::format(
        "stiffness of an overlap of {:.4g} radii at {:.4g} m/s, contact time {:.4g} ms at 1 mm, as the radius", target_,
        speed_, std::numbers::pi * target_ / speed_ * stretch);
  }
  if (twice_[pair] == 0.0) return text + fmt::format(", damping {:.4g} N s/m", damping_[pair]);
  const double e = materials.pair(a, b).restitution;
  text += fmt::format(", restitution {:.4g} (damping ratio {:.4g})", std::max(e, restitution_.least), zeta);
  return e < restitution_.least ? text + fmt::format(", where {:.4g} is asked for", e) : text;
}

void LinearPairs::find_stiffness(const ContactBatch& __restrict batch, Lane& __restrict stiffness) const {
  granular::spread(stiffness_, batch, stiffness);
  if (!scales_) return;
  alignas(64) Lane scaled;
  granular::spread(scaled_, batch, scaled);
  for (std::size_t k = 0; k < batch.count; ++k)
    stiffness[k] += scaled[k] * batch.mass[k] / (batch.radius[k] * batch.radius[k]);
}

void LinearPairs::find_damping(const ContactBatch& __restrict batch, const Lane& __restrict stiffness,
                               Lane& __restrict damping) const {
  granular::spread(twice_, batch, damping);
  for (std::size_t k = 0; k < batch.count; ++k) damping[k] *= std::sqrt(stiffness[k] * batch.mass[k]);
  if (!has_damping_) return;
  alignas(64) Lane own;
  granular::spread(damping_, batch, own);
  for (std::size_t k = 0; k < batch.count; ++k) damping[k] += own[k];
}

}  // namespace scree
