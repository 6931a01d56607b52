// The projections onto the sets of blocks against brute-force minimisation, against their optimality conditions and
// against the closed form of the contact's cone.
#include "scree/ccp/block_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "scree/ccp/cone3.hpp"

namespace scree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct RowPart {
  double coefficient = kInfinity;  ///< infinite: the normal row
  double weight = 1.0;
  int part = 0;  ///< rows of one part share a length
};

/// What holds row `k` of a cone, as the table of CcpBlock says.
RowPart row_part(const CcpBlock& b, const BlockMetric& d, int k) {
  if (k == 0) return {kInfinity, d.normal, 0};
  if (k == 1 || (k == 2 && b.rows != 2)) return {b.friction, d.tangent, 1};
  if (b.rows == 6 && k == 3) return {b.spinning, d.spin, 2};
  return {b.rolling, d.rolling, 3};
}

double squared_distance(const CcpBlock& b, const BlockMetric& d, std::span<const double> p, std::span<const double> g) {
  double sum = 0.0;
  for (int k = 0; k < b.rows; ++k) {
    const double gap = p[static_cast<std::size_t>(k)] - g[static_cast<std::size_t>(k)];
    sum += row_part(b, d, k).weight * gap * gap;
  }
  return sum;
}

/// The distance to the nearest point of the cone among those with the normal part n: every part cut to its bound.
double squared_distance_at(const CcpBlock& b, const BlockMetric& d, std::span<const double> g, double n) {
  std::array<double, 4> squares{}, weight{}, bound{};
  for (int k = 1; k < b.rows; ++k) {
    const RowPart part = row_part(b, d, k);
    const auto at = static_cast<std::size_t>(part.part);
    squares[at] += g[static_cast<std::size_t>(k)] * g[static_cast<std::size_t>(k)];
    weight[at] = part.weight;
    bound[at] = part.coefficient * n;
  }
  double sum = d.normal * (n - g[0]) * (n - g[0]);
  for (std::size_t k = 1; k < 4; ++k) {
    const double over = std::max(0.0, std::sqrt(squares[k]) - bound[k]);
    sum += weight[k] * over * over;
  }
  return sum;
}

/// The least distance over n by thirds of an interval: convex in n, and never nearer above |g_n| + the largest break point.
double brute_force(const CcpBlock& b, const BlockMetric& d, std::span<const double> g) {
  double size = 0.0, least = kInfinity;
  for (int k = 0; k < b.rows; ++k) {
    size += std::abs(g[static_cast<std::size_t>(k)]);
    const double mu = row_part(b, d, k).coefficient;
    if (mu > 0.0) least = std::min(least, mu);
  }
  double low = 0.0, high = size * (1.0 + 1.0 / std::min(1.0, least));
  for (int i = 0; i < 400; ++i) {
    const double a = low + (high - low) / 3.0, c = high - (high - low) / 3.0;
    (squared_distance_at(b, d, g, a) <= squared_distance_at(b, d, g, c) ? high : low) =
        squared_distance_at(b, d, g, a) <= squared_distance_at(b, d, g, c) ? c : a;
  }
  return std::min(squared_distance_at(b, d, g, low), squared_distance_at(b, d, g, 0.0));
}

class BlockCone : public testing::Test {
 protected:
  static constexpr std::array<std::uint8_t, 5> kSizes{1, 2, 3, 5, 6};

  double coefficient() {
    switch (random_() % 6) {
      case 0:
        return 0.0;
      case 1:
        return 1e6;
      case 2:
        return 1e-6;
      default:
        return std::abs(normal_(random_));
    }
  }
  CcpBlock cone(std::uint8_t rows) {
    return {.kind = CcpKind::cone,
            .rows = rows,
            .friction = coefficient(),
            .spinning = coefficient(),
            .rolling = coefficient()};
  }
  BlockMetric metric() {
    const auto weight = [&] { return std::exp(2.0 * normal_(random_)); };
    return {weight(), weight(), weight(), weight()};
  }
  std::vector<double> draw(std::uint8_t rows) {
    std::vector<double> g(rows);
    for (double& x : g) x = random_() % 8 == 0 ? 0.0 : normal_(random_);
    return g;
  }
  /// A point of the cone, on the bound of each part half of the time.
  std::vector<double> member(const CcpBlock& b) {
    std::vector<double> z = draw(b.rows);
    z[0] = std::abs(z[0]);
    for (int part = 1; part < 4; ++part) {
      double square = 0.0, bound = 0.0;
      for (int k = 1; k < b.rows; ++k) {
        if (row_part(b, {}, k).part != part) continue;
        square += z[static_cast<std::size_t>(k)] * z[static_cast<std::size_t>(k)];
        bound = row_part(b, {}, k).coefficient * z[0] * (random_() % 2 == 0 ? 1.0 : 0.3);
      }
      for (int k = 1; k < b.rows; ++k) {
        if (row_part(b, {}, k).part == part && square > 0.0)
          z[static_cast<std::size_t>(k)] *= bound / std::sqrt(square);
      }
    }
    return z;
  }

