// SpatialOrder: numbers the bodies that contacts move along a Morton curve, so
// that bodies close in space are close in memory.
//
// A pure function of positions and contacts: no history shows in the result.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/model/body.hpp"

namespace scree::dvi {

inline constexpr std::uint32_t kNotInProblem = std::numeric_limits<std::uint32_t>::max();

/// The bodies of a step's problem. Keeps its memory between steps.
class SpatialOrder {
 public:
  /// Numbers the bodies that `contacts` mention, and `joined`: dynamic ones along
  /// the curve, then the others by index.
  void build(const BodyView& bodies, std::span<const Contact> contacts, std::span<const BodyIndex> joined = {});

  /// Body of the scene by number.
  [[nodiscard]] std::span<const BodyIndex> bodies() const { return bodies_; }
  /// Number of a body of the scene, or kNotInProblem.
  [[nodiscard]] std::uint32_t number(BodyIndex body) const { return number_[body]; }

 private:
  struct Coded {
    std::uint32_t code;
    BodyIndex body;
  };
  void encode(const BodyView& bodies);
  void sort_by_code();

  std::vector<std::uint32_t> number_;
  std::vector<BodyIndex> bodies_;
  std::vector<Coded> coded_;
  std::vector<Coded> scratch_;
};

}  // namespace scree::dvi
