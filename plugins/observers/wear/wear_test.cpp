// The observer against closed forms, from contacts written by hand: a plate (id 0) and a ball (id 1).
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "scree/config/validate.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/model/material.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"
#include "wear_observer.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr double kStep = 1e-3, kHardness = 2e9, kFriction = 0.4;
constexpr const char* kPlate = "bodies = ['plate']\nhardness = 2e9\nwear_coefficient = 1e-3\n";

class WearTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_wear_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    services.materials().add({"steel", 7800.0, {.friction = kFriction}, {}});
    services.set_part_name("wear");
    ShapeData slab;
    slab.name = "slab";
    slab.primitives.resize(1);
    slab.primitives[0].primitive.kind = ShapeKind::box;
    slab.primitives[0].primitive.size = {0.5, 0.5, 0.1};
    services.shapes().add(slab);
    services.add_body("plate", {0, {}, "slab"});
    bodies.add_immovable(0, {0, 0, -0.1});
    bodies.add_sphere(1, {0, 0, 0.05}, 0.05, 1000.0);
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  [[nodiscard]] std::unique_ptr<WearObserver> make(const std::string& options, const fs::path& results = {}) {
    auto wear = std::make_unique<WearObserver>(options_from_text(options, WearObserver::parameters()));
    wear->setup(services, results);
    return wear;
  }
  /// A contact of the plate and the ball; impulse on the ball [N s] and velocities of it [m/s], world.
  void touch(const Vec3& point, const Vec3& impulse, const Vec3& before, const Vec3& after, std::uint64_t feature = 0,
             const Vec3& normal = {0, 0, 1}) {
    const ContactFrame frame = contact_frame(normal);
    contact.push_back({0, 1, 0, 0, feature, point, normal, 0.0});
    impulses.push_back(to_contact(frame, impulse));
    befores.push_back(to_contact(frame, before));
    afters.push_back(to_contact(frame, after));
  }
  void clear() {
    contact.clear();
    impulses.clear();
    befores.clear();
    afters.clear();
  }
  [[nodiscard]] Observation at(std::uint64_t step) const {
    return {bodies.view(), {contact, impulses, befores, afters, {}, age}, {}, kStep * static_cast<double>(step), kStep,
            step};
  }
  void look(WearObserver& wear, std::uint64_t step) { wear.observe(at(step), services.attributes()); }
  static WearAmount sum_of(const WearObserver& wear) {
    WearAmount sum;
    for (const WearAmount& face : wear.account(0).faces()) sum += face;
    return sum;
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  std::vector<Contact> contact;
  std::vector<Vec3> impulses, befores, afters;
  double age = 0.0;
};

// A ball slides to rest under Coulomb friction: the way is v0^2 / (2 mu g), the volume k m g s / H, the energy m v0^2 / 2; the
// ball leaves wear along its way and nowhere else.
TEST_F(WearTest, a_ball_that_slides_to_rest_wears_as_archard_says) {
  const auto wear = make(std::string{kPlate} + "largest_face = 0.05");
  const double m = bodies.mass[1], g = 9.81, v0 = 1.0;
  const auto steps = static_cast<int>(v0 / (kFriction * g * kStep));
  double x = -0.2, v = v0;
  for (int n = 1; n <= steps; ++n) {
    const double v1 = v - kFriction * g * kStep;
    touch({x, 0.01, 0}, m * g * kStep * Vec3{-kFriction, 0, 1}, {v, 0, 0}, {v1, 0, 0});
    look(*wear, static_cast<std::uint64_t>(n));
    clear();
    x += 0.5 * (v + v1) * kStep;
    v = v1;
  }
  const double way = x + 0.2;
  const WearAmount& total = wear->account(0).total();
  EXPECT_NEAR(way, v0 * v0 / (2 * kFriction * g), 1e-5);
  EXPECT_NEAR(total.sliding_volume, 1e-3 * m * g * way / kHardness, 1e-12 * total.sliding_volume);
  EXPECT_NEAR(total.sliding_energy, 0.5 * m * (v0 * v0 - v * v), 1e-12 * total.sliding_energy);
  EXPECT_EQ(total.impact_volume, 0.0);
  EXPECT_NEAR(sum_of(*wear).sliding_volume, total.sliding_volume, 1e-12 * total.sliding_volume);
  for (std::size_t f = 0; f < wear->faces(0).size(); ++f) {
    if (wear->account(0).faces()[f].volume() == 0.0) continue;
    for (const std::uint32_t corner : wear->faces(0).triangles()[f]) {
      const Vec3& p = wear->faces(0).points()[corner];
      EXPECT_NEAR(p.z, 0.1, 1e-12);  // the upper side of the slab, in its own frame
      EXPECT_LT(std::abs(p.y - 0.01), 0.0501);
      EXPECT_GT(p.x, -0.2501);
      EXPECT_LT(p.x, -0.2 + way + 0.0501);
    }
  }
}

