// Stays: how long each body was in a region, to the fraction of a step at which its way crossed the border.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "analysis/body_memory.hpp"
#include "analysis/region.hpp"
#include "scree/interfaces/observer.hpp"

namespace scree {

/// A stay that has ended.
struct Stay {
  BodyId id = 0;
  std::uint32_t material = 0;
  double mass = 0.0;     ///< [kg]
  double entered = 0.0;  ///< [s]
  double left = 0.0;     ///< [s]
  [[nodiscard]] double duration() const { return left - entered; }
};

/// What is in the region now.
struct HoldUp {
  std::uint64_t number = 0;
  double mass = 0.0;    ///< [kg]
  double oldest = 0.0;  ///< longest time since entering, of those whose entering was seen [s]
};

/// Follows the dynamic bodies. Ways between outer steps are taken as straight.
class Stays {
 public:
  /// With `count_initial` false, what is in the region at the first look is not counted when it leaves.
  Stays(Region region, bool count_initial) : region_{std::move(region)}, count_initial_{count_initial} {}

  /// Looks at the bodies at the end of a step; stays that ended are appended to `ended`.
  void look(const Observation& now, std::vector<Stay>& ended);
  [[nodiscard]] const HoldUp& hold_up() const { return hold_up_; }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  struct Followed {
    static constexpr std::size_t kNumbers = 7;
    Vec3 place;            // at the last look, in the frame of the region [m]
    bool inside = false;   // at the last look
    double entered = 0.0;  // [s]; NaN: before the first look, not to be counted
    double mass = 0.0;     // [kg]
    std::uint32_t material = 0;
    [[nodiscard]] std::array<double, kNumbers> numbers() const;
    static Followed of(std::span<const double> n);
  };

  void step(BodyId id, Followed& body, const Vec3& place, const Observation& now, std::vector<Stay>& ended) const;
  static void end(BodyId id, const Followed& body, double left, std::vector<Stay>& ended);
  [[nodiscard]] bool holds(const Vec3& local) const { return region_.everywhere() || contains(region_.box(), local); }

  Region region_;
  bool count_initial_;
  bool first_look_ = true;
  BodyMemory<Followed> bodies_;
  HoldUp hold_up_;
};

}  // namespace scree
