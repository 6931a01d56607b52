// scree's collision beside Bullet's world and FCL's manager, each called as its users call it, taking turns in one run.
//
//     peers_bench [--spheres BED] [--hulls BED] [--frames N] [--part spheres|hulls|growth|threads] [--csv FILE]
//
// Every frame all bodies sit within 1 % of their radius of their place in the bed; nothing else is in the world. Without a
// bed file (see bed.hpp) a bed of 64 000 (hulls: 8000) is made. Hulls have 16 points on the sphere of the bed's grain, grown so
// that a hull touches 0.4 others or so. `growth` is scree alone from 64k to 1M spheres, `threads` scree with one and two, beside a
// copy of memory with one and two. Times are processor time of the calling thread, but for threads.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <numbers>
#include <random>
#include <thread>

#include "bed.hpp"
#include "plugins.hpp"
#include "scree/base/release.hpp"
#include "world.hpp"

namespace scree::bench {
namespace {

struct Settings {
  std::string spheres, hulls, part, csv;
  int frames = 9;
};

struct Runner {
  std::string name;
  Contender* contender;               // never destroyed: Bullet's world takes a minute to, pair by pair
  std::vector<double> cpu{}, wall{};  // [s] a frame
  std::size_t contacts = 0;
};

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double wall_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

World spheres_of(const Bed& bed) {
  World world;
  const BodyView view = bed.bodies.view();
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (view.motion[i] != Motion::dynamic) continue;
    world.position.push_back(view.position[i]);
    world.orientation.emplace_back();
    world.radius.push_back(view.radius[i]);
    world.mean_radius += view.radius[i];
  }
  world.mean_radius /= static_cast<double>(world.size());
  return world;
}

World load(const std::string& file, std::size_t count) {
  Bed bed;
  if (file.empty()) {
    make_bed(count, bed);
  } else {
    read_bed(file, bed);
  }
  return spheres_of(bed);
}

/// Points at random on spheres 1.12 times the grains, turned at random.
World hulls_in(World world) {
  std::mt19937_64 random{2};
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < world.size(); ++i) {
    world.radius[i] *= 1.12;
    std::vector<Vec3> points(16);
    for (Vec3& p : points) p = world.radius[i] * normalized(Vec3{normal(random), normal(random), normal(random)});
    world.hull.push_back(std::move(points));
    world.orientation[i] = normalized(Quat{normal(random), normal(random), normal(random), normal(random)});
  }
  return world;
}

std::vector<Vec3> shaken(const World& world, std::mt19937_64& random) {
  std::uniform_real_distribution<double> shake{-1.0, 1.0};
  std::vector<Vec3> out = world.position;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] += 0.01 * world.radius[i] * Vec3{shake(random), shake(random), shake(random)};
  }
  return out;
}

/// Frames in turns; the first two of each are not counted.
void run(const World& world, std::vector<Runner>& runners, int frames) {
  std::mt19937_64 random{3};
  for (int f = 0; f < frames + 2; ++f) {
    const std::vector<Vec3> position = shaken(world, random);
    for (Runner& runner : runners) {
      const double cpu = cpu_now(), wall = wall_now();
      runner.contacts = runner.contender->frame(position);
      if (f < 2) continue;
      runner.cpu.push_back(1e3 * (cpu_now() - cpu));
      runner.wall.push_back(1e3 * (wall_now() - wall));
    }
  }
}

/// Pairs of `one` that are deeper than `least` [m] and that `other` does not have.
std::size_t lacking(const std::vector<Touch>& one, const std::vector<Touch>& other, double least) {
  return static_cast<std::size_t>(std::ranges::count_if(one, [&](const Touch& touch) {
    const auto pair = [](const Touch& t) { return std::pair{t.a, t.b}; };
    return -touch.gap > least && !std::ranges::binary_search(other, pair(touch), {}, pair);
  }));
}

/// The table of a run, the first runner against each other one.
void print(const char* what, const World& world, const std::vector<Runner>& runners, std::FILE* csv) {
  fmt::print("\n{}: {} bodies\n", what, world.size());
  fmt::print("{:<28} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9} {:>9}\n", "", "CPU median", "CPU best", "wall best",
             "contacts", "touching", "misses", "extra");
  const std::vector<Touch> ours = runners[0].contender->touches();
  for (const Runner& runner : runners) {
    const std::vector<Touch> theirs = runner.contender->touches();
    const double least = 1e-3 * world.mean_radius;
    const std::size_t misses = lacking(ours, theirs, least), extra = lacking(theirs, ours, least);
    fmt::print("{:<28} {:>7.2f} ms {:>7.2f} ms {:>7.2f} ms {:>10} {:>10} {:>9} {:>9}\n", runner.name,
               median(runner.cpu), std::ranges::min(runner.cpu), std::ranges::min(runner.wall), runner.contacts,
               theirs.size(), misses, extra);
    if (csv != nullptr) {
      fmt::print(csv, "{},{},{},{},{},{},{},{},{},{}\n", what, runner.name, world.size(), median(runner.cpu),
                 std::ranges::min(runner.cpu), std::ranges::min(runner.wall), runner.contacts, theirs.size(), misses,
                 extra);
    }
  }
  for (std::size_t k = 1; k < runners.size(); ++k) {
    fmt::print("  {} takes {:.1f} times as long as {} (median of CPU)\n", runners[k].name,
               median(runners[k].cpu) / median(runners[0].cpu), runners[0].name);
  }
}

