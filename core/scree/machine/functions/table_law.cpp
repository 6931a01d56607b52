#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "scree/config/options.hpp"
#include "scree/machine/functions/time_law.hpp"
#include "scree/machine/functions/time_series.hpp"

namespace scree {
namespace {

/// Through points: by straight lines, or by cubics that are monotone where the points are (Fritsch & Butland 1984, SIAM J.
/// Sci. Stat. Comput. 5). The cubic of a piece is y + s (m + s (c + s d)), s from its left end.
class Table final : public TimeLaw {
 public:
  Table(std::vector<double> times, const std::vector<double>& values, bool cubic, bool repeats)
      : times_{std::move(times)}, repeats_{repeats} {
    make_pieces(values, cubic);
  }

  [[nodiscard]] double value(double t) const override {
    const Place at = place(t);
    const Piece& p = pieces_[at.piece];
    return p.y + at.s * (p.m + at.s * (p.c + at.s * p.d));
  }
  [[nodiscard]] double derivative(double t) const override {
    const Place at = place(t);
    const Piece& p = pieces_[at.piece];
    return p.m + at.s * (2.0 * p.c + at.s * 3.0 * p.d);
  }
  [[nodiscard]] double integral(double a, double b) const override { return integral_to(b) - integral_to(a); }

 private:
  struct Piece {
    double y, m, c, d;       // [unit of the setting over powers of s]
    double integral_before;  // since the first time [unit of the setting times s]
  };
  struct Place {
    std::size_t piece;
    double s;  // since the left end of the piece [s]
  };

  void make_pieces(const std::vector<double>& values, bool cubic) {
    const std::size_t last = times_.size() - 1;
    std::vector<double> slope(last), tangent(last + 1);
    for (std::size_t k = 0; k < last; ++k) slope[k] = (values[k + 1] - values[k]) / (times_[k + 1] - times_[k]);
    if (cubic) tangent = tangents(slope, repeats_ && values.front() == values.back());
    // Before the first time and after the last the value is held.
    pieces_.push_back({values.front(), 0.0, 0.0, 0.0, 0.0});
    double sum = 0.0;
    for (std::size_t k = 0; k < last; ++k) {
      const double h = times_[k + 1] - times_[k];
      Piece p{values[k], slope[k], 0.0, 0.0, sum};
      if (cubic) {
        p.m = tangent[k];
        p.c = (3.0 * slope[k] - 2.0 * tangent[k] - tangent[k + 1]) / h;
        p.d = (tangent[k] + tangent[k + 1] - 2.0 * slope[k]) / (h * h);
      }
      pieces_.push_back(p);
      sum += own_integral(p, h);
    }
    pieces_.push_back({values.back(), 0.0, 0.0, 0.0, sum});
  }

  [[nodiscard]] std::vector<double> tangents(const std::vector<double>& slope, bool periodic) const {
    const std::size_t last = slope.size();
    const auto between = [&](std::size_t left, std::size_t right) {
      if (slope[left] * slope[right] <= 0.0) return 0.0;
      const double a = times_[left + 1] - times_[left], b = times_[right + 1] - times_[right];
      return 3.0 * (a + b) / ((2.0 * b + a) / slope[left] + (b + 2.0 * a) / slope[right]);
    };
    std::vector<double> tangent(last + 1);
    for (std::size_t k = 1; k < last; ++k) tangent[k] = between(k - 1, k);
    tangent.front() = periodic ? between(last - 1, 0) : slope.front();
    tangent.back() = periodic ? tangent.front() : slope.back();
    return tangent;
  }

  static double own_integral(const Piece& p, double s) {
    return s * (p.y + s * (p.m / 2.0 + s * (p.c / 3.0 + s * p.d / 4.0)));
  }

  [[nodiscard]] double period() const { return times_.back() - times_.front(); }
  /// The time within the points that `t` stands for, and in `laps` how many periods were taken off.
  [[nodiscard]] double folded(double t, double& laps) const {
    laps = repeats_ ? std::floor((t - times_.front()) / period()) : 0.0;
    return laps == 0.0 ? t : std::clamp(t - laps * period(), times_.front(), times_.back());
  }
  [[nodiscard]] Place place(double t) const {
    double laps = 0.0;
    const double at = folded(t, laps);
    auto k = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), at) - times_.begin());
    if (repeats_) k = std::clamp<std::size_t>(k, 1, times_.size() - 1);
    return {k, at - times_[k == 0 ? 0 : k - 1]};
  }
  /// Since the first time.
  [[nodiscard]] double integral_to(double t) const {
    double laps = 0.0;
    static_cast<void>(folded(t, laps));
    const Place at = place(t);
    const Piece& p = pieces_[at.piece];
    return laps * pieces_.back().integral_before + p.integral_before + own_integral(p, at.s);
  }

  std::vector<double> times_;  // [s]
  bool repeats_;
  std::vector<Piece> pieces_;  // before the first time, between the times, after the last
};

void check_points(const Options& o) {
  const std::vector<double>& times = o.numbers("times");
  const std::vector<double>& values = o.numbers("values");
  if (times.size() < 2) throw o.error("times", "has " + std::to_string(times.size()) + " entries; two are the least");
  if (times.size() != values.size()) {
    throw o.error("values",
                  "has " + std::to_string(values.size()) + " entries, but 'times' has " + std::to_string(times.size()));
  }
  if (std::ranges::adjacent_find(times, std::greater_equal{}) != times.end()) {
    throw o.error("times", "must ascend from entry to entry");
  }
}

}  // namespace

std::unique_ptr<const TimeLaw> make_table_law(const Options& o) {
  const bool has_file = o.has("file"), has_points = o.has("times") && o.has("values");
  if (has_file == has_points || has_file == (o.has("times") || o.has("values"))) {
    throw o.error("a table needs either 'times' and 'values', or 'file' with a row of time and value a line");
  }
  TimeSeries series;
  if (has_file) {
    static constexpr std::array<std::size_t, 1> kColumns{1};
    series = read_time_series(o.path("file"), kColumns, "two numbers: time [s], value in SI", o.location("file"));
  } else {
    check_points(o);
    series.times = o.numbers("times");
    series.values = o.numbers("values");
  }
  return std::make_unique<Table>(std::move(series.times), series.values, o.text("interpolation") == "monotone_cubic",
                                 o.text("outside") == "repeat");
}

}  // namespace scree
