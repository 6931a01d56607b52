// Recorded contact problems: every bit comes back, and whatever does not fit is named.
#include "scree/ccp/ccp_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/state/hdf5_checkpoint.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class CcpFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("scree_ccp_file_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "ccp_7.h5";
    const test::TestingProblem problem = test::random_problem({.bodies = 6, .contacts = 9, .compliant = true});
    std::vector<double> guess(problem.view().rows(), 0.25);
    guess[1] = -0.0;
    record_ = make_ccp_record(problem.view(), guess, {"00c0ffee", "0.1.0", 0.35, 7, 1e-5, 40});
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// What reading says after `spoil` changed the record; "" when it is taken.
  std::string reading(const std::function<void(CcpRecord&)>& spoil) const {
    CcpRecord spoilt = record_;
    spoil(spoilt);
    write_ccp_file(file_, spoilt);
    return reading();
  }
  [[nodiscard]] std::string reading() const {
    try {
      (void)read_ccp_file(file_);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      return error.what();
    }
    return {};
  }
  void expect_refused(const std::string& words, const std::function<void(CcpRecord&)>& spoil) const {
    const std::string said = reading(spoil);
    EXPECT_NE(said.find(words), std::string::npos) << "wanted: " << words << "\nsaid: " << said;
    EXPECT_NE(said.find(file_.string()), std::string::npos) << said;
  }

  fs::path folder_, file_;
  CcpRecord record_;
};

TEST_F(CcpFileTest, returns_every_bit_that_was_written) {
  write_ccp_file(file_, record_);
  const CcpRecord back = read_ccp_file(file_);
  EXPECT_EQ(back.inverse_mass, record_.inverse_mass);
  EXPECT_EQ(back.inverse_inertia, record_.inverse_inertia);
  EXPECT_EQ(back.r, record_.r);
  EXPECT_EQ(back.compliance, record_.compliance);
  EXPECT_EQ(back.guess, record_.guess);
  EXPECT_TRUE(std::signbit(back.guess[1]));
  ASSERT_EQ(back.contacts.size(), record_.contacts.size());
  for (std::size_t i = 0; i < back.contacts.size(); ++i) {
    const CcpContact &a = back.contacts[i], &b = record_.contacts[i];
    EXPECT_TRUE(a.normal == b.normal && a.arm_a == b.arm_a && a.arm_b == b.arm_b) << i;
    EXPECT_TRUE(a.friction == b.friction && a.a == b.a && a.b == b.b) << i;
  }
  EXPECT_EQ(back.origin.scene_hash, "00c0ffee");
  EXPECT_EQ(back.origin.scree_version, "0.1.0");
  EXPECT_EQ(back.origin.time, 0.35);
  EXPECT_EQ(back.origin.step, 7u);
  EXPECT_EQ(back.origin.tolerance, 1e-5);
  EXPECT_EQ(back.origin.max_iterations, 40);
}

TEST_F(CcpFileTest, takes_problems_without_contacts_and_without_compliance) {
  EXPECT_EQ(reading([](CcpRecord& record) { record.compliance.clear(); }), "");
  EXPECT_EQ(reading([](CcpRecord& record) { record = {}; }), "");
}

/// A motor with one bound and a contact that resists rolling, behind the contacts.
void add_blocks(CcpRecord& record) {
  record.blocks = {{.kind = CcpKind::box, .rows = 2, .first_row = 0, .a = 1, .b = 2, .lower = -kInfinity, .upper = 0.5},
                   {.kind = CcpKind::cone,
                    .rows = 6,
                    .first_row = 2,
                    .a = 0,
                    .b = 3,
                    .friction = 0.5,
                    .spinning = 0.1,
                    .rolling = 0.2}};
  for (int k = 0; k < 8; ++k) {
    const double x = k;
    record.block_rows.push_back({{{x, 1, 2}, {3, 4, 5}}, {{-x, -1, -2}, {6, 7, 8}}});
    record.r.push_back(0.25 * x);
    record.guess.push_back(-0.5 * x);
    record.compliance.push_back(0.125 * x);
  }
}

