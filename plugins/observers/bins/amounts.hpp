// Tallies by category: how many bodies and how much mass of each material and each target.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

class StateReader;
class StateWriter;

/// Bodies and their mass.
struct Tally {
  std::uint64_t number = 0;
  double mass = 0.0;  ///< [kg]

  Tally& operator+=(const Tally& other) {
    number += other.number;
    mass += other.mass;
    return *this;
  }
};

/// What a body counts as: bit k is category k. One bit of a material, and one of every target that it belongs to.
using CategoryMask = std::uint64_t;
inline constexpr std::size_t kMostCategories = 64;

/// A table of tallies: one row per category, one column per bin, product, or single.
class TallyTable {
 public:
  TallyTable() = default;
  TallyTable(std::size_t categories, std::size_t columns) : columns_{columns}, amounts_(categories * columns) {}

  /// Adds one body to every category of its mask.
  void add(CategoryMask mask, std::size_t column, double mass);

  [[nodiscard]] const Tally& at(std::size_t category, std::size_t column = 0) const {
    return amounts_[category * columns_ + column];
  }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t categories() const { return columns_ == 0 ? 0 : amounts_.size() / columns_; }
  /// Over all columns.
  [[nodiscard]] Tally sum(std::size_t category) const;

  void save(StateWriter& out, std::string_view name) const;
  /// @throws Error (io) when the saved table has another size.
  void load(const StateReader& in, std::string_view name);

 private:
  std::size_t columns_ = 0;
  std::vector<Tally> amounts_;
};

}  // namespace scree
