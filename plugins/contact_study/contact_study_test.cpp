#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "contact_study/contact_log.hpp"
#include "contact_study/contact_motion.hpp"
#include "contact_study/followed_bodies.hpp"
#include "contact_study/log_histogram.hpp"
#include "contact_study/series_table.hpp"
#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

Options names(const std::string& toml) {
  return options_from_text("bodies = " + toml, {Parameter::texts("bodies", "names")});
}

TEST(followed_bodies, are_found_by_id_whatever_their_index) {
  test::FakeSceneServices services;
  services.add_body("plate", {3, {}, {}});
  services.add_body("drum", {1, {}, {}});
  FollowedBodies followed;
  followed.setup(names("['plate', 'drum']"), "bodies", services);
  test::TestBodies bodies{services.attributes()};
  for (const BodyId id : {BodyId{1}, BodyId{2}, BodyId{3}, BodyId{7}}) bodies.add_sphere(id, {}, 1e-3, 1000.0);
  followed.locate(bodies.view());
  EXPECT_EQ(followed.index(0), 2u);
  EXPECT_EQ(followed.index(1), 0u);
  EXPECT_EQ(followed.slot(1), FollowedBodies::kNone);

  const std::vector<Contact> contact{{0, 2, 5, 6, 0, {}, {}, 0.0}, {1, 3, 0, 0, 0, {}, {}, 0.0}};
  const std::vector<Vec3> impulse(2), velocity(2);
  std::vector<BodyContact> seen;
  followed.visit({contact, impulse, velocity, velocity}, [&](const BodyContact& c) { seen.push_back(c); });
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].slot, 1u);
  EXPECT_EQ(seen[0].sign, -1.0);
  EXPECT_EQ(seen[0].primitive, 5u);
  EXPECT_EQ(seen[1].slot, 0u);
  EXPECT_EQ(seen[1].other, 0u);
  EXPECT_EQ(seen[1].primitive, 6u);

  test::TestBodies fewer{services.attributes()};
  fewer.add_sphere(3, {}, 1e-3, 1000.0);
  followed.locate(fewer.view());
  EXPECT_EQ(followed.index(0), 0u);
  EXPECT_EQ(followed.index(1), FollowedBodies::kGone);
}

TEST(followed_bodies, a_name_that_is_unknown_or_twice_is_refused) {
  test::FakeSceneServices services;
  services.add_body("drum", {1, {}, {}});
  FollowedBodies one, two;
  EXPECT_THROW(one.setup(names("['drun']"), "bodies", services), Error);
  EXPECT_THROW(two.setup(names("['drum', 'drum']"), "bodies", services), Error);
}

// A body that moves and turns evenly for `age` goes back exactly where it came from: half a turn about z.
TEST(contact_motion, bodies_are_put_back_to_where_they_touched) {
  Attributes attributes;
  test::TestBodies bodies{attributes};
  const std::size_t i = bodies.add_sphere(0, {1, 2, 3}, 0.1, 1000.0, {2, 0, 0});
  bodies.angular_velocity[i] = {0, 0, std::numbers::pi / 0.5};
  const Pose then = pose_at_contacts(bodies.view(), 0, 0.5);
  EXPECT_NEAR(then.position.x, 0.0, 1e-15);
  const Vec3 x = rotate(then.orientation, {1, 0, 0});
  EXPECT_NEAR(x.x, -1.0, 1e-15);
  EXPECT_NEAR(x.y, 0.0, 1e-15);
}

