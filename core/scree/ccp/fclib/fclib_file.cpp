#include "scree/ccp/fclib/fclib_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/detail/fclib_matrix_io.hpp"
#include "scree/results/output_file.hpp"

namespace scree {

namespace {

/// Names that a problem's group may have.
constexpr std::array kGroups{"fclib_local",          "fclib_global",        "fclib_local_rolling",
                             "fclib_global_rolling", "fclib_rolling_local", "fclib_rolling_global"};

Handle open_hdf5(const std::filesystem::path& file) {
  silence_hdf5();
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

Handle top_of(const Handle& file) { return {H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose}; }

/// Length of a vector that a matrix asks for.
struct Wanted {
  const char* matrix;
  std::size_t size;
};

std::vector<double> vector_for(const FclibGroupReader& vectors, const char* name, const Wanted& wanted) {
  std::vector<double> values = vectors.doubles(name);
  vectors.place().inside(name).require(
      values.size() == wanted.size,
      fmt::format("has {} numbers, and {} asks for {}", values.size(), wanted.matrix, wanted.size));
  return values;
}

void require_size(const FclibGroupReader& in, const char* name, const FclibMatrix& matrix, std::size_t rows,
                  std::size_t columns) {
  in.place().inside(name).require(
      matrix.rows == rows && matrix.columns == columns,
      fmt::format("is {} x {}; a matrix of {} x {} is needed", matrix.rows, matrix.columns, rows, columns));
}

FclibLocal read_local(const FclibGroupReader& in) {
  FclibLocal local;
  local.W = read_fclib_matrix(in.group("W"));
  require_size(in, "W", local.W, local.W.rows, local.W.rows);
  const FclibGroupReader vectors = in.group("vectors");
  local.q = vector_for(vectors, "q", {"W", local.W.rows});
  if (in.has("V") || in.has("R")) {
    local.V = read_fclib_matrix(in.group("V"));
    local.R = read_fclib_matrix(in.group("R"));
    require_size(in, "V", local.V, local.W.rows, local.V.columns);
    require_size(in, "R", local.R, local.V.columns, local.V.columns);
    local.s = vector_for(vectors, "s", {"R", local.R.rows});
  }
  return local;
}

FclibGlobal read_global(const FclibGroupReader& in) {
  FclibGlobal global;
  global.M = read_fclib_matrix(in.group("M"));
  require_size(in, "M", global.M, global.M.rows, global.M.rows);
  global.H = read_fclib_matrix(in.group("H"));
  require_size(in, "H", global.H, global.M.rows, global.H.columns);
  const FclibGroupReader vectors = in.group("vectors");
  global.f = vector_for(vectors, "f", {"M", global.M.rows});
  global.w = vector_for(vectors, "w", {"H", global.H.columns});
  if (in.has("G")) {
    global.G = read_fclib_matrix(in.group("G"));
    require_size(in, "G", global.G, global.M.rows, global.G.columns);
    global.b = vector_for(vectors, "b", {"G", global.G.columns});
  }
  return global;
}

std::vector<double> read_friction(const FclibGroupReader& vectors, const char* name) {
  std::vector<double> values = vectors.doubles(name);
  const auto bad = std::find_if(values.begin(), values.end(), [](double mu) { return mu < 0.0; });
  if (bad != values.end()) {
    vectors.place().inside(name).fail(
        fmt::format("has {:g} at entry {}; friction is not negative", *bad, bad - values.begin()));
  }
  return values;
}

/// mu and the number of rows of a contact.
void read_contacts(const FclibGroupReader& in, FclibProblem& problem) {
  const FclibGroupReader vectors = in.group("vectors");
  problem.spacedim = static_cast<int>(std::min<std::int64_t>(in.integer("spacedim", 1), 100));
  in.place()
      .inside("spacedim")
      .require(problem.spacedim == 2 || problem.spacedim == 3 || problem.spacedim == 5,
               fmt::format("is {}; valid are 2, 3, and 5 with rolling friction", problem.spacedim));
  problem.mu = read_friction(vectors, "mu");
  if (vectors.has("mu_r")) {
    problem.rolling = read_friction(vectors, "mu_r");
    vectors.place().inside("mu_r").require(
        problem.rolling.size() == problem.mu.size(),
        fmt::format("has {} numbers, and mu has {}", problem.rolling.size(), problem.mu.size()));
  } else {
    vectors.place().inside("mu_r").require(problem.spacedim != 5, "is missing; contacts of 5 rows need it");
  }
  const std::size_t rows = problem.contact_rows(), contacts = problem.mu.size();
  const bool rolling = !problem.rolling.empty();
  const auto fits = [&](std::size_t each) { return rows == each * contacts; };
  const bool good =
      rolling ? fits(5) || (fits(3) && problem.spacedim == 3) : fits(static_cast<std::size_t>(problem.spacedim));
  vectors.place().inside("mu").require(
      good, fmt::format("has {} numbers for {} rows of contacts; {} rows a contact are needed", contacts, rows,
                        rolling ? "5" : std::to_string(problem.spacedim)));
}

FclibSolution read_solution(const FclibGroupReader& in, const FclibProblem& problem) {
  const auto vector = [&](const char* name, std::size_t size, const char* what) {
    return in.has(name) ? in.doubles(name, size, what) : std::vector<double>{};
  };
  FclibSolution solution;
  solution.r = in.doubles("r", problem.contact_rows(), "row of a contact");
  solution.u = vector("u", problem.contact_rows(), "row of a contact");
  solution.v = problem.global() ? vector("v", problem.freedoms(), "degree of freedom") : std::vector<double>{};
  solution.lambda = problem.bilateral_rows() > 0 ? vector("l", problem.bilateral_rows(), "bilateral constraint")
                                                 : std::vector<double>{};
  return solution;
}

void read_answers(const FclibGroupReader& top, FclibProblem& problem) {
  if (top.has("guesses")) {
    const FclibGroupReader guesses = top.group("guesses");
    const std::int64_t count = guesses.integer("number_of_guesses", 0);
    for (std::int64_t k = 1; k <= count; ++k) {
      problem.guesses.push_back(read_solution(guesses.group(std::to_string(k)), problem));
    }
  }
  if (top.has("solution")) problem.solution = read_solution(top.group("solution"), problem);
}

void write_solution(const FclibGroupWriter& out, const FclibSolution& solution) {
  if (!solution.v.empty()) out.write("v", solution.v);
  if (!solution.lambda.empty()) out.write("l", solution.lambda);
  if (!solution.u.empty()) out.write("u", solution.u);
  out.write("r", solution.r);
}

void write_form(const FclibGroupWriter& out, const FclibGroupWriter& vectors, const FclibLocal& local) {
  write_fclib_matrix(out.group("W"), local.W);
  vectors.write("q", local.q);
  if (local.V.columns == 0) return;
  write_fclib_matrix(out.group("V"), local.V);
  write_fclib_matrix(out.group("R"), local.R);
  vectors.write("s", local.s);
}

void write_form(const FclibGroupWriter& out, const FclibGroupWriter& vectors, const FclibGlobal& global) {
  write_fclib_matrix(out.group("M"), global.M);
  write_fclib_matrix(out.group("H"), global.H);
  vectors.write("f", global.f);
  vectors.write("w", global.w);
  if (global.G.columns == 0) return;
  write_fclib_matrix(out.group("G"), global.G);
  vectors.write("b", global.b);
}

void write_all(const FclibGroupWriter& top, const FclibProblem& problem) {
  const std::string rolling = problem.rolling.empty() ? "" : "_rolling";
  const FclibGroupWriter out = top.group((problem.global() ? "fclib_global" : "fclib_local") + rolling);
  const FclibGroupWriter vectors = out.group("vectors");
  out.write("spacedim", problem.spacedim);
  vectors.write("mu", problem.mu);
  if (!problem.rolling.empty()) vectors.write("mu_r", problem.rolling);
  std::visit([&](const auto& form) { write_form(out, vectors, form); }, problem.form);
  const FclibGroupWriter info = out.group("info");
  info.write("title", problem.info.title);
  info.write("description", problem.info.description);
  info.write("math_info", problem.info.math_info);
  for (const FclibAttribute& attribute : problem.info.attributes) info.write(attribute);
  if (!problem.guesses.empty()) {
    const FclibGroupWriter guesses = top.group("guesses");
    guesses.write("number_of_guesses", static_cast<int>(problem.guesses.size()));
    for (std::size_t k = 0; k < problem.guesses.size(); ++k) {
      write_solution(guesses.group(std::to_string(k + 1)), problem.guesses[k]);
    }
  }
  if (problem.solution) write_solution(top.group("solution"), *problem.solution);
}

}  // namespace

ProblemKind problem_kind(const std::filesystem::path& file) {
  silence_hdf5();
  if (!std::filesystem::is_regular_file(file) || H5Fis_hdf5(file.c_str()) <= 0) return ProblemKind::no_hdf5;
  const Handle opened = open_hdf5(file);
  if (!opened.valid()) return ProblemKind::damaged;
  const auto has = [&](const char* name) { return H5Lexists(opened.get(), name, H5P_DEFAULT) > 0; };
  if (std::any_of(kGroups.begin(), kGroups.end(), has)) return ProblemKind::fclib;
  return H5Aexists(opened.get(), "scree_version") > 0 ? ProblemKind::scree : ProblemKind::other;
}

FclibProblem read_fclib_file(const std::filesystem::path& file) {
  const FclibPlace at{file.string(), ""};
  const Handle opened = open_hdf5(file);
  at.require(opened.valid(), "is not an HDF5 file, or is damaged or cut short; an FCLIB problem is needed");
  const FclibGroupReader top{top_of(opened), at};
  const auto* const name =
      std::find_if(kGroups.begin(), kGroups.end(), [&](const char* group) { return top.has(group); });
  at.require(name != kGroups.end(), "holds no FCLIB problem; a group \"fclib_local\" or \"fclib_global\" is needed");
  const FclibGroupReader in = top.group(*name);
  FclibProblem problem;
  if (std::string_view{*name}.find("global") != std::string_view::npos) {
    problem.form = read_global(in);
  } else {
    problem.form = read_local(in);
  }
  read_contacts(in, problem);
  if (in.has("info")) {
    const FclibGroupReader info = in.group("info");
    problem.info = {info.text("title"), info.text("description"), info.text("math_info"), info.attributes()};
  }
  read_answers(top, problem);
  return problem;
}

void write_fclib_file(const std::filesystem::path& file, const FclibProblem& problem) {
  silence_hdf5();
  const FclibPlace at{file.string(), ""};
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  constexpr std::size_t kIncrement = 1 << 20;  // [byte]
  H5Pset_fapl_core(access.get(), kIncrement, false);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  const Handle image{H5Fcreate("fclib", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
  at.require(image.valid(), "cannot be composed in memory");
  write_all({top_of(image), at}, problem);
  at.require(H5Fflush(image.get(), H5F_SCOPE_LOCAL) >= 0, "cannot be composed in memory");
  const ssize_t size = H5Fget_file_image(image.get(), nullptr, 0);
  at.require(size > 0, "cannot be composed in memory");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  at.require(H5Fget_file_image(image.get(), bytes.data(), bytes.size()) == size, "cannot be composed in memory");
  replace_file(file, bytes);
}

}  // namespace scree
