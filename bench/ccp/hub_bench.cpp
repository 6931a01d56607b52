// A body that thousands of grains touch: a drum of 200 kg on a motor, against a pile on a floor that does not move.
//
//     hub_bench [SOLVER ...]      without names: all solvers
//     SCREE_SIDE=N SCREE_LAYERS=N SCREE_DRUM=N    grains along an edge of the layers (71), layers (4), mass of the drum [kg] (200)
//
// N x N grains of 1 g lie on the drum, in layers, and touch their neighbours. The drum has a revolute joint (5 free rows) and a
// motor (1 box row) to the world; in the other pile it has them too, but the grains lie on an immovable body. `last`: the
// drum is numbered after the grains, so that contacts are in the order of the grains; `middle`: among them, so that half of its
// contacts follow each other. Figures are the least of interleaved repeats, by processor time on one thread, by wall time on two.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "methods.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::bench {
namespace {

constexpr int kRepeats = 7;
constexpr double kGrain = 1e-3;   // [kg]
constexpr double kRadius = 5e-3;  // of a grain [m]

enum class Place { immovable, last, middle };

/// The pile, with the drum where it is asked for.
class Pile {
 public:
  Pile(std::size_t side, std::size_t layers, double drum_mass, Place place) : side_{side}, layers_{layers} {
    const std::size_t grains = side * side * layers;
    const auto drum = static_cast<std::uint32_t>(place == Place::middle ? grains / 2 : grains);
    const auto world = static_cast<std::uint32_t>(grains + 1);
    const double j = 0.4 * kGrain * kRadius * kRadius;
    inverse_mass_.assign(grains + 2, 1.0 / kGrain);
    inverse_inertia_.assign(grains + 2, Mat3::diagonal({1.0 / j, 1.0 / j, 1.0 / j}));
    inverse_mass_[drum] = 1.0 / drum_mass;
    inverse_inertia_[drum] = Mat3::diagonal({10.0 / drum_mass, 10.0 / drum_mass, 10.0 / drum_mass});
    inverse_mass_[world] = 0.0;
    inverse_inertia_[world] = {};
    for (std::size_t at = 0; at < grains; ++at) number_.push_back(static_cast<std::uint32_t>(at < drum ? at : at + 1));
    add_contacts(place == Place::immovable ? world : drum);
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const CcpContact& x, const CcpContact& y) { return std::min(x.a, x.b) < std::min(y.a, y.b); });
    for (const CcpContact& c : contacts_) r_.insert(r_.end(), {c.normal.z > 0.5 ? -1e-2 : 0.0, 1e-3, 0.0});
    add_joint(world, drum);
  }

  [[nodiscard]] CcpProblem problem() const {
    return {inverse_mass_, inverse_inertia_, contacts_, r_, {}, blocks_, block_rows_, {}};
  }

 private:
  // Grains in tiles of four by four columns: as close in memory as a curve through space brings them.
  [[nodiscard]] std::uint32_t grain(std::size_t x, std::size_t y, std::size_t z) const {
    constexpr std::size_t kTile = 4;
    const std::size_t left = x / kTile * kTile, low = y / kTile * kTile;
    const std::size_t wide = std::min(kTile, side_ - left), deep = std::min(kTile, side_ - low);
    const std::size_t before = low * side_ + left * deep;
    return number_[(before + (y - low) * wide + (x - left)) * layers_ + z];
  }
  void add(std::uint32_t a, std::uint32_t b, const Vec3& normal) {
    contacts_.push_back({normal, kRadius * normal, -kRadius * normal, 0.5, a, b});
  }
  void add_contacts(std::uint32_t floor) {
    for (std::size_t x = 0; x < side_; ++x) {
      for (std::size_t y = 0; y < side_; ++y) {
        const auto along = [&](std::size_t k) {
          return kRadius * (2.0 * static_cast<double>(k) - static_cast<double>(side_));
        };
        contacts_.push_back({{0, 0, 1}, {along(x), along(y), -0.3}, {0, 0, -kRadius}, 0.5, floor, grain(x, y, 0)});
        for (std::size_t z = 0; z < layers_; ++z) {
          if (z + 1 < layers_) add(grain(x, y, z), grain(x, y, z + 1), {0, 0, 1});
          if (x + 1 < side_) add(grain(x, y, z), grain(x + 1, y, z), {1, 0, 0});
          if (y + 1 < side_) add(grain(x, y, z), grain(x, y + 1, z), {0, 1, 0});
        }
      }
    }
  }
  void add_joint(std::uint32_t world, std::uint32_t drum) {
    constexpr double kLength = 0.3;  // [m]
    blocks_ = {{.kind = CcpKind::free, .rows = 5, .first_row = 0, .a = world, .b = drum},
               {.kind = CcpKind::box, .rows = 1, .first_row = 5, .a = world, .b = drum, .lower = -1.0, .upper = 1.0}};
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      block_rows_.push_back({{-axis, {}}, {axis, {}}});
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {
      block_rows_.push_back({{{}, -kLength * axis}, {{}, kLength * axis}});
    }
    r_.insert(r_.end(), {0.0, 0.0, -1e-2, 0.0, 0.0, -0.1});
  }

  std::size_t side_, layers_;
  std::vector<std::uint32_t> number_;
  std::vector<double> inverse_mass_;
  std::vector<Mat3> inverse_inertia_;
  std::vector<CcpContact> contacts_;
  std::vector<double> r_;
  std::vector<CcpBlock> blocks_;
  std::vector<CcpRow> block_rows_;
};