  std::mt19937_64 random_{17};
  std::normal_distribution<double> normal_;
};

TEST_F(BlockCone, projection_is_the_nearest_point_by_brute_force) {
  for (const std::uint8_t rows : kSizes) {
    for (int i = 0; i < 3000; ++i) {
      const CcpBlock b = cone(rows);
      const BlockMetric d = i % 2 == 0 ? BlockMetric{} : metric();
      const std::vector<double> g = draw(rows);
      std::vector<double> p = g;
      project_block(b, d, p);
      double size = 0.0;
      for (int k = 0; k < rows; ++k) {
        const double x = g[static_cast<std::size_t>(k)];
        size += row_part(b, d, k).weight * x * x;
      }
      // Rounding in p is 1e-15 of the largest number that it is made of, which mu = 1e6 may raise by that much.
      EXPECT_LE(violation(b, p), 1e-15 * 1e6 * std::sqrt(size) / std::sqrt(d.normal));
      EXPECT_LE(squared_distance(b, d, p, g), brute_force(b, d, g) + 1e-12 * size) << "rows " << int{rows} << ", " << i;
    }
  }
}

// p is nearest exactly when (g - p) . D (z - p) <= 0 for every z of the set.
TEST_F(BlockCone, projection_meets_the_variational_inequality) {
  for (const std::uint8_t rows : kSizes) {
    for (int i = 0; i < 2000; ++i) {
      const CcpBlock b = cone(rows);
      const BlockMetric d = metric();
      const std::vector<double> g = draw(rows);
      std::vector<double> p = g;
      project_block(b, d, p);
      for (int j = 0; j < 10; ++j) {
        const std::vector<double> z = member(b);
        double product = 0.0, terms = 0.0;
        for (int k = 0; k < rows; ++k) {
          const auto at = static_cast<std::size_t>(k);
          const double term = row_part(b, d, k).weight * (g[at] - p[at]) * (z[at] - p[at]);
          product += term;
          terms += row_part(b, d, k).weight * (std::abs(g[at]) + std::abs(p[at])) * (std::abs(z[at]) + std::abs(p[at]));
        }
        EXPECT_LE(product, 1e-13 * terms) << "rows " << int{rows} << ", " << i;
      }
    }
  }
}

// Moreau: g = p + q with p in K, -q in K*, p . q = 0. Rounding of numbers of size one, times mu in the dual cone's bound.
TEST_F(BlockCone, projection_splits_into_cone_and_polar_part) {
  for (const std::uint8_t rows : kSizes) {
    for (int i = 0; i < 2000; ++i) {
      const CcpBlock b = cone(rows);
      const std::vector<double> g = draw(rows);
      std::vector<double> p = g, u(rows);
      project_block(b, p);
      double product = 0.0;
      for (std::size_t k = 0; k < rows; ++k) {
        u[k] = p[k] - g[k];
        product += p[k] * u[k];
      }
      const double mu = 1.0 + b.friction + b.spinning + b.rolling;
      EXPECT_GE(u[0], dissipation_rate(b, u) - 1e-14 * mu) << "rows " << int{rows} << ", " << i;
      EXPECT_NEAR(product, 0.0, 1e-13);
    }
  }
}

TEST_F(BlockCone, projection_of_three_rows_is_that_of_a_contact) {
  for (int i = 0; i < 2000; ++i) {
    const CcpBlock b = cone(3);
    const BlockMetric d = metric();
    std::vector<double> g = draw(3);
    const Vec3 contact = project_cone3({g[0], g[1], g[2]}, b.friction, cone_weights(d.normal, d.tangent, b.friction));
    project_block(b, d, g);
    EXPECT_NEAR(norm(Vec3{g[0], g[1], g[2]} - contact), 0.0, 1e-14 * (1.0 + norm(contact)));
  }
}

TEST_F(BlockCone, projection_of_a_projection_changes_rounding_only) {
  for (const std::uint8_t rows : kSizes) {
    for (int i = 0; i < 2000; ++i) {
      const CcpBlock b = cone(rows);
      const BlockMetric d = metric();
      std::vector<double> once = draw(rows);
      project_block(b, d, once);
      std::vector<double> twice = once;
      project_block(b, d, twice);
      double size = 0.0;
      for (const double x : once) size = std::max(size, std::abs(x));
      for (std::size_t k = 0; k < rows; ++k) EXPECT_NEAR(twice[k], once[k], 1e-15 * size);
    }
  }
}

TEST_F(BlockCone, points_inside_keep_their_bits) {
  const CcpBlock b{.kind = CcpKind::cone, .rows = 6, .friction = 0.5, .spinning = 0.1, .rolling = 0.2};
  const std::vector<double> inside{1.0, 0.3, -0.2, -0.09, 0.1, 0.1};
  std::vector<double> g = inside;
  project_block(b, g);
  EXPECT_EQ(g, inside);
}

