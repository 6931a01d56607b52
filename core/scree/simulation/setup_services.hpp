// SetupServices: what parts ask for at setup, answered from the scene.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/simulation/parts.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {

/// Everything of a simulation that parts may refer to. The objects outlive the services.
struct SetupContext {
  SceneModel& model;
  BodyStore& bodies;
  const Parts& parts;
  const Executor& executor;
  double time_step;  ///< [s]
  double end_time;   ///< [s]
  std::vector<std::string>& log;
  std::vector<std::string>& warnings;
};

/// Answers one part at a time.
class SetupServices final : public SceneServices, public ResultRegistry {
 public:
  explicit SetupServices(const SetupContext& context) : context_{context} {}

  /// Says which part asks from now on; named in messages, streams and attribute writers.
  void serve(const PartInfo& part) { part_ = &part; }
  /// Lets materials and scene bodies provide the columns that they set.
  void provide_from_scene();
  /// Refuses a simulation in which a part reads a column that nothing provides. @throws Error (usage).
  void check_attributes();
  /// Warns of columns that materials, bodies or sources give and no part reads: a misspelt name, most likely.
  void warn_of_unread() const;
  /// Refuses a body that lacks a column which a part reads and no part writes. `values` are those that the body and its
  /// material give. @throws Error (usage) naming the body, the column and its reader.
  void check_body(const NewBody& body, std::span<const std::pair<AttributeId, double>> values) const;

  [[nodiscard]] std::string part_name() const override { return part_->name; }
  [[nodiscard]] const ElectricField& electric_field(std::string_view name) const override;
  [[nodiscard]] NamedBody body(std::string_view name) const override;
  [[nodiscard]] std::uint32_t material(std::string_view name) const override;
  [[nodiscard]] Materials& materials() override { return context_.model.materials; }
  [[nodiscard]] ShapeSet& shapes() override { return context_.model.shapes; }
  AttributeId provide_attribute(const AttributeInfo& info) override;
  AttributeId require_attribute(std::string_view name, std::string_view unit, std::string_view help) override;
  AttributeId optional_attribute(const AttributeInfo& info) override;
  void show_all_attributes() override { shows_all_ = true; }
  [[nodiscard]] RandomStream random_stream(std::string_view purpose) const override;
  [[nodiscard]] const Executor& executor() const override { return context_.executor; }
  [[nodiscard]] double time_step() const override { return context_.time_step; }
  [[nodiscard]] double end_time() const override { return context_.end_time; }
  void log(std::string_view line) const override;
  [[nodiscard]] std::vector<std::string> body_names() const override;
  void claim_result(const std::string& file) override;

 private:
  // Every quantity in an `attributes` table has the dimension of its column.
  void check_attribute_units() const;
  // Where the scene gives a value for a column; nowhere when a source does.
  [[nodiscard]] SourceLocation place_of(const std::string& column) const;

  struct Reader {
    std::string part;
    std::string attribute;
    std::string help;
    SourceLocation where;
  };
  SetupContext context_;
  const PartInfo* part_ = nullptr;
  ResultClaims claims_;
  std::vector<Reader> readers_;
  std::vector<std::string> used_;  // columns that a part reads, or writes while the simulation runs
  bool shows_all_ = false;         // a part shows every column
  std::vector<std::pair<AttributeId, std::size_t>> given_;  // columns that bodies have to bring, and who reads them
};

}  // namespace scree
