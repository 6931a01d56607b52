// FakeSceneServices: a scene for unit tests of parts, filled in by hand.
//
//     FakeSceneServices services;
//     services.add_electric_field("gap", field);
//     services.add_body("roll", {.id = 1, .pose = {}, .shape = "roll"});
//     part.setup(services);
//     EXPECT_TRUE(services.provides("charge_corona"));
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/results/result_claims.hpp"

namespace scree::test {

/// Scene services over plain maps. What was declared, provided and logged can be looked at afterwards.
class FakeSceneServices final : public SceneServices, public ResultRegistry {
 public:
  explicit FakeSceneServices(int threads = 1) : executor_{threads} {}

  /// `field` must outlive this object.
  void add_electric_field(const std::string& name, const ElectricField& field) { fields_[name] = &field; }
  void add_body(const std::string& name, const NamedBody& body) { bodies_[name] = body; }

  /// What the part under test is called from now on.
  void set_part_name(const std::string& name) { part_name_ = name; }
  [[nodiscard]] std::string part_name() const override { return part_name_; }

  [[nodiscard]] const ElectricField& electric_field(std::string_view name) const override {
    return *find(fields_, name, "electric field");
  }
  [[nodiscard]] NamedBody body(std::string_view name) const override { return find(bodies_, name, "body"); }
  [[nodiscard]] std::vector<std::string> body_names() const override {
    std::vector<std::string> names;
    for (const auto& [name, body] : bodies_) {
      if (names.size() <= body.id) names.resize(body.id + 1);
      names[body.id] = name;
    }
    return names;
  }
  [[nodiscard]] std::uint32_t material(std::string_view name) const override {
    const std::int64_t index = materials_.find(name);
    if (index < 0) throw Error{ErrorKind::usage, "no material '" + std::string{name} + "'"};
    return static_cast<std::uint32_t>(index);
  }
  [[nodiscard]] Materials& materials() override { return materials_; }
  [[nodiscard]] ShapeSet& shapes() override { return shapes_; }

  AttributeId provide_attribute(const AttributeInfo& info) override {
    provided_.push_back(info.name);
    return attributes_.declare(info);
  }
  AttributeId require_attribute(std::string_view name, std::string_view unit, std::string_view help) override {
    required_.emplace_back(name);
    return attributes_.declare({std::string{name}, std::string{unit}, std::string{help}, 0.0, {}});
  }
  AttributeId optional_attribute(const AttributeInfo& info) override { return attributes_.declare(info); }

  [[nodiscard]] RandomStream random_stream(std::string_view purpose) const override { return {seed, purpose}; }
  [[nodiscard]] const Executor& executor() const override { return executor_; }
  [[nodiscard]] double time_step() const override { return step; }
  [[nodiscard]] double end_time() const override { return end; }
  void log(std::string_view line) const override { log_.emplace_back(line); }
  void claim_result(const std::string& file) override { claims_.claim("the part under test", file); }

  /// The columns that parts declared; the bodies of a test share them.
  [[nodiscard]] Attributes& attributes() { return attributes_; }
  [[nodiscard]] const std::vector<std::string>& log_lines() const { return log_; }
  [[nodiscard]] bool provides(const std::string& column) const { return contains(provided_, column); }
  [[nodiscard]] bool requires_column(const std::string& column) const { return contains(required_, column); }

  /// Files in `folder` and below that the part under test has not claimed at setup.
  [[nodiscard]] std::vector<std::string> unclaimed_in(const std::filesystem::path& folder) const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator{folder}) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && !claims_.has(name)) files.push_back(name);
    }
    return files;
  }

  double step = 1e-3;  ///< outer time step [s]
  double end = 1.0;    ///< [s]
  std::uint64_t seed = 1;

 private:
  template <class Value>
  static const Value& find(const std::map<std::string, Value>& values, std::string_view name, const char* what) {
    const auto found = values.find(std::string{name});
    if (found == values.end())
      throw Error{ErrorKind::usage, std::string{"no "} + what + " '" + std::string{name} + "'"};
    return found->second;
  }
  static bool contains(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  }

  std::string part_name_;
  Executor executor_;
  std::map<std::string, const ElectricField*> fields_;
  std::map<std::string, NamedBody> bodies_;
  Materials materials_;
  ShapeSet shapes_;
  Attributes attributes_;
  ResultClaims claims_;
  std::vector<std::string> provided_;
  std::vector<std::string> required_;
  mutable std::vector<std::string> log_;
};

}  // namespace scree::test
