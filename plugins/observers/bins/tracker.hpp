// Tracker: follows every body from its first sight to its bin or its loss, so that nothing vanishes.
//
// At any time, for every category:   fed = in flight + lost + binned      (numbers exactly, masses to rounding)
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "amounts.hpp"
#include "collector.hpp"
#include "scree/interfaces/observer.hpp"

namespace scree {

/// How bodies left without a bin.
struct Loss {
  std::string sink;
  std::string reason;
  TallyTable amounts;  ///< one column
};

/// A body that came into a bin.
struct Binned {
  std::size_t bin;
  double a;     ///< where along u, 0..1 [1]
  double time;  ///< of the crossing [s]
  CategoryMask mask;
  double mass;  ///< [kg]
};

/// Follows the dynamic bodies.
class Tracker {
 public:
  /// What a body counts as, when it is first seen.
  using Categorise = std::function<CategoryMask(const BodyView&, BodyIndex)>;
  /// What a body counts as that was removed before it was ever seen.
  using CategoriseRemoved = std::function<CategoryMask(std::uint32_t material)>;

  Tracker(std::size_t categories, Categorise categorise, CategoriseRemoved categorise_removed);

  /// Looks at the bodies at the end of a step; appends those that came into a bin to `binned`.
  void look(const Observation& now, const Collector& collector, std::vector<Binned>& binned);
  /// Writes each body's bin into a column: 0 not yet, k + 1 in bin k, -1 crossed the plane outside of the rectangle.
  void write_column(const BodyView& bodies, std::span<double> column) const;

  [[nodiscard]] const TallyTable& fed() const { return fed_; }
  [[nodiscard]] const TallyTable& binned() const { return binned_; }
  [[nodiscard]] const std::vector<Loss>& losses() const { return losses_; }
  /// Over all reasons.
  [[nodiscard]] Tally lost(std::size_t category) const;
  /// Seen, and neither binned nor lost.
  [[nodiscard]] TallyTable in_flight() const;

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  struct Tracked {
    BodyId id;
    Vec3 position;  // at the last look [m]
    double mass;    // [kg]
    CategoryMask mask;
    std::int64_t state;  // as in write_column()
  };

  void account_removed(std::span<const RemovedBody> removed);
  void lose(const std::string& sink, const std::string& reason, CategoryMask mask, double mass);
  [[nodiscard]] Tracked first_seen(const Observation& now, BodyIndex body);
  void step(Tracked& body, const Vec3& position, const Observation& now, const Collector& collector,
            std::vector<Binned>& binned);

  std::size_t categories_;
  Categorise categorise_;
  CategoriseRemoved categorise_removed_;
  std::vector<Tracked> tracked_;  // ascending by id
  std::vector<Tracked> next_;
  BodyId next_unseen_ = 0;  // every body below was seen, or removed before it could be
  TallyTable fed_, binned_;
  std::vector<Loss> losses_;
};

}  // namespace scree
