// Contact problems of statics and of one step, built by hand, whose answers are known in closed form: for every solver.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "conformance/ccp_solver_case.hpp"
#include "scree/math/contact_frame.hpp"
#include "solver_by_name.hpp"

namespace scree::test {
namespace {

constexpr double kG = 9.81, kStep = 1e-3, kTolerance = 1e-12;  // [m/s2], [s], of all solves [m/s]

/// Bodies with positions and free velocities v0 + h M^-1 f, and contacts at points in the world.
struct Bench {
  TestingProblem problem;
  std::vector<Vec3> position;
  std::vector<Twist> free;

  std::uint32_t immovable() {
    position.emplace_back();
    free.emplace_back();
    return problem.add_immovable();
  }
  std::uint32_t body(double mass, const Vec3& inertia, const Vec3& centre, const Twist& free_velocity) {
    position.push_back(centre);
    free.push_back(free_velocity);
    return problem.add_body(mass, inertia);
  }
  /// `b_n`: what is added to the normal row of r, Phi / h say [m/s].
  void contact(std::uint32_t a, std::uint32_t b, const Vec3& point, const Vec3& normal, double friction,
               double b_n = 0.0) {
    problem.add_contact(a, b, normal, point - position[a], point - position[b], friction, {});
    const Vec3 u = relative_velocity(problem.contacts.back(), free[a], free[b]);
    store_block(problem.r, problem.contacts.size() - 1, u + Vec3{b_n, 0, 0});
  }
  /// A contact that resists rolling and spinning: arms of the moments [m], `length` [m] that makes rows of them.
  void rolling_contact(std::uint32_t a, std::uint32_t b, const Vec3& point, const Vec3& normal, double friction,
                       double spinning, double rolling, double length, double b_n = 0.0) {
    const ContactFrame f = contact_frame(normal);
    std::vector<CcpRow> rows;
    std::vector<double> r;
    for (const Vec3& e : {f.normal, f.tangent1, f.tangent2}) {
      rows.push_back({{-e, -cross(point - position[a], e)}, {e, cross(point - position[b], e)}});
    }
    for (const Vec3& e : {f.normal, f.tangent1, f.tangent2}) rows.push_back({{{}, -length * e}, {{}, length * e}});
    for (const CcpRow& row : rows) {
      r.push_back(dot(row.a.linear, free[a].linear) + dot(row.a.angular, free[a].angular) +
                  dot(row.b.linear, free[b].linear) + dot(row.b.angular, free[b].angular));
    }
    r[0] += b_n;
    problem.add_block({.kind = CcpKind::cone,
                       .a = a,
                       .b = b,
                       .friction = friction,
                       .spinning = spinning / length,
                       .rolling = rolling / length},
                      rows, r);
  }
  /// Velocities after the impulses `gamma`.
  [[nodiscard]] std::vector<Twist> after(const std::vector<double>& gamma) const {
    const CcpProblem view = problem.view();
    DelassusOperator delassus;
    delassus.bind(view, nullptr);
    std::vector<Twist> v(view.bodies());
    delassus.body_velocities(gamma, v);
    for (std::size_t k = 0; k < v.size(); ++k) v[k] += free[k];
    return v;
  }
};

/// Impulse of contact i on its body b, world [N s].
Vec3 impulse_on_b(const Bench& bench, const std::vector<double>& gamma, std::size_t i) {
  return in_world(bench.problem.contacts[i], load_block(gamma, i));
}

class ClosedForms : public testing::TestWithParam<const char*> {
 protected:
  Solved solved(const Bench& bench) {
    Solved s = solve(*solver_named(GetParam()), bench.problem.view(), kTolerance, 1000000);
    EXPECT_EQ(s.summary.status, SolveStatus::converged);
    EXPECT_LE(ccp_residual(bench.problem.view(), s.gamma), 2 * kTolerance);
    return s;
  }
};

class RollingClosedForms : public ClosedForms {
 protected:
  void SetUp() override {
    if (!takes_blocks(*solver_named(GetParam()))) GTEST_SKIP() << "takes no blocks";
  }
};

constexpr double kRadius = 0.05, kMass = 0.4;
constexpr double kSphereInertia = 0.4 * kMass * kRadius * kRadius;
constexpr double kWeight = kMass * kG * kStep;  // over a step [N s]

std::uint32_t add_sphere(Bench& bench, const Vec3& centre, const Vec3& velocity, const Vec3& turning) {
  return bench.body(kMass, {kSphereInertia, kSphereInertia, kSphereInertia}, centre, {velocity, turning});
}

// Two contacts: a sphere spins in the corner of a floor and a wall, slipping on both. N1 + mu N2 = W and N2 = mu N1, so
// that N1 = W / (1 + mu^2). Both float at mu |u_t|, so that the associated problem has the impulses of exact friction.
TEST_P(ClosedForms, sphere_spinning_in_a_corner_slips_on_floor_and_wall) {
  const double mu = 0.4, w0 = 30.0;
  const double floor_impulse = kWeight / (1 + mu * mu), wall_impulse = mu * floor_impulse;
  const double w1 = w0 - kRadius * mu * (floor_impulse + wall_impulse) / kSphereInertia;
  for (const bool floating : {true, false}) {
    Bench bench;
    const std::uint32_t ground = bench.immovable();
    const std::uint32_t ball = add_sphere(bench, {0, 0, kRadius}, {0, 0, -kG * kStep}, {0, w0, 0});
    const double float_rate = floating ? mu * kRadius * w1 : 0.0;
    bench.contact(ground, ball, {0, 0, 0}, {0, 0, 1}, mu, float_rate);
    bench.contact(ground, ball, {kRadius, 0, kRadius}, {-1, 0, 0}, mu, float_rate);
    const Solved s = solved(bench);
    if (!floating) {
      expect_solution(bench.problem.view(), s.gamma, kTolerance);  // the associated answer: both contacts lift off
      continue;
    }
    // 1e-12 m/s of residual are 1e-10 of g h.
    EXPECT_NEAR(s.gamma[0], floor_impulse, 1e-8 * kWeight);
    EXPECT_NEAR(s.gamma[3], wall_impulse, 1e-8 * kWeight);
    EXPECT_NEAR(impulse_on_b(bench, s.gamma, 0).x, mu * floor_impulse, 1e-8 * kWeight);
    EXPECT_NEAR(impulse_on_b(bench, s.gamma, 1).z, mu * wall_impulse, 1e-8 * kWeight);
    EXPECT_NEAR(bench.after(s.gamma)[ball].angular.y, w1, 1e-8 * w0);
  }
}

/// A sphere in a groove whose walls make the angle `half` with the vertical plane between them.
Bench groove(double half, double mu, double free_rise) {
  Bench bench;
  const std::uint32_t walls = bench.immovable();
  const std::uint32_t ball = add_sphere(bench, {}, {0, 0, free_rise}, {});
  for (const double side : {1.0, -1.0}) {
    const Vec3 normal{side * std::cos(half), 0, std::sin(half)};
    bench.contact(walls, ball, -kRadius * normal, normal, mu);
  }
  return bench;
}

double coulomb_error_of(const Bench& bench, const std::vector<double>& gamma) {
  return CcpJudge{}.figures(bench.problem.view(), gamma, nullptr).coulomb_error;
}

// Pulled upwards, a sphere in a groove comes free if mu < tan(half). With more friction both states meet Coulomb's
// conditions, free and wedged by impulses along the line between the contacts, as large as it takes; the associated problem
// has the wedged one alone.
TEST_P(ClosedForms, groove_lets_go_or_wedges_by_the_angle_of_friction) {
  const double half = 20.0 / 180.0 * std::numbers::pi, rise = 0.01;
  for (const double mu : {0.9 * std::tan(half), 1.1 * std::tan(half)}) {
    const Bench bench = groove(half, mu, rise);
    const Solved s = solved(bench);
    const Vec3 sum = impulse_on_b(bench, s.gamma, 0) + impulse_on_b(bench, s.gamma, 1);
    const Vec3 v = bench.after(s.gamma)[1].linear;
    const std::vector<double> none(6, 0.0);
    EXPECT_LT(coulomb_error_of(bench, none), 1e-12);
    if (mu < std::tan(half)) {
      EXPECT_EQ(s.gamma, none);
      EXPECT_NEAR(v.z, rise, 1e-15);
    } else {
      // A wedge this narrow makes 30 of the residual; 1e-10 m/s are 1e-8 of the rise.
      EXPECT_NEAR(v.z, 0.0, 1e-10);
      EXPECT_NEAR(sum.z, -kMass * rise, 1e-8 * kMass * rise);
      // Each wall pushes down: N (sin - T / N cos) with |T| <= mu N, so N is at least what the limit of friction needs.
      const double least = 0.5 * kMass * rise / (mu * std::cos(half) - std::sin(half));
      EXPECT_GE(s.gamma[0], least * (1 - 1e-8));
      EXPECT_NEAR(s.gamma[0], s.gamma[3], 1e-8 * s.gamma[0]);
      EXPECT_LT(coulomb_error_of(bench, s.gamma), 1e-8);
    }
  }
}

// Pressed into the groove it rests; friction takes any part of the weight: N sin + T cos = W / 2.
TEST_P(ClosedForms, groove_carries_the_weight_whatever_friction_does) {
  const double half = 20.0 / 180.0 * std::numbers::pi;
  for (const double mu : {0.0, 0.3, 0.8}) {
    const Bench bench = groove(half, mu, -kG * kStep);
    const Solved s = solved(bench);
    const Vec3 sum = impulse_on_b(bench, s.gamma, 0) + impulse_on_b(bench, s.gamma, 1);
    EXPECT_NEAR(sum.z, kWeight, 1e-8 * kWeight);
    EXPECT_NEAR(sum.x, 0.0, 1e-8 * kWeight);
    EXPECT_NEAR(norm(bench.after(s.gamma)[1].linear), 0.0, 1e-10);
    const double most = 0.5 * kWeight / std::sin(half);  // without friction
    if (mu == 0.0) {
      EXPECT_NEAR(s.gamma[0], most, 1e-8 * kWeight);
    }
    // At most friction pulls it down as hard as it can, N sin - mu N cos = W / 2; a steep groove then knows no limit.
    const double hold = std::sin(half) - mu * std::cos(half);
    if (hold > 0.0) {
      EXPECT_LE(s.gamma[0], 0.5 * kWeight / hold * (1 + 1e-8));
    }
  }
}

// A table on four legs, loaded off its middle: single impulses are not determined, their sum and moments are.
TEST_P(ClosedForms, table_on_four_legs_carries_its_load_with_moments_in_balance) {
  const double mass = 12.0, a = 0.5, b = 0.3, height = 0.7;
  const Vec3 load{0.1, -0.08, 0.0};  // centre of mass off the middle of the legs
  Bench bench;
  const std::uint32_t ground = bench.immovable();
  const std::uint32_t table = bench.body(mass, {0.6, 1.1, 1.4}, {}, {{0, 0, -kG * kStep}, {}});
  std::array<Vec3, 4> foot;
  for (std::size_t k = 0; k < 4; ++k) {
    foot[k] = Vec3{k % 2 == 0 ? a : -a, k < 2 ? b : -b, -height} - load;
    bench.contact(ground, table, foot[k], {0, 0, 1}, 0.5);
  }
  const Solved s = solved(bench);
  Vec3 sum, moment;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GE(s.gamma[3 * k], 0.0);
    sum += impulse_on_b(bench, s.gamma, k);
    moment += cross(foot[k], impulse_on_b(bench, s.gamma, k));
  }
  const double weight = mass * kG * kStep;
  EXPECT_NEAR(norm(sum - Vec3{0, 0, weight}), 0.0, 1e-8 * weight);
  EXPECT_NEAR(norm(moment), 0.0, 1e-8 * weight * a);
  EXPECT_NEAR(norm(bench.after(s.gamma)[table].linear), 0.0, 1e-10);
  expect_solution(bench.problem.view(), s.gamma, kTolerance);
}

// Three equal cylinders in a pyramid, the lower two a gap apart: with theta the angle of the upper normals from the
// vertical, N = W / 2 and T = W / 2 tan(theta / 2) (0.13397 W where they nearly touch); 1.5 W under each lower one.
TEST_P(ClosedForms, three_cylinders_in_a_pyramid_carry_each_other_as_statics_says) {
  const double length = 0.2, apart = 2 * kRadius * (1 + 1e-9), sine = 0.5 * apart / (2 * kRadius);
  const double cosine = std::sqrt(1 - sine * sine), tangent = sine / (1 + cosine);
  const double across = kMass * (kRadius * kRadius / 4 + length * length / 12);
  const Vec3 inertia{across, 0.5 * kMass * kRadius * kRadius, across};  // about y
  const Twist falling{{0, 0, -kG * kStep}, {}};
  Bench bench;
  const std::uint32_t ground = bench.immovable();
  const std::uint32_t left = bench.body(kMass, inertia, {-0.5 * apart, 0, kRadius}, falling);
  const std::uint32_t right = bench.body(kMass, inertia, {0.5 * apart, 0, kRadius}, falling);
  const std::uint32_t top = bench.body(kMass, inertia, {0, 0, kRadius + 2 * kRadius * cosine}, falling);
  bench.contact(ground, left, {-0.5 * apart, 0, 0}, {0, 0, 1}, 0.5);
  bench.contact(ground, right, {0.5 * apart, 0, 0}, {0, 0, 1}, 0.5);
  for (const std::uint32_t lower : {left, right}) {
    const Vec3 normal = normalized(bench.position[top] - bench.position[lower]);
    bench.contact(lower, top, bench.position[lower] + kRadius * normal, normal, 0.5);
  }
  const Solved s = solved(bench);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 floor = load_block(s.gamma, k), upper = load_block(s.gamma, k + 2);
    EXPECT_NEAR(floor.x, 1.5 * kWeight, 1e-7 * kWeight);
    EXPECT_NEAR(std::hypot(floor.y, floor.z), 0.5 * tangent * kWeight, 1e-7 * kWeight);
    EXPECT_NEAR(upper.x, 0.5 * kWeight, 1e-7 * kWeight);
    EXPECT_NEAR(std::hypot(upper.y, upper.z), 0.13397 * kWeight, 1e-5 * kWeight);
  }
  EXPECT_LE(ccp_residual(bench.problem.view(), s.gamma), 1e-9);
}

