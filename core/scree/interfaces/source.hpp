// Source: adds bodies while the simulation runs.
#pragma once

#include <vector>

#include "scree/interfaces/plugin.hpp"
#include "scree/interfaces/report_table.hpp"
#include "scree/model/body_store.hpp"

namespace scree {

class SceneServices;

/// Feeds bodies. Called once at the beginning of every outer step.
class Source : public Plugin {
 public:
  static constexpr const char* kKind = "source";
  ~Source() override;

  virtual void setup(SceneServices& services);

  /// Appends the bodies born at `time` [s] for a step of length `dt` [s] to
  /// `out`. `bodies` are those that exist.
  virtual void emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) = 0;
  /// Tables for the end of the run.
  [[nodiscard]] virtual std::vector<ReportTable> report() const;
};

}  // namespace scree
