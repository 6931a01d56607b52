// SideEnvelope: how the field of a plane formula fades past the sides of a machine of finite width.
//
//     none     g = 1
//     cutoff   g = 1 for |z| <= half_width, else 0
//     tanh     g = 1/2 (1 - tanh((|z| - z0) / l))        fitted to a 3-D field in the middle of the gap only
//
// z is measured along the axis of the roll from the middle of the machine.
#pragma once

#include <vector>

#include "scree/config/options.hpp"

namespace scree {

/// A factor between 0 and 1 by the position along the roll's axis.
class SideEnvelope {
 public:
  explicit SideEnvelope(const Options& options);
  static std::vector<Parameter> parameters();

  /// g(z) [1]; `z` from the middle of the machine [m].
  [[nodiscard]] double operator()(double z) const;
  /// True when g = 1 everywhere.
  [[nodiscard]] bool is_none() const { return kind_ == Kind::none; }

 private:
  enum class Kind { none, cutoff, tanh };
  Kind kind_;
  double half_width_;      ///< [m]
  double decay_position_;  ///< z0, where g = 1/2 [m]
  double decay_length_;    ///< l [m]
};

}  // namespace scree
