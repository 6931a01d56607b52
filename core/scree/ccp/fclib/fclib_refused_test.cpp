// What is not an FCLIB problem is refused in one sentence that names the file and the dataset; nothing crashes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "scree/ccp/fclib/fclib_ccp.hpp"
#include "scree/ccp/fclib/testing_fclib.hpp"
#include "scree/state/detail/hdf5_handle.hpp"

namespace scree {
namespace {

using test::small_global;
using test::small_local;

class FclibRefused : public test::FclibFileTest {
 protected:
  void expect_local_refused(const std::string& words,
                            const std::function<void(FclibProblem&, FclibLocal&)>& spoil) const {
    FclibProblem problem = small_local();
    spoil(problem, std::get<FclibLocal>(problem.form));
    expect_refused(problem, words);
  }
  void expect_global_refused(const std::string& words,
                             const std::function<void(FclibProblem&, FclibGlobal&)>& spoil) const {
    FclibProblem problem = small_global();
    spoil(problem, std::get<FclibGlobal>(problem.form));
    expect_refused(problem, words);
  }
  [[nodiscard]] std::string bytes() const {
    std::ifstream in{file_, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
  }
  void replace(const std::string& contents) const { std::ofstream{file_, std::ios::binary} << contents; }
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_F(FclibRefused, numbers_that_are_not_finite) {
  expect_local_refused("/fclib_local/vectors/q has nan at entry 4; finite numbers are needed",
                       [](FclibProblem&, FclibLocal& local) { local.q[4] = kNan; });
  expect_local_refused("/fclib_local/W/x has inf at entry 0; finite numbers are needed",
                       [](FclibProblem&, FclibLocal& local) { local.W.entries[0].value = kInfinity; });
  expect_local_refused("/fclib_local/vectors/mu has nan at entry 0; finite numbers are needed",
                       [](FclibProblem& problem, FclibLocal&) { problem.mu[0] = kNan; });
  expect_global_refused("/fclib_global/vectors/f has -inf at entry 2; finite numbers are needed",
                        [](FclibProblem&, FclibGlobal& global) { global.f[2] = -kInfinity; });
  expect_local_refused("/guesses/1/r has nan at entry 1; finite numbers are needed",
                       [](FclibProblem& problem, FclibLocal&) {
                         problem.guesses = {{{}, {}, {0, kNan, 0, 0, 0, 0}, {}}};
                       });
}

TEST_F(FclibRefused, negative_friction) {
  expect_local_refused("/fclib_local/vectors/mu has -0.25 at entry 1; friction is not negative",
                       [](FclibProblem& problem, FclibLocal&) { problem.mu[1] = -0.25; });
  expect_local_refused("/fclib_local_rolling/vectors/mu_r has -1 at entry 0; friction is not negative",
                       [](FclibProblem& problem, FclibLocal&) {
                         problem.rolling = {-1, 0};
                       });
}

TEST_F(FclibRefused, sizes_that_do_not_fit) {
  expect_local_refused("/fclib_local/vectors/q has 5 numbers, and W asks for 6",
                       [](FclibProblem&, FclibLocal& local) { local.q.pop_back(); });
  expect_local_refused("/fclib_local/vectors/mu has 3 numbers for 6 rows of contacts; 3 rows a contact are needed",
                       [](FclibProblem& problem, FclibLocal&) { problem.mu.push_back(0.5); });
  expect_local_refused("/fclib_local/spacedim is 4; valid are 2, 3, and 5 with rolling friction",
                       [](FclibProblem& problem, FclibLocal&) { problem.spacedim = 4; });
  expect_local_refused("/fclib_local/vectors/mu_r is missing; contacts of 5 rows need it",
                       [](FclibProblem& problem, FclibLocal&) { problem.spacedim = 5; });
  expect_local_refused("/fclib_local/W is 6 x 7; a matrix of 6 x 6 is needed",
                       [](FclibProblem&, FclibLocal& local) { local.W.columns = 7; });
  expect_local_refused("/fclib_local/R is 2 x 2; a matrix of 1 x 1 is needed",
                       [](FclibProblem&, FclibLocal& local) { local.R.rows = local.R.columns = 2; });
  expect_global_refused("/fclib_global/H is 5 x 6; a matrix of 6 x 6 is needed",
                        [](FclibProblem&, FclibGlobal& global) {
                          global.H = {5, 6, {}};
                        });
  expect_global_refused("/solution/v has 2 numbers; 6 are needed, one a degree of freedom",
                        [](FclibProblem& problem, FclibGlobal&) {
                          problem.solution = {{1, 2}, {}, {0, 0, 0, 0, 0, 0}, {}};
                        });
}

TEST_F(FclibRefused, indices_that_are_out_of_range) {
  expect_local_refused("/fclib_local/W/i has 6 at entry 2; the matrix has 6 columns, counted from 0",
                       [](FclibProblem&, FclibLocal& local) { local.W.entries[1].column = 6; });
  expect_global_refused("/fclib_global/H/i has 9 at entry 0; the matrix has 6 rows, counted from 0",
                        [](FclibProblem&, FclibGlobal& global) { global.H.entries[0].row = 9; });
}

TEST_F(FclibRefused, datasets_and_groups_that_are_missing) {
  const std::pair<const char*, FclibProblem> cases[] = {
      {"/fclib_local/W", small_local()},          {"/fclib_local/W/nz", small_local()},
      {"/fclib_local/R", small_local()},          {"/fclib_local/vectors", small_local()},
      {"/fclib_local/vectors/mu", small_local()}, {"/fclib_local/spacedim", small_local()},
      {"/fclib_global/H/x", small_global()},      {"/fclib_global/vectors/b", small_global()}};
  for (const auto& [path, problem] : cases) {
    write_fclib_file(file_, problem);
    {
      const Handle opened{H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
      ASSERT_GE(H5Ldelete(opened.get(), path, H5P_DEFAULT), 0) << path;
    }
    EXPECT_EQ(reading(), file_.string() + ": " + path + " is missing; an FCLIB problem needs it");
  }
  write_fclib_file(file_, small_local());
  {
    const Handle opened{H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
    H5Ldelete(opened.get(), "/fclib_local", H5P_DEFAULT);
  }
  EXPECT_EQ(reading(),
            file_.string() + ": holds no FCLIB problem; a group \"fclib_local\" or \"fclib_global\" is needed");
}

TEST_F(FclibRefused, a_dataset_of_another_kind) {
  write_fclib_file(file_, small_local());
  {
    const Handle opened{H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
    ASSERT_GE(H5Lmove(opened.get(), "/fclib_local/info/title", opened.get(), "/fclib_local/vectors/text", H5P_DEFAULT,
                      H5P_DEFAULT),
              0);
    H5Ldelete(opened.get(), "/fclib_local/vectors/q", H5P_DEFAULT);
    H5Lmove(opened.get(), "/fclib_local/vectors/text", opened.get(), "/fclib_local/vectors/q", H5P_DEFAULT,
            H5P_DEFAULT);
  }
  EXPECT_EQ(reading(), file_.string() + ": /fclib_local/vectors/q holds text; numbers are needed");
}

// Found by fuzzing: HDF5 asked for as much memory as the type said.
TEST_F(FclibRefused, numbers_of_a_gigabyte_each) {
  write_fclib_file(file_, small_local());
  {
    const Handle opened{H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
    H5Ldelete(opened.get(), "/fclib_local/vectors/mu", H5P_DEFAULT);
    const Handle type{H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
    H5Tset_size(type.get(), std::size_t{1} << 30);
    const hsize_t count = 2;
    const Handle space{H5Screate_simple(1, &count, nullptr), H5Sclose};
    const Handle made{H5Dcreate2(opened.get(), "/fclib_local/vectors/mu", type.get(), space.get(), H5P_DEFAULT,
                                 H5P_DEFAULT, H5P_DEFAULT),
                      H5Dclose};
    ASSERT_TRUE(made.valid());
  }
  EXPECT_EQ(reading(),
            file_.string() + ": /fclib_local/vectors/mu holds numbers of no known length; the file is damaged");
}

/// What reducing `problem` says; "" when it is taken.
std::string reducing(FclibProblem problem) {
  try {
    const FclibCcp reduced{std::move(problem), "stack.hdf5"};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    return error.what();
  }
  return {};
}

std::string reducing_local(const std::function<void(FclibLocal&)>& spoil) {
  FclibProblem problem = small_local();
  spoil(std::get<FclibLocal>(problem.form));
  return reducing(std::move(problem));
}

std::string reducing_global(const std::function<void(FclibGlobal&)>& spoil) {
  FclibProblem problem = small_global();
  spoil(std::get<FclibGlobal>(problem.form));
  return reducing(std::move(problem));
}

TEST_F(FclibRefused, a_mass_matrix_that_is_not_positive_definite) {
  const auto with_mass = [](double mass) {
    return reducing_global([&](FclibGlobal& global) { global.M.entries[1].value = mass; });
  };
  const auto said = [](const std::string& pivot) {
    return "stack.hdf5: /fclib_global/M is not positive definite: elimination leaves " + pivot +
           " on the diagonal of row 1, counted from 0; a mass matrix leaves positive numbers, so mend the masses and "
           "inertias of that degree of freedom, or take it out";
  };
  EXPECT_EQ(with_mass(2.0), "");
  EXPECT_EQ(with_mass(0.0), said("0"));
  EXPECT_EQ(with_mass(-1.0), said("-1"));
  // A gyroscopic term of 0.1 kg beside a mass that is negative: LU would take it.
  EXPECT_EQ(reducing_global([](FclibGlobal& global) {
              global.M.entries[1].value = -1.0;
              global.M.entries.push_back({0, 1, 0.1});
              global.M.entries.push_back({1, 0, -0.1});
            }),
            said("-1"));
}

TEST_F(FclibRefused, a_matrix_that_is_not_symmetric) {
  const auto said = [](const std::string& name, const std::string& share) {
    return "stack.hdf5: /" + name + " is not symmetric: numbers that should be the same differ by " + share +
           " of the largest; a contact problem has a symmetric one";
  };
  // Where the mirror image has +0.5.
  EXPECT_EQ(reducing_local([](FclibLocal& local) { local.W.entries[6].value = -0.5; }), said("fclib_local/W", "0.5"));
  // The mirror image has nothing; the largest number is 4 kg.
  EXPECT_EQ(reducing_global([](FclibGlobal& global) {
              global.M.entries.push_back({0, 1, 1.0});
            }),
            said("fclib_global/M", "0.25"));
}

// Normal rows 2 and 1 with x between them: the eigenvalues (3 +- sqrt(1 + 4 x^2)) / 2 of them pass zero at x = sqrt 2, which
// is singular and valid.
TEST_F(FclibRefused, a_local_matrix_with_an_eigenvalue_below_zero) {
  const auto coupled = [](double x) {
    return reducing_local([&](FclibLocal& local) {
      local.W.entries[6].value = local.W.entries[7].value = x;
      local.V = {6, 0, {}}, local.R = {0, 0, {}}, local.s.clear();
    });
  };
  EXPECT_EQ(coupled(1.4), "");
  EXPECT_EQ(coupled(std::sqrt(2.0)), "");
  EXPECT_EQ(
      coupled(2.0),
      "stack.hdf5: /fclib_local/W is not positive semidefinite: an eigenvalue of the symmetric part is -0.562 or less, "
      "and the largest number of the diagonal 2; what masses make has none below zero, so look for rows with a wrong "
      "sign or of another problem");
}

// W alone is fine; with V = (0.5, ..., -0.25) and R = 0 the constraint has no row of its own to stand on.
TEST_F(FclibRefused, bilateral_constraints_that_no_masses_make) {
  const std::string said = reducing_local([](FclibLocal& local) { local.R.entries.clear(); });
  EXPECT_TRUE(
      said.starts_with("stack.hdf5: /fclib_local/W, V and R make a matrix [W V; V^T R] that is not positive "
                       "semidefinite: an eigenvalue of the symmetric part is -"))
      << said;
}

TEST_F(FclibRefused, files_that_are_cut_short_or_no_hdf5_files) {
  write_fclib_file(file_, small_local());
  const std::string whole = bytes();
  const std::string said =
      file_.string() + ": is not an HDF5 file, or is damaged or cut short; an FCLIB problem is needed";
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, whole.size() / 2, whole.size() - 1}) {
    replace(whole.substr(0, size));
    EXPECT_EQ(reading(), said) << size << " of " << whole.size() << " bytes";
  }
  replace("W = 1, q = 2\n");
  EXPECT_EQ(reading(), said);
}

// A damaged file is read, or refused with an Error: whatever else happens, happens to this test.
TEST_F(FclibRefused, damage_at_random_never_crashes) {
  const std::string from_environment = std::getenv("SCREE_FUZZ") != nullptr ? std::getenv("SCREE_FUZZ") : "";
  const int cases = from_environment.empty() ? 300 : std::stoi(from_environment);
  int taken = 0, refused = 0;
  for (const FclibProblem& problem : {small_local(), small_global()}) {
    write_fclib_file(file_, problem);
    const std::string whole = bytes();
    for (int k = 0; k < cases; ++k) {
      std::mt19937_64 random{static_cast<std::uint64_t>(k)};
      std::string damaged = whole;
      if (random() % 8 == 0) damaged.resize(random() % whole.size());
      for (std::size_t flips = 1 + random() % 4; flips > 0 && !damaged.empty(); --flips) {
        char& byte = damaged[random() % damaged.size()];
        byte = static_cast<char>(random() % 2 == 0 ? byte ^ (1 << (random() % 8)) : random() % 256);
      }
      replace(damaged);
      try {
        const FclibCcp reduced{read_fclib_file(file_), file_.string()};
        ++taken;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(taken, cases / 8) << "most damage hits nothing that is read";
  EXPECT_GT(refused, cases / 8);
}

}  // namespace
}  // namespace scree
