// Observer: looks at the simulation and writes results; it changes nothing that
// moves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/interfaces/plugin.hpp"
#include "scree/interfaces/report_table.hpp"
#include "scree/model/body.hpp"

namespace scree {

class SceneServices;

/// One body that a sink took out.
struct RemovedBody {
  BodyId id = 0;
  std::uint32_t material = 0;  ///< index into Materials
  double mass = 0.0;           ///< [kg]
  double time = 0.0;           ///< [s]
  Vec3 position;               ///< [m], world
  std::string sink;            ///< name of the sink
  std::string reason;
};

/// What an observer may see. Spans and references are valid during the call
/// only.
struct Observation {
  BodyView bodies;
  ContactView contacts;                  ///< of the step that just ended, indices into `bodies`
  std::span<const RemovedBody> removed;  ///< taken out since the observer last looked
  double time = 0.0;                     ///< [s]
  double dt = 0.0;                       ///< outer step [s]
  std::uint64_t step = 0;                ///< steps done
};

/// Looks once per outer step: after the fields advanced and before sinks
/// remove.
class Observer : public Plugin {
 public:
  static constexpr const char* kKind = "observer";
  ~Observer() override;

  /// `results` is the folder to write into; empty when a run writes nothing.
  virtual void setup(SceneServices& services, const std::filesystem::path& results);
  /// `attributes` may be written only in columns that the observer provides.
  virtual void observe(const Observation& now, Attributes& attributes) = 0;
  /// Called once at the end of the run, also of an interrupted one: writes what
  /// is left.
  virtual void finish(const Observation& last);
  /// Tables for the end of the run, after finish().
  [[nodiscard]] virtual std::vector<ReportTable> report() const;
};

}  // namespace scree