TEST(contact_motion, sliding_and_mobilisation_follow_coulomb) {
  EXPECT_DOUBLE_EQ(mobilisation({2.0, 0.3, 0.4}, 0.5), 0.5);
  EXPECT_FALSE(slides({2.0, 0.3, 0.4}, 0.5));
  EXPECT_TRUE(slides({2.0, 0.6, 0.8}, 0.5));
  EXPECT_TRUE(slides({2.0, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(slides({0.0, 0.0, 0.0}, 0.0));
  EXPECT_EQ(mobilisation({2.0, 0.0, 0.0}, 0.0), 0.0);
}

// Two decades in thirds; an amount at an edge belongs to the bin above it.
TEST(log_histogram, bins_by_order_of_magnitude_and_loses_nothing) {
  LogHistogram bins{1e-3, 1e-1, 3};
  ASSERT_EQ(bins.bins(), 6u);
  EXPECT_DOUBLE_EQ(bins.edges().front(), 1e-3);
  EXPECT_NEAR(bins.edges().back(), 1e-1, 1e-16);
  for (const double q : {0.0, -1.0, 1e-3, 2e-3, 3e-3, 0.5}) bins.add(q, 2.0 * q);
  EXPECT_EQ(bins.below(), 2u);
  EXPECT_EQ(bins.above(), 1u);
  EXPECT_EQ(bins.count(0), 2u);  // up to 2.15e-3
  EXPECT_EQ(bins.count(1), 1u);
  EXPECT_DOUBLE_EQ(bins.weight(0), 6e-3);
  EXPECT_EQ(bins.total_count(), 6u);
  EXPECT_DOUBLE_EQ(bins.total_weight(), 2.0 * (6e-3 + 0.5 - 1.0));

  MemoryState state;
  bins.save(state.writer());
  LogHistogram again{1e-3, 1e-1, 3}, other{1e-3, 1e-1, 4};
  again.load(state.reader());
  EXPECT_EQ(again.count(0), 2u);
  EXPECT_THROW(other.load(state.reader()), Error);
}

TEST(series_table, a_resumed_table_has_the_rows_of_one_run) {
  const fs::path folder = fs::temp_directory_path() / ("scree_table_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::vector<SeriesColumn> columns{{"time", "s"}, {"body", "", {"drum", "plate"}}, {"force", "N"}};
  const std::vector<std::vector<double>> rows{{0.1, 0, 5.0}, {0.1, 1, 6.0}, {0.2, 0, 1.0 / 3.0}};
  SeriesTable whole{columns}, first{columns}, second{columns};
  whole.open(folder / "whole.csv");
  for (const std::vector<double>& row : rows) whole.add(row);
  whole.close();
  first.add(rows[0]);
  first.add(rows[1]);
  MemoryState state;
  first.save(state.writer());
  second.open(folder / "second.csv");
  second.load(state.reader());
  second.add(rows[2]);
  second.close();
  const auto text = [&](const char* name) {
    std::ifstream in{folder / name};
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  };
  EXPECT_EQ(text("whole.csv"), text("second.csv"));
  EXPECT_EQ(text("second.csv").substr(0, 46), "time [s],body,force [N]\n0.1,drum,5\n0.1,plate,6");
  EXPECT_EQ(second.column(2, 1, 0.0), (std::vector<double>{5.0, 1.0 / 3.0}));
  EXPECT_EQ(second.column(0).size(), 3u);
  EXPECT_THROW(second.add(std::vector<double>{1.0}), std::logic_error);
  fs::remove_all(folder);
}

// Rigid contacts push or do nothing; soft ones, whose work is known, may pull.
TEST(contact_log, what_begins_with_a_pull_is_new_once_and_shares_with_what_pushes) {
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  for (const BodyId id : {BodyId{0}, BodyId{1}}) bodies.add_sphere(id, {}, 1e-3, 1000.0);
  const std::vector<Contact> contact{{0, 1, 0, 0, 0, {}, {0, 0, 1}, 0.0}, {0, 1, 0, 0, 1, {}, {0, 0, 1}, 0.0}};
  const std::vector<Vec3> first{{-1.0, 0, 0}, {3.0, 0, 0}}, second{{2.0, 0, 0}, {-1.0, 0, 0}}, velocity(2);
  const std::vector<double> work(2);
  const auto view = [&](const std::vector<Vec3>& impulse, bool soft) {
    ContactView contacts{contact, impulse, velocity, velocity};
    if (soft) contacts.work = work;
    return contacts;
  };
  ContactLog soft, rigid;
  soft.look(bodies.view(), view(first, true));
  EXPECT_DOUBLE_EQ(soft.share(0), 0.25);
  EXPECT_DOUBLE_EQ(soft.share(1), 0.75);
  soft.look(bodies.view(), view(second, true));
  EXPECT_FALSE(soft.is_new(0) || soft.is_new(1));
  EXPECT_EQ(soft.loaded(), 2u);
  rigid.look(bodies.view(), view(first, false));
  EXPECT_FALSE(rigid.is_new(0));
  EXPECT_DOUBLE_EQ(rigid.share(1), 1.0);
}

TEST(series_table, intervals_are_whole_steps) {
  EXPECT_EQ(steps_between(0.0, 1e-3), 1u);
  EXPECT_EQ(steps_between(0.0104, 1e-3), 10u);
}

}  // namespace
}  // namespace scree
