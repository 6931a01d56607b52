// The tables of a bins observer for the end of a run.
#include <fmt/format.h>

#include "bins_result.hpp"

namespace scree {

namespace {

std::string kilograms(double mass) { return fmt::format("{:.6g}", mass); }
std::string percent(double share) { return fmt::format("{:.2f}", 100.0 * share); }

ReportTable ledger(const BinsResult& result) {
  ReportTable table;
  table.title = result.name + ": where everything went";
  table.header = {"material",       "fed",       "in flight",     "lost", "collected", "fed [kg]",
                  "in flight [kg]", "lost [kg]", "collected [kg]"};
  const TallyTable in_flight = result.tracker.in_flight();
  std::vector<std::size_t> rows = result.shown();
  rows.push_back(0);
  for (const std::size_t c : rows) {
    const Tally fed = result.tracker.fed().at(c), flying = in_flight.at(c), lost = result.tracker.lost(c),
                collected = result.tracker.binned().at(c);
    table.rows.push_back({result.categories.names[c], std::to_string(fed.number), std::to_string(flying.number),
                          std::to_string(lost.number), std::to_string(collected.number), kilograms(fed.mass),
                          kilograms(flying.mass), kilograms(lost.mass), kilograms(collected.mass)});
  }
  return table;
}

ReportTable losses(const BinsResult& result) {
  ReportTable table;
  table.title = result.name + ": lost without a bin";
  table.header = {"material", "sink", "reason", "number", "mass [kg]"};
  for (const Loss& loss : result.tracker.losses()) {
    for (const std::size_t c : result.shown()) {
      const Tally& amount = loss.amounts.at(c);
      if (amount.number == 0) continue;
      table.rows.push_back(
          {result.categories.names[c], loss.sink, loss.reason, std::to_string(amount.number), kilograms(amount.mass)});
    }
  }
  return table;
}

ProductMass mass_of(const TallyTable& products, std::size_t category, std::size_t product) {
  return {products.at(category, product).mass, products.at(0, product).mass};
}

ProductMass total_of(const TallyTable& products, std::size_t category) {
  return {products.sum(category).mass, products.sum(0).mass};
}

ReportTable products(const BinsResult& result) {
  const ReadableAxis axis = readable_axis(result.collector);
  const double length = norm(result.collector.u());
  ReportTable table;
  table.title = result.name + ": products (recovery of the collected mass)";
  table.header = {"product", "from " + axis.name + " [m]", "to " + axis.name + " [m]", "mass [kg]"};
  for (const std::size_t c : result.judged()) {
    const std::string& name = result.categories.names[c];
    for (const char* what : {" [kg]", " grade [%]", " recovery [%]"}) table.header.push_back(name + what);
  }
  for (std::size_t p = 0; p < result.plan.names.size(); ++p) {
    const double from = p == 0 ? 0.0 : result.plan.splitters[p - 1] / length;
    const double to = p < result.plan.splitters.size() ? result.plan.splitters[p] / length : 1.0;
    std::vector<std::string> row{result.plan.names[p], fmt::format("{:.4g}", axis.at_origin + from * axis.per_u),
                                 fmt::format("{:.4g}", axis.at_origin + to * axis.per_u),
                                 kilograms(result.products.at(0, p).mass)};
    for (const std::size_t c : result.judged()) {
      const ProductMass mass = mass_of(result.products, c, p);
      row.push_back(kilograms(mass.target));
      row.push_back(percent(grade(mass)));
      row.push_back(percent(recovery(mass, total_of(result.products, c))));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

StripMasses strip_masses(const BinsResult& result) {
  const auto strips = static_cast<std::size_t>(result.collector.u_bins());
  StripMasses masses{std::vector(result.categories.names.size(), std::vector<double>(strips, 0.0)), {}};
  for (std::size_t c = 0; c < result.categories.names.size(); ++c) {
    for (std::size_t bin = 0; bin < result.bins.columns(); ++bin) {
      masses.target[c][bin % strips] += result.bins.at(c, bin).mass;
    }
  }
  masses.all = masses.target[0];
  return masses;
}

const char* to_text(Objective objective) {
  return objective == Objective::recovery_times_grade ? "recovery x grade" : "separation efficiency";
}

// The plans for which the best splitters are sought: the scene's, or one splitter for each target, to either side.
std::vector<std::vector<std::size_t>> plans(const BinsResult& result) {
  if (!result.plan.wanted.empty()) return {result.plan.wanted};
  std::vector<std::vector<std::size_t>> list;
  for (const std::size_t c : result.judged()) {
    list.push_back({c, kNoTarget});
    list.push_back({kNoTarget, c});
  }
  return list;
}

std::string describe(const BinsResult& result, const std::vector<std::size_t>& wanted) {
  std::string text;
  for (const std::size_t c : wanted) {
    text += (text.empty() ? "" : " | ") + (c == kNoTarget ? std::string{"rest"} : result.categories.names[c]);
  }
  return text;
}

ReportTable best_splitters(const BinsResult& result) {
  const ReadableAxis axis = readable_axis(result.collector);
  const double length = norm(result.collector.u());
  const auto strips = static_cast<double>(result.collector.u_bins());
  const StripMasses masses = strip_masses(result);
  ReportTable table;
  table.title = result.name + ": best splitters by " + to_text(result.plan.objective) + ", over all edges of bins";
  table.header = {"products along u", "splitters at u [m]", "at " + axis.name + " [m]",
                  "objective [%]",    "grade [%]",          "recovery [%]"};
  for (const auto& wanted : plans(result)) {
    if (wanted.size() > masses.all.size()) continue;
    const BestSplit best = best_split(masses, wanted, result.plan.objective);
    std::string u, place, grades, recoveries;
    for (const std::size_t edge : best.edges) {
      const double fraction = static_cast<double>(edge) / strips;
      u += fmt::format("{}{:.4g}", u.empty() ? "" : ", ", fraction * length);
      place += fmt::format("{}{:.4g}", place.empty() ? "" : ", ", axis.at_origin + fraction * axis.per_u);
    }
    for (std::size_t p = 0; p < wanted.size(); ++p) {
      if (wanted[p] == kNoTarget) continue;
      ProductMass mass, total;
      for (std::size_t s = 0; s < masses.all.size(); ++s) {
        const bool inside = (p == 0 || s >= best.edges[p - 1]) && (p == best.edges.size() || s < best.edges[p]);
        total.target += masses.target[wanted[p]][s];
        total.all += masses.all[s];
        if (inside) mass.target += masses.target[wanted[p]][s];
        if (inside) mass.all += masses.all[s];
      }
      grades += (grades.empty() ? "" : ", ") + percent(grade(mass));
      recoveries += (recoveries.empty() ? "" : ", ") + percent(recovery(mass, total));
    }
    table.rows.push_back({describe(result, wanted), u, place, percent(best.value), grades, recoveries});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> bins_report(const BinsResult& result) {
  std::vector<ReportTable> tables{ledger(result)};
  if (!result.tracker.losses().empty()) tables.push_back(losses(result));
  tables.push_back(products(result));
  if (result.judged().size() > 1 || !result.plan.wanted.empty()) tables.push_back(best_splitters(result));
  return tables;
}

}  // namespace scree
