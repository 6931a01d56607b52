#include "emitter.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/error.hpp"
#include "scree/state/memory_state.hpp"
#include "testing_feed.hpp"

namespace scree {
namespace {

using testing_feed::FeedScene;
using testing_feed::kStep;

// A wide outlet for small grains, so that nothing has to wait.
const std::string kOutlet = "centre = [0, 0, 1]\nu = [0.5, 0, 0]\nv = [0, 0.5, 0]\nvelocity = [0, 0, -1]\n";
const std::string kGrains = "families = [{name = 'grains', material = 'plastic', size = '0.1 mm', shape = 'sphere'}]\n";
// Two orders of magnitude in size, and rods that are longer than their size.
const std::string kMixed =
    "families = [\n"
    "{name = 'fine', material = 'plastic', share = 0.9, size = {type = 'uniform', min = 2e-4, max = 1e-3}, shape = "
    "'sphere'},\n"
    "{name = 'coarse', material = 'copper', share = 0.05, size = '10 mm', shape = 'sphere'},\n"
    "{name = 'rods', material = 'copper', share = 0.05, size = '3 mm', shape = {type = 'shaving', aspect = 6}}]\n";
const std::string kNarrow = "centre = [0, 0, 0]\nu = [0.03, 0, 0]\nv = [0, 0.03, 0]\n";

/// Mass of what comes out in `steps` steps of an outlet that is kept free [kg], and its number.
std::vector<double> masses(FeedScene& scene, Emitter& emitter, int steps, double dt = kStep) {
  std::vector<double> all;
  for (int step = 0; step < steps; ++step) {
    scene.remove_all();
    for (const NewBody& body : scene.emit(emitter, step, dt)) all.push_back(body.mass);
  }
  return all;
}

TEST(emitter, emits_the_same_whole_number_every_step) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 10000\n" + kOutlet + kGrains);
  for (int step = 0; step < 3000; ++step) {
    scene.remove_all();
    // 10 a step: whatever 3000 sums of 0.001 s round to, no step gets 9 or 11.
    ASSERT_EQ(scene.emit(*emitter, step).size(), 10U) << "in step " << step;
  }
  EXPECT_EQ(emitter->postponed(), 0U);
}

TEST(emitter, is_never_a_whole_particle_away_from_its_rate) {
  FeedScene scene;
  const double rate = 777.123;
  const auto emitter = scene.make<Emitter>("rate = 777.123\n" + kOutlet + kGrains);
  for (int step = 0; step < 5000; ++step) {
    scene.remove_all();
    scene.emit(*emitter, step);
    const double due = rate * (step + 1) * kStep;
    ASSERT_LE(static_cast<double>(emitter->emitted()), due + 1e-9);
    ASSERT_GT(static_cast<double>(emitter->emitted()) + 1.0, due);
  }
}

TEST(emitter, mass_rate_is_met_to_half_a_particle) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>(
      "mass_rate = '10 g/s'\n" + kOutlet +
      "families = [{name = 'g', material = 'copper', size = {type = 'uniform', min = 1e-3, max = 2e-3}, shape = "
      "'sphere'}]\n");
  const double largest = 8400.0 * std::numbers::pi / 6.0 * 8e-9;
  double sum = 0.0;
  for (int step = 0; step < 2000; ++step) {
    scene.remove_all();
    for (const NewBody& body : scene.emit(*emitter, step)) sum += body.mass;
    ASSERT_NEAR(sum, 0.01 * (step + 1) * kStep, 0.5 * largest * (1.0 + 1e-9));
  }
}

// Balls that stay on the outlet block it, which used to be told nowhere.
TEST(emitter, tells_what_is_due_and_not_born) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>(
      "rate = 100\n" + kNarrow + "families = [{name = 'g', material = 'copper', size = '20 mm', shape = 'sphere'}]\n");
  EXPECT_TRUE(emitter->report().empty());
  // At most five balls of 20 mm have room on 30 mm x 30 mm: one in each corner and one between them.
  for (int step = 0; step < 3000; ++step) scene.emit(*emitter, step);
  const auto left = static_cast<double>(300 - emitter->emitted());  // 100 a second for 3 s
  EXPECT_GT(left, 290.0);
  EXPECT_EQ(emitter->backlog(), left);
  ASSERT_EQ(emitter->report().size(), 1U);
  EXPECT_EQ(emitter->report()[0].rows[0][2], std::to_string(300 - emitter->emitted()));
  const auto tells = [](const std::string& line) {
    return line.find("are due and find no place") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(scene.services.log_lines(), tells), 1);
}

TEST(emitter, begins_and_ends_when_told) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 1000\nstart = 0.1\nstop = 0.2\n" + kOutlet + kGrains);
  for (int step = 0; step < 400; ++step) {
    const std::size_t born = scene.emit(*emitter, step).size();
    if (step < 100 || step >= 200) {
      ASSERT_EQ(born, 0U) << "in step " << step;
    }
  }
  EXPECT_EQ(emitter->emitted(), 100U);  // 1000/s over 0.1 s
}

