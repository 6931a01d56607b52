// Electric fields for unit tests, independent of the plugins.
#pragma once

#include <algorithm>
#include <cmath>

#include "scree/interfaces/electric_field.hpp"

namespace scree::test {

/// The same field everywhere; it can be changed between calls.
class FakeElectricField final : public ElectricField {
 public:
  explicit FakeElectricField(const Vec3& e) : value{e} {}
  void evaluate(std::span<const Vec3>, double, std::span<Vec3> field, std::span<double>) const override {
    std::fill(field.begin(), field.end(), value);
  }
  Vec3 value;  ///< [V/m]
};

/// The published separator's field outside of its conductors, written as that of two line charges: roll of 0.16 m at the
/// origin, electrode of 0.019 m at 0.267 m and 30 degrees, -35 kV.
class SeparatorField final : public ElectricField {
 public:
  void evaluate(std::span<const Vec3> position, double, std::span<Vec3> field, std::span<double>) const override {
    constexpr double kRoll = 0.16;
    constexpr double kElectrode = 0.019;
    constexpr double kDistance = 0.267;
    const double middle = (kDistance * kDistance + kRoll * kRoll - kElectrode * kElectrode) / (2.0 * kDistance);
    const double half = std::sqrt(middle * middle - kRoll * kRoll);
    // The potential of the line charges, ln of the ratio of distances, on both surfaces at the line of centres.
    const double at_roll = std::log((kRoll - (middle - half)) / (middle + half - kRoll));
    const double inner = kDistance - kElectrode;
    const double at_electrode = std::log((inner - (middle - half)) / (middle + half - inner));
    const double strength = -35e3 / (at_electrode - at_roll);  // [V]
    const Vec3 to_electrode{std::sqrt(0.75), 0.5, 0.0};
    for (std::size_t i = 0; i < position.size(); ++i) {
      const Vec3 x{position[i].x, position[i].y, 0.0};
      const Vec3 from_a = x - (middle - half) * to_electrode;
      const Vec3 from_b = x - (middle + half) * to_electrode;
      field[i] = -strength * (from_a / squared_norm(from_a) - from_b / squared_norm(from_b));
    }
  }
};

}  // namespace scree::test