// The velocity before the solve holds a step of gravity; a ball held by friction does not slide for that.
TEST_F(WearTest, what_friction_holds_wears_nothing) {
  const auto wear = make(kPlate);
  touch({0, 0, 0}, {0.5 * kFriction * 1e-3, 0, 1e-3}, {-9.81 * kStep, 0, 0}, {});
  for (std::uint64_t step = 1; step <= 5; ++step) look(*wear, step);
  EXPECT_EQ(wear->account(0).total().volume(), 0.0);
}

// Steel by its material, or what the scene states: mass is density times volume, and the table at the end tells both.
TEST_F(WearTest, mass_has_the_density_of_the_material_or_of_the_setting) {
  for (const auto& [setting, density] : {std::pair{"", 7800.0}, std::pair{"\ndensity = 1500.0", 1500.0}}) {
    const auto wear = make(std::string{kPlate} + "interval = 0.001" + setting, folder);
    touch({0, 0, 0}, {-kFriction, 0, 1.0}, {1, 0, 0}, {1, 0, 0});
    look(*wear, 1);
    clear();
    const ReportTable table = wear->report().front();
    EXPECT_EQ(table.header[4], "density [kg/m3]");
    EXPECT_EQ(std::stod(table.rows[0][4]), density);
    const double volume = wear->account(0).total().volume();
    EXPECT_GT(volume, 0.0);
    EXPECT_NEAR(std::stod(table.rows[0][3]), density * volume, 1e-5 * density * volume);  // six digits
  }
}

TEST_F(WearTest, a_face_size_that_makes_too_many_faces_is_refused_with_one_that_does_not) {
  try {
    (void)make(std::string{kPlate} + "largest_face = 1e-5");
    FAIL() << "not refused";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'largest_face' is refused: the surface of 'plate' is divided into about"), std::string::npos)
        << text;
    const std::string proposal = "with largest_face = ";
    ASSERT_NE(text.find(proposal), std::string::npos) << text;
    const double edge = std::stod(text.substr(text.find(proposal) + proposal.size()));
    // Three digits are printed.
    EXPECT_LE(make(std::string{kPlate} + "largest_face = " + std::to_string(1.01 * edge))->faces(0).size(), kMostFaces);
  }
}

// 10 m/s at 30 degrees, then at 90: m U^2 / (4 p) / 4 and nothing. Contacts that stay loaded are one impact.
TEST_F(WearTest, impacts_wear_as_finnie_says) {
  const auto wear = make(kPlate);
  const double m = bodies.mass[1], u = 10.0, unit = m * u * u / (4.0 * kHardness);
  const Vec3 aslant{u * std::cos(std::numbers::pi / 6), 0, -u * 0.5};
  touch({0.1, 0.1, 0}, {0, 0, m * 5.0}, aslant, {});
  look(*wear, 1);
  EXPECT_NEAR(wear->account(0).total().impact_volume, 0.25 * unit, 1e-14 * unit);
  EXPECT_NEAR(wear->account(0).total().impact_energy, 0.5 * m * 25.0, 1e-12);
  look(*wear, 2);
  EXPECT_EQ(wear->account(0).impacts(), 1.0);
  clear();
  look(*wear, 3);
  touch({0.1, 0.1, 0}, {0, 0, m * u}, {0, 0, -u}, {});
  look(*wear, 4);
  EXPECT_EQ(wear->account(0).impacts(), 2.0);
  EXPECT_NEAR(wear->account(0).total().impact_volume, 0.25 * unit, 1e-14 * unit);
}

// A body that lands on four points lands once.
TEST_F(WearTest, points_of_one_impact_share_it) {
  const auto wear = make(kPlate);
  const double m = bodies.mass[1];
  for (std::uint64_t corner = 0; corner < 4; ++corner) {
    touch({0.1 * static_cast<double>(corner), 0, 0}, {0, 0, 0.3 + 0.1 * static_cast<double>(corner)}, {2, 0, -3}, {},
          corner);
  }
  look(*wear, 1);
  EXPECT_NEAR(wear->account(0).impacts(), 1.0, 1e-15);
  EXPECT_NEAR(wear->account(0).total().impact_energy, 0.5 * m * 9.0, 1e-12);
}

