// Contact problems of every kind with a known solution: complementary impulses and velocities are drawn, then r follows. The
// velocities are those of every solution; the impulses need not be.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/delassus.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {

/// What planted_problem() draws.
struct PlantedKind {
  std::size_t bodies = 6;
  std::size_t immovable = 1;
  std::size_t contacts = 6;
  std::size_t blocks = 6;  ///< kinds, rows and Jacobians at random
  bool compliant = false;
  double mass_decades = 1.0;      ///< masses between 1 and 10^this
  double friction_decades = 0.0;  ///< coefficients of up to 10^this
  double slides = 10.0;           ///< what touches sticks with more: u_n = mu |u_t| has mu times the error of u_t
  std::size_t reach = 0;          ///< bodies that touch are so many apart at most, as in a bed; 0: any
  double repeats = 0.0;           ///< share of the units that stand where one before them does: N is singular
  std::uint64_t seed = 1;
};

struct PlantedProblem {
  TestingProblem problem;
  std::vector<double> gamma;  ///< [N s]
  std::vector<double> u;      ///< N gamma + r [m/s]
};

/// Draws the parts of a planted problem.
class Planter {
 public:
  explicit Planter(const PlantedKind& what) : what_{what}, random_{what.seed} {}

  PlantedProblem draw() {
    for (std::size_t k = 0; k < what_.immovable; ++k) out_.problem.add_immovable();
    for (std::size_t k = 0; k < what_.bodies; ++k) {
      const double m = std::pow(10.0, what_.mass_decades * uniform());
      out_.problem.add_body(m, {0.1 * m * (1.0 + uniform()), 0.1 * m * (1.0 + uniform()), 0.15 * m});
    }
    while (out_.problem.contacts.size() < what_.contacts) add_contact();
    while (out_.problem.blocks.size() < what_.blocks) add_block();
    if (what_.compliant) add_compliance();
    plant();
    return std::move(out_);
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>{0.0, 1.0}(random_); }
  double normal() { return std::normal_distribution<double>{}(random_); }
  bool chance(double share) { return uniform() < share; }
  Vec3 direction() { return normalized(Vec3{normal(), normal(), normal()}); }
  Twist twist() { return {normal() * direction(), 0.5 * direction()}; }
  double coefficient() {
    if (chance(0.2)) return 0.0;
    return uniform() * std::pow(10.0, what_.friction_decades * uniform());
  }
  std::uint32_t body() {
    const auto all = static_cast<double>(what_.immovable + what_.bodies);
    return static_cast<std::uint32_t>(uniform() * all);
  }

  /// Another body for `a`: within reach, when both move.
  std::uint32_t partner(std::uint32_t a) {
    const std::uint32_t b = body(), reach = static_cast<std::uint32_t>(what_.reach);
    if (reach == 0 || std::min(a, b) < what_.immovable || a == b) return b;
    return b > a ? a + 1 + (b - a - 1) % reach : a - 1 - (a - b - 1) % reach;
  }

  void add_contact() {
    std::vector<CcpContact>& contacts = out_.problem.contacts;
    if (!contacts.empty() && chance(what_.repeats)) {
      contacts.push_back(contacts[static_cast<std::size_t>(uniform() * static_cast<double>(contacts.size()))]);
      contacts.back().friction = coefficient();
      out_.problem.r.resize(out_.problem.r.size() + 3);
      return;
    }
    const std::uint32_t a = body(), b = partner(a);
    if (a >= b || b < what_.immovable) return;
    out_.problem.add_contact(a, b, direction(), 0.5 * direction(), 0.5 * direction(), coefficient(), {});
  }

  void add_block() {
    constexpr std::array<std::size_t, 5> kConeRows{1, 2, 3, 5, 6};
    CcpBlock block{.kind = static_cast<CcpKind>(random_() % 4), .a = body()};
    block.b = partner(block.a);
    if (std::max(block.a, block.b) < what_.immovable) return;
    block.friction = coefficient(), block.spinning = coefficient(), block.rolling = coefficient();
    const std::size_t rows = block.kind == CcpKind::cone ? kConeRows[random_() % 5] : 1 + random_() % 6;
    std::vector<CcpRow> jacobian = rows_at_a_point(rows, block.kind == CcpKind::cone, direction(), 0.5 * direction(),
                                                   0.5 * direction(), 0.1 + uniform());
    if (chance(0.5)) {
      for (CcpRow& row : jacobian) row = {twist(), twist()};
    }
    if (!out_.problem.blocks.empty() && chance(what_.repeats)) {
      const CcpBlock& before = out_.problem.blocks.back();
      block.a = before.a, block.b = before.b;
      for (std::size_t k = 0; k < std::min<std::size_t>(rows, before.rows); ++k) {
        jacobian[k] = out_.problem.block_rows[before.first_row + k];
      }
    }
    out_.problem.add_block(block, jacobian, std::vector<double>(rows, 0.0));
  }

