// BinsResult: everything that a bins observer knows at the end, and its table, report and figure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "scree/interfaces/observer.hpp"
#include "splitting.hpp"
#include "tracker.hpp"

namespace scree {

/// What bodies are counted as. Category 0 is "all"; then come the materials, then the targets.
struct Categories {
  std::vector<std::string> names;
  std::size_t first_target = 0;      ///< index of the first target; names.size() without targets
  std::vector<std::size_t> aliased;  ///< materials that are targets under their own name

  /// The index of a material or target, or names.size().
  [[nodiscard]] std::size_t find(const std::string& name) const;
};

/// How the collector's bins are grouped into products.
struct ProductPlan {
  std::vector<double> splitters;         ///< distance from the origin along u, ascending [m]
  std::vector<std::string> names;        ///< one more than splitters
  std::vector<std::size_t> wanted = {};  ///< category that each product is for, or kNoTarget; may be empty
  Objective objective = Objective::recovery_times_grade;

  /// The product of a crossing at `a` |u|.
  [[nodiscard]] std::size_t product(double distance) const;
};

/// A view of the observer's state; references stay valid while the observer lives.
struct BinsResult {
  const std::string& name;
  const Categories& categories;
  const Collector& collector;
  const Tracker& tracker;
  const ProductPlan& plan;
  const TallyTable& bins;      ///< categories x bins
  const TallyTable& products;  ///< categories x products
  double time;                 ///< [s]

  /// Targets, or without any the materials, of which something was fed.
  [[nodiscard]] std::vector<std::size_t> judged() const;
  /// Materials and targets of which something was fed.
  [[nodiscard]] std::vector<std::size_t> shown() const;
};

/// The coordinate along u that people read: the world's when u lies along a world axis, else the distance.
struct ReadableAxis {
  std::string name;  ///< "x", "y", "z" or "u"
  double at_origin;  ///< [m]
  double per_u;      ///< change over the whole edge u [m]
};
[[nodiscard]] ReadableAxis readable_axis(const Collector& collector);

/// One row per bin: edges along u and v [m], centre in the world [m], number and mass of every category.
void write_bins_table(const BinsResult& result, const std::filesystem::path& file);

/// One row per category: numbers and masses [kg] fed, in flight, lost and collected, with every digit.
void write_ledger(const BinsResult& result, const std::filesystem::path& file);

/// Where everything went, what was lost, the products, and the best splitters.
[[nodiscard]] std::vector<ReportTable> bins_report(const BinsResult& result);

/// The output distribution: share of each category's collected mass by bin along u.
[[nodiscard]] plot::Figure bins_figure(const BinsResult& result);

}  // namespace scree
