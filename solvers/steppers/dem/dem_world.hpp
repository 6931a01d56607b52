// A small world for tests of dem: balls over a half space, neighbours by trying all pairs, and a law of springs and dashpots.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "dem.hpp"
#include "scree/machine/machine.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"
#include "support/fake_scene_services.hpp"
#include "support/memory_state.hpp"
#include "support/test_bodies.hpp"

namespace scree::test {

/// Fn = k x + C v until the gap is zero again; a tangential spring and dashpot of the same strength, cut off at mu |Fn|.
class SpringLaw final : public ContactLaw {
 public:
  [[nodiscard]] std::size_t history_size() const override { return 3; }
  [[nodiscard]] bool resists_rolling() const override { return rolling > 0.0; }
  [[nodiscard]] double stable_step(const ContactScale& contact) const override {
    return 0.05 * 3.14 * std::sqrt(contact.mass / stiffness);
  }
  void forces(ContactBatch& batch) const override {
    for (std::size_t k = 0; k < batch.count; ++k) {
      const Vec3 n = batch.normal[k], v = batch.velocity[k], vt = v - dot(v, n) * n;
      const double push = stiffness * batch.overlap[k] - damping * dot(v, n);
      Vec3 spring{batch.history[0][k], batch.history[1][k], batch.history[2][k]};
      spring += batch.ahead[k] * vt;
      const Vec3 pull = -1.0 * (stiffness * spring + damping * vt);
      const double limit = friction * std::abs(push), size = norm(pull);
      const Vec3 tangent = size > limit ? (limit / size) * pull : pull;
      if (size > limit) spring = (-1.0 / stiffness) * (tangent + damping * vt);
      spring += batch.lead * vt;
      batch.history[0][k] = spring.x, batch.history[1][k] = spring.y, batch.history[2][k] = spring.z;
      batch.force.set(k, push * n + tangent);
      batch.torque.set(k, -rolling * batch.spin[k]);
    }
  }

  double stiffness = 1e4;  ///< [N/m]
  double damping = 0.0;    ///< [N s/m]
  double friction = 0.0;
  double rolling = 0.0;  ///< moment against relative spin [N m s]
};

/// Body 0 is the half space below its position, the others are balls of their radius, or bodies that touch nothing.
class DemHost final : public StepServices {
 public:
  DemHost(TestBodies& bodies, const SpringLaw& law, int threads) : bodies_{bodies}, law_{law}, executor_{threads} {
    materials_.add({"stuff", 1000.0, {}, {}});
  }
  [[nodiscard]] BodyState state() {
    return {bodies_.view(), bodies_.position, bodies_.orientation, bodies_.velocity, bodies_.angular_velocity};
  }
  void forces(const BodyView& view, double, WrenchView out) override {
    ++asked;
    for (std::size_t i = 0; i < view.size(); ++i) {
      out.force[i] = view.motion[i] == Motion::dynamic ? view.mass[i] * gravity : Vec3{};
      out.torque[i] = {};
    }
  }
  std::span<const Contact> contacts(const BodyView&, std::span<const Vec3>, std::span<const Vec3>, double) override {
    return {};
  }
  SolveSummary solve_ccp(const CcpProblem&, std::span<double>) override { return {}; }
  NeighbourView neighbours(const BodyView& view, const ExpectedMotion& expected) override {
    ++searches;
    const auto reach = [&](BodyIndex a, BodyIndex b) {
      return expected.skin + expected.horizon * norm(expected.velocity[b] - expected.velocity[a]);
    };
    balls_.clear(), others_.clear();
    for (BodyIndex a = 1; a < view.size(); ++a) {
      if (view.position[a].z - view.radius[a] - view.position[0].z >= reach(0, a)) continue;
      if (simple_floor && view.motion[0] == Motion::fixed) {
        balls_.push_back({0, a});
      } else {
        others_.push_back(a);
      }
    }
    for (BodyIndex a = 1; balls_meet && a < view.size(); ++a) {
      for (BodyIndex b = a + 1; b < view.size(); ++b) {
        if (norm(view.position[b] - view.position[a]) < view.radius[a] + view.radius[b] + reach(a, b))
          balls_.push_back({a, b});
      }
    }
    if (!others_.empty()) others_.insert(others_.begin(), 0);
    return {balls_, others_};
  }
  std::span<const Contact> neighbour_contacts(const BodyView& view, double reach) override {
    found_.clear();
    for (const BodyIndex b : others_) {
      const double floor = view.position[0].z, gap = view.position[b].z - view.radius[b] - floor;
      if (b == 0 || gap >= reach) continue;
      found_.push_back({0, b, 0, 0, 0, {view.position[b].x, view.position[b].y, floor + 0.5 * gap}, {0, 0, 1}, gap});
    }
    return found_;
  }
  [[nodiscard]] bool forces_are_steady() const override { return steady; }
  [[nodiscard]] const ContactLaw* contact_law() const override { return &law_; }
  [[nodiscard]] const Materials& materials() const override { return materials_; }
  [[nodiscard]] const Executor& executor() const override { return executor_; }

