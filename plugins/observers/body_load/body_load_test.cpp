// Loads against statics and mechanics, from contacts written by hand.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "body_load.hpp"
#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 1e-3;  // [s]

/// A plate (id 0), a ball (id 1) and the contacts of a step.
class BodyLoadTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_load_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    services.add_body("plate", {0, {}, {}});
    services.add_body("ball", {1, {}, {}});
    services.set_part_name("body_load");
    bodies.add_immovable(0, {0, 0, 0});
    bodies.add_sphere(1, {0, 0, 0.1}, 0.1, 1000.0);
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  [[nodiscard]] BodyLoad make(const std::string& options) {
    return BodyLoad{options_from_text(options, BodyLoad::parameters())};
  }
  /// A contact of a = 0 and b = 1 with an impulse on b in the world [N s].
  void touch(const Vec3& point, const Vec3& normal, const Vec3& impulse, const Vec3& moment = {}) {
    contact.push_back({0, 1, 0, 0, 0, point, normal, 0.0});
    impulses.push_back(to_contact(contact_frame(normal), impulse));
    moments.push_back(to_contact(contact_frame(normal), moment));
    velocity.emplace_back();
  }
  void clear() {
    contact.clear();
    impulses.clear();
    moments.clear();
    velocity.clear();
  }
  [[nodiscard]] Observation at(std::uint64_t step, double age = 0.0) const {
    return {bodies.view(),
            {contact, impulses, velocity, velocity, moments, age},
            {},
            kStep * static_cast<double>(step),
            kStep,
            step};
  }
  void look(BodyLoad& load, std::uint64_t step, double age = 0.0) {
    load.observe(at(step, age), services.attributes());
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in{folder / name};
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  std::vector<Contact> contact;
  std::vector<Vec3> impulses, moments, velocity;
};

// A ball lies on a plate, off its centre: the plate carries m g, and m g x lever about its centre of mass.
TEST_F(BodyLoadTest, a_plate_carries_the_weight_and_its_moment) {
  BodyLoad load = make("bodies = ['plate', 'ball']\ninterval = 0.01");
  load.setup(services, folder);
  const double weight = bodies.mass[1] * 9.81;
  touch({0.3, -0.2, 0}, {0, 0, 1}, {0, 0, weight * kStep});
  for (std::uint64_t step = 1; step <= 10; ++step) look(load, step);
  // Sums of ten: ten roundings.
  EXPECT_NEAR(load.total(0).impulse.z, -weight * 0.01, 1e-14 * weight);
  EXPECT_NEAR(load.total(1).impulse.z, weight * 0.01, 1e-14 * weight);
  EXPECT_NEAR(load.total(0).angular_impulse.x, -0.2 * -weight * 0.01, 1e-14 * weight);
  EXPECT_NEAR(load.total(0).angular_impulse.y, -0.3 * -weight * 0.01, 1e-14 * weight);
  EXPECT_EQ(load.total(0).angular_impulse.z, 0.0);
  EXPECT_EQ(load.total(0).work, 0.0);
}

TEST_F(BodyLoadTest, torque_is_about_the_stated_point_and_axis) {
  BodyLoad load = make("bodies = ['plate']\npoint = [0.3, 1.0, 0.0]\naxis = [2.0, 0.0, 0.0]\ninterval = 0.0");
  load.setup(services, {});
  touch({0.3, 3.0, 0}, {0, 0, 1}, {0, 0, 5.0});
  look(load, 1);
  EXPECT_DOUBLE_EQ(load.total(0).angular_impulse.x, -5.0 * 2.0);
  EXPECT_DOUBLE_EQ(load.total(0).axial_impulse, -5.0 * 2.0);
}

