// fclib_samples FOLDER writes problems of FCLIB, good and bad; fclib_samples print FILE shows the solution in one as JSON.
#include <hdf5.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "scree/ccp/fclib/testing_fclib.hpp"

namespace {

namespace fs = std::filesystem;
using namespace scree;

/// A mass of 2 kg that slides at 3 m/s along a wall and meets it at 1 m/s, mu 0.5, in one contact; a local problem.
FclibProblem sliding() {
  FclibLocal local;
  local.W = {3, 3, {{0, 0, 0.5}, {1, 1, 0.5}, {2, 2, 0.5}}, FclibStorage::columns};
  local.q = {-1.0, 3.0, 0.0};
  return {.form = std::move(local), .mu = {0.5}, .info = {"sliding mass", "", ""}};
}

void write_bad(const fs::path& folder) {
  FclibProblem problem = sliding();
  std::get<FclibLocal>(problem.form).q[1] = std::numeric_limits<double>::quiet_NaN();
  write_fclib_file(folder / "nan.hdf5", problem);
  problem = sliding();
  problem.mu[0] = -0.5;
  write_fclib_file(folder / "negative_mu.hdf5", problem);
  problem = sliding();
  std::get<FclibLocal>(problem.form).W.entries[0].row = 3;
  write_fclib_file(folder / "index.hdf5", problem);
  problem = sliding();
  problem.mu.push_back(0.5);
  write_fclib_file(folder / "sizes.hdf5", problem);
  problem = sliding();
  std::get<FclibLocal>(problem.form).W.entries[2].value = -0.25;
  write_fclib_file(folder / "pulls.hdf5", problem);
  problem = test::small_global();
  std::get<FclibGlobal>(problem.form).M.entries[3].value = 0.0;
  write_fclib_file(folder / "no_mass.hdf5", problem);
  write_fclib_file(folder / "missing.hdf5", sliding());
  const hid_t opened = H5Fopen((folder / "missing.hdf5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(opened, "/fclib_local/vectors/q", H5P_DEFAULT);
  H5Fclose(opened);
  fs::copy_file(folder / "sliding.hdf5", folder / "cut.hdf5");
  fs::resize_file(folder / "cut.hdf5", fs::file_size(folder / "cut.hdf5") / 2);
  std::ofstream{folder / "text.hdf5"} << "W = 1\n";
  H5Fclose(H5Fcreate((folder / "other.hdf5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
}

void print(const char* file) {
  const FclibSolution s = read_fclib_file(file).solution.value();
  std::puts(nlohmann::json{{"v", s.v}, {"u", s.u}, {"r", s.r}, {"l", s.lambda}}.dump().c_str());
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3) {
    print(arguments[2]);
    return 0;
  }
  const fs::path folder = arguments[1];
  write_fclib_file(folder / "sliding.hdf5", sliding());
  write_fclib_file(folder / "stack.hdf5", test::small_global());
  write_fclib_file(folder / "coupled.hdf5", test::small_local());
  write_bad(folder);
  return 0;
}