TEST(emitter, ends_after_its_total) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 7000\ntotal = 123\n" + kOutlet + kGrains);
  EXPECT_EQ(masses(scene, *emitter, 100).size(), 123U);
}

TEST(emitter, shares_by_number_converge) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 1e6\n" + kOutlet +
                                           "families = [{name = 'a', material = 'copper', share = 3, size = 1e-5, "
                                           "shape = 'sphere'},\n"
                                           "{name = 'b', material = 'plastic', share = 7, size = 2e-5, shape = "
                                           "'sphere'}]\n");
  double copper = 0.0;
  const int total = 40000;
  for (int step = 0; step < 40; ++step) {
    scene.remove_all();
    for (const NewBody& body : scene.emit(*emitter, step)) copper += body.material == 0 ? 1.0 : 0.0;
  }
  ASSERT_EQ(emitter->emitted(), static_cast<std::uint64_t>(total));
  // Binomial: five deviations.
  EXPECT_NEAR(copper / total, 0.3, 5.0 * std::sqrt(0.3 * 0.7 / total));
}

TEST(emitter, shares_by_mass_converge) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>(
      "rate = 1e6\nshare_by = 'mass'\n" + kOutlet +
      "families = [{name = 'a', material = 'copper', share = 0.4, size = {type = 'uniform', min = 1e-5, max = 3e-5}, "
      "shape = 'sphere'},\n"
      "{name = 'b', material = 'plastic', share = 0.6, size = {type = 'log_normal', median = 2e-5, log_deviation = "
      "0.3}, shape = 'sphere'}]\n");
  std::vector<std::pair<double, double>> drawn;
  double copper = 0.0, all = 0.0;
  for (int step = 0; step < 100; ++step) {
    scene.remove_all();
    for (const NewBody& body : scene.emit(*emitter, step)) {
      const double a = body.material == 0 ? body.mass : 0.0;
      drawn.emplace_back(a, body.mass);
      copper += a;
      all += body.mass;
    }
  }
  // A ratio of sums scatters by sqrt(sum (a - share m)^2) / sum m. Five of that, and the 0.2 % to which the mean masses
  // of both families are sampled, five times over.
  double squares = 0.0;
  for (const auto& [a, mass] : drawn) squares += (a - 0.4 * mass) * (a - 0.4 * mass);
  EXPECT_NEAR(copper / all, 0.4, 5.0 * std::sqrt(squares) / all + 5.0 * 0.4 * 0.6 * std::sqrt(2.0) * 2e-3);
}

TEST(emitter, nothing_is_born_into_another) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 4000\nvelocity = [0, 0, -0.5]\n" + kNarrow + kMixed);
  for (int step = 0; step < 200; ++step) {
    const std::size_t born = scene.emit(*emitter, step).size();
    ASSERT_GE(testing_feed::smallest_gap(scene, born), 0.0) << "in step " << step;
    scene.move();
  }
  EXPECT_GT(emitter->emitted(), 400U);
  EXPECT_GT(emitter->postponed(), 0U);  // the outlet was crowded, or this test shows nothing
}

TEST(emitter, places_fill_the_outlet_and_the_way_of_a_step) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 1e6\n" + kOutlet + kGrains);
  Aabb seen = Aabb::empty();
  for (const NewBody& body : scene.emit(*emitter, 0)) seen = merged(seen, body.pose.position);
  const Aabb outlet{{-0.25, -0.25, 1.0 - kStep}, {0.25, 0.25, 1.0}};
  // 1000 uniform places come within 2 % of every edge, but for one time in 10^8.
  for (int axis = 0; axis < 3; ++axis) {
    const double near_edge = 0.02 * (outlet.upper[axis] - outlet.lower[axis]);
    EXPECT_GE(seen.lower[axis], outlet.lower[axis]);
    EXPECT_LE(seen.upper[axis], outlet.upper[axis]);
    EXPECT_LE(seen.lower[axis], outlet.lower[axis] + near_edge);
    EXPECT_GE(seen.upper[axis], outlet.upper[axis] - near_edge);
  }
}

TEST(emitter, what_waits_is_born_later_and_in_order) {
  FeedScene blocked, free;
  const std::string scene = "rate = 3000\n" + kNarrow + kMixed;  // at rest: the outlet fills up
  const auto waiting = blocked.make<Emitter>(scene), unhindered = free.make<Emitter>(scene);
  std::vector<double> late;
  for (int step = 0; step < 150; ++step)
    for (const NewBody& body : blocked.emit(*waiting, step)) late.push_back(body.mass);
  ASSERT_LT(waiting->emitted(), 400U);  // of 450 due
  for (int step = 150; step < 400; ++step) {
    blocked.remove_all();
    for (const NewBody& body : blocked.emit(*waiting, step)) late.push_back(body.mass);
  }
  EXPECT_EQ(waiting->emitted(), 1200U);  // 3000/s over 0.4 s
  EXPECT_EQ(late, masses(free, *unhindered, 400));
}

