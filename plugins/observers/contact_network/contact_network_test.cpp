// Files of the observer, and its state.
#include "contact_network.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include "scree/config/validate.hpp"
#include "scree/model/material.hpp"
#include "scree/state/memory_state.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

// A column of three grains on a floor (id 0), whose forces differ from step to step.
class ContactNetworkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_network_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "second");
    services.materials().add({"stone", 1000.0, {.friction = 0.5}, {}});
    services.set_part_name("contact_network");
    bodies.add_immovable(0, {5, 5, -7});
    for (BodyId k = 1; k < 4; ++k) bodies.add_sphere(k, {0, 0, static_cast<double>(k) - 0.5}, 0.5, 1000.0);
    for (BodyIndex k = 0; k < 3; ++k) {
      contact.push_back({k, k + 1, 0, 0, 0, {0, 0, static_cast<double>(k)}, {0, 0, 1}, 0.0});
    }
    velocity.resize(3);
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  [[nodiscard]] std::unique_ptr<ContactNetwork> make(const std::string& options, const fs::path& results) {
    auto part = std::make_unique<ContactNetwork>(options_from_text(options, ContactNetwork::parameters()));
    part->setup(services, results);
    return part;
  }
  void look(ContactNetwork& part, std::uint64_t step) {
    std::mt19937_64 random{step};
    impulse.clear();
    for (int k = 0; k < 3; ++k) {
      const double f = 1e-3 * static_cast<double>(1 + random() % 9);
      impulse.push_back({f, k == 1 ? 0.5 * f : 0.1 * f, 0.0});
    }
    part.observe(
        {bodies.view(), {contact, impulse, velocity, velocity}, {}, 1e-3 * static_cast<double>(step), 1e-3, step},
        services.attributes());
  }
  void finish(ContactNetwork& part, std::uint64_t step) {
    part.finish({bodies.view(), {}, {}, 1e-3 * static_cast<double>(step), 1e-3, step});
  }
  [[nodiscard]] std::string read(const fs::path& name) const {
    std::ifstream in{folder / name, std::ios::binary};
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
  std::vector<Contact> contact;
  std::vector<Vec3> impulse, velocity;
};

TEST_F(ContactNetworkTest, a_resumed_run_writes_what_one_run_writes) {
  const char* options = "interval = 0.002\nfile_interval = 0.005\nfrom = 0.004";
  const auto whole = make(options, folder), first = make(options, {}), second = make(options, folder / "second");
  for (std::uint64_t step = 1; step <= 9; ++step) look(*whole, step), look(*first, step);
  MemoryState state;
  first->save(state.writer());
  second->load(state.reader());
  for (std::uint64_t step = 10; step <= 20; ++step) look(*whole, step), look(*second, step);
  finish(*whole, 20);
  finish(*second, 20);
  for (const char* name : {"contact_network.csv", "contact_network_coordination.csv", "contact_network_forces.csv",
                           "contact_network_00000020.vtp"}) {
    EXPECT_FALSE(read(name).empty()) << name;
    EXPECT_EQ(read(name), read(fs::path{"second"} / name)) << name;
  }
  EXPECT_TRUE(fs::exists(folder / "contact_network_forces.svg"));
  EXPECT_EQ(whole->report()[0].rows[0][0], "3");
}

TEST_F(ContactNetworkTest, the_end_of_the_run_has_a_row_once) {
  for (const auto& [end, rows] : {std::pair{std::uint64_t{11}, 4}, std::pair{std::uint64_t{12}, 4}}) {
    services.end = 1e-3 * static_cast<double>(end);
    const auto part = make("interval = 0.004", folder);
    for (std::uint64_t step = 1; step <= end; ++step) look(*part, step);
    const double force = std::max({impulse[0].x, impulse[1].x, impulse[2].x}) / 1e-3;
    finish(*part, end);
    const std::string table = read("contact_network.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), rows) << table;
    std::istringstream last{table.substr(table.rfind('\n', table.size() - 2) + 1)};
    std::vector<double> values;
    for (std::string cell; std::getline(last, cell, ',');) values.push_back(std::stod(cell));
    EXPECT_DOUBLE_EQ(values.at(0), services.end);
    EXPECT_NEAR(values.at(7), force, 1e-12 * force);
  }
}

// Segments between centres, from the floor's point of contact; the middle link slides.
TEST_F(ContactNetworkTest, the_file_has_a_segment_for_every_link) {
  const auto part = make("file_interval = 0.001", folder);
  look(*part, 1);
  std::ostringstream command;
  command.precision(17);
  command << "/usr/bin/python3 -c \"import sys, vtk\n"
             "r = vtk.vtkXMLPolyDataReader(); r.SetFileName(sys.argv[1]); r.Update(); d = r.GetOutput()\n"
             "assert d.GetNumberOfLines() == 3\n"
             "heights = [[d.GetPoint(d.GetCell(i).GetPointId(k))[2] for k in (0, 1)] for i in range(3)]\n"
             "assert heights == [[0.0, 0.5], [0.5, 1.5], [1.5, 2.5]], heights\n"
             "get = lambda name: [d.GetCellData().GetArray(name).GetValue(i) for i in range(3)]\n"
             "assert get('slides') == [0, 1, 0] and get('wall') == [1, 0, 0]\n"
             "assert all(abs(a - b) < 1e-12 for a, b in zip(get('mobilisation'), (0.2, 1.0, 0.2)))\n"
             "assert all(abs(a - float(b)) < 1e-12 for a, b in zip(get('normal_force'), sys.argv[2:5]))\" "
          << (folder / "contact_network_00000001.vtp").string();
  for (const Vec3& j : impulse) command << " " << j.x / 1e-3;
  EXPECT_EQ(std::system(command.str().c_str()), 0);
}

TEST_F(ContactNetworkTest, a_region_inside_out_is_refused) {
  EXPECT_THROW(static_cast<void>(make("region = { lower = [0, 0, 1], upper = [1, 1, 0] }", {})), Error);
}

}  // namespace
}  // namespace scree