  [[nodiscard]] std::uint64_t filter_version() const override { return balls_meet ? 1 : 0; }
  [[nodiscard]] Machine* machine() override { return joints; }

  Machine* joints = nullptr;  ///< of the scene; none
  Vec3 gravity;               ///< [m/s2]
  bool steady = true;
  bool balls_meet = true;    ///< not kept apart by the scene's filter
  bool simple_floor = true;  ///< as the real pipeline has it; else the narrow phase finds its contacts
  int asked = 0;             ///< times that forces() was called
  int searches = 0;          ///< for neighbours

 private:
  TestBodies& bodies_;
  const SpringLaw& law_;
  Executor executor_;
  Materials materials_;
  std::vector<BodyPair> balls_;
  std::vector<BodyIndex> others_;
  std::vector<Contact> found_;
};

struct DemWorld {
  explicit DemWorld(const DemOptions& options = {}, int threads = 1) : dem{options}, host{bodies, law, threads} {
    PrimitiveData plane;
    plane.primitive.kind = ShapeKind::plane;
    add_shape(plane, 0.0);
    dem.setup(scene);
    bodies.add_immovable(0, {0, 0, -1e3}, Motion::fixed);
  }
  std::uint32_t add_shape(const PrimitiveData& primitive, double volume) {
    ShapeData shape;
    shape.primitives = {primitive};
    shape.volume = volume;
    return scene.shapes().add(shape);
  }
  std::size_t add_ball(const Vec3& centre, double radius, const Vec3& velocity = {}, double density = 1000.0) {
    const std::size_t i = bodies.add_sphere(bodies.id.back() + 1, centre, radius, density, velocity);
    PrimitiveData ball;
    ball.primitive.size = {radius, 0, 0};
    const double volume = 4.0 / 3.0 * 3.14159265358979 * radius * radius * radius;
    bodies.shape[i] = add_shape(ball, volume);
    return i;
  }
  StepSummary step(double dt) {
    const StepSummary summary = dem.step(host, host.state(), time, dt);
    time += dt;
    return summary;
  }
  [[nodiscard]] Vec3 momentum() const {
    Vec3 sum;
    for (std::size_t i = 1; i < bodies.id.size(); ++i) sum += bodies.mass[i] * bodies.velocity[i];
    return sum;
  }
  [[nodiscard]] Vec3 angular_momentum() const {
    Vec3 sum;
    for (std::size_t i = 1; i < bodies.id.size(); ++i) {
      sum += cross(bodies.position[i], bodies.mass[i] * bodies.velocity[i]) +
             bodies.inertia[i].x * bodies.angular_velocity[i];
    }
    return sum;
  }
  [[nodiscard]] double kinetic_energy() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < bodies.id.size(); ++i) {
      sum += 0.5 * bodies.mass[i] * squared_norm(bodies.velocity[i]) +
             0.5 * bodies.inertia[i].x * squared_norm(bodies.angular_velocity[i]);
    }
    return sum;
  }

  /// A cloud of balls that touch each other a little, at rest but for random velocities [m/s].
  void add_cloud(int side, double speed) {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> any{-1.0, 1.0};
    for (int k = 0; k < side * side * side; ++k) {
      const int layer = k / side, top = layer / side;
      const Vec3 cell{static_cast<double>(k % side), static_cast<double>(layer % side), static_cast<double>(top)};
      const Vec3 shift{any(random), any(random), any(random)}, v{any(random), any(random), any(random)};
      add_ball(0.0097 * cell + 0.0003 * shift, 0.005, speed * v);
    }
  }

  Attributes attributes;
  TestBodies bodies{attributes};
  FakeSceneServices scene;
  SpringLaw law;
  Dem dem;
  DemHost host;
  double time = 0.0;  ///< [s]
};

}  // namespace scree::test
