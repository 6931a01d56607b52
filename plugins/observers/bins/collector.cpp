#include "collector.hpp"

#include "scree/base/require.hpp"

namespace scree {

Collector::Collector(const Vec3& origin, const Vec3& u, const Vec3& v, int u_bins, int v_bins, Direction direction)
    : origin_{origin}, u_{u}, v_{v}, u_bins_{u_bins}, v_bins_{v_bins}, direction_{direction} {
  const Vec3 area = cross(u, v);
  SCREE_REQUIRE(norm(area) > 1e-12 * norm(u) * norm(v), "the edges of a collector must not be parallel");
  normal_ = normalized(area);
  // The dual basis: also right when the edges are not at right angles.
  along_a_ = cross(v, area) / squared_norm(area);
  along_b_ = cross(area, u) / squared_norm(area);
}

std::optional<Crossing> Collector::crossing(const Vec3& from, const Vec3& to) const {
  const double before = dot(normal_, from - origin_), after = dot(normal_, to - origin_);
  const bool was_beyond = before >= 0.0, is_beyond = after >= 0.0;
  if (was_beyond == is_beyond) return std::nullopt;
  if (direction_ != Direction::both && is_beyond != (direction_ == Direction::forward)) return std::nullopt;
  const double fraction = before / (before - after);
  const Vec3 place = from + fraction * (to - from) - origin_;
  return Crossing{dot(along_a_, place), dot(along_b_, place), fraction};
}

std::int64_t Collector::bin(const Crossing& crossing) const {
  if (!(crossing.a >= 0.0 && crossing.a < 1.0 && crossing.b >= 0.0 && crossing.b < 1.0)) return -1;
  const auto iu = static_cast<std::int64_t>(crossing.a * u_bins_);
  const auto iv = static_cast<std::int64_t>(crossing.b * v_bins_);
  return iv * u_bins_ + iu;
}

}  // namespace scree
