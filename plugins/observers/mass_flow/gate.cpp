#include "gate.hpp"

namespace scree {

Parameter Gate::parameter() {
  const Parameter normal = Parameter::vector("normal", "1", "direction of forward flow, of any length");
  std::vector<Variant> forms{
      {"plane", "an unbounded plane", {Parameter::vector("point", "m", "a point of the plane"), normal}},
      {"disc",
       "a disc",
       {Parameter::vector("centre", "m", "of the disc"), normal,
        Parameter::number("radius", "m", "of the disc").above(0.0)}},
      {"rectangle",
       "a rectangle or parallelogram; forward is along u x v",
       {Parameter::vector("corner", "m", "one of its corners"), Parameter::vector("u", "m", "edge from the corner"),
        Parameter::vector("v", "m", "the other edge from the corner")}}};
  return Parameter::variant("gate", std::move(forms), "the opening through which the flow is measured");
}

Gate::Gate(const Options& options) {
  const Options& gate = options.table("gate");
  if (gate.type() == "rectangle") {
    const Vec3 u = gate.vector("u"), v = gate.vector("v"), n = cross(u, v);
    if (norm(n) <= 1e-12 * norm(u) * norm(v)) {
      throw gate.error("v", "and 'u' are parallel or zero; they must span the gate");
    }
    point_ = gate.vector("corner");
    normal_ = normalized(n);
    edge_ = Parallelogram{cross(v, n) / squared_norm(n), cross(n, u) / squared_norm(n)};
    return;
  }
  normal_ = normalized(gate.vector("normal"));
  if (normal_ == Vec3{}) throw gate.error("normal", "must not be zero; [0, 0, -1] counts what falls as forward");
  const bool disc = gate.type() == "disc";
  point_ = gate.vector(disc ? "centre" : "point");
  if (disc) edge_ = Disc{gate.number("radius")};
}

bool Gate::is_open_at(const Vec3& from_point) const {
  if (const auto* disc = std::get_if<Disc>(&edge_)) return squared_norm(from_point) <= disc->radius * disc->radius;
  if (const auto* area = std::get_if<Parallelogram>(&edge_)) {
    const double a = dot(area->along_u, from_point), b = dot(area->along_v, from_point);
    return a >= 0.0 && a < 1.0 && b >= 0.0 && b < 1.0;
  }
  return true;
}

std::optional<Passage> Gate::passage(const Vec3& from, const Vec3& to) const {
  const double before = dot(from - point_, normal_), after = dot(to - point_, normal_);
  if ((before >= 0.0) == (after >= 0.0)) return std::nullopt;
  const double fraction = before / (before - after);
  const Vec3 place = from + fraction * (to - from);
  if (!is_open_at(place - point_)) return std::nullopt;
  return Passage{after >= 0.0, fraction, place};
}

}  // namespace scree