TEST(emitter, velocities_have_the_mean_and_spread_of_the_scene) {
  FeedScene scene;
  const auto emitter = scene.make<Emitter>("rate = 1e7\nvelocity_spread = 0.2\nspin_spread = 30\n" + kOutlet + kGrains);
  const auto born = scene.emit(*emitter, 0);
  const auto n = static_cast<double>(born.size());
  ASSERT_EQ(born.size(), 10000U);
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0, squares = 0.0, spin = 0.0;
    for (const NewBody& body : born) {
      const double v = body.velocity[axis] - (axis == 2 ? -1.0 : 0.0);
      sum += v;
      squares += v * v;
      spin += body.angular_velocity[axis] * body.angular_velocity[axis];
    }
    // Five deviations of a mean and of a deviation.
    EXPECT_NEAR(sum / n, 0.0, 5.0 * 0.2 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares / n), 0.2, 5.0 * 0.2 / std::sqrt(2.0 * n));
    EXPECT_NEAR(std::sqrt(spin / n), 30.0, 5.0 * 30.0 / std::sqrt(2.0 * n));
  }
}

void expect_same_bits(const BodyStore& a, const BodyStore& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.hash(), b.hash());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.view().shape[i], b.view().shape[i]);
    EXPECT_EQ(a.view().inertia[i], b.view().inertia[i]);
  }
}

TEST(emitter, two_runs_are_equal_to_the_bit) {
  FeedScene one, two;
  const std::string text = "rate = 4000\nvelocity = [0, 0, -0.5]\nvelocity_spread = 0.1\n" + kNarrow + kMixed;
  const auto a = one.make<Emitter>(text), b = two.make<Emitter>(text);
  for (int step = 0; step < 60; ++step) {
    one.emit(*a, step);
    two.emit(*b, step);
  }
  expect_same_bits(one.bodies, two.bodies);
}

TEST(emitter, continues_to_the_bit_with_a_particle_that_waits) {
  FeedScene straight, resumed;
  const std::string text = "rate = 4000\nvelocity_spread = 0.1\n" + kNarrow + kMixed;
  const auto a = straight.make<Emitter>(text), b = resumed.make<Emitter>(text);
  const auto run = [](FeedScene& scene, Emitter& emitter, int from, int to) {
    for (int step = from; step < to; ++step) {
      scene.emit(emitter, step);
      if (step % 50 == 0) scene.remove_all();
    }
  };
  run(straight, *a, 0, 130);
  run(resumed, *b, 0, 130);
  ASSERT_GT(a->postponed(), 0U);
  ASSERT_LT(a->emitted(), 4000U * 130U / 1000U);  // one is waiting now

  MemoryState saved;
  b->save(saved.writer());
  const auto c = resumed.make<Emitter>(text);
  c->load(saved.reader());
  // Another emitter was set up in the resumed scene: its shapes are as many, so indices are compared through their data.
  run(straight, *a, 130, 260);
  run(resumed, *c, 130, 260);
  EXPECT_GT(a->emitted(), 200U);
  EXPECT_EQ(a->emitted(), c->emitted());
  EXPECT_EQ(a->postponed(), c->postponed());
  EXPECT_EQ(straight.bodies.hash(), resumed.bodies.hash());
}

TEST(emitter, a_second_feed_changes_nothing_of_the_first) {
  FeedScene alone, together;
  const std::string text = "rate = 4000\nvelocity = [0, 0, -0.5]\n" + kNarrow + kMixed;
  const auto a = alone.make<Emitter>(text), b = together.make<Emitter>(text);
  const auto other = together.make<Emitter>("rate = 3000\n" + kOutlet + kGrains);
  for (int step = 0; step < 60; ++step) {
    const auto first = alone.emit(*a, step), second = together.emit(*b, step);
    together.emit(*other, step);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      ASSERT_EQ(first[i].pose.position, second[i].pose.position);
      ASSERT_EQ(first[i].mass, second[i].mass);
    }
  }
}

TEST(emitter, refuses_what_contradicts_itself) {
  FeedScene scene;
  EXPECT_THROW(scene.make<Emitter>(kOutlet + kGrains), Error);
  EXPECT_THROW(scene.make<Emitter>("rate = 1\nmass_rate = 1\n" + kOutlet + kGrains), Error);
  EXPECT_THROW(scene.make<Emitter>("rate = 1\nstart = 2\nstop = 1\n" + kOutlet + kGrains), Error);
  EXPECT_THROW(scene.make<Emitter>("rate = 1\ncentre = [0,0,0]\nu = [1,0,0]\nv = [1,1,0]\n" + kGrains), Error);
}

}  // namespace
}  // namespace scree
