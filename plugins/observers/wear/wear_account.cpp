#include "wear_account.hpp"

#include "scree/base/error.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

void append(std::vector<double>& out, const WearAmount& a) {
  out.insert(out.end(), {a.sliding_volume, a.impact_volume, a.sliding_energy, a.impact_energy});
}

WearAmount amount_at(const std::vector<double>& values, std::size_t k) {
  return {values[4 * k], values[4 * k + 1], values[4 * k + 2], values[4 * k + 3]};
}

}  // namespace

void WearAccount::add(std::size_t face, const WearAmount& amount, double impacts) {
  faces_[face] += amount;
  total_ += amount;
  impacts_ += impacts;
}

void WearAccount::mark() {
  for (std::size_t f = 0; f < faces_.size(); ++f) reference_[f] = faces_[f].volume();
}

void WearAccount::save(StateWriter& out) const {
  std::vector<double> values;
  for (const WearAmount& face : faces_) append(values, face);
  append(values, total_);
  values.push_back(impacts_);
  out.write("amounts", std::span<const double>{values});
  out.write("reference", std::span<const double>{reference_});
}

void WearAccount::load(const StateReader& in) {
  const std::vector<double> values = in.doubles("amounts");
  if (values.size() != 4 * (faces_.size() + 1) + 1) {
    throw Error{ErrorKind::io,
                "the checkpoint has other faces than the scene; resume with the `largest_face`, `segments` and "
                "shapes that it was written with"};
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) faces_[f] = amount_at(values, f);
  total_ = amount_at(values, faces_.size());
  impacts_ = values.back();
  reference_ = in.doubles("reference");
}

}  // namespace scree
