// Cone complementarity problems for tests: random feasible ones and closed forms.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::test {

/// Owns what a CcpProblem refers to.
struct TestingProblem {
  std::vector<double> inverse_mass;
  std::vector<Mat3> inverse_inertia;
  std::vector<CcpContact> contacts;
  std::vector<double> r;
  std::vector<double> compliance;
  std::vector<CcpBlock> blocks;
  std::vector<CcpRow> block_rows;
  std::vector<std::uint32_t> matrix_first, matrix_column;
  std::vector<std::size_t> matrix_value;
  std::vector<double> matrix_values;

  [[nodiscard]] CcpProblem view() const {
    return {inverse_mass, inverse_inertia, contacts,   r,
            compliance,   blocks,          block_rows, {matrix_first, matrix_column, matrix_value, matrix_values}};
  }

  /// Adds a body; returns its index.
  std::uint32_t add_body(double mass, const Vec3& inertia) {
    inverse_mass.push_back(1.0 / mass);
    inverse_inertia.push_back(Mat3::diagonal({1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z}));
    return static_cast<std::uint32_t>(inverse_mass.size() - 1);
  }
  std::uint32_t add_immovable() {
    inverse_mass.push_back(0.0);
    inverse_inertia.push_back({});
    return static_cast<std::uint32_t>(inverse_mass.size() - 1);
  }
  /// Adds a contact with row constants `velocity` (normal, tangent 1, tangent 2).
  void add_contact(std::uint32_t a, std::uint32_t b, const Vec3& normal, const Vec3& arm_a, const Vec3& arm_b,
                   double friction, const Vec3& velocity) {
    contacts.push_back({normal, arm_a, arm_b, friction, a, b});
    r.insert(r.end(), {velocity.x, velocity.y, velocity.z});
  }
  /// Adds a block with its Jacobian and row constants, after all contacts; its first row is filled in.
  void add_block(CcpBlock block, const std::vector<CcpRow>& jacobian, const std::vector<double>& velocity) {
    block.rows = static_cast<std::uint8_t>(jacobian.size());
    block.first_row = static_cast<std::uint32_t>(block_rows.size());
    blocks.push_back(block);
    block_rows.insert(block_rows.end(), jacobian.begin(), jacobian.end());
    r.insert(r.end(), velocity.begin(), velocity.end());
  }
};

/// A sphere (body 1) on the floor (body 0); r = `velocity` in the contact frame.
inline TestingProblem sphere_on_floor(double mass, double radius, double friction, const Vec3& velocity) {
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  const double j = 0.4 * mass * radius * radius;
  const std::uint32_t sphere = t.add_body(mass, {j, j, j});
  t.add_contact(floor, sphere, {0, 0, 1}, {}, {0, 0, -radius}, friction, velocity);
  return t;
}

/// The rows of a joint or of a contact of `rows` rows at a point: velocities along the axes of the contact frame, then turning
/// about them, times `length` [m]. Cones of 5 rows leave out the turning about the normal.
inline std::vector<CcpRow> rows_at_a_point(std::size_t rows, bool cone, const Vec3& normal, const Vec3& arm_a,
                                           const Vec3& arm_b, double length) {
  const ContactFrame frame = contact_frame(normal);
  const std::array<Vec3, 3> axes{frame.normal, frame.tangent1, frame.tangent2};
  std::vector<CcpRow> out;
  for (std::size_t k = 0; k < std::min<std::size_t>(rows, 3); ++k) {
    out.push_back({{-axes[k], -cross(arm_a, axes[k])}, {axes[k], cross(arm_b, axes[k])}});
  }
  for (std::size_t k = 3; k < rows; ++k) {
    const Vec3 axis = length * axes[cone && rows == 5 ? k - 2 : k - 3];
    out.push_back({{{}, -axis}, {{}, axis}});
  }
  return out;
}

/// One body of mass `m` that a block moves along x, y, z and turns about x, y, z with arms of 1 m: N = 1/m. r = `u`.
inline TestingProblem one_block(double m, const CcpBlock& block, const std::vector<double>& u) {
  constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  TestingProblem t;
  const std::uint32_t world = t.add_immovable(), body = t.add_body(m, {m, m, m});
  CcpBlock b = block;
  b.a = world, b.b = body;
  std::vector<CcpRow> rows(u.size());
  for (std::size_t k = 0; k < u.size(); ++k) (k < 3 ? rows[k].b.linear : rows[k].b.angular) = kAxes[k % 3];
  t.add_block(b, rows, u);
  return t;
}

/// What random_problem() draws.
struct RandomProblem {
  std::size_t bodies = 10;
  std::size_t immovable = 1;
  std::size_t contacts = 20;
  bool compliant = false;
  double mass_decades = 1.0;  ///< masses between 1 and 10^this
  std::size_t reach = 0;      ///< bodies that touch are so many apart at most, as in a bed; 0: any
  std::uint64_t seed = 1;
};

/// Random contacts between random bodies. Feasible: r = D^T v + s with s in K*,
/// so that the velocity -v satisfies all contacts.
inline TestingProblem random_problem(const RandomProblem& what) {
  std::mt19937_64 random{what.seed};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  TestingProblem t;
  for (std::size_t k = 0; k < what.immovable; ++k) t.add_immovable();
  for (std::size_t k = 0; k < what.bodies; ++k) {
    const double m = std::pow(10.0, what.mass_decades * uniform(random));
    t.add_body(m, {0.1 * m * (1.0 + uniform(random)), 0.1 * m * (1.0 + uniform(random)), 0.15 * m});
  }
  std::vector<Twist> velocity(what.immovable + what.bodies);
  for (std::size_t k = what.immovable; k < velocity.size(); ++k) {
    velocity[k] = {{normal(random), normal(random), normal(random)}, {normal(random), normal(random), normal(random)}};
  }
  const auto direction = [&] { return normalized(Vec3{normal(random), normal(random), normal(random)}); };
  while (t.contacts.size() < what.contacts) {
    auto a = static_cast<std::uint32_t>(uniform(random) * static_cast<double>(velocity.size()));
    auto b = static_cast<std::uint32_t>(uniform(random) * static_cast<double>(velocity.size()));
    if (a == b || std::max(a, b) < what.immovable) continue;
    if (a > b) std::swap(a, b);
    if (what.reach > 0 && a >= what.immovable) b = a + 1 + (b - a - 1) % static_cast<std::uint32_t>(what.reach);
    const double mu = uniform(random) < 0.2 ? 0.0 : uniform(random);
    const double arm = 0.5;
    t.add_contact(a, b, direction(), a < what.immovable ? Vec3{} : arm * direction(), arm * direction(), mu, {});
    const Vec3 u = relative_velocity(t.contacts.back(), velocity[a], velocity[b]);
    const Vec3 slip{0.0, 0.3 * normal(random), 0.3 * normal(random)};
    const Vec3 slack{mu * norm(slip) + (uniform(random) < 0.5 ? 0.0 : uniform(random)), slip.y, slip.z};
    store_block(t.r, t.contacts.size() - 1, u + slack);
  }
  if (what.compliant) {
    for (std::size_t i = 0; i < 3 * what.contacts; ++i)
      t.compliance.push_back(i % 3 == 0 ? 0.1 * uniform(random) : 0.0);
  }
  return t;
}

}  // namespace scree::test
