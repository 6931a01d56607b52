// Tiny observers for tests of core.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/state/state_io.hpp"

namespace scree::testing_parts {

/// Writes a file, so it says.
class Writer final : public Observer {
 public:
  explicit Writer(const Options& o) : file_{o.text("file")} {}
  static std::vector<Parameter> parameters() { return {Parameter::text("file", "name").by_default("")}; }
  void setup(SceneServices& services, const std::filesystem::path&) override {
    if (!file_.empty()) claim_results(services, file_, {""});
  }
  void observe(const Observation&, Attributes&) override {}

 private:
  std::string file_;
};

/// Counts steps in units of `unit`, through checkpoints; claims the file counter_NAME.csv.
class Counter final : public Observer {
 public:
  explicit Counter(const Options& o) : unit_{o.number("unit")} {}
  static std::vector<Parameter> parameters() { return {Parameter::number("unit", "1", "of a step").by_default(1.0)}; }
  void setup(SceneServices& services, const std::filesystem::path&) override {
    claim_results(services, "counter_" + services.part_name(), {".csv"});
  }
  void observe(const Observation&, Attributes&) override { sum_ += unit_; }
  void save(StateWriter& out) const override { out.write("sum", sum_); }
  void load(const StateReader& in) override { sum_ = in.number("sum"); }

 private:
  double unit_, sum_ = 0.0;
};

}  // namespace scree::testing_parts
