// Materials, and what two of them do when they touch.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree {

/// Contact parameters of a pair of materials.
struct ContactMaterial {
  double friction = 0.0;                 ///< sliding, Coulomb [1]
  double restitution = 0.0;              ///< Newton, normal [1]
  double rolling_friction = 0.0;         ///< arm of the rolling torque [m]
  double spinning_friction = 0.0;        ///< arm of the spinning torque [m]
  double compliance = 0.0;               ///< normal, 1 / stiffness [m/N]; 0 is rigid
  double damping = 0.0;                  ///< normal, of a compliant contact [N s/m]
  double surface_energy = 0.0;           ///< work of adhesion of the pair, that of both surfaces [J/m2]
  double cohesion_energy_density = 0.0;  ///< attraction per area of contact [J/m3]

  bool operator==(const ContactMaterial&) const = default;
};

/// What a body is made of.
struct Material {
  std::string name;
  double density = 1000.0;  ///< [kg/m3]
  ContactMaterial contact;  ///< its half of a pair that the scene does not list
  std::vector<std::pair<std::string, double>>
      attributes;               ///< body attributes that come with the material [their units]
  double young_modulus = 0.0;   ///< of elastic contacts [Pa]; 0: not known
  double poisson_ratio = 0.25;  ///< the same [1]
};

/// How a pair that the scene does not list gets its parameters from the two
/// materials.
enum class PairRule { minimum, maximum, mean, geometric_mean };

/// All materials and the table of their pairs.
class Materials {
 public:
  /// Adds a material and returns its index. @throws std::logic_error for a name
  /// used twice.
  std::uint32_t add(Material material);
  void set_rule(PairRule rule);
  /// Lists a pair explicitly; order does not matter.
  void set_pair(std::uint32_t a, std::uint32_t b, const ContactMaterial& values);

  [[nodiscard]] std::size_t size() const { return materials_.size(); }
  [[nodiscard]] const Material& operator[](std::uint32_t index) const { return materials_[index]; }
  /// The index of a material, or -1.
  [[nodiscard]] std::int64_t find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  /// The parameters between two materials: listed, else by the rule.
  [[nodiscard]] const ContactMaterial& pair(std::uint32_t a, std::uint32_t b) const {
    return table_[a * materials_.size() + b];
  }
  [[nodiscard]] bool is_listed(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] PairRule rule() const { return rule_; }

 private:
  void refresh();
  PairRule rule_ = PairRule::minimum;
  std::vector<Material> materials_;
  struct Listed {
    std::uint32_t a, b;
    ContactMaterial values;
  };
  std::vector<Listed> listed_;
  std::vector<ContactMaterial> table_;
};

}  // namespace scree
