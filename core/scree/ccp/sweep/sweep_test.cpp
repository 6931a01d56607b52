// The pieces of sweeps: local steps, colours, and the layout in groups.
#include <gtest/gtest.h>

#include <random>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {

// The step's stiffness must bound the block, or an update may raise the objective: x^T (omega / step - A) x >= 0.
TEST(local_step, bounds_the_block) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const TestingProblem t = random_problem({.bodies = 6, .contacts = 12, .mass_decades = 2.0, .seed = seed});
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < t.contacts.size(); ++i) {
      const Mat3 a = diagonal_block(t.view(), i);
      const sweep::LocalStep step = sweep::block_step(a, 0.5, 1.0);
      for (int k = 0; k < 20; ++k) {
        const Vec3 x{normal(random), normal(random), normal(random)};
        const double bound = x.x * x.x / step.normal + (x.y * x.y + x.z * x.z) / step.tangent;
        EXPECT_LE(dot(x, a * x), bound * (1.0 + 1e-12));
      }
    }
  }
}

/// A problem whose last body touches `touching` of the contacts, one after the other.
TestingProblem with_hub(std::size_t touching) {
  TestingProblem t = random_problem({.bodies = 4000, .immovable = 2, .contacts = 6000, .seed = 8});
  const std::uint32_t hub = t.add_body(1e3, {1.0, 1.0, 1.0});
  for (std::uint32_t k = 0; k < touching; ++k) {
    t.add_contact(2 + k % 4000, hub, {0, 0, 1}, {0, 0, 0.5}, {0, 0, -0.5}, 0.4, {-1.0, 0.1, 0.0});
  }
  return t;
}

