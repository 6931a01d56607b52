#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scree/config/validate.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"
#include "vtk_observer.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class VtkObserverTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_vtk_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    services.materials().add({"copper", 8900.0, {}, {}});
    services.materials().add({"PE & \"PP\" <1>", 946.0, {}, {}});
    services.step = 0.1;
    add_shapes();
    charge = services.provide_attribute({"charge_corona", "C", "", 0.0, {}});
    other_charge = services.provide_attribute({"charge_induced", "C", "", 0.0, {}});
    add_bodies();
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  void add_shapes() {
    PrimitiveData cluster, wall;
    cluster.primitive.kind = ShapeKind::sphere_cluster;
    cluster.spheres = {{{1e-3, 0, 0}, 2e-3}, {{-1e-3, 0, 0}, 3e-3}};
    wall.primitive.kind = ShapeKind::box;
    wall.primitive.size = {0.1, 0.2, 0.3};
    for (const PrimitiveData& primitive : {cluster, wall}) {
      ShapeData shape;
      shape.primitives = {primitive};
      services.shapes().add(shape);
    }
  }
  void add_bodies() {
    bodies.add_immovable(1, {0, 0, -1});
    bodies.shape[0] = 1;
    for (BodyId i = 0; i < 3; ++i) {
      const auto x = static_cast<double>(i);
      bodies.add_sphere(10 + i, {0.1 * x, 0.7, -0.3}, 3e-3, 1000.0, {1.0 / 3.0, 2, 3.0 * x});
      bodies.material.back() = 1;
      bodies.angular_velocity.back() = {0, 0, 5};
      bodies.orientation.back() = from_rotation_vector({0, 0, 0.1 * x});
      services.attributes().column(charge).back() = 1e-10 * x;
      services.attributes().column(other_charge).back() = -3e-10;
    }
  }

  [[nodiscard]] VtkObserver make(const std::string& options) {
    return VtkObserver{options_from_text(options, VtkObserver::parameters())};
  }
  [[nodiscard]] Observation at(std::uint64_t step) const {
    return {bodies.view(), {}, {}, 0.1 * static_cast<double>(step), 0.1, step};
  }
  void observe(VtkObserver& observer, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t step = from; step <= to; ++step) observer.observe(at(step), services.attributes());
  }
  [[nodiscard]] std::vector<std::string> files(const std::string& prefix) const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator{folder}) {
      const std::string name = entry.path().filename();
      if (name.starts_with(prefix)) found.push_back(name);
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in{folder / name, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  AttributeId charge = 0, other_charge = 0;
};

// What VTK must find in a file: all values of the three dynamic bodies.
Json expected_particles(const test::TestBodies& bodies, const std::string& file, double time, double tolerance) {
  std::vector<double> points, velocity, orientation, mass;
  for (std::size_t i = 1; i < bodies.id.size(); ++i) {
    points.insert(points.end(), {bodies.position[i].x, bodies.position[i].y, bodies.position[i].z});
    velocity.insert(velocity.end(), {bodies.velocity[i].x, bodies.velocity[i].y, bodies.velocity[i].z});
    const Quat q = bodies.orientation[i];
    orientation.insert(orientation.end(), {q.w, q.x, q.y, q.z});
    mass.push_back(bodies.mass[i]);
  }
  Json arrays{{"id", {10, 11, 12}},
              {"type", {1, 1, 1}},
              {"shape", {0, 0, 0}},
              {"material", {1, 1, 1}},
              {"radius", {3e-3, 3e-3, 3e-3}},
              {"charge", {-3e-10, 1e-10 - 3e-10, 2e-10 - 3e-10}},
              {"charge_corona", {0.0, 1e-10, 2e-10}},
              {"angular_velocity", {0, 0, 5, 0, 0, 5, 0, 0, 5}}};
  arrays["mass"] = mass;
  arrays["velocity"] = velocity;
  arrays["orientation_wxyz"] = orientation;
  return {{"file", file},           {"points", points}, {"arrays", arrays},
          {"tolerance", tolerance}, {"time", time},     {"materials", {"copper", "PE & \"PP\" <1>"}}};
}

TEST_F(VtkObserverTest, files_read_back_with_vtk_to_every_value) {
  VtkObserver observer = make("interval = 0.2\nspheres = true");
  observer.setup(services, folder);
  observe(observer, 1, 3);
  observer.finish(at(3));
  Json expected;
  // Double precision keeps every bit; summing two charges rounds once.
  expected["files"] = {expected_particles(bodies, "particles_00000002.vtp", 0.2, 1e-15)};
  Json spheres{{"file", "spheres_00000002.vtp"}, {"tolerance", 1e-14}, {"time", 0.2}};
  spheres["materials"] = expected["files"][0]["materials"];
  spheres["arrays"] = {{"id", {10, 10, 11, 11, 12, 12}}, {"radius", {2e-3, 3e-3, 2e-3, 3e-3, 2e-3, 3e-3}}};
  for (std::size_t i = 1; i < 4; ++i) {
    const double angle = 0.1 * static_cast<double>(i - 1);
    for (const double side : {1e-3, -1e-3}) {
      const Vec3 p = bodies.position[i];
      for (const double x : {p.x + side * std::cos(angle), p.y + side * std::sin(angle), p.z}) {
        spheres["points"].push_back(x);
      }
    }
  }
  expected["files"].push_back(spheres);
  expected["walls"] = {{"file", "walls_00000002.vtp"}, {"triangles", 12}, {"volume", 8 * 0.1 * 0.2 * 0.3}};
  expected["collection"] = {{0.2, 0, "particles_00000002.vtp"},
                            {0.2, 1, "walls_00000002.vtp"},
                            {0.1 * 3, 0, "particles_00000003.vtp"},
                            {0.1 * 3, 1, "walls_00000002.vtp"}};
  services.claim_result("expected.json");
  std::ofstream{folder / "expected.json"} << expected;
  const std::string command = "/usr/bin/python3 " SCREE_READ_BACK " " + folder.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VtkObserverTest, single_precision_keeps_seven_digits) {
  VtkObserver observer = make("precision = 'single'");
  observer.setup(services, folder);
  observer.finish(at(1));
  Json expected;
  // Half a unit in the last place of a float is 6e-8.
  expected["files"] = {expected_particles(bodies, "particles_00000001.vtp", 0.1, 6e-8)};
  expected["walls"] = {{"file", "walls_00000001.vtp"}, {"triangles", 12}, {"volume", 0.048}};
  expected["collection"] = {{0.1, 0, "particles_00000001.vtp"}, {0.1, 1, "walls_00000001.vtp"}};
  services.claim_result("expected.json");
  std::ofstream{folder / "expected.json"} << expected;
  const std::string command = "/usr/bin/python3 " SCREE_READ_BACK " " + folder.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VtkObserverTest, arrays_of_many_blocks_and_of_none_are_whole) {
  bodies = test::TestBodies{services.attributes()};
  VtkObserver observer = make("walls = false");
  observer.setup(services, folder);
  observer.finish(at(1));
  // 50 000 points are 1.2 MB: two blocks.
  for (BodyId id = 0; id < 50'000; ++id) bodies.add_sphere(id, {1e-3 * static_cast<double>(id), 0, 0}, 1e-3, 1000.0);
  observer.finish(at(2));
  const std::string command =
      "/usr/bin/python3 -c \"import sys, vtk\n"
      "for name, count in ((sys.argv[1], 0), (sys.argv[2], 50000)):\n"
      "    reader = vtk.vtkXMLPolyDataReader(); reader.SetFileName(name); reader.Update()\n"
      "    data = reader.GetOutput(); assert data.GetNumberOfPoints() == count\n"
      "    for i in range(count): assert data.GetPoint(i)[0] == 1e-3 * i\" " +
      (folder / "particles_00000001.vtp").string() + " " + (folder / "particles_00000002.vtp").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VtkObserverTest, walls_are_written_again_only_when_they_moved) {
  VtkObserver observer = make("interval = 0.1");
  observer.setup(services, folder);
  observe(observer, 1, 3);
  bodies.orientation[0] = from_rotation_vector({0, 0, 0.1});
  observe(observer, 4, 5);
  EXPECT_EQ(files("walls_"), (std::vector<std::string>{"walls_00000001.vtp", "walls_00000004.vtp"}));
  EXPECT_EQ(files("particles_").size(), 5u);
}

// Particles 10, 11, 12 stand at x = 0, 0.1, 0.2; the wall reaches from -0.1 to 0.1: the plane x = 0.05 halves one and takes two.
TEST_F(VtkObserverTest, a_plane_takes_particles_and_parts_of_walls_away) {
  services.add_body("wall", {1, {}, {}});
  services.add_body("first", {10, {}, {}});
  VtkObserver cut = make("interval = 0.1\nplane = [{ point = [0.05, 0, 0], normal = [1, 0, 0] }]");
  VtkObserver hidden = make("interval = 0.1\nhide = ['wall']\nas_walls = ['first']");
  cut.setup(services, folder);
  services.set_part_name("hidden");
  hidden.setup(services, folder);
  observe(cut, 1, 1);
  observe(hidden, 1, 1);
  const std::string command =
      "/usr/bin/python3 -c \"import sys, vtk\n"
      "def read(name):\n"
      "    r = vtk.vtkXMLPolyDataReader(); r.SetFileName(sys.argv[1] + '/' + name); r.Update(); return r.GetOutput()\n"
      "d = read('particles_00000001.vtp')\n"
      "assert [d.GetPointData().GetArray('id').GetValue(i) for i in range(d.GetNumberOfPoints())] == [10]\n"
      "b = read('walls_00000001.vtp').GetBounds(); assert abs(b[0] + 0.1) < 1e-12 and abs(b[1] - 0.05) < 1e-12, b\n"
      "d = read('particles_hidden_00000001.vtp')\n"
      "assert [d.GetPointData().GetArray('id').GetValue(i) for i in range(d.GetNumberOfPoints())] == [11, 12]\n"
      "b = read('walls_hidden_00000001.vtp').GetBounds(); assert b[1] < 0.01, b\" " +
      folder.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VtkObserverTest, two_observers_have_files_of_their_own) {
  VtkObserver plain = make("interval = 0.1"), named = make("interval = 0.2");
  services.set_part_name("vtk");
  plain.setup(services, folder);
  services.set_part_name("Coarse");
  named.setup(services, folder);
  observe(plain, 1, 3);
  observe(named, 1, 3);
  EXPECT_EQ(files("particles_").size(), 4u);
  EXPECT_EQ(files("particles_coarse_"), std::vector<std::string>{"particles_coarse_00000002.vtp"});
  EXPECT_NE(read("run.pvd").find("particles_00000003.vtp"), std::string::npos);
  EXPECT_NE(read("run_coarse.pvd").find("particles_coarse_00000002.vtp"), std::string::npos);
}

TEST_F(VtkObserverTest, a_resumed_run_keeps_its_earlier_frames) {
  VtkObserver first = make("interval = 0.2");
  first.setup(services, folder);
  observe(first, 1, 4);
  MemoryState saved;
  first.save(saved.writer());
  VtkObserver second = make("interval = 0.2");
  second.setup(services, folder);
  second.load(saved.reader());
  observe(second, 5, 6);
  const std::string collection = read("run.pvd");
  for (const char* name : {"particles_00000002", "particles_00000004", "particles_00000006"}) {
    EXPECT_NE(collection.find(name), std::string::npos) << name;
  }
}

TEST_F(VtkObserverTest, writes_nothing_without_a_folder) {
  VtkObserver observer = make("");
  observer.setup(services, {});
  observe(observer, 0, 3);
  observer.finish(at(3));
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace scree
