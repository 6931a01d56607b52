// SceneServices: what a part may ask for when it is set up.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scree/model/attributes.hpp"
#include "scree/model/body.hpp"
#include "scree/model/random.hpp"

namespace scree {

class ElectricField;
class Executor;
class Materials;
class ShapeSet;

/// A scene body found by name.
struct NamedBody {
  BodyId id = 0;
  Pose pose;          ///< of the body frame at the start [m], world
  std::string shape;  ///< name of its shape
};

/// Given once, at setup. References stay valid for the whole run.
class SceneServices {
 public:
  virtual ~SceneServices();

  /// The name of the part being set up: the scene's `name`, else its type; empty for services that know none. For
  /// names of files and columns.
  [[nodiscard]] virtual std::string part_name() const;

  /// An electric field of the scene by name. @throws Error (usage) naming those
  /// that exist.
  [[nodiscard]] virtual const ElectricField& electric_field(std::string_view name) const = 0;
  /// A body of the scene by name. @throws Error (usage) naming those that
  /// exist, with a suggestion.
  [[nodiscard]] virtual NamedBody body(std::string_view name) const = 0;
  /// The index of a material by name. @throws Error (usage) naming those that
  /// exist, with a suggestion.
  [[nodiscard]] virtual std::uint32_t material(std::string_view name) const = 0;
  [[nodiscard]] virtual Materials& materials() = 0;
  [[nodiscard]] virtual ShapeSet& shapes() = 0;

  /// Declares that the calling part writes this column (one field a column).
  /// Bodies start with `info.initial`.
  virtual AttributeId provide_attribute(const AttributeInfo& info) = 0;
  /// Declares that the calling part reads this column. Checked after all parts
  /// are set up: a scene in which nothing provides the column (a part, a
  /// material, a source) is refused, unless `fallback` is given, which is then
  /// used as initial value.
  virtual AttributeId require_attribute(std::string_view name, std::string_view unit, std::string_view help) = 0;
  virtual AttributeId optional_attribute(const AttributeInfo& info) = 0;
  /// Declares that the calling part shows every column, whatever its name: a column that no other part reads is then of
  /// use.
  virtual void show_all_attributes();

  /// A random stream of the calling part: the seed of the scene and the part's
  /// own name and `purpose`.
  [[nodiscard]] virtual RandomStream random_stream(std::string_view purpose) const = 0;
  [[nodiscard]] virtual const Executor& executor() const = 0;
  /// Outer time step [s] and end [s] of the simulation.
  [[nodiscard]] virtual double time_step() const = 0;
  [[nodiscard]] virtual double end_time() const = 0;
  /// Lines for the log: what was assumed, what was measured at setup.
  virtual void log(std::string_view line) const = 0;

  /// Names of the scene's bodies: entry k belongs to the body with id k, empty when it has none. For labels.
  [[nodiscard]] virtual std::vector<std::string> body_names() const;
};

}  // namespace scree