// Every contact in one chunk, once; no movable body but a hub in two chunks of a colour; a hub costs no colour, and nothing has to
// wait for it.
TEST(colouring, chunks_of_one_colour_share_no_movable_body_but_hubs) {
  std::size_t colours_without = 0;
  for (const std::size_t touching : {0, 2000}) {
    const TestingProblem t = with_hub(touching);
    const auto hub = static_cast<std::uint32_t>(t.inverse_mass.size() - 1);
    sweep::Sequence sequence;
    sequence.build_split(t.view(), sweep::Colouring::kChunkLength);
    sweep::Colouring colouring;
    colouring.build(t.view(), sequence);
    std::vector<int> seen(t.contacts.size(), 0);
    std::vector<std::int64_t> owner(t.inverse_mass.size());
    const std::size_t colours = colouring.first().size() - 1;
    EXPECT_EQ(colouring.first().back(), colouring.chunks().size());
    for (std::size_t c = 0; c < colours; ++c) {
      std::fill(owner.begin(), owner.end(), -1);
      for (std::size_t k = colouring.first()[c]; k < colouring.first()[c + 1]; ++k) {
        const std::size_t chunk = colouring.chunks()[k];
        for (std::size_t at = sequence.first()[chunk]; at < sequence.first()[chunk + 1]; ++at) {
          const std::uint32_t i = sequence.contacts()[at];
          ++seen[i];
          for (const std::uint32_t body : {t.contacts[i].a, t.contacts[i].b}) {
            if (t.inverse_mass[body] == 0.0 || body == hub) continue;
            EXPECT_TRUE(owner[body] < 0 || owner[body] == static_cast<std::int64_t>(k));
            owner[body] = static_cast<std::int64_t>(k);
          }
        }
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1);
    if (touching == 0) colours_without = colours;
    // Half as many contacts more make as many conflicts more, not one with every other chunk.
    EXPECT_LE(2 * colours, 3 * colours_without + 2);
  }
}

// Contacts of one body in a row would each take a group of their own.
TEST(contact_sweep, contacts_of_a_hub_fill_the_lanes) {
  const TestingProblem t = with_hub(2000);
  for (const bool coloured : {false, true}) {
    ContactSweep sweep;
    sweep.bind(t.view(), {.coloured = coloured});
    EXPECT_LT(static_cast<double>(sweep.groups()), 1.1 * static_cast<double>(t.contacts.size()) / 4.0);
    std::vector<double> gamma(t.view().rows()), same(gamma.size());
    for (std::size_t k = 0; k < gamma.size(); ++k) gamma[k] = static_cast<double>(k);
    sweep.set_impulses(gamma);
    sweep.impulses(same);
    EXPECT_EQ(gamma, same);  // each contact has its lane
  }
}

/// Sweeps over `t` from zero. Impulses, and what a sweep says of the velocities that they cause.
struct Swept {
  std::vector<double> gamma;
  std::vector<Twist> w;
  std::vector<double> objective;  ///< after each sweep [J]
};

Swept swept(const TestingProblem& t, bool coloured, int sweeps, int threads) {
  const CcpProblem problem = t.view();
  const Executor executor{threads};
  ContactSweep sweep;
  sweep.bind(problem, {.coloured = coloured});
  Swept out;
  out.gamma.assign(problem.rows(), 0.0);
  out.w.assign(problem.bodies(), Twist{});
  sweep.set_impulses(out.gamma);
  sweep.set_velocities(out.w);
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  for (int k = 0; k < sweeps; ++k) {
    sweep.with_layout([&](const auto& layout) {
      sweep.for_chunks(k % 2 == 1, &executor, [&](std::size_t, std::size_t first, std::size_t last) {
        sweep::for_groups(layout, first, last, k % 2 == 1, [&](std::size_t group) { layout.update(group); });
      });
    });
    sweep.impulses(out.gamma);
    out.objective.push_back(delassus.objective(out.gamma));
  }
  sweep.velocities(out.w);
  return out;
}

// A light hub that 2000 contacts push at once, the worst for a body in copies: every sweep goes downhill all the same, the hub
// has the velocity of its impulses, and threads do not show.
TEST(contact_sweep, copies_of_a_hub_never_go_uphill_and_add_up) {
  TestingProblem t = with_hub(2000);
  t.inverse_mass.back() = 10.0;
  t.inverse_inertia.back() = Mat3::diagonal({10.0, 20.0, 30.0});
  for (const bool coloured : {false, true}) {
    const Swept one = swept(t, coloured, 12, 1), two = swept(t, coloured, 12, 2);
    EXPECT_EQ(one.gamma, two.gamma);
    for (std::size_t k = 1; k < one.objective.size(); ++k) EXPECT_LE(one.objective[k], one.objective[k - 1]);
    EXPECT_LT(one.objective.back(), 0.0);
    DelassusOperator delassus;
    const CcpProblem problem = t.view();
    delassus.bind(problem, nullptr);
    std::vector<Twist> w(problem.bodies());
    delassus.body_velocities(one.gamma, w);
    // Thousands of updates of numbers near ten, each rounded.
    EXPECT_NEAR(norm(w.back().linear - one.w.back().linear), 0.0, 1e-10 * (1.0 + norm(w.back().linear)));
    EXPECT_NEAR(norm(w.back().angular - one.w.back().angular), 0.0, 1e-10 * (1.0 + norm(w.back().angular)));
  }
}

// A sweep backwards undoes nothing but goes through the same groups: each exactly once, in the opposite order of chunks that
// share bodies. One thread, so that the order can be recorded.
TEST(contact_sweep, backward_is_the_opposite_order_and_visits_every_group_once) {
  const TestingProblem t = random_problem({.bodies = 900, .immovable = 2, .contacts = 2500, .seed = 3});
  for (const bool coloured : {false, true}) {
    ContactSweep sweep;
    sweep.bind(t.view(), {.coloured = coloured});
    std::vector<std::size_t> there, back;
    const auto record = [](std::vector<std::size_t>& order) {
      return [&order](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) order.push_back(k);
      };
    };
    sweep.for_chunks(false, nullptr, record(there));
    sweep.for_chunks(true, nullptr, record(back));
    ASSERT_EQ(there.size(), sweep.groups());
    std::vector<char> seen(there.size(), 0);
    for (const std::size_t k : there) seen[k] = 1;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
    ASSERT_EQ(back.size(), there.size());
    // Groups that share a movable body: whichever is first on the way there is second on the way back, chunk by chunk.
    std::vector<std::size_t> position(there.size());
    for (std::size_t k = 0; k < back.size(); ++k) position[back[k]] = k;
    const auto chunk_of = [&](std::size_t k) {
      std::size_t found = 0;
      sweep.for_chunks(false, nullptr, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        if (k >= first && k < last) found = chunk;
      });
      return found;
    };
    const auto share = [&](std::size_t x, std::size_t y) {
      for (const std::uint32_t i : {sweep.bodies_of(x, true)[0], sweep.bodies_of(x, false)[0]}) {
        if (i >= t.inverse_mass.size() || t.inverse_mass[i] == 0.0) continue;
        if (i == sweep.bodies_of(y, true)[0] || i == sweep.bodies_of(y, false)[0]) return true;
      }
      return false;
    };
    for (std::size_t k = 0; k + 1 < there.size(); k += 37) {
      for (std::size_t l = k + 1; l < there.size(); l += 41) {
        if (!share(there[k], there[l])) continue;
        if (chunk_of(there[k]) == chunk_of(there[l])) continue;
        EXPECT_GT(position[there[k]], position[there[l]]);
      }
    }
  }
}

TEST(contact_sweep, impulses_and_velocities_come_back_as_they_were_set) {
  const TestingProblem t = random_problem({.bodies = 40, .contacts = 91, .seed = 5});
  ContactSweep sweep;
  sweep.bind(t.view(), {});
  std::vector<double> gamma(t.view().rows()), same(gamma.size());
  for (std::size_t k = 0; k < gamma.size(); ++k) gamma[k] = 0.25 * static_cast<double>(k);
  std::vector<Twist> w(t.inverse_mass.size(), Twist{{1, 2, 3}, {4, 5, 6}}), same_w(w.size());
  sweep.set_impulses(gamma);
  sweep.set_velocities(w);
  sweep.impulses(same);
  sweep.velocities(same_w);
  EXPECT_EQ(gamma, same);
  EXPECT_EQ(w, same_w);
}

}  // namespace scree::test
