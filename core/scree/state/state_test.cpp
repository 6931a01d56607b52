#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/state/hdf5_checkpoint.hpp"
#include "scree/state/memory_state.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

const std::vector<double> kDoubles{0.1, -0.0, 1e-310, std::numeric_limits<double>::infinity()};
const std::vector<std::uint64_t> kIntegers{0, ~std::uint64_t{0}, 1};
const std::vector<Vec3> kVectors{{1, 2, 3}, {4, 5, 6}};
const std::vector<Quat> kQuaternions{{0.5, 0.5, 0.5, 0.5}};

void write_everything(StateWriter& out) {
  out.write("doubles", kDoubles);
  out.write("integers", kIntegers);
  out.write("vectors", kVectors);
  out.write("quaternions", kQuaternions);
  out.write("number", 2.5);
  out.write("integer", std::uint64_t{7});
  out.write("text", "Grüße, scree");
  out.write("empty_text", "");
  out.write("none", std::vector<double>{});
  const auto part = out.group("part");
  part->write("number", -1.0);
  part->group("inner")->write("integer", std::uint64_t{9});
}

void expect_everything(const StateReader& in) {
  EXPECT_EQ(in.doubles("doubles"), kDoubles);
  EXPECT_TRUE(std::signbit(in.doubles("doubles")[1])) << "the sign of zero is a bit of the state as well";
  EXPECT_EQ(in.integers("integers"), kIntegers);
  EXPECT_EQ(in.vectors("vectors"), kVectors);
  EXPECT_EQ(in.quaternions("quaternions"), kQuaternions);
  EXPECT_EQ(in.number("number"), 2.5);
  EXPECT_EQ(in.integer("integer"), 7u);
  EXPECT_EQ(in.text("text"), "Grüße, scree");
  EXPECT_EQ(in.text("empty_text"), "");
  EXPECT_TRUE(in.doubles("none").empty());
  EXPECT_EQ(in.group("part")->number("number"), -1.0);
  EXPECT_EQ(in.group("part")->group("inner")->integer("integer"), 9u);
  EXPECT_TRUE(in.has("part"));
  EXPECT_FALSE(in.has("nothing"));
}

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    return error.what();
  }
  return "no error";
}

void expect_refusals(const StateReader& in) {
  EXPECT_NE(message([&] { (void)in.number("nothing"); }).find("\"nothing\""), std::string::npos);
  EXPECT_NE(message([&] { (void)in.group("nothing"); }).find("\"nothing\""), std::string::npos);
  EXPECT_NE(message([&] { (void)in.doubles("integers"); }).find("another kind"), std::string::npos);
  EXPECT_NE(message([&] { (void)in.text("doubles"); }).find("another kind"), std::string::npos);
  EXPECT_NE(message([&] { (void)in.number("doubles"); }).find("4 numbers"), std::string::npos);
  EXPECT_NE(message([&] { (void)in.vectors("doubles"); }).find("multiple of three"), std::string::npos);
}

class CheckpointTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_state_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    file = folder / "checkpoint.h5";
  }
  void TearDown() override { fs::remove_all(folder); }

  void save() const {
    CheckpointWriter out{{"00c0ffee", "0.1.0"}};
    write_everything(out.root());
    out.save_as(file);
  }
  [[nodiscard]] std::string bytes() const {
    std::ifstream in{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
  }
  void put(const std::string& content) const { std::ofstream{file, std::ios::binary} << content; }
  [[nodiscard]] std::string reading() const {
    return message([&] {
      const CheckpointReader in{file};
      expect_everything(in.root());
    });
  }

  fs::path folder, file;
};

TEST(memory_state, returns_every_bit_that_was_written) {
  MemoryState state;
  write_everything(state.writer());
  expect_everything(state.reader());
  expect_refusals(state.reader());
}

TEST(memory_state, refuses_a_name_written_twice) {
  MemoryState state;
  state.writer().write("x", 1.0);
  EXPECT_THROW(state.writer().write("x", 2.0), Error);
}

TEST_F(CheckpointTest, returns_every_bit_that_was_written) {
  save();
  const CheckpointReader in{file};
  EXPECT_EQ(in.header().scene_hash, "00c0ffee");
  EXPECT_EQ(in.header().scree_version, "0.1.0");
  expect_everything(in.root());
  expect_refusals(in.root());
}

TEST_F(CheckpointTest, refuses_a_name_written_twice) {
  CheckpointWriter out{{"", ""}};
  out.root().write("x", 1.0);
  EXPECT_THROW(out.root().write("x", 2.0), Error);
}

TEST_F(CheckpointTest, is_the_same_file_for_the_same_state) {
  save();
  const std::string first = bytes();
  save();
  EXPECT_EQ(bytes(), first);
}

TEST_F(CheckpointTest, grows_beyond_one_piece_of_memory) {
  const std::vector<double> many(1'000'000, 0.25);
  CheckpointWriter out{{"", ""}};
  out.root().write("many", many);
  out.save_as(file);
  EXPECT_EQ(CheckpointReader{file}.root().doubles("many"), many);
}

TEST_F(CheckpointTest, says_what_is_wrong_with_a_file) {
  EXPECT_NE(reading().find("there is no checkpoint " + file.string()), std::string::npos);
  put("[simulation]\nend_time = 5\n");
  EXPECT_NE(reading().find("not an HDF5 file"), std::string::npos);
  put("");
  EXPECT_NE(reading().find("not an HDF5 file"), std::string::npos);
  EXPECT_NE(message([&] { const CheckpointReader in{folder}; }).find("is not a file"), std::string::npos);
}

TEST_F(CheckpointTest, refuses_a_file_cut_at_any_length) {
  save();
  const std::string whole = bytes();
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    put(whole.substr(0, size));
    const std::string said = reading();
    EXPECT_TRUE(said.find("cut short") != std::string::npos || said.find("not an HDF5 file") != std::string::npos)
        << size << ": " << said;
  }
}

TEST_F(CheckpointTest, notices_a_changed_number) {
  save();
  std::string content = bytes();
  const double sought = kVectors[1].x;
  const std::size_t place = content.find(std::string{reinterpret_cast<const char*>(&sought), sizeof sought});
  ASSERT_NE(place, std::string::npos);
  content[place + 7] = static_cast<char>(content[place + 7] ^ 1);
  put(content);
  EXPECT_NE(reading().find("damaged"), std::string::npos);
}

TEST_F(CheckpointTest, refuses_a_foreign_hdf5_file) {
  const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(id);
  EXPECT_NE(reading().find("not a checkpoint of scree"), std::string::npos);
}

TEST_F(CheckpointTest, keeps_the_last_good_file_when_the_disk_is_full) {
  save();
  const std::string good = bytes();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1024, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = message([&] { save(); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_NE(said.find("checkpoint.h5"), std::string::npos) << said;
  EXPECT_NE(said.find("File too large"), std::string::npos) << said;
  EXPECT_EQ(bytes(), good);
  EXPECT_EQ(std::distance(fs::directory_iterator{folder}, fs::directory_iterator{}), 1) << "a part was left behind";
}

}  // namespace
}  // namespace scree
