// Attributes: named columns of one double per body, for what fields, feeds and
// observers know about a body.
//
// For example `charge_corona` [C], `relative_permittivity` [1],
// `metal_fraction` [1]. Columns are allocated by core, follow bodies as they
// are added and removed, and go to results and checkpoints by themselves.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// Index of a column; found once at setup, used every step.
using AttributeId = std::size_t;

/// What a column holds.
struct AttributeInfo {
  std::string name;  ///< lower_snake
  std::string unit;  ///< SI, for headers of results
  std::string help;
  double initial = 0.0;              ///< [unit of the column], for a body whose source says nothing else
  std::vector<std::string> writers;  ///< parts that provide the column; at most
                                     ///< one of them may be a field
};

/// All columns of the bodies of a simulation.
class Attributes {
 public:
  /// The id of `name`, declared if it is new. Every body gets `info.initial`.
  AttributeId declare(const AttributeInfo& info);
  /// True when a column of that name exists.
  [[nodiscard]] bool has(std::string_view name) const;
  /// @throws std::out_of_range when no such column exists.
  [[nodiscard]] AttributeId id(std::string_view name) const;

  [[nodiscard]] std::span<double> column(AttributeId id) { return columns_[id]; }
  [[nodiscard]] std::span<const double> column(AttributeId id) const { return columns_[id]; }
  [[nodiscard]] const AttributeInfo& info(AttributeId id) const { return infos_[id]; }
  [[nodiscard]] std::size_t count() const { return infos_.size(); }

  /// Makes room for `bodies` bodies.
  void reserve(std::size_t bodies);
  /// Adds one body at the end with the initial values.
  void append_body();
  /// Keeps the bodies with keep[i] != 0, in order.
  void compact(std::span<const char> keep);
  /// Sets the number of bodies; new ones get the initial values. For
  /// checkpoints.
  void resize(std::size_t bodies);

 private:
  std::size_t bodies_ = 0;
  std::vector<AttributeInfo> infos_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace scree
