// Fill: a box full of particles at the beginning.
#pragma once

#include <array>
#include <optional>
#include <unordered_set>
#include <vector>

#include "family.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/math/aabb.hpp"

namespace scree {

class ShapeSet;

/// Places a number of particles on a jittered lattice, from the lower corner of a box upwards, at the first step. Cells
/// that hold a body already are passed over. Each particle is moved about in its cell, by what it is smaller: cells are
/// wider than the largest particle where sizes hardly differ, as far as the box has room.
class Fill final : public Source {
 public:
  explicit Fill(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// A lattice with cells wider than the largest particle by the share `loose`.
  void lay(double loose);
  [[nodiscard]] std::int64_t cell_count() const;
  /// Cells that no bounding sphere of a dynamic body reaches into.
  void take(const Aabb& box, std::unordered_set<std::int64_t>& taken) const;
  [[nodiscard]] std::vector<std::int64_t> free_cells(const BodyView& bodies) const;
  /// Lays the loosest lattice that has room, and returns a free cell for each particle. @throws Error as check_room().
  [[nodiscard]] std::vector<std::int64_t> places(const BodyView& bodies);
  [[nodiscard]] Vec3 middle(std::int64_t cell) const;
  /// @throws Error (usage) when fewer cells are free than particles wanted.
  void check_room(std::int64_t cells) const;

  Options options_;
  Vec3 lower_, upper_;  // [m]
  std::int64_t count_;
  int up_;                               // axis along which layers follow each other
  double radius_ = 0.0;                  // of the largest bounding sphere [m]
  double mean_radius_ = 0.0;             // of all bounding spheres [m]
  std::array<std::int64_t, 3> cells_{};  // of the lattice along x, y, z
  double reach_ = 0.0;                   // no particle reaches further from the middle of its cell [m]
  Vec3 pitch_;                           // of the lattice, more than 2 reach_ [m]
  std::optional<Mixture> mixture_;
  ShapeSet* shapes_ = nullptr;
  std::optional<RandomStream> particles_;  // which particles they are
  std::optional<RandomStream> places_;     // where in its cell each one is
  bool done_ = false;
};

}  // namespace scree