// A drum turns at w against a friction force F at radius R: torque - F R about its axis, power - F R w.
TEST_F(BodyLoadTest, power_of_a_turning_body_is_torque_times_speed) {
  BodyLoad load = make("bodies = ['plate']\ninterval = 0.0");
  load.setup(services, {});
  const double w = 3.0, r = 0.5, impulse = 2e-3;
  bodies.angular_velocity[0] = {0, 0, w};
  touch({r, 0, 0}, {1, 0, 0}, {0, impulse, 0});
  look(load, 1);
  EXPECT_NEAR(load.total(0).axial_impulse, -impulse * r, 1e-16);
  EXPECT_NEAR(load.total(0).work, -impulse * r * w, 1e-16);
}

// A belt carries grains at u against gravity or friction: its drive gives F u though the body stays.
TEST_F(BodyLoadTest, the_drive_of_a_belt_works_against_the_load_on_it) {
  BodyLoad load = make("bodies = ['plate']\ninterval = 0.0");
  load.setup(services, {});
  bodies.surface_motion.resize(2);
  bodies.surface_motion[0] = {{1.5, 0, 0}, {}};
  touch({0, 0, 0}, {0, 0, 1}, {2e-3, 0, 5e-3});
  look(load, 1);
  EXPECT_DOUBLE_EQ(load.total(0).work, -1.5 * 2e-3);
}

// Free bodies: the work in a step is the change of kinetic energy, m (v1^2 - v0^2) / 2, whatever the impulse is; turning as well,
// by the moment of an impulse off the centre and by a moment of the contact itself.
TEST_F(BodyLoadTest, work_on_a_free_body_is_its_kinetic_energy) {
  BodyLoad load = make("bodies = ['ball']\ninterval = 0.0");
  load.setup(services, {});
  bodies.velocity[1] = {0.3, 0, -1.0};
  look(load, 1);
  const Vec3 point{0, 0, 0}, impulse{-0.1, 0.2, 3.0}, moment{0, 0.01, 0.02};
  touch(point, {0, 0, 1}, impulse, moment);
  const double m = bodies.mass[1], j = bodies.inertia[1].x;
  const Vec3 v0 = bodies.velocity[1], v1 = v0 + impulse / m;
  const Vec3 w1 = (cross(point - bodies.position[1], impulse) + moment) / j;
  bodies.velocity[1] = v1;
  bodies.angular_velocity[1] = w1;
  look(load, 2);
  const double gained = 0.5 * m * (squared_norm(v1) - squared_norm(v0)) + 0.5 * j * squared_norm(w1);
  EXPECT_NEAR(load.total(0).work, gained, 1e-14);
}

// A body that touches in the first step that is seen: its velocity before follows from its impulses.
TEST_F(BodyLoadTest, work_is_whole_from_the_first_step_on) {
  BodyLoad load = make("bodies = ['ball']\ninterval = 0.0");
  load.setup(services, {});
  const double m = bodies.mass[1];
  bodies.velocity[1] = {0.5, 0, 0};
  touch({0, 0, 0.1}, {0, 0, 1}, {-0.2, 0, 0});
  look(load, 1);
  const double v0 = 0.5 + 0.2 / m;
  EXPECT_NEAR(load.total(0).work, 0.5 * m * (0.25 - v0 * v0), 1e-15);
}

// Contacts found at the beginning of the step: the ball has moved on since, its torque has not.
TEST_F(BodyLoadTest, levers_are_those_of_the_moment_of_contact) {
  BodyLoad load = make("bodies = ['ball']\ninterval = 0.0");
  load.setup(services, {});
  bodies.velocity[1] = {2.0, 0, 0};
  touch({0, 0, 0}, {0, 0, 1}, {0, 0, 1.0});
  bodies.position[1] = {2.0 * kStep, 0, 0.1};
  look(load, 1, kStep);
  EXPECT_NEAR(load.total(0).angular_impulse.y, 0.0, 1e-17);
}

