// Files of FCLIB: every variant of the format is understood, and comes back as it was.
#include "scree/ccp/fclib/fclib_file.hpp"

#include <gtest/gtest.h>

#include <map>

#include "scree/ccp/fclib/testing_fclib.hpp"
#include "scree/state/detail/hdf5_handle.hpp"
#include "scree/state/hdf5_checkpoint.hpp"

namespace scree {
namespace {

using test::FclibFileTest;
using test::small_global;
using test::small_local;

using Dense = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// The numbers of a matrix by their places.
Dense dense(const FclibMatrix& matrix) {
  Dense out;
  for (const MatrixEntry& e : matrix.entries) out[{e.row, e.column}] += e.value;
  return out;
}

void expect_same(const FclibMatrix& a, const FclibMatrix& b) {
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.storage, b.storage);
  EXPECT_EQ(dense(a), dense(b));
}

TEST_F(FclibFileTest, keeps_a_local_problem_in_every_storage) {
  for (const FclibStorage storage : {FclibStorage::triplets, FclibStorage::columns, FclibStorage::rows}) {
    const FclibProblem problem = small_local(storage), back = through_file(problem);
    const auto &a = std::get<FclibLocal>(problem.form), &b = std::get<FclibLocal>(back.form);
    expect_same(a.W, b.W);
    expect_same(a.V, b.V);
    expect_same(a.R, b.R);
    EXPECT_EQ(a.q, b.q);
    EXPECT_EQ(a.s, b.s);
    EXPECT_EQ(back.mu, problem.mu);
    EXPECT_EQ(back.spacedim, 3);
    EXPECT_EQ(back.rows_per_contact(), 3u);
    EXPECT_EQ(back.info.title, "two contacts");
    EXPECT_EQ(back.info.description, "made by hand");
    EXPECT_EQ(back.info.math_info, "unique");
  }
}

TEST_F(FclibFileTest, keeps_a_global_problem_in_every_storage) {
  for (const FclibStorage storage : {FclibStorage::triplets, FclibStorage::columns, FclibStorage::rows}) {
    const FclibProblem problem = small_global(storage), back = through_file(problem);
    const auto &a = std::get<FclibGlobal>(problem.form), &b = std::get<FclibGlobal>(back.form);
    expect_same(a.M, b.M);
    expect_same(a.H, b.H);
    expect_same(a.G, b.G);
    EXPECT_EQ(a.f, b.f);
    EXPECT_EQ(a.w, b.w);
    EXPECT_EQ(a.b, b.b);
  }
}

TEST_F(FclibFileTest, keeps_the_attributes_of_the_info) {
  FclibProblem problem = small_local();
  problem.info.attributes = {{"big", std::vector<std::int64_t>{std::int64_t{1} << 40}},
                             {"numberOfInvolvedDS", std::vector<std::int64_t>{99, -1}},
                             {"program", std::string{"by hand"}},
                             {"time", std::vector<double>{0.125}}};
  const std::vector<FclibAttribute> back = through_file(problem).info.attributes;
  ASSERT_EQ(back.size(), 4u);
  for (std::size_t k = 0; k < back.size(); ++k) {
    EXPECT_EQ(back[k].name, problem.info.attributes[k].name);
    EXPECT_EQ(back[k].value, problem.info.attributes[k].value) << back[k].name;
  }
}

TEST_F(FclibFileTest, keeps_guesses_solution_and_what_is_known_of_a_matrix) {
  FclibProblem problem = small_global();
  const FclibSolution first{{1, 2, 3, 4, 5, 6}, {1, 0, 0, 2, 0, 0}, {3, 0, 0, 4, 0, 0}, {7}};
  const FclibSolution second{{}, {}, {5, 0, 0, 6, 0, 0}, {}};
  problem.guesses = {first, second};
  problem.solution = first;
  std::get<FclibGlobal>(problem.form).M.info = {"diagonal", 2.0, 512.0, 6};
  const FclibProblem back = through_file(problem);
  ASSERT_EQ(back.guesses.size(), 2u);
  EXPECT_EQ(back.guesses[0].v, first.v);
  EXPECT_EQ(back.guesses[0].u, first.u);
  EXPECT_EQ(back.guesses[0].lambda, first.lambda);
  EXPECT_EQ(back.guesses[1].r, second.r);
  EXPECT_TRUE(back.guesses[1].u.empty());
  ASSERT_TRUE(back.solution.has_value());
  EXPECT_EQ(back.solution->r, first.r);
  const auto& info = std::get<FclibGlobal>(back.form).M.info;
  ASSERT_TRUE(info.has_value());
  EXPECT_EQ(info->comment, "diagonal");
  EXPECT_EQ(info->conditioning, 2.0);
  EXPECT_EQ(info->determinant, 512.0);
  EXPECT_EQ(info->rank, 6);
}

TEST_F(FclibFileTest, knows_plane_contacts_and_rolling_friction_by_their_rows) {
  FclibProblem plane = small_local();
  plane.spacedim = 2;
  plane.mu = {0.1, 0.2, 0.3};
  EXPECT_EQ(through_file(plane).rows_per_contact(), 2u);

  FclibLocal local;
  for (std::uint32_t k = 0; k < 5; ++k) local.W.entries.push_back({k, k, 1.0});
  local.W.rows = local.W.columns = 5;
  local.q.assign(5, -1.0);
  for (const int spacedim : {3, 5}) {
    const FclibProblem rolling{.form = local, .spacedim = spacedim, .mu = {0.5}, .rolling = {0.01}};
    const FclibProblem back = through_file(rolling);
    EXPECT_EQ(back.rows_per_contact(), 5u);
    EXPECT_EQ(back.rolling, rolling.rolling);
  }
  FclibProblem plane_rolling = small_local();
  plane_rolling.rolling = {0.01, 0.02};
  EXPECT_EQ(through_file(plane_rolling).rows_per_contact(), 3u);
}

TEST_F(FclibFileTest, tells_files_by_what_they_hold) {
  write_fclib_file(file_, small_local());
  EXPECT_EQ(problem_kind(file_), ProblemKind::fclib);
  EXPECT_EQ(problem_kind(folder_), ProblemKind::no_hdf5);
  EXPECT_EQ(problem_kind(folder_ / "missing.hdf5"), ProblemKind::no_hdf5);
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) / 2);
  EXPECT_EQ(problem_kind(file_), ProblemKind::damaged);
  const auto other = folder_ / "other.h5";
  { const Handle made{H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose}; }
  EXPECT_EQ(problem_kind(other), ProblemKind::other);
  CheckpointWriter{{"", "0.1.0"}}.save_as(other);
  EXPECT_EQ(problem_kind(other), ProblemKind::scree);
}