// A sphere that rolls and is held back: v' = -5 mu_r g / (7 R), friction m v', the moment mu_r m g against its turning;
// whatever length makes rows of angular velocities.
TEST_P(RollingClosedForms, rolling_sphere_is_slowed_by_five_sevenths_of_mu_r_g_over_r) {
  const double v0 = 0.3, mu_r = 1e-3, slow = 5 * mu_r * kG / (7 * kRadius), w1 = (v0 - slow * kStep) / kRadius;
  for (const double length : {kRadius, 0.1 * kRadius, 1.0}) {
    Bench bench;
    const std::uint32_t ground = bench.immovable();
    const std::uint32_t ball = add_sphere(bench, {0, 0, kRadius}, {v0, 0, -kG * kStep}, {0, v0 / kRadius, 0});
    bench.rolling_contact(ground, ball, {}, {0, 0, 1}, 0.5, 1e-3, mu_r, length, mu_r * w1);  // it floats
    const Solved s = solved(bench);
    const ContactFrame f = contact_frame({0, 0, 1});
    const Vec3 force = to_world(f, {s.gamma[0], s.gamma[1], s.gamma[2]});
    const Vec3 moment = length * to_world(f, {s.gamma[3], s.gamma[4], s.gamma[5]});
    EXPECT_NEAR(norm(force - Vec3{-kMass * slow * kStep, 0, kWeight}), 0.0, 1e-7 * kWeight);
    EXPECT_NEAR(norm(moment - Vec3{0, -mu_r * kWeight, 0}), 0.0, 1e-7 * kWeight * kRadius);
    EXPECT_NEAR(bench.after(s.gamma)[ball].linear.x, v0 - slow * kStep, 1e-10);
  }
}

