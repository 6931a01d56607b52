// Small problems of every form that FCLIB knows, and a folder for their files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/fclib_file.hpp"

namespace scree::test {

/// Two contacts of three rows, coupled, and a bilateral constraint.
inline FclibProblem small_local(FclibStorage storage = FclibStorage::rows) {
  FclibLocal local;
  local.W = {
      6, 6, {{0, 0, 2}, {1, 1, 2}, {2, 2, 2}, {3, 3, 1}, {4, 4, 1}, {5, 5, 1}, {0, 3, 0.5}, {3, 0, 0.5}}, storage};
  local.q = {-1.0, 0.25, 0.0, -0.5, 0.0, 0.125};
  local.V = {6, 1, {{0, 0, 0.5}, {4, 0, -0.25}}, storage};
  local.R = {1, 1, {{0, 0, 1.0}}, storage};
  local.s = {0.0625};
  FclibProblem problem{.form = std::move(local), .mu = {0.5, 0.25}};
  problem.info = {"two contacts", "made by hand", "unique"};
  return problem;
}

/// Two masses of 2 and 4 kg; the first rests on the floor, the second on the first; the second is held sideways.
inline FclibProblem small_global(FclibStorage storage = FclibStorage::triplets) {
  FclibGlobal global;
  global.M = {6, 6, {{0, 0, 2}, {1, 1, 2}, {2, 2, 2}, {3, 3, 4}, {4, 4, 4}, {5, 5, 4}}, storage};
  // Contact 0 of body 0 with the floor; contact 1 between the bodies; normal z, tangents x and y.
  global.H = {6,
              6,
              {{2, 0, 1}, {0, 1, 1}, {1, 2, 1}, {2, 3, -1}, {5, 3, 1}, {0, 4, -1}, {3, 4, 1}, {1, 5, -1}, {4, 5, 1}},
              storage};
  global.f = {0.5, 0, -2, 0, 0, -4};
  global.w = {0, 0, 0, 0, 0, 0};
  global.G = {6, 1, {{3, 0, 1}}, storage};
  global.b = {0};
  return {.form = std::move(global), .mu = {0.5, 0.5}};
}

/// A folder of its own for every test.
class FclibFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("scree_fclib_" + std::string{info->name()} + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "problem.hdf5";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] FclibProblem through_file(const FclibProblem& problem) const {
    write_fclib_file(file_, problem);
    return read_fclib_file(file_);
  }
  /// What reading the file says; "" when it is taken.
  [[nodiscard]] std::string reading() const {
    try {
      (void)read_fclib_file(file_);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::io);
      return error.what();
    }
    return {};
  }
  /// The file of `problem` has to be refused with the sentence `words`, which names the file first.
  void expect_refused(const FclibProblem& problem, const std::string& words) const {
    write_fclib_file(file_, problem);
    EXPECT_EQ(reading(), file_.string() + ": " + words);
  }

  std::filesystem::path folder_, file_;
};

}  // namespace scree::test