TEST_F(CcpFileTest, returns_blocks_of_other_kinds) {
  add_blocks(record_);
  write_ccp_file(file_, record_);
  const CcpRecord back = read_ccp_file(file_);
  ASSERT_EQ(back.blocks.size(), 2u);
  EXPECT_EQ(back.blocks[0].kind, CcpKind::box);
  EXPECT_EQ(back.blocks[0].lower, -kInfinity);
  EXPECT_EQ(back.blocks[0].upper, 0.5);
  EXPECT_EQ(back.blocks[1].kind, CcpKind::cone);
  EXPECT_EQ(back.blocks[1].rows, 6);
  EXPECT_EQ(back.blocks[1].first_row, 2u);
  EXPECT_EQ(back.blocks[1].a, 0u);
  EXPECT_EQ(back.blocks[1].b, 3u);
  EXPECT_EQ(back.blocks[1].friction, 0.5);
  EXPECT_EQ(back.blocks[1].spinning, 0.1);
  EXPECT_EQ(back.blocks[1].rolling, 0.2);
  ASSERT_EQ(back.block_rows.size(), 8u);
  EXPECT_TRUE(back.block_rows[7].b.linear == (Vec3{-7, -1, -2}) && back.block_rows[7].a.angular == (Vec3{3, 4, 5}));
  EXPECT_EQ(back.r, record_.r);
  EXPECT_EQ(back.problem().rows(), record_.r.size());
}

TEST_F(CcpFileTest, refuses_blocks_that_do_not_fit) {
  const auto expect_block_refused = [&](const std::string& words, const std::function<void(CcpBlock&)>& spoil) {
    expect_refused(words, [&](CcpRecord& record) {
      add_blocks(record);
      spoil(record.blocks[1]);
    });
  };
  expect_block_refused("block 1 is of an unknown kind", [](CcpBlock& b) { b.kind = static_cast<CcpKind>(4); });
  expect_block_refused("block 1 names a body that is not there", [](CcpBlock& b) { b.b = 7; });
  expect_block_refused("block 1 has a coefficient of friction", [](CcpBlock& b) { b.rolling = -0.1; });
  expect_block_refused("\"block_row_a\" has 48 entries instead of 42", [](CcpBlock& b) { b.rows = 5; });
  expect_refused("\"r\" has 34 entries instead of 35, one a row", [](CcpRecord& record) {
    add_blocks(record);
    record.r.pop_back();
  });
  expect_refused("block 0 has no number between its bounds", [](CcpRecord& record) {
    add_blocks(record);
    record.blocks[0].lower = 1.0;
  });
  expect_refused("block 0 has no number between its bounds", [](CcpRecord& record) {
    add_blocks(record);
    record.blocks[0].lower = record.blocks[0].upper = std::numeric_limits<double>::infinity();
  });
}

TEST_F(CcpFileTest, refuses_wrong_sizes) {
  expect_refused("\"r\" has 26 entries instead of 27", [](CcpRecord& record) { record.r.pop_back(); });
  expect_refused("\"guess\" has 28", [](CcpRecord& record) { record.guess.push_back(0.0); });
  expect_refused("\"compliance\" has 26", [](CcpRecord& record) { record.compliance.pop_back(); });
  expect_refused("\"inverse_inertia\" has 54 entries instead of 63",
                 [](CcpRecord& record) { record.inverse_inertia.pop_back(); });
}

TEST_F(CcpFileTest, refuses_bodies_that_are_not_there) {
  expect_refused("contact 4 is on body 7, but there are only 7 bodies",
                 [](CcpRecord& record) { record.contacts[4].b = 7; });
}

