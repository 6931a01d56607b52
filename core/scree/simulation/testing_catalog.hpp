// A catalog of tiny parts for tests of core: libscree is tested without any plugin.
#pragma once

#include <gtest/gtest.h>
#include <atomic>

#include <functional>
#include <string>
#include <vector>

#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/force_field.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/interfaces/sink.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/simulation/testing_observers.hpp"
#include "scree/state/state_io.hpp"

namespace scree::testing_parts {

/// v += h f / m, x += h v; no contacts.
class FreeFlight final : public TimeStepper {
 public:
  StepSummary step(StepServices& services, const BodyState& bodies, double time, double dt) override {
    force_.resize(bodies.view.size());
    torque_.resize(bodies.view.size());
    services.forces(bodies.view, time, {force_, torque_});
    StepSummary summary;
    for (std::size_t i = 0; i < bodies.view.size(); ++i) {
      if (bodies.view.motion[i] != Motion::dynamic) continue;
      const Vec3 before = bodies.velocity[i];
      bodies.velocity[i] += dt * inverse_mass(bodies.view, static_cast<BodyIndex>(i)) * force_[i];
      bodies.position[i] += dt * bodies.velocity[i];
      summary.work.force_work += dt * dot(force_[i], 0.5 * (before + bodies.velocity[i]));
    }
    return summary;
  }
  [[nodiscard]] ContactView contacts() const override { return {}; }

 private:
  std::vector<Vec3> force_, torque_;
};

/// Every pair of boxes.
class AllPairs final : public BroadPhase {
 public:
  void find_pairs(const BoxView& boxes, const Executor&, std::vector<CandidatePair>& out) override {
    for (ColliderIndex b = 0; b < boxes.size(); ++b) {
      for (ColliderIndex a = 0; a < b; ++a) {
        if (overlap(boxes.box[a], boxes.box[b])) out.push_back({a, b});
      }
    }
  }
};

/// Spheres only.
class Spheres final : public NarrowPhase {
 public:
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override {
    return a == ShapeKind::sphere && b == ShapeKind::sphere;
  }
  void bind(const ShapeSet& shapes, std::size_t) override { shapes_ = &shapes; }
  void collide(const ColliderView& view, std::span<const ColliderPair> pairs, ContactBuffer& out) const override {
    for (const ColliderPair& pair : pairs) {
      const Vec3 d = view.pose[pair.b].position - view.pose[pair.a].position;
      const double gap = norm(d) - shapes_->primitives()[view.primitive[pair.a]].size.x -
                         shapes_->primitives()[view.primitive[pair.b]].size.x;
      if (norm(d) == 0.0) ++fallbacks_;  // no line of centres: its normal is made up
      if (gap < pair.reach) out.push_back({view.body[pair.a], view.body[pair.b], 0, 0, 0, {}, normalized(d), gap});
    }
  }
  [[nodiscard]] std::uint64_t fallbacks() const override { return fallbacks_; }

 private:
  const ShapeSet* shapes_ = nullptr;
  mutable std::atomic<std::uint64_t> fallbacks_ = 0;
};

/// Constant acceleration along x; `poison` makes it write NaN from some time on, `charge_only` ids ignored.
class Push final : public ForceField {
 public:
  explicit Push(const Options& o) : acceleration_{o.number("acceleration")}, poison_from_{o.number("poison_from")} {}
  static std::vector<Parameter> parameters() {
    return {Parameter::number("acceleration", "m/s2", "along x").by_default(1.0),
            Parameter::number("poison_from", "s", "time from which the force is NaN").by_default(1e9)};
  }
  void add_forces(const BodyView& bodies, double time, WrenchView out) const override {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      out.force[i].x += bodies.mass[i] * acceleration_;
      if (time >= poison_from_ && i == 1) out.force[i].x = std::nan("");
    }
  }

 private:
  double acceleration_;  // [m/s2]
  double poison_from_;   // [s]
};

/// Reads the attribute `charge` [C]; no force.
class Charged final : public ForceField {
 public:
  void setup(SceneServices& services) override { services.require_attribute("charge", "C", "of the body"); }
  void add_forces(const BodyView&, double, WrenchView) const override {}
};

/// Reads a column that bodies have to bring.
class Weigher final : public ForceField {
 public:
  void setup(SceneServices& services) override { services.require_attribute("ballast", "kg", "what the body carries"); }
  void add_forces(const BodyView&, double, WrenchView) const override {}
};

/// One body a step at a random height; its counter is its state.
class Drip final : public Source {
 public:
  void setup(SceneServices& services) override { random_.push_back(services.random_stream("height")); }
  void emit(const BodyView&, double, double, std::vector<NewBody>& out) override {
    NewBody body;
    body.pose.position = {0, 0, random_[0].uniform()};
    body.mass = 2.0;
    body.radius = 1e-3;
    out.push_back(body);
  }
  void save(StateWriter& out) const override { out.write("counter", random_[0].counter()); }
  void load(const StateReader& in) override { random_[0].set_counter(in.integer("counter")); }

 private:
  std::vector<RandomStream> random_;
};

/// Removes what passed x = limit.
class Gate final : public Sink {
 public:
  explicit Gate(const Options& o) : limit_{o.number("limit")} {}
  static std::vector<Parameter> parameters() { return {Parameter::number("limit", "m", "bound on x")}; }
  void mark(const BodyView& bodies, double, std::span<char> remove) override {
    for (std::size_t i = 0; i < bodies.size(); ++i) remove[i] |= static_cast<char>(bodies.position[i].x > limit_);
  }
  [[nodiscard]] std::string reason() const override { return "passed the gate"; }

 private:
  double limit_;  // [m]
};

/// Finds the parts above by name.
class Catalog final : public PluginCatalog {
 public:
  Catalog() {
    list_.add<TimeStepper, FreeFlight>("free_flight", "");
    list_.add<BroadPhase, AllPairs>("all_pairs", "");
    list_.add<NarrowPhase, Spheres>("spheres", "");
    list_.add<ForceField, Push>("push", "", Push::parameters());
    list_.add<ForceField, Charged>("charged", "");
    list_.add<ForceField, Weigher>("weigher", "");
    list_.add<Source, Drip>("drip", "");
    list_.add<Sink, Gate>("gate", "", Gate::parameters());
    list_.add<Observer, Writer>("writer", "", Writer::parameters());
    list_.add<Observer, Counter>("counter", "", Counter::parameters());
  }
  [[nodiscard]] PluginList& list() { return list_; }
  [[nodiscard]] const PluginEntry& entry(std::string_view kind, std::string_view name,
                                         const SourceLocation& where) const override {
    for (const PluginEntry& entry : list_.entries()) {
      if (entry.kind == kind && entry.name == name) return entry;
    }
    throw Error{ErrorKind::usage, where, "no " + std::string{kind} + " '" + std::string{name} + "'"};
  }
  [[nodiscard]] std::vector<const PluginEntry*> entries() const override {
    std::vector<const PluginEntry*> all;
    for (const PluginEntry& entry : list_.entries()) all.push_back(&entry);
    return all;
  }

 private:
  PluginList list_;
};

/// A scene that the parts above can run; `more` is appended.
inline std::string scene(const std::string& more) {
  return "[simulation]\nend_time = 1.0\ntime_step = 0.1\n[time_stepper]\ntype = 'free_flight'\n[broad_phase]\ntype = "
         "'all_pairs'\n[[narrow_phase]]\ntype = 'spheres'\n[material.stone]\ndensity = 1000\n[shape.ball]\ntype = "
         "'sphere'\nradius = 0.1\n" +
         more;
}

}  // namespace scree::testing_parts
