// Emitter: particles that come out of a rectangle at a rate.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "family.hpp"
#include "occupancy.hpp"
#include "scree/interfaces/source.hpp"

namespace scree {

class ShapeSet;

/// A steady feed. What finds no place is born later, never lost.
class Emitter final : public Source {
 public:
  explicit Emitter(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

  /// Particles born so far, and how often one had to wait for a place.
  [[nodiscard]] std::uint64_t emitted() const { return emitted_; }
  [[nodiscard]] std::uint64_t postponed() const { return postponed_; }
  /// Particles that were due at the end of the last step and are not born; of a mass_rate, by the mean mass so far.
  [[nodiscard]] double backlog() const;

 private:
  /// Time since the start of the feed, at `until` [s].
  [[nodiscard]] double open_until(double until) const;
  /// Says once that the feed is more than a second behind.
  void tell_of_backlog(double time);
  [[nodiscard]] bool is_due(const Particle& particle, double until) const;
  /// The box of all places of birth in a step of `dt` [s].
  [[nodiscard]] Aabb outlet(double dt) const;
  /// A pose on the outlet where the particle overlaps nothing, or false after some trials.
  bool place(Particle& particle, double dt);

  Options options_;
  std::optional<double> rate_;       // [1/s]
  std::optional<double> mass_rate_;  // [kg/s]
  std::uint64_t total_ = std::numeric_limits<std::uint64_t>::max();
  double start_ = 0.0;                                     // [s]
  double stop_ = std::numeric_limits<double>::infinity();  // [s]
  Vec3 centre_, u_, v_;                                    // [m]
  Vec3 velocity_;                                          // [m/s]
  double spread_ = 0.0;                                    // deviation of the velocity along each axis [m/s]
  double spin_ = 0.0;                                      // deviation of the angular velocity about each axis [rad/s]

  std::optional<Mixture> mixture_;
  ShapeSet* shapes_ = nullptr;
  const SceneServices* services_ = nullptr;
  std::string name_;
  std::optional<RandomStream> particles_;  // which particle comes next
  std::optional<RandomStream> places_;     // where it is born
  Occupancy occupancy_;

  std::uint64_t emitted_ = 0;
  double emitted_mass_ = 0.0;  // [kg]
  std::uint64_t postponed_ = 0;
  double until_ = 0.0;                 // end of the last step [s]
  bool told_ = false;                  // of the backlog
  std::optional<Particle> pending_;    // drawn, but without a place so far
  std::uint64_t pending_counter_ = 0;  // of particles_ before it was drawn, so that it can be drawn again
};

}  // namespace scree