TEST_F(CcpFileTest, refuses_numbers_that_are_not_finite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  expect_refused("entry 5 of \"r\" is not a finite number", [&](CcpRecord& record) { record.r[5] = nan; });
  expect_refused("entry 0 of \"guess\"", [&](CcpRecord& record) { record.guess[0] = infinite; });
  expect_refused("entry 2 of \"inverse_mass\"", [&](CcpRecord& record) { record.inverse_mass[2] = nan; });
  expect_refused("body 3 is not finite", [&](CcpRecord& record) { record.inverse_inertia[3].row1.z = nan; });
  expect_refused("contact 1 has a number", [&](CcpRecord& record) { record.contacts[1].arm_a.x = nan; });
  expect_refused("contact 1 has a number", [&](CcpRecord& record) { record.contacts[1].friction = infinite; });
  expect_refused("\"tolerance\"", [&](CcpRecord& record) { record.origin.tolerance = nan; });
}

TEST_F(CcpFileTest, refuses_what_no_problem_can_have) {
  expect_refused("negative coefficient of friction", [](CcpRecord& record) { record.contacts[2].friction = -0.1; });
  expect_refused("\"inverse_mass\" is negative", [](CcpRecord& record) { record.inverse_mass[1] = -1.0; });
  expect_refused("\"compliance\" is negative", [](CcpRecord& record) { record.compliance[4] = -1e-9; });
  expect_refused("not symmetric", [](CcpRecord& record) { record.inverse_inertia[2].row0.y += 1.0; });
  expect_refused("the inverse inertia of body 0 is not zero, but its inverse mass is",
                 [](CcpRecord& record) { record.inverse_inertia[0] = Mat3::identity(); });
  expect_refused("negative diagonal", [](CcpRecord& record) { record.inverse_inertia[2].row2.z = -1.0; });
  expect_refused("not a unit vector", [](CcpRecord& record) { record.contacts[0].normal.x += 0.5; });
  expect_refused("\"max_iterations\"", [](CcpRecord& record) { record.origin.max_iterations = 0; });
}

TEST_F(CcpFileTest, refuses_a_file_cut_at_any_length) {
  write_ccp_file(file_, record_);
  std::ifstream in{file_, std::ios::binary};
  const std::string whole{std::istreambuf_iterator<char>{in}, {}};
  for (std::size_t size = 0; size < whole.size(); size += 409) {
    std::ofstream{file_, std::ios::binary} << whole.substr(0, size);
    const std::string said = reading();
    EXPECT_TRUE(said.find("cut short") != std::string::npos || said.find("not an HDF5 file") != std::string::npos)
        << size << ": " << said;
  }
}

// A changed byte is noticed by a check sum, or lies where the file holds nothing: then nothing has changed.
TEST_F(CcpFileTest, never_gives_other_numbers_for_a_changed_byte) {
  write_ccp_file(file_, record_);
  std::ifstream in{file_, std::ios::binary};
  const std::string whole{std::istreambuf_iterator<char>{in}, {}};
  int refused = 0;
  for (std::size_t place = 0; place < whole.size(); place += 251) {
    std::string content = whole;
    content[place] = static_cast<char>(content[place] ^ 0x10);
    std::ofstream{file_, std::ios::binary} << content;
    if (!reading().empty()) {
      ++refused;
    } else {
      EXPECT_EQ(read_ccp_file(file_).r, record_.r) << place;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(CcpFileTest, refuses_other_files) {
  EXPECT_NE(reading().find("there is no contact problem " + file_.string()), std::string::npos);
  std::ofstream{file_} << "no problem\n";
  EXPECT_NE(reading().find("is not a contact problem: it is not an HDF5 file"), std::string::npos);
  CheckpointWriter checkpoint{{"", ""}};
  checkpoint.save_as(file_);
  EXPECT_NE(reading().find("holds a checkpoint of scree; a contact problem such as ccp_100.h5 is needed"),
            std::string::npos);
}

TEST_F(CcpFileTest, a_problem_is_no_checkpoint) {
  write_ccp_file(file_, record_);
  try {
    const CheckpointReader reader{file_};
    ADD_FAILURE() << "the problem was taken for a checkpoint";
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("holds a contact problem of scree; a checkpoint"), std::string::npos);
  }
}

}  // namespace
}  // namespace scree