// The plate turns by 90 degrees about z and moves: what hits the same place of it wears the same face.
TEST_F(WearTest, parts_that_move_wear_where_they_are_hit) {
  const auto wear = make(std::string{kPlate} + "largest_face = 0.02");
  const Vec3 place{0.31, -0.12, 0.1};  // of the plate
  const double m = bodies.mass[1];
  const auto hit = [&](std::uint64_t step) {
    clear();
    look(*wear, step);
    const Pose pose{bodies.position[0] - age * bodies.velocity[0], bodies.orientation[0]};
    const Vec3 normal = rotate(pose.orientation, {0, 0, 1}), along = rotate(pose.orientation, {1, 0, 0});
    touch(transform(pose, place), m * normal, along - normal, {}, 0, normal);
    look(*wear, step + 1);
  };
  hit(1);
  bodies.position[0] = {3, 4, 5};
  bodies.velocity[0] = {0, 100, 0};
  bodies.orientation[0] = from_rotation_vector({0.3, 0, std::numbers::pi / 2});
  age = kStep;
  hit(3);
  std::size_t worn = 0;
  for (const WearAmount& face : wear->account(0).faces()) worn += face.volume() > 0.0;
  EXPECT_EQ(worn, 1u);
  EXPECT_EQ(wear->account(0).impacts(), 2.0);
}

// Many contacts anywhere: faces and contacts have the same sums, and a resumed run has the same of everything.
TEST_F(WearTest, faces_add_up_to_contacts_and_a_resumed_run_to_one) {
  const std::string options = std::string{kPlate} + "largest_face = 0.1\ninterval = 0.002\nfield_interval = 0.005";
  fs::create_directories(folder / "whole");
  fs::create_directories(folder / "second");
  const auto whole = make(options, folder / "whole"), first = make(options), second = make(options, folder / "second");
  const auto run = [&](WearObserver& a, WearObserver& b, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t step = from; step <= to; ++step) {
      std::mt19937_64 random{step};
      std::uniform_real_distribution<double> draw{-0.5, 0.5};
      clear();
      for (std::uint64_t k = 0; k < 1 + step % 7; ++k) {
        touch({draw(random), draw(random), 0}, {kFriction * 1e-3, 0, 1e-3},
              {draw(random), draw(random), -0.6 + draw(random)}, {draw(random), draw(random), 0.1}, k);
      }
      look(a, step);
      look(b, step);
    }
  };
  run(*whole, *first, 1, 11);
  MemoryState state;
  first->save(state.writer());
  second->load(state.reader());
  run(*whole, *second, 12, 23);
  whole->finish(at(23));
  second->finish(at(23));
  const WearAmount& total = whole->account(0).total();
  const WearAmount sum = sum_of(*whole);
  EXPECT_GT(total.impact_volume, 0.0);
  // A hundred roundings.
  EXPECT_NEAR(sum.sliding_volume, total.sliding_volume, 1e-14 * total.sliding_volume);
  EXPECT_NEAR(sum.impact_volume, total.impact_volume, 1e-14 * total.impact_volume);
  EXPECT_NEAR(sum.impact_energy, total.impact_energy, 1e-14 * total.impact_energy);
  const auto read = [&](const fs::path& name) {
    std::ifstream in{folder / name, std::ios::binary};
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  };
  for (const char* name : {"wear.csv", "wear_00000020.vtp", "wear_00000023.vtp"}) {
    EXPECT_FALSE(read(fs::path{"whole"} / name).empty()) << name;
    EXPECT_EQ(read(fs::path{"whole"} / name), read(fs::path{"second"} / name)) << name;
  }
  EXPECT_TRUE(fs::exists(folder / "whole" / "wear.svg"));
}

// VTK reads the field: depth times area is the volume.
TEST_F(WearTest, the_field_holds_the_volume_for_vtk) {
  const auto wear = make(kPlate, folder);
  touch({0.2, 0.1, 0}, {kFriction, 0, 1.0}, {1, 0, 0}, {1, 0, 0});
  look(*wear, 1);
  wear->finish(at(1));
  std::ostringstream command;
  command.precision(17);
  command << "/usr/bin/python3 -c \"import sys, vtk\n"
             "r = vtk.vtkXMLPolyDataReader(); r.SetFileName(sys.argv[1]); r.Update(); d = r.GetOutput().GetCellData()\n"
             "depth, area = d.GetArray('depth'), d.GetArray('area')\n"
             "volume = sum(depth.GetValue(i) * area.GetValue(i) for i in range(depth.GetNumberOfTuples()))\n"
             "expected = float(sys.argv[2]); assert abs(volume - expected) < 1e-12 * expected, volume\n"
             "assert abs(sum(area.GetValue(i) for i in range(area.GetNumberOfTuples())) - 2.8) < 1e-9\" "
          << (folder / "wear_00000001.vtp").string() << " " << wear->account(0).total().volume();
  EXPECT_EQ(std::system(command.str().c_str()), 0);
  EXPECT_NEAR(wear->account(0).total().volume(), 1e-3 * 1.0 / kHardness, 1e-24);
}

}  // namespace
}  // namespace scree