// On an incline a sphere stays iff tan a <= mu_r / R; the moment then is R m g sin a.
TEST_P(RollingClosedForms, sphere_stays_on_an_incline_up_to_the_rolling_angle) {
  const double mu_r = 5e-3;
  for (const double slope : {0.99 * mu_r / kRadius, 1.01 * mu_r / kRadius}) {
    const double angle = std::atan(slope);
    Bench bench;
    const std::uint32_t ground = bench.immovable();
    const Vec3 fall = kG * kStep * Vec3{std::sin(angle), 0, -std::cos(angle)};
    const std::uint32_t ball = add_sphere(bench, {0, 0, kRadius}, fall, {});
    bench.rolling_contact(ground, ball, {}, {0, 0, 1}, 0.9, 0.0, mu_r, kRadius);
    const Solved s = solved(bench);
    const Twist v = bench.after(s.gamma)[ball];
    if (slope < mu_r / kRadius) {
      EXPECT_NEAR(norm(v.linear), 0.0, 1e-10);
      const Vec3 moment = kRadius * to_world(contact_frame({0, 0, 1}), {s.gamma[3], s.gamma[4], s.gamma[5]});
      EXPECT_NEAR(moment.y, -kRadius * kWeight * std::sin(angle), 1e-7 * kRadius * kWeight);
    } else {
      EXPECT_GT(v.linear.x, 1e-3 * kG * kStep * std::sin(angle));
      EXPECT_NEAR(v.linear.x - kRadius * v.angular.y, 0.0, 1e-10);  // it rolls
    }
  }
}