// Written by HDF5's own calls, as FCLIB's library and others do: scalars without extent, wide integers, room left in x.
class HandMade : public FclibFileTest {
 protected:
  void SetUp() override {
    FclibFileTest::SetUp();
    image_ = std::make_unique<Handle>(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  }
  void TearDown() override {
    image_.reset();
    FclibFileTest::TearDown();
  }
  template <class Value>
  void put(const std::string& name, hid_t type, const std::vector<Value>& values) {
    const hsize_t size = values.size();
    const Handle space{size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose};
    const Handle links{H5Pcreate(H5P_LINK_CREATE), H5Pclose};
    H5Pset_create_intermediate_group(links.get(), 1);
    const Handle data{H5Dcreate2(image_->get(), name.c_str(), type, space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT),
                      H5Dclose};
    ASSERT_TRUE(data.valid());
    H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  void integers(const std::string& name, const std::vector<long long>& values) { put(name, H5T_NATIVE_LLONG, values); }
  void doubles(const std::string& name, const std::vector<double>& values) { put(name, H5T_NATIVE_DOUBLE, values); }

  /// A global problem of three freedoms and two plane contacts, H as triplets with rows `rows` and columns `columns`.
  void put_problem(const std::vector<long long>& p, const std::vector<long long>& i) {
    integers("fclib_global/spacedim", {2});
    for (const auto& [name, m, n] : {std::tuple{"M", 3, 3}, {"H", 3, 4}}) {
      const std::string group = std::string{"fclib_global/"} + name;
      integers(group + "/m", {m});
      integers(group + "/n", {n});
      integers(group + "/nzmax", {6});
    }
    integers("fclib_global/M/nz", {-1});
    integers("fclib_global/M/p", {0, 1, 2, 3});
    integers("fclib_global/M/i", {0, 1, 2});
    doubles("fclib_global/M/x", {2, 4, 8});
    integers("fclib_global/H/nz", {5});
    integers("fclib_global/H/p", p);
    integers("fclib_global/H/i", i);
    doubles("fclib_global/H/x", {1, 2, 3, 4, 5, 99});  // the last one is room that nobody used
    doubles("fclib_global/vectors/f", {0, -1, 0});
    doubles("fclib_global/vectors/w", {0, 0, 0, 0});
    put("fclib_global/vectors/mu", H5T_NATIVE_FLOAT, std::vector<float>{0.5F, 0.25F});
    image_.reset();
  }

  std::unique_ptr<Handle> image_;
};

// Columns p, rows i; (1, 2) is there twice.
const Dense kByHand{{{0, 0}, 1.0}, {{1, 1}, 2.0}, {{2, 3}, 3.0}, {{1, 2}, 9.0}};

TEST_F(HandMade, triplets_have_rows_in_i_and_columns_in_p) {
  put_problem({0, 1, 3, 2, 2}, {0, 1, 2, 1, 1});
  const FclibProblem problem = read_fclib_file(file_);
  EXPECT_EQ(dense(std::get<FclibGlobal>(problem.form).H), kByHand);
  EXPECT_EQ(dense(std::get<FclibGlobal>(problem.form).M), (Dense{{{0, 0}, 2.0}, {{1, 1}, 4.0}, {{2, 2}, 8.0}}));
  EXPECT_EQ(problem.mu, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(problem.rows_per_contact(), 2u);
}

TEST_F(HandMade, triplets_the_other_way_round_are_understood_where_only_that_fits) {
  put_problem({0, 1, 2, 1, 1}, {0, 1, 3, 2, 2});
  EXPECT_EQ(dense(std::get<FclibGlobal>(read_fclib_file(file_).form).H), kByHand);
}

}  // namespace
}  // namespace scree
