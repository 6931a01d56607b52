// Time a contact of the contact laws, as plugins: batches of 64 contacts in the first-level cache, of one pair of materials or of
// several. It does not show what gathering a batch and adding its forces cost.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "support/fake_scene_services.hpp"

namespace scree {
namespace {

struct Variant {
  const char* name;
  const char* plugin;
  const char* toml;
};

constexpr Variant kVariants[] = {
    {"linear", "linear_spring_dashpot", "stiffness = 1e5"},
    {"linear_overlap_target", "linear_spring_dashpot", ""},
    {"linear_rolling", "linear_spring_dashpot", "stiffness = 1e5\nrolling = \"elastic_plastic\""},
    {"linear_rolling_spinning_dmt", "linear_spring_dashpot",
     "stiffness = 1e5\nrolling = \"elastic_plastic\"\nspinning = \"elastic_plastic\"\ncohesion = \"dmt\""},
    {"hertz", "hertz_mindlin", ""},
    {"hertz_jkr", "hertz_mindlin", "cohesion = \"jkr\""},
};

/// A batch of grains of 1 mm that lie and slide on each other, of materials 0 and 1 alone or mixed.
std::unique_ptr<ContactBatch> bed(bool mixed) {
  auto batch = std::make_unique<ContactBatch>();
  batch->count = ContactBatch::kMost;
  batch->lead = 5e-7;
  for (ContactBatch::Lane& lane : batch->history) lane.fill(0.0);
  for (std::size_t k = 0; k < batch->count; ++k) {
    const double s = static_cast<double>(k);
    batch->overlap[k] = 1e-6 * (1.0 + std::sin(s));
    batch->radius[k] = 5e-4 * (1.0 + 0.2 * std::sin(3.0 * s));
    batch->mass[k] = 5e-6;
    batch->normal.set(k, normalized(Vec3{std::sin(5.0 * s), std::cos(7.0 * s), std::sin(11.0 * s)}));
    batch->velocity.set(k, 1e-3 * Vec3{std::cos(5.0 * s), std::sin(3.0 * s), std::cos(2.0 * s)});
    batch->spin.set(k, Vec3{std::cos(s), std::sin(s), std::cos(2.0 * s)});
    batch->materials[k] = mixed ? k % 4 : 0;
    batch->ahead[k] = 5e-7;
  }
  return batch;
}

void run(benchmark::State& state, const Variant& variant, bool mixed) {
  PluginHost host;
  host.load(std::string{SCREE_PLUGINS} + "/" + variant.plugin + ".so");
  test::FakeSceneServices services;
  for (const char* name : {"glass", "steel"}) {
    services.materials().add({.name = name,
                              .density = 2500.0,
                              .contact = {.friction = 0.4,
                                          .restitution = 0.7,
                                          .rolling_friction = 1e-5,
                                          .spinning_friction = 1e-5,
                                          .surface_energy = 0.01},
                              .attributes = {},
                              .young_modulus = 1e9});
  }
  const PluginEntry& entry = *host.entries().front();
  const std::unique_ptr<Plugin> plugin = entry.make(options_from_text(variant.toml, entry.parameters));
  auto& law = static_cast<ContactLaw&>(*plugin);
  law.setup(services);
  const std::unique_ptr<ContactBatch> batch = bed(mixed);
  for (auto _ : state) {
    law.forces(*batch);
    benchmark::DoNotOptimize(batch->force.x.data());
    benchmark::ClobberMemory();
  }
  state.counters["contact"] = benchmark::Counter(
      ContactBatch::kMost, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

const bool kListed = [] {
  for (const Variant& variant : kVariants) {
    for (const bool mixed : {false, true}) {
      benchmark::RegisterBenchmark((std::string{variant.name} + (mixed ? "/four_pairs" : "/one_pair")).c_str(), run,
                                   variant, mixed);
    }
  }
  return true;
}();

}  // namespace
}  // namespace scree

BENCHMARK_MAIN();
