#include "convergence.hpp"

#include <fmt/format.h>

#include "plot/figure.hpp"
#include "say.hpp"
#include "scree/ccp/count_contacts.hpp"

namespace scree {
namespace {

/// The trials with one kind of start, over iterations or over seconds.
plot::Figure figure_of(const CcpRecord& record, const std::vector<SolverTrial>& trials, bool warm, bool over_time) {
  plot::Figure figure;
  figure.title = warm ? "Convergence, from the impulses of the last step" : "Convergence, from zero impulses";
  figure.note = fmt::format("step {} at {:.6g} s: {}", record.origin.step, record.origin.time,
                            counted(count_contacts(record.problem()), "contact", "contacts"));
  figure.x = {over_time ? "time [s]" : "iterations", plot::Scale::linear, {}};
  figure.y = {"residual [m/s]", plot::Scale::logarithmic, {}};
  for (const SolverTrial& trial : trials) {
    if (trial.warm != warm) continue;
    plot::Series series{trial.solver, plot::SeriesStyle::line, {}, {}};
    for (const TrialPoint& point : trial.history) {
      series.x.push_back(point.iteration * (over_time ? seconds_per_iteration(trial) : 1.0));
      series.y.push_back(point.residual);
    }
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace

std::string start_name(const SolverTrial& trial) { return trial.warm ? "warm" : "cold"; }

double seconds_per_iteration(const SolverTrial& trial) {
  return trial.summary.iterations == 0 ? 0.0 : trial.wall_time / trial.summary.iterations;
}

ConvergenceLog::ConvergenceLog(const std::filesystem::path& file)
    : table_{file,
             {{"step", ""}, {"solver", ""}, {"start", ""}, {"iteration", ""}, {"time", "s"}, {"residual", "m/s"}}} {}

void ConvergenceLog::add(const CcpRecord& record, const SolverTrial& trial) {
  for (const TrialPoint& point : trial.history) {
    table_.cell(record.origin.step).cell(trial.solver).cell(start_name(trial));
    table_.cell(static_cast<std::int64_t>(point.iteration)).cell(point.iteration * seconds_per_iteration(trial));
    table_.cell(point.residual).end_row();
  }
}

void draw_convergence(const CcpRecord& record, const std::vector<SolverTrial>& trials,
                      const std::filesystem::path& folder) {
  for (const bool warm : {false, true}) {
    for (const bool over_time : {false, true}) {
      const plot::Figure figure = figure_of(record, trials, warm, over_time);
      if (figure.series.empty()) continue;
      write_figure(figure, folder / fmt::format("convergence_{}_{}_{}", record.origin.step, warm ? "warm" : "cold",
                                                over_time ? "time" : "iterations"));
    }
  }
}

}  // namespace scree