std::vector<std::string> chain() {
  std::vector<std::string> names;
  for (const char* name : {"sphere_cluster", "polyhedron", "bullet", "fcl"}) {
    if (is_built("narrow_phase", name)) names.emplace_back(name);
  }
  return names;
}

void peers(const char* what, const World& world, int frames, std::FILE* csv) {
  std::vector<Runner> runners;
  runners.push_back({"scree grid + default chain", make_scree(world, "grid", chain(), 1).release()});
  runners.push_back({"Bullet world, radius 1", make_bullet_world(world, 1.0).release()});
  runners.push_back({"Bullet world, radius 2", make_bullet_world(world, 2.0).release()});
  runners.push_back({"FCL manager", make_fcl_manager(world).release()});
  run(world, runners, frames);
  print(what, world, runners, csv);
}

void growth(int frames, std::FILE* csv) {
  for (const std::size_t count : {64000u, 256000u, 1000000u}) {
    const World world = load("", count);
    std::vector<Runner> runners;
    runners.push_back({"scree grid + default chain", make_scree(world, "grid", chain(), 1).release()});
    run(world, runners, frames);
    print("growth", world, runners, csv);
    fmt::print("  {:.1f} ns of CPU a body\n", 1e6 * median(runners[0].cpu) / static_cast<double>(world.size()));
  }
}

/// Best time of copying 256 MB with so many threads [ms].
double copy_time(unsigned threads) {
  const std::size_t length = 32u << 20;
  static std::vector<double> from(length, 1.0), to(length, 0.0);
  double best = 1e9;
  for (int repeat = 0; repeat < 7; ++repeat) {
    const double start = wall_now();
    std::vector<std::thread> workers;
    for (unsigned t = 0; t < threads; ++t) {
      workers.emplace_back([&, t] {
        const auto part = static_cast<std::ptrdiff_t>(length / threads);
        std::copy_n(from.begin() + t * part, part, to.begin() + t * part);
      });
    }
    for (std::thread& worker : workers) worker.join();
    best = std::min(best, 1e3 * (wall_now() - start));
  }
  return best;
}

void threads(const World& world, int frames, std::FILE* csv) {
  std::vector<Runner> runners;
  runners.push_back({"scree, 1 thread", make_scree(world, "grid", chain(), 1).release()});
  runners.push_back({"scree, 2 threads", make_scree(world, "grid", chain(), 2).release()});
  run(world, runners, 3 * frames);
  print("threads", world, runners, csv);
  const double gain = std::ranges::min(runners[0].wall) / std::ranges::min(runners[1].wall);
  const double copy = copy_time(1) / copy_time(2);
  fmt::print("  two threads: {:.2f} times as fast; copying memory: {:.2f} times; share of that {:.2f} (best of wall)\n",
             gain, copy, gain / copy);
}

Settings read_arguments(int argc, char** argv) {
  Settings settings;
  const std::map<std::string, std::string*> texts{{"--spheres", &settings.spheres},
                                                  {"--hulls", &settings.hulls},
                                                  {"--part", &settings.part},
                                                  {"--csv", &settings.csv}};
  for (int k = 1; k < argc; ++k) {
    const std::string key = argv[k];
    if (key.starts_with("--benchmark")) continue;  // what `./dev bench` gives to all
    if (k + 1 == argc) throw std::runtime_error{key + " needs a value, or is no option of peers_bench"};
    const std::string value = argv[++k];
    if (key == "--frames") {
      settings.frames = std::stoi(value);
    } else {
      *texts.at(key) = value;
    }
  }
  return settings;
}

void run_all(const Settings& settings) {
  std::FILE* csv = settings.csv.empty() ? nullptr : std::fopen(settings.csv.c_str(), "w");
  if (csv != nullptr) {
    fmt::print(csv, "part,who,bodies,cpu_median_ms,cpu_best_ms,wall_best_ms,contacts,touching,misses,extra\n");
  }
  const auto wanted = [&](const char* part) { return settings.part.empty() || settings.part == part; };
  if (wanted("spheres")) peers("spheres", load(settings.spheres, 64000), settings.frames, csv);
  if (wanted("hulls")) peers("hulls", hulls_in(load(settings.hulls, 8000)), settings.frames, csv);
  if (wanted("threads")) threads(load(settings.spheres, 64000), settings.frames, csv);
  if (settings.part == "frame") {
    const World world = load(settings.spheres, 64000);
    std::vector<Runner> runners;
    runners.push_back({"scree grid + default chain", make_scree(world, "grid", chain(), 1).release()});
    run(world, runners, settings.frames);
    print("frame", world, runners, csv);
  }
  if (wanted("growth")) growth(settings.frames, csv);
  if (csv != nullptr) std::fclose(csv);
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  scree::map_large_blocks();  // as scree does
  try {
    scree::bench::run_all(scree::bench::read_arguments(argc, argv));
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "peers_bench: {}\n", problem.what());
    return 1;
  }
}
