// Cost of finding the contacts of a settled bed: broad phases x sizes x threads.
//
// What it does not show: contact solving, and scenes whose bodies fly about or differ in size by decades. With
// SCREE_BED=file (see bed.hpp) that bed is measured as well.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>

#include "bed.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/host/plugin_host.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::bench {
namespace {

template <class Interface>
std::unique_ptr<Interface> make(const std::string& name) {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  auto plugin = host->entry(Interface::kKind, name, {}).make(Options{});
  return std::unique_ptr<Interface>{dynamic_cast<Interface*>(plugin.release())};
}

/// Count 0 stands for the bed file.
Bed& bed_of(std::size_t count) {
  static std::map<std::size_t, std::unique_ptr<Bed>> beds;
  auto& bed = beds[count];
  if (bed == nullptr) {
    bed = std::make_unique<Bed>();
    if (count == 0) {
      read_bed(std::getenv("SCREE_BED"), *bed);
    } else {
      make_bed(count, *bed);
    }
  }
  return *bed;
}

/// One frame of a bed whose grains tremble: all of collision, as a stepper asks for it.
void frame(benchmark::State& state, const std::string& broad_name) {
  Bed& bed = bed_of(static_cast<std::size_t>(state.range(0)));
  const Executor executor{static_cast<int>(state.range(1))};
  const auto broad = make<BroadPhase>(broad_name);
  const auto narrow = make<NarrowPhase>("sphere_cluster");
  CollisionPipeline pipeline{bed.shapes, *broad, {narrow.get()}, executor};
  const double dt = 1e-3;
  double sign = 1.0;
  // Twice before the clock starts: memory is allocated, incremental phases are built.
  for (int k = 0; k < 2; ++k) {
    const BodyView view = bed.bodies.view();
    pipeline.find(view, view.velocity, view.angular_velocity, dt);
  }
  for (auto _ : state) {
    const BodyState bodies = bed.bodies.state();
    for (std::size_t i = 0; i < bodies.position.size(); ++i) bodies.position[i] += sign * dt * bodies.velocity[i];
    sign = -sign;
    benchmark::DoNotOptimize(pipeline.find(bodies.view, bodies.view.velocity, bodies.view.angular_velocity, dt).data());
  }
  const auto bodies = static_cast<double>(bed.bodies.size());
  state.counters["bodies"] = bodies;
  state.counters["candidates/body"] = static_cast<double>(pipeline.counts().candidates) / bodies;
  state.counters["pairs/body"] = static_cast<double>(pipeline.counts().pairs) / bodies;
  state.counters["contacts/body"] = static_cast<double>(pipeline.counts().contacts) / bodies;
  state.counters["s/body"] =
      benchmark::Counter(bodies, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void add_benchmarks() {
  for (const char* const broad : {"grid", "bullet_dbvt"}) {
    auto* const one = benchmark::RegisterBenchmark((std::string{"frame/"} + broad).c_str(),
                                                   [broad](benchmark::State& state) { frame(state, broad); });
    one->ArgNames({"bodies", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
    const bool file = std::getenv("SCREE_BED") != nullptr;
    for (const long count : {0L, 32000L, 64000L, 256000L}) {
      if (count == 0 && !file) continue;
      for (const long threads : {1L, 2L}) one->Args({count, threads});
    }
  }
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  scree::bench::add_benchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
