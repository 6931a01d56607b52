// Plugin: what every exchangeable part of a simulation has in common.
#pragma once

namespace scree {

class StateReader;
class StateWriter;

/// Base of all interfaces. A part is made from its Options, set up once, called
/// every step, and saved with checkpoints.
class Plugin {
 public:
  Plugin() = default;
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  virtual ~Plugin();

  /// Counts changes of what save() writes; a checkpoint of another version is
  /// refused.
  [[nodiscard]] virtual int version() const { return 1; }
  /// Writes everything that decides the next step and is not in the scene.
  /// Stateless parts write nothing.
  virtual void save(StateWriter& out) const;
  /// Restores what save() wrote.
  virtual void load(const StateReader& in);
  /// Frees workspace that the next call fills anew. The host asks for it in large scenes, so that the phases of a step take
  /// the same memory one after another. By default nothing is freed.
  virtual void release_workspace();
};

}  // namespace scree
