// PlaneSink: takes out what crosses a plane.
//
//     n . (x - p) > 0      x: centre of mass, p: a point of the plane, n: normal, towards the side where bodies leave
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/sink.hpp"

namespace scree {

/// Removes the dynamic bodies whose centre of mass is beyond a plane.
class PlaneSink final : public Sink {
 public:
  explicit PlaneSink(const Options& options);
  static std::vector<Parameter> parameters();

  void mark(const BodyView& bodies, double time, std::span<char> remove) override;
  [[nodiscard]] std::string reason() const override;

 private:
  Vec3 point_;   ///< [m], world
  Vec3 normal_;  ///< unit [1], world
};

}  // namespace scree
