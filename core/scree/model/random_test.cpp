#include "scree/model/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scree/model/philox.hpp"

namespace scree {
namespace {

// Known answers published with Random123 (kat_vectors, philox4x32 10).
TEST(Philox, gives_the_published_answers) {
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t f = 0xffffffff;
  EXPECT_EQ(philox4x32({f, f, f, f}, {f, f}), (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, resumes_from_its_counter) {
  RandomStream first{7, "feed"};
  for (int i = 0; i < 10; ++i) first.uniform();
  RandomStream second{7, "feed"};
  second.set_counter(first.counter());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(first(), second());
}

TEST(RandomStream, names_and_seeds_are_independent) {
  RandomStream a{7, "feed"}, b{7, "wall"}, c{8, "feed"};
  const auto x = a(), y = b(), z = c();
  EXPECT_NE(x, y);
  EXPECT_NE(x, z);
}

// Law of large numbers: with n = 1e5 the mean of U(0,1) has deviation 1/sqrt(12 n) = 9.1e-4, that of N(0,1) 3.2e-3, and
// its variance deviates by sqrt(2/n) = 4.5e-3. Bounds are five deviations.
TEST(RandomStream, moments_are_right) {
  RandomStream stream{1, "moments"};
  constexpr int n = 100000;
  double uniform_mean = 0, normal_mean = 0, normal_square = 0;
  for (int i = 0; i < n; ++i) {
    uniform_mean += stream.uniform() / n;
    const double x = stream.normal();
    normal_mean += x / n;
    normal_square += x * x / n;
  }
  EXPECT_NEAR(uniform_mean, 0.5, 4.6e-3);
  EXPECT_NEAR(normal_mean, 0.0, 1.6e-2);
  EXPECT_NEAR(normal_square, 1.0, 2.3e-2);
}

// A uniform rotation takes z to a uniform point of the sphere: each component has mean 0 and variance 1/3.
TEST(RandomStream, orientations_are_uniform) {
  RandomStream stream{1, "orientation"};
  constexpr int n = 50000;
  Vec3 mean, square;
  for (int i = 0; i < n; ++i) {
    const Quat q = stream.orientation();
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14);
    const Vec3 v = rotate(q, {0, 0, 1});
    mean += v / n;
    square += hadamard(v, v) / n;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0.0, 5 * std::sqrt(1.0 / 3.0 / n));
    EXPECT_NEAR(square[axis], 1.0 / 3.0, 5 * std::sqrt(4.0 / 45.0 / n));
  }
}

}  // namespace
}  // namespace scree
