#include "run_statistics.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <initializer_list>
#include <numeric>

#include "scree/model/body_store.hpp"
#include "scree/model/material.hpp"

namespace scree {
namespace {

/// Largest resident memory of the program so far [byte].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double over(double sum, std::uint64_t count) { return count == 0 ? 0.0 : sum / static_cast<double>(count); }

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-e% ") == std::string::npos;
}

}  // namespace

void RunStatistics::add(const StepRecord& step) {
  last_ = step;
  ++steps_;
  most_contacts_ = std::max(most_contacts_, step.contacts);
  most_bodies_ = std::max(most_bodies_, step.bodies);
  fallbacks_ += step.fallbacks;
  if (is_soft_) sub_steps_ += static_cast<double>(step.iterations);
  if (step.contacts == 0) return;
  ++steps_in_contact_;
  const auto contacts = static_cast<double>(step.contacts);
  contacts_ += contacts;
  iterations_ += static_cast<double>(step.iterations);
  residual_ += step.residual;
  largest_residual_ = std::max(largest_residual_, step.residual);
  mean_penetration_ += contacts * step.mean_penetration;
  max_penetration_ = std::max(max_penetration_, step.max_penetration);
}

double RunStatistics::mean_sub_steps() const { return over(sub_steps_, steps_); }

std::vector<std::pair<std::string, double>> RunStatistics::measures() const {
  std::vector<std::pair<std::string, double>> all{{"most_bodies", static_cast<double>(most_bodies_)},
                                                  {"most_contacts", static_cast<double>(most_contacts_)},
                                                  {"mean_contacts", over(contacts_, steps_)}};
  if (is_soft_) {
    all.emplace_back("mean_sub_steps", mean_sub_steps());
  } else {
    all.emplace_back("mean_iterations", over(iterations_, steps_in_contact_));
    all.emplace_back("mean_residual [m/s]", over(residual_, steps_in_contact_));
    all.emplace_back("largest_residual [m/s]", largest_residual_);
  }
  all.emplace_back("mean_penetration_over_radius", contacts_ > 0.0 ? mean_penetration_ / contacts_ : 0.0);
  all.emplace_back("max_penetration [m]", max_penetration_);
  all.emplace_back("narrow_phase_fallbacks", static_cast<double>(fallbacks_));
  all.emplace_back("peak_memory [byte]", peak_memory());
  return all;
}

ReportTable work_table(const RunStatistics& statistics, const PhaseTimer& timer) {
  ReportTable table{"work", {"what", "value"}, {}};
  for (const auto& [name, value] : statistics.measures()) {
    table.rows.push_back({name, fmt::format("{:.4g}", value)});
  }
  const PhaseTimer::Seconds& seconds = timer.total();
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const auto share = [&](std::initializer_list<Phase> phases) {
    double part = 0.0;
    for (const Phase phase : phases) part += seconds[static_cast<std::size_t>(phase)];
    return fmt::format("{:.1f}", sum > 0.0 ? 100.0 * part / sum : 0.0);
  };
  table.rows.push_back({"time for collision [%]", share({Phase::collision})});
  if (!statistics.is_soft()) table.rows.push_back({"time for the solver [%]", share({Phase::solver})});
  table.rows.push_back({"time for fields [%]", share({Phase::forces, Phase::fields})});
  table.rows.push_back({"time for output [%]", share({Phase::observers, Phase::output})});
  return table;
}

ReportTable balance_table(const Simulation& simulation) {
  const Materials& materials = simulation.materials();
  std::vector<Amount> in_flight(materials.size());
  const BodyView bodies = simulation.bodies().view();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] == Motion::dynamic) in_flight[bodies.material[i]].add(bodies.mass[i]);
  }
  ReportTable table{"particles by material",
                    {"material", "fed", "fed [kg]", "in flight", "in flight [kg]", "removed", "removed [kg]"},
                    {}};
  for (std::uint32_t m = 0; m < materials.size(); ++m) {
    const Amount& fed = simulation.feed().fed[m];
    const Amount& removed = simulation.feed().removed[m];
    if (fed.count == 0) continue;
    std::vector<std::string> row{materials[m].name};
    for (const Amount& amount : {fed, in_flight[m], removed}) {
      row.push_back(fmt::format("{}", amount.count));
      row.push_back(fmt::format("{:.6g}", amount.mass));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable phase_table(const PhaseTimer& timer) {
  const PhaseTimer::Seconds& seconds = timer.total();
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const std::vector<std::string> names = phase_names();
  ReportTable table{"wall time by phase", {"phase", "time [s]", "share"}, {}};
  for (std::size_t p = 0; p < names.size(); ++p) {
    table.rows.push_back({names[p], fmt::format("{:.3f}", seconds[p]),
                          fmt::format("{:.1f} %", sum > 0.0 ? 100.0 * seconds[p] / sum : 0.0)});
  }
  return table;
}

std::string to_text(const ReportTable& table) {
  std::vector<std::vector<std::string>> lines{table.header};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<std::size_t> width;
  std::vector<bool> right;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    width.resize(std::max(width.size(), lines[l].size()), 0);
    right.resize(width.size(), true);
    for (std::size_t c = 0; c < lines[l].size(); ++c) {
      width[c] = std::max(width[c], lines[l][c].size());
      if (l > 0 && !lines[l][c].empty() && !is_number(lines[l][c])) right[c] = false;
    }
  }
  std::string text = table.title + "\n";
  for (const std::vector<std::string>& line : lines) {
    std::string row = " ";
    for (std::size_t c = 0; c < line.size(); ++c) {
      row += right[c] ? fmt::format(" {:>{}} ", line[c], width[c]) : fmt::format(" {:<{}} ", line[c], width[c]);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

}  // namespace scree
