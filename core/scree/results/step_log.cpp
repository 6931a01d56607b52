#include "scree/results/step_log.hpp"

#include "scree/model/material.hpp"

namespace scree {

namespace {

std::vector<CsvColumn> step_columns(const std::vector<std::string>& phases) {
  std::vector<CsvColumn> columns{{"step", ""},
                                 {"time", "s"},
                                 {"bodies", ""},
                                 {"contacts", ""},
                                 {"iterations", ""},
                                 {"residual", "m/s"},
                                 {"status", ""},
                                 {"mean_penetration", "1"},
                                 {"max_penetration", "m"},
                                 {"kinetic_energy", "J"},
                                 {"potential_energy", "J"},
                                 {"contact_loss", "J"},
                                 {"boundary_work", "J"},
                                 {"force_work", "J"},
                                 {"joint_work", "J"},
                                 {"fed_kinetic_energy", "J"},
                                 {"fallbacks", ""}};
  for (const std::string& phase : phases) columns.push_back({"seconds_" + phase, "s"});
  return columns;
}

}  // namespace

StepLog::StepLog(const std::filesystem::path& file, const std::vector<std::string>& phases)
    : table_{file, step_columns(phases)} {}

void StepLog::add(const StepRecord& record, std::span<const double> phase_seconds) {
  table_.cell(record.step).cell(record.time).cell(record.bodies).cell(record.contacts).cell(record.iterations);
  table_.cell(record.residual).cell(record.status).cell(record.mean_penetration).cell(record.max_penetration);
  const EnergyAccount& energy = record.energy;
  table_.cell(energy.kinetic).cell(energy.potential).cell(energy.work.contact_loss).cell(energy.work.boundary_work);
  table_.cell(energy.work.force_work).cell(energy.work.joint_work).cell(energy.fed_kinetic).cell(record.fallbacks);
  for (const double seconds : phase_seconds) table_.cell(seconds);
  table_.end_row();
}

RemovedLog::RemovedLog(const std::filesystem::path& file, const Materials& materials)
    : materials_{materials},
      table_{file,
             {{"id", ""},
              {"material", ""},
              {"mass", "kg"},
              {"time", "s"},
              {"x", "m"},
              {"y", "m"},
              {"z", "m"},
              {"sink", ""},
              {"reason", ""}}} {}

void RemovedLog::add(std::span<const RemovedBody> removed) {
  for (const RemovedBody& body : removed) {
    table_.cell(body.id).cell(materials_[body.material].name).cell(body.mass).cell(body.time);
    table_.cell(body.position.x).cell(body.position.y).cell(body.position.z).cell(body.sink).cell(body.reason);
    table_.end_row();
  }
}

}  // namespace scree
