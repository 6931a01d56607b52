#include "scree/model/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scree/config/options.hpp"
#include "scree/model/random.hpp"

namespace scree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxDraws = 10000;

using Draw = std::function<double(RandomStream&)>;

/// Uniform in (0, 1], so that its logarithm is finite.
double positive_uniform(RandomStream& random) { return 1.0 - random.uniform(); }

/// Draws again until the value lies in [minimum, maximum]; a law that hardly ever does is refused when it is made.
Draw truncated(Draw draw, double minimum, double maximum) {
  return [draw = std::move(draw), minimum, maximum](RandomStream& random) {
    double value = draw(random);
    for (int i = 0; i < kMaxDraws && (value < minimum || value > maximum); ++i) value = draw(random);
    return std::clamp(value, minimum, maximum);
  };
}

/// Weights for each value, or for each interval between neighbours.
Draw table(const std::vector<double>& values, const std::vector<double>& weights) {
  std::vector<double> cumulative(weights.size());
  std::partial_sum(weights.begin(), weights.end(), cumulative.begin());
  const bool histogram = weights.size() + 1 == values.size();
  return [values, cumulative, histogram](RandomStream& random) {
    const double u = random.uniform() * cumulative.back();
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u);
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(found - cumulative.begin()), cumulative.size() - 1);
    if (!histogram) return values[k];
    const double below = k == 0 ? 0.0 : cumulative[k - 1];
    return values[k] + (values[k + 1] - values[k]) * (u - below) / (cumulative[k] - below);
  };
}

void check_table(const Options& o) {
  const std::vector<double>& values = o.numbers("values");
  const std::vector<double>& weights = o.numbers("weights");
  if (values.empty() || (weights.size() != values.size() && weights.size() + 1 != values.size())) {
    throw o.error("weights", "needs as many numbers as there are values, " + std::to_string(values.size()) +
                                 ", or one fewer for a histogram between the values, but has " +
                                 std::to_string(weights.size()));
  }
  const bool negative = std::any_of(weights.begin(), weights.end(), [](double w) { return w < 0.0; });
  if (negative || std::accumulate(weights.begin(), weights.end(), 0.0) <= 0.0) {
    throw o.error("weights", "must be positive or zero, and not all zero");
  }
  if (weights.size() + 1 == values.size() && !std::is_sorted(values.begin(), values.end())) {
    throw o.error("values", "must increase, as they bound the classes of a histogram");
  }
}

/// The untruncated law of a variant.
Draw law(const Options& o) {
  const std::string& type = o.type();
  if (type == "uniform") {
    return [min = o.number("min"), max = o.number("max")](RandomStream& r) { return r.uniform(min, max); };
  }
  if (type == "normal") {
    return [mean = o.number("mean"), s = o.number("deviation")](RandomStream& r) { return mean + s * r.normal(); };
  }
  if (type == "log_normal") {
    return [median = o.number("median"), s = o.number("log_deviation")](RandomStream& r) {
      return median * std::exp(s * r.normal());
    };
  }
  if (type == "weibull") {
    return [scale = o.number("scale"), shape = o.number("shape")](RandomStream& r) {
      return scale * std::pow(-std::log(positive_uniform(r)), 1.0 / shape);
    };
  }
  if (type == "zhang") {
    return [min = o.number("min"), mean = o.number("mean")](RandomStream& r) {
      return min - (mean - min) * std::log(positive_uniform(r));
    };
  }
  if (type == "table") return table(o.numbers("values"), o.numbers("weights"));
  return [value = o.number("value")](RandomStream&) { return value; };
}

/// Refuses bounds that leave (almost) nothing of a law: one draw in a hundred has to lie within them.
void check_bounds(const Options& o, const Draw& draw, double minimum, double maximum) {
  if (minimum >= maximum) throw o.error("min", "must be below 'max'");
  RandomStream random{0, "bounds of a distribution"};
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const double value = draw(random);
    inside += static_cast<int>(value >= minimum && value <= maximum);
  }
  if (inside < 10) {
    throw o.error(o.has("min") ? "min" : "max", "leaves fewer than 1 % of the draws of this " + o.type() +
                                                    " distribution within its bounds; move the bounds or the law");
  }
}

}  // namespace

std::vector<Variant> Distribution::variants(const std::string& unit) {
  const auto number = [&](const char* name, const char* help) { return Parameter::number(name, unit, help); };
  const Parameter lower = number("min", "smaller draws are repeated").optional();
  const Parameter upper = number("max", "larger draws are repeated").optional();
  return {{"constant", "Always the same.", {number("value", "the value")}},
          {"uniform",
           "Every value between two bounds alike.",
           {number("min", "lower bound"), number("max", "upper bound")}},
          {"normal",
           "Gauss.",
           {number("mean", "mean"), number("deviation", "standard deviation").at_least(0.0), lower, upper}},
          {"log_normal",
           "The logarithm is normal.",
           {number("median", "median").above(0.0),
            Parameter::number("log_deviation", "1", "standard deviation of the natural logarithm").at_least(0.0), lower,
            upper}},
          {"weibull",
           "Weibull, also called Rosin and Rammler: 1 - exp(-(x / scale)^shape).",
           {number("scale", "63.2 % of the values are smaller").above(0.0),
            Parameter::number("shape", "1", "exponent").above(0.0), lower, upper}},
          {"zhang",
           "An exponential law above a least value, as measured on shredded scrap.",
           {number("mean", "mean"), number("min", "least value"), upper}},
          {"table",
           "Values with weights, or a histogram when there is one weight fewer than values.",
           {Parameter::numbers("values", unit, "the values, or the bounds of the classes"),
            Parameter::numbers("weights", "1", "of the values, or of the classes between them")}}};
}

Parameter Distribution::parameter(std::string name, std::string unit, std::string help) {
  std::vector<Variant> alternatives = variants(unit);
  return Parameter::variant(std::move(name), std::move(alternatives), std::move(help))
      .with_shorthand("constant", "value");
}

Distribution::Distribution(double value)
    : draw_{[value](RandomStream&) { return value; }}, minimum_{value}, maximum_{value} {}

Distribution::Distribution(const Options& o) : minimum_{-kInfinity}, maximum_{kInfinity} {
  const std::string& type = o.type();
  if (type == "table") check_table(o);
  if (type == "zhang" && o.number("mean") <= o.number("min")) throw o.error("mean", "must be above 'min'");
  draw_ = law(o);
  if (type == "constant") {
    minimum_ = maximum_ = o.number("value");
  } else if (type == "table") {
    const auto [low, high] = std::minmax_element(o.numbers("values").begin(), o.numbers("values").end());
    minimum_ = *low;
    maximum_ = *high;
  } else {
    if (type == "weibull" || type == "log_normal") minimum_ = 0.0;
    if (o.has("min")) minimum_ = o.number("min");
    if (o.has("max")) maximum_ = o.number("max");
    check_bounds(o, draw_, minimum_, maximum_);
    draw_ = truncated(std::move(draw_), minimum_, maximum_);
  }
}

}  // namespace scree
