// TwoClasses: which of two kinds a body is, for mixing and segregation.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "analysis/body_memory.hpp"
#include "scree/config/options.hpp"

namespace scree {

class SceneServices;

/// The class of a body.
enum class BodyClass : std::int8_t { neither = -1, first = 0, second = 1 };

/// A rule that parts bodies into two classes: by material, by the side of a plane, by size, or by an attribute. It is asked
/// when a body is first seen, and again at every look until the time `at`; from then on the body keeps its class.
class TwoClasses {
 public:
  /// The settings `classes` and `class_names`.
  static std::vector<Parameter> parameters();

  TwoClasses() = default;
  /// @throws Error (usage) for an unknown material, a material in both classes, a normal of length zero.
  TwoClasses(const Options& options, SceneServices& services);

  /// Looks at the bodies at `time` [s]. To be called every step, so that a body is asked where it appears.
  void look(const BodyView& bodies, double time);
  /// The class of every dynamic body of the last look, in order of id.
  [[nodiscard]] const std::vector<BodyClass>& of_dynamic() const { return of_dynamic_; }
  [[nodiscard]] const std::array<std::string, 2>& names() const { return names_; }

  void save(StateWriter& out) const { memory_.save(out); }
  void load(const StateReader& in) { memory_.load(in); }

 private:
  struct ByMaterial {
    std::vector<BodyClass> of_material;
  };
  struct BySide {
    Vec3 point;   // [m]
    Vec3 normal;  // any length
  };
  struct BySize {
    double diameter;  // [m]
  };
  struct ByAttribute {
    AttributeId column;
    double threshold;  // [unit of the column]
  };
  struct Remembered {
    static constexpr std::size_t kNumbers = 1;
    BodyClass value = BodyClass::neither;
    [[nodiscard]] std::array<double, 1> numbers() const { return {static_cast<double>(value)}; }
    static Remembered of(std::span<const double> n) { return {static_cast<BodyClass>(static_cast<int>(n[0]))}; }
  };

  void set_names(const Options& options, const std::array<std::string, 2>& plain);
  void set_materials(const Options& rule, SceneServices& services);
  [[nodiscard]] BodyClass ask(const BodyView& bodies, BodyIndex body) const;

  std::variant<ByMaterial, BySide, BySize, ByAttribute> rule_;
  double at_ = 0.0;  // [s]
  std::array<std::string, 2> names_;
  BodyMemory<Remembered> memory_;
  std::vector<BodyClass> of_dynamic_;
};

}  // namespace scree