struct Variant {
  const char* name;
  const char* plugin;
  const char* toml;
  int few, many;  ///< iterations
};

constexpr Variant kVariants[] = {{"pgs", "pgs", "", 10, 40},
                                 {"pgs coloured", "pgs", "order = \"coloured\"", 10, 40},
                                 {"asgs", "asgs", "", 10, 40},
                                 {"asgs coloured", "asgs", "order = \"coloured\"", 10, 40},
                                 {"jacobi", "jacobi", "", 10, 40},
                                 {"apgd", "apgd", "", 10, 40},
                                 {"spg", "spg", "", 10, 40},
                                 {"admm", "admm", "", 4, 10},
                                 {"interior_point", "interior_point", "", 1, 3},
                                 {"semismooth_newton", "semismooth_newton", "", 1, 3}};

double seconds(bool processor) {
  if (!processor) return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What solves of few and of many iterations took at least: their difference is free of what comes before and after.
struct Iterations {
  std::array<double, 2> seconds{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::array<int, 2> made{};
  double residual = 0.0;  ///< after the many [m/s]

  [[nodiscard]] double each() const { return (seconds[1] - seconds[0]) / (made[1] - made[0]); }
};

void repeat(const Variant& variant, CcpSolver& solver, const CcpProblem& problem, const Executor& executor,
            Iterations& out) {
  const bool processor = executor.threads() == 1;
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> gamma(problem.rows());
    SolveContext context;
    context.tolerance = 0.0;
    context.max_iterations = k == 0 ? variant.few : variant.many;
    context.executor = &executor;
    const double start = seconds(processor);
    const SolveSummary summary = solver.solve(problem, context, gamma);
    out.seconds[k] = std::min(out.seconds[k], seconds(processor) - start);
    out.made[k] = summary.iterations;
    out.residual = summary.residual;
  }
}

std::size_t number_from(const char* variable, std::size_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

void print(const Variant& variant, const std::array<Pile, 3>& piles, int threads) {
  const Executor executor{threads};
  const std::unique_ptr<CcpSolver> solver = make_solver(variant.plugin, variant.toml);
  std::array<Iterations, 3> done;
  std::array<double, 3> each{};
  for (int k = 0; k < kRepeats; ++k) {
    for (std::size_t p = 0; p < piles.size(); ++p) repeat(variant, *solver, piles[p].problem(), executor, done[p]);
  }
  for (std::size_t p = 0; p < piles.size(); ++p) {
    each[p] = 1e9 * done[p].each() / static_cast<double>(piles[p].problem().contacts.size());
  }
  fmt::print("{:<20}{:>8}{:>11.1f}{:>11.1f}{:>7.2f}{:>11.1f}{:>7.2f}", variant.name, threads, each[0], each[1],
             each[1] / each[0], each[2], each[2] / each[0]);
  fmt::print("{:>12.1e}{:>10.1e}{:>10.1e}\n", done[0].residual, done[1].residual, done[2].residual);
  std::fflush(stdout);
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  using namespace scree::bench;
  const std::size_t side = number_from("SCREE_SIDE", 71), layers = number_from("SCREE_LAYERS", 4);
  const auto mass = static_cast<double>(number_from("SCREE_DRUM", 200));
  const std::array piles{Pile{side, layers, mass, Place::immovable}, Pile{side, layers, mass, Place::last},
                         Pile{side, layers, mass, Place::middle}};
  fmt::print("{} contacts, {} of them on the drum; ns per contact and iteration; residual after the last [m/s]\n\n",
             piles[0].problem().contacts.size(), side * side);
  fmt::print("{:<20}{:>8}{:>11}{:>11}{:>7}{:>11}{:>7}{:>12}{:>10}{:>10}\n", "", "threads", "immovable", "drum last",
             "ratio", "middle", "ratio", "immovable", "last", "middle");
  for (const Variant& variant : kVariants) {
    bool asked = argc == 1;
    for (int k = 1; k < argc; ++k) asked = asked || std::string{argv[k]} == variant.plugin;
    for (int threads = 1; threads <= 2 && asked; ++threads) print(variant, piles, threads);
  }
  return 0;
}
