// Counter-based random streams (Philox 4x32-10: Salmon, Moraes, Dror, Shaw
// 2011, "Parallel random numbers: as easy as 1, 2, 3").
//
// A stream is a pure function of (seed, name, counter). Every user has a stream
// of its own name, so that adding an observer, or a second feed, changes
// nothing that another one draws. Its whole state is the counter.
#pragma once

#include <cstdint>
#include <string_view>

#include "scree/math/quat.hpp"

namespace scree {

/// A stream of random numbers that can be saved as one integer.
class RandomStream {
 public:
  using result_type = std::uint64_t;

  RandomStream(std::uint64_t seed, std::string_view name);

  /// Uniform 64 random bits; makes the stream a UniformRandomBitGenerator.
  std::uint64_t operator()();
  static constexpr std::uint64_t min() { return 0; }
  static constexpr std::uint64_t max() { return ~std::uint64_t{0}; }

  /// Uniform in [0, 1) with 53 random bits.
  double uniform();
  /// Uniform in [lower, upper).
  double uniform(double lower, double upper);
  /// Normal with mean 0 and deviation 1 (Box-Muller; two draws each, nothing
  /// kept between calls).
  double normal();
  /// An orientation uniform over all rotations (Shoemake 1992).
  Quat orientation();

  /// Draws so far; with it a stream is resumed exactly.
  [[nodiscard]] std::uint64_t counter() const { return counter_; }
  void set_counter(std::uint64_t counter) { counter_ = counter; }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace scree
