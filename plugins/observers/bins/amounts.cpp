#include "amounts.hpp"

#include <bit>

#include "scree/base/error.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

void TallyTable::add(CategoryMask mask, std::size_t column, double mass) {
  for (CategoryMask left = mask; left != 0; left &= left - 1) {
    const auto category = static_cast<std::size_t>(std::countr_zero(left));
    amounts_[category * columns_ + column] += {1, mass};
  }
}

Tally TallyTable::sum(std::size_t category) const {
  Tally total;
  for (std::size_t column = 0; column < columns_; ++column) total += at(category, column);
  return total;
}

void TallyTable::save(StateWriter& out, std::string_view name) const {
  std::vector<std::uint64_t> numbers;
  std::vector<double> masses;
  for (const Tally& amount : amounts_) {
    numbers.push_back(amount.number);
    masses.push_back(amount.mass);
  }
  const auto group = out.group(name);
  group->write("number", numbers);
  group->write("mass", masses);
}

void TallyTable::load(const StateReader& in, std::string_view name) {
  const auto group = in.group(name);
  const std::vector<std::uint64_t> numbers = group->integers("number");
  const std::vector<double> masses = group->doubles("mass");
  if (numbers.size() != amounts_.size() || masses.size() != amounts_.size()) {
    throw Error{ErrorKind::io,
                "the checkpoint's bins have another number of materials, targets, bins or splitters than "
                "the scene's; resume with the scene that wrote it."};
  }
  for (std::size_t i = 0; i < amounts_.size(); ++i) amounts_[i] = {numbers[i], masses[i]};
}

}  // namespace scree
