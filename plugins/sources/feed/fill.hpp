// Fill: a box full of particles at the beginning.
#pragma once

#include <optional>

#include "family.hpp"
#include "scree/interfaces/source.hpp"

namespace scree {

class ShapeSet;

/// Places a number of particles on a jittered lattice, from the lower corner of a box upwards, at the first step.
class Fill final : public Source {
 public:
  explicit Fill(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  void emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  Options options_;
  Vec3 lower_, upper_;  // [m]
  std::int64_t count_;
  int up_;  // axis along which layers follow each other
  std::optional<Mixture> mixture_;
  ShapeSet* shapes_ = nullptr;
  std::optional<RandomStream> random_;
  bool done_ = false;
};

}  // namespace scree