  void add_compliance() {
    DelassusOperator delassus;
    const CcpProblem p = out_.problem.view();
    delassus.bind(p, nullptr);
    std::vector<double> compliance(p.rows());
    const auto fill = [&](std::size_t first, std::size_t rows, double trace) {
      for (std::size_t k = 0; k < rows; ++k) compliance[first + k] = chance(0.5) ? 0.0 : 0.1 * trace * uniform();
    };
    for (std::size_t i = 0; i < p.contacts.size(); ++i) fill(3 * i, 3, delassus.traces()[i]);
    for (std::size_t i = 0; i < p.blocks.size(); ++i) {
      fill(first_row(p, p.blocks[i]), p.blocks[i].rows, delassus.traces()[p.contacts.size() + i]);
    }
    out_.problem.compliance = compliance;
  }

  void plant() {
    const std::size_t rows = out_.problem.view().rows();
    out_.gamma.resize(rows), out_.u.resize(rows);
    DelassusOperator delassus;
    CcpProblem p = out_.problem.view();
    delassus.bind(p, nullptr);
    // Impulses of a size that changes velocities by about one.
    const auto scale = [](double rows_of_unit, double trace) { return trace > 0.0 ? rows_of_unit / trace : 1.0; };
    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      CcpBlock block = block_of(p.contacts[i]);
      plant_unit(block, 3 * i, scale(3.0, delassus.traces()[i]));
    }
    for (std::size_t i = 0; i < p.blocks.size(); ++i) {
      CcpBlock& block = out_.problem.blocks[i];
      plant_unit(block, first_row(p, block), scale(block.rows, delassus.traces()[p.contacts.size() + i]));
    }
    delassus.apply(out_.gamma, out_.problem.r);
    for (std::size_t k = 0; k < rows; ++k) out_.problem.r[k] = out_.u[k] - out_.problem.r[k];
  }

  /// Complementary g and u of one unit; a box gets its bounds here.
  void plant_unit(CcpBlock& block, std::size_t first, double scale) {
    double *const g = out_.gamma.data() + first, *const u = out_.u.data() + first;
    if (block.kind == CcpKind::cone) return plant_cone(block, scale, g, u);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (block.kind == CcpKind::box) {
      block.lower = chance(0.2) ? -kInfinity : -scale * uniform();
      block.upper = chance(0.2) ? kInfinity : scale * uniform();
    }
    const double lower = block.kind == CcpKind::nonnegative ? 0.0
                         : block.kind == CcpKind::free      ? -kInfinity
                                                            : block.lower;
    const double upper = block.kind == CcpKind::box ? block.upper : kInfinity;
    for (std::size_t k = 0; k < block.rows; ++k) {
      g[k] = std::clamp(scale * normal(), lower, upper);
      u[k] = 0.0;
      if (g[k] == lower) u[k] = std::abs(normal());
      if (g[k] == upper) u[k] = -std::abs(normal());
    }
  }

  /// One part of a cone: impulse within or on its bound, which is then opposite to the velocity. Adds to u_n.
  void plant_part(double coefficient, std::size_t count, bool open, double n, double* g, double* u, double& u_n) {
    const double angle = 6.28 * uniform(), across = count == 2 ? std::sin(angle) : 0.0;
    const double along = count == 2 ? std::cos(angle) : chance(0.5) ? 1.0 : -1.0;
    const bool slides = open || coefficient == 0.0 || (coefficient < what_.slides && chance(0.5));
    const double speed = slides ? uniform() / std::max(1.0, coefficient) : 0.0;
    const double force = coefficient * n * (slides ? 1.0 : uniform());
    g[0] = force * along, u[0] = -speed * along;
    if (count == 2) g[1] = force * across, u[1] = -speed * across;
    u_n += coefficient * speed;
  }

  void plant_cone(const CcpBlock& block, double scale, double* g, double* u) {
    const bool open = chance(0.4);
    const double most = std::max({1.0, block.friction, block.spinning, block.rolling});
    g[0] = open ? 0.0 : scale * uniform() / most;
    u[0] = open && (most > what_.slides || chance(0.5)) ? 0.1 + uniform() : 0.0;
    if (block.rows >= 2) plant_part(block.friction, block.rows == 2 ? 1 : 2, open, g[0], g + 1, u + 1, u[0]);
    if (block.rows == 6) plant_part(block.spinning, 1, open, g[0], g + 3, u + 3, u[0]);
    if (block.rows >= 5) plant_part(block.rolling, 2, open, g[0], g + block.rows - 2, u + block.rows - 2, u[0]);
  }

  PlantedKind what_;
  std::mt19937_64 random_;
  PlantedProblem out_;
};

inline PlantedProblem planted_problem(const PlantedKind& what) { return Planter{what}.draw(); }

}  // namespace scree::test
