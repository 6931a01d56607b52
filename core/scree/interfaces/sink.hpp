// Sink: takes bodies out of the simulation, with a reason.
#pragma once

#include <span>
#include <string>

#include "scree/interfaces/plugin.hpp"
#include "scree/model/body.hpp"

namespace scree {

class SceneServices;

/// Removes bodies. Called at the end of every outer step; what it removes is
/// logged with id, place and reason.
class Sink : public Plugin {
 public:
  static constexpr const char* kKind = "sink";
  ~Sink() override;

  virtual void setup(SceneServices& services);

  /// Sets remove[i] = 1 for the dynamic bodies that leave at `time` [s], the
  /// end of the step; never clears an entry.
  virtual void mark(const BodyView& bodies, double time, std::span<char> remove) = 0;
  /// One line that says why a body is removed, for the log: "left through plane
  /// y = -0.6 m".
  [[nodiscard]] virtual std::string reason() const = 0;
};

}  // namespace scree