// A top on its point: spinning friction takes mu_s m g from I w, and no more than stops it.
TEST_P(RollingClosedForms, spinning_friction_slows_a_top_until_it_stops) {
  const double mu_s = 2e-3, slow = mu_s * kWeight / kSphereInertia;
  for (const double w0 : {10.0 * slow, 0.5 * slow}) {
    const double w1 = std::max(0.0, w0 - slow);
    Bench bench;
    const std::uint32_t ground = bench.immovable();
    const std::uint32_t ball = add_sphere(bench, {0, 0, kRadius}, {0, 0, -kG * kStep}, {0, 0, w0});
    bench.rolling_contact(ground, ball, {}, {0, 0, 1}, 0.5, mu_s, 0.0, kRadius, mu_s * w1);
    const Solved s = solved(bench);
    EXPECT_NEAR(bench.after(s.gamma)[ball].angular.z, w1, 1e-7 * slow);
    EXPECT_NEAR(kRadius * s.gamma[3], -kSphereInertia * (w0 - w1), 1e-7 * mu_s * kWeight);
  }
}

std::string solver_name(const testing::TestParamInfo<const char*>& info) { return info.param; }
constexpr const char* kSolvers[] = {"admm",   "apgd", "asgs", "interior_point",
                                    "jacobi", "pgs",  "spg",  "semismooth_newton"};
INSTANTIATE_TEST_SUITE_P(solvers, ClosedForms, testing::ValuesIn(kSolvers), solver_name);
INSTANTIATE_TEST_SUITE_P(solvers, RollingClosedForms, testing::ValuesIn(kSolvers), solver_name);

}  // namespace
}  // namespace scree::test
