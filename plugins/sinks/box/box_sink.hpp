// BoxSink: takes out what leaves, or enters, a box aligned with the axes.
#pragma once

#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/sink.hpp"
#include "scree/math/aabb.hpp"

namespace scree {

/// Removes the dynamic bodies whose centre of mass is outside (or inside) a box.
class BoxSink final : public Sink {
 public:
  explicit BoxSink(const Options& options);
  static std::vector<Parameter> parameters();

  void mark(const BodyView& bodies, double time, std::span<char> remove) override;
  [[nodiscard]] std::string reason() const override;

 private:
  Aabb box_;  ///< [m], world
  bool remove_inside_;
};

}  // namespace scree
