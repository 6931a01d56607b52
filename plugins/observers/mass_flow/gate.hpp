// Gate: the flat opening through which a flow is measured.
#pragma once

#include <optional>
#include <variant>

#include "scree/config/options.hpp"
#include "scree/math/vec3.hpp"

namespace scree {

/// A way of a body through a gate.
struct Passage {
  bool forward = true;    ///< along the normal
  double fraction = 0.0;  ///< of the step that had passed [1]
  Vec3 place;             ///< [m]
};

/// An unbounded plane, a disc or a parallelogram. Being on the plane counts as being on the side of the normal, so that no
/// passage is seen twice or never.
class Gate {
 public:
  /// The setting `gate`.
  static Parameter parameter();
  /// @throws Error (usage) for a normal of length zero or parallel edges.
  explicit Gate(const Options& options);

  /// The passage by a straight step from one place to another [m], both in the frame of the gate, if there is one.
  [[nodiscard]] std::optional<Passage> passage(const Vec3& from, const Vec3& to) const;

 private:
  struct Disc {
    double radius;  // [m]
  };
  struct Parallelogram {
    Vec3 along_u, along_v;  // coordinates 0..1 from the point are along_u . d and along_v . d [1/m]
  };
  [[nodiscard]] bool is_open_at(const Vec3& from_point) const;

  Vec3 point_;   // [m]
  Vec3 normal_;  // unit [1]
  std::variant<std::monostate, Disc, Parallelogram> edge_;
};

}  // namespace scree