// The stepper says what contacts did to the plate while it turned and moved on; the ball has nothing but its contact.
TEST_F(BodyLoadTest, what_a_stepper_has_summed_up_is_the_load) {
  for (const bool stated : {false, true}) {
    BodyLoad load = make(std::string{"bodies = ['plate', 'ball']\ninterval = 0.0\naxis = [0, 0, 2]"} +
                         (stated ? "\npoint = [1.0, 0.0, 0.0]" : ""));
    load.setup(services, {});
    bodies.motion[0] = Motion::kinematic;
    bodies.velocity[0] = {4.0, 0, 0};
    bodies.position[0] = {2e-3, 0, 0};
    touch({0.3, 0, 0}, {0, 0, 1}, {0, 0.2, 1.0});
    const std::vector<ContactLoad> summed{{0, {0, -0.19, -0.9}, {0.01, 0.02, -0.06}, -0.05}};
    Observation now = at(1);
    now.contacts.loads = summed;
    load.observe(now, services.attributes());
    const LoadSum& plate = load.total(0);
    EXPECT_EQ(plate.impulse, (Vec3{0, -0.19, -0.9}));
    EXPECT_EQ(plate.work, -0.05);
    EXPECT_EQ(plate.contacts, 1.0);
    // Half a step before its end the plate's centre was at the origin: (0 - 1) x (-0.19) more about the point.
    EXPECT_NEAR(plate.axial_impulse, -0.06 + (stated ? 0.19 : 0.0), 1e-16);
    EXPECT_NEAR(plate.angular_impulse.y, 0.02 + (stated ? -0.9 : 0.0), 1e-15);
    EXPECT_EQ(load.total(1).impulse, (Vec3{0, 0.2, 1.0}));
    clear();
  }
}

TEST_F(BodyLoadTest, a_resumed_run_writes_the_table_of_one_run) {
  const char* options = "bodies = ['plate', 'ball']\ninterval = 0.004";
  BodyLoad whole = make(options), first = make(options), second = make(options);
  whole.setup(services, folder);
  first.setup(services, {});
  touch({0.3, -0.2, 0}, {0, 0, 1}, {1.0 / 3.0, 0, 2.0}, {0, 0.1, 0});
  const auto run = [&](const std::vector<BodyLoad*>& loads, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t step = from; step <= to; ++step) {
      bodies.velocity[1] = {0.1 * static_cast<double>(step), 0, 0};
      bodies.angular_velocity[1] = {0, 0.2 * static_cast<double>(step), 0};
      for (BodyLoad* load : loads) look(*load, step);
    }
  };
  run({&whole, &first}, 1, 10);
  MemoryState state;
  first.save(state.writer());
  fs::create_directories(folder / "second");
  second.setup(services, folder / "second");
  second.load(state.reader());
  run({&whole, &second}, 11, 19);
  whole.finish(at(19));
  second.finish(at(19));
  const std::string table = read("body_load.csv");
  EXPECT_EQ(table, read("second/body_load.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 2 * 5);
  EXPECT_EQ(whole.report()[0].rows, second.report()[0].rows);
  EXPECT_TRUE(fs::exists(folder / "body_load_torque.svg"));
}

TEST_F(BodyLoadTest, a_body_that_a_sink_took_is_said_to_have_left) {
  BodyLoad load = make("bodies = ['ball']\ninterval = 0.0");
  load.setup(services, {});
  touch({0, 0, 0}, {0, 0, 1}, {0, 0, 1.0});
  look(load, 1);
  clear();
  test::TestBodies rest{services.attributes()};
  rest.add_immovable(0, {});
  load.observe({rest.view(), {}, {}, 2 * kStep, kStep, 2}, services.attributes());
  load.finish({rest.view(), {}, {}, 2 * kStep, kStep, 2});
  EXPECT_EQ(load.report()[0].rows[0].back(), "0.002");
  EXPECT_DOUBLE_EQ(load.total(0).impulse.z, 1.0);
}

TEST_F(BodyLoadTest, an_axis_without_length_is_refused) {
  EXPECT_THROW(static_cast<void>(make("bodies = ['ball']\naxis = [0, 0, 0]")), Error);
  EXPECT_THROW(static_cast<void>(make("bodies = []")), Error);
}

}  // namespace
}  // namespace scree