TEST_F(BlockCone, degenerate_cones) {
  // No friction of any sort: the positive normal part is left.
  std::vector<double> g{2.0, 3.0, -4.0, 1.0, 5.0, 6.0};
  project_block({.kind = CcpKind::cone, .rows = 6}, g);
  EXPECT_EQ(g, (std::vector<double>{2.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
  g = {-2.0, 3.0, -4.0, 1.0, 5.0, 6.0};
  project_block({.kind = CcpKind::cone, .rows = 6}, g);
  EXPECT_EQ(g, std::vector<double>(6, 0.0));
  // Zero stays, and a pull straight away from the surface leaves nothing.
  g.assign(5, 0.0);
  project_block({.kind = CcpKind::cone, .rows = 5, .friction = 0.3, .rolling = 0.1}, g);
  EXPECT_EQ(g, std::vector<double>(5, 0.0));
  g = {-1.0, 0.0};
  project_block({.kind = CcpKind::cone, .rows = 2, .friction = 0.3}, g);
  EXPECT_EQ(g, (std::vector<double>{0.0, 0.0}));
  // Plane: (0, 1) with mu = 1 lies at 45 degrees.
  g = {0.0, -1.0};
  project_block({.kind = CcpKind::cone, .rows = 2, .friction = 1.0}, g);
  EXPECT_EQ(g, (std::vector<double>{0.5, -0.5}));
}

// Only rolling is beyond its bound: n rises for it alone, n (1 + mu_r^2) = g_n + mu_r ||rho||, and t and s keep their bits.
TEST_F(BlockCone, parts_within_their_bounds_are_left_alone) {
  std::vector<double> g{1.0, 0.1, 0.2, 0.05, 3.0, -4.0};
  const double rolling = 0.5;
  project_block({.kind = CcpKind::cone, .rows = 6, .friction = 0.9, .spinning = 0.1, .rolling = rolling}, g);
  const double n = (1.0 + rolling * 5.0) / (1.0 + rolling * rolling);
  EXPECT_NEAR(g[0], n, 1e-15);
  EXPECT_EQ(std::vector<double>(g.begin() + 1, g.begin() + 4), (std::vector<double>{0.1, 0.2, 0.05}));
  EXPECT_NEAR(g[4], rolling * n * 0.6, 1e-15);
  EXPECT_NEAR(g[5], -rolling * n * 0.8, 1e-15);
}

TEST_F(BlockCone, rows_of_other_kinds_are_cut_one_by_one) {
  std::vector<double> g{-1.0, 2.0, -3.0};
  project_block({.kind = CcpKind::free, .rows = 3}, g);
  EXPECT_EQ(g, (std::vector<double>{-1.0, 2.0, -3.0}));
  EXPECT_LT(violation({.kind = CcpKind::free, .rows = 3}, g), 0.0);
  const CcpBlock box{.kind = CcpKind::box, .rows = 3, .lower = -2.0, .upper = 1.0};
  EXPECT_EQ(violation(box, g), 1.0);
  project_block(box, {9.0, 1.0, 1.0, 1.0}, g);
  EXPECT_EQ(g, (std::vector<double>{-1.0, 1.0, -2.0}));
  project_block({.kind = CcpKind::box, .rows = 3, .lower = -kInfinity, .upper = kInfinity}, g);
  EXPECT_EQ(g, (std::vector<double>{-1.0, 1.0, -2.0}));
  EXPECT_EQ(violation({.kind = CcpKind::nonnegative, .rows = 3}, g), 2.0);
  project_block({.kind = CcpKind::nonnegative, .rows = 3}, g);
  EXPECT_EQ(g, (std::vector<double>{0.0, 1.0, 0.0}));
}

TEST_F(BlockCone, projection_of_what_is_no_number_ends_and_shows_it) {
  for (const std::uint8_t rows : kSizes) {
    for (std::size_t k = 0; k < rows; ++k) {
      std::vector<double> g(rows, 0.5);
      g[k] = std::nan("");
      project_block({.kind = CcpKind::cone, .rows = rows, .friction = 0.3, .spinning = 0.3, .rolling = 0.3}, g);
      EXPECT_TRUE(std::any_of(g.begin(), g.end(), [](double x) { return std::isnan(x); })) << int{rows} << ", " << k;
    }
  }
}

TEST_F(BlockCone, violation_is_the_largest_excess) {
  const CcpBlock b{.kind = CcpKind::cone, .rows = 6, .friction = 0.5, .spinning = 0.1, .rolling = 0.2};
  // Beyond by 5 - 0.5, 0.3 - 0.1 and 0 - 0.2.
  const std::vector<double> g{1.0, 3.0, 4.0, -0.3, 0.0, 0.0};
  EXPECT_NEAR(violation(b, g), 4.5, 1e-15);
  const std::vector<double> pulling{-7.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(violation(b, pulling), 7.0);
  EXPECT_NEAR(dissipation_rate(b, g), 0.5 * 5.0 + 0.1 * 0.3, 1e-15);
}

}  // namespace
}  // namespace scree
