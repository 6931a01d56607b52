// A small world for tests of dvi: spheres over a half space, stepped by hand.
#pragma once

#include "dvi.hpp"
#include "support/fake_step_services.hpp"
#include "support/memory_state.hpp"

namespace scree::test {

/// Body 0 is the half space; spheres follow.
struct World {
  explicit World(const DviOptions& options = {}, int threads = 1) : dvi{options}, host{bodies, threads} {
    bodies.add_immovable(0, {}, Motion::fixed);
  }
  std::size_t add_sphere(const Vec3& centre, double radius, double density = 1000.0, const Vec3& velocity = {}) {
    return bodies.add_sphere(bodies.id.size(), centre, radius, density, velocity);
  }
  StepSummary step(double h) {
    const StepSummary summary = dvi.step(host, host.state(), time, h);
    time += h;
    return summary;
  }
  void run(int steps, double h) {
    for (int k = 0; k < steps; ++k) step(h);
  }

  /// Takes over the motion of a world with the same bodies, and what its stepper saves.
  void resume(const World& from) {
    MemoryState state;
    MemoryWriter writer{state};
    from.dvi.save(writer);
    bodies.position = from.bodies.position;
    bodies.orientation = from.bodies.orientation;
    bodies.velocity = from.bodies.velocity;
    bodies.angular_velocity = from.bodies.angular_velocity;
    time = from.time;
    dvi.load(MemoryReader{state});
  }

  Attributes attributes;
  TestBodies bodies{attributes};
  Dvi dvi;
  FakeStepServices host;
  double time = 0.0;  ///< [s]
};

}  // namespace scree::test
