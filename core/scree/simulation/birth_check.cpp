#include "scree/simulation/birth_check.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace scree {
namespace {

/// The radius that an overlap is compared with: that of the smaller of the bodies that can move [m].
double smaller_radius(const BodyView& bodies, const Contact& contact) {
  double radius = std::numeric_limits<double>::infinity();
  for (const BodyIndex body : {contact.a, contact.b}) {
    if (bodies.motion[body] == Motion::dynamic) radius = std::min(radius, bodies.radius[body]);
  }
  return radius;
}

std::string name_of(const BodyView& bodies, BodyIndex body, std::span<const SceneBody> known) {
  const BodyId id = bodies.id[body];
  if (id < known.size() && !known[id].name.empty()) return "body '" + known[id].name + "'";
  return "body " + std::to_string(id) + (id < known.size() ? " (of shape '" + known[id].shape + "')" : std::string{});
}

}  // namespace

void BirthCheck::check(const BodyView& bodies, std::span<const Contact> contacts, std::span<const SceneBody> known) {
  if (births_.empty() || births_.front().first >= bodies.size()) return;
  for (const Contact& contact : contacts) {
    if (contact.b < births_.front().first) continue;  // a < b: both are old
    const double radius = smaller_radius(bodies, contact);
    if (!(-contact.gap > kAllowed * radius)) continue;
    const auto after = [&](const Birth& birth) { return birth.first <= contact.b; };
    const PartInfo& source = *std::find_if(births_.rbegin(), births_.rend(), after)->source;
    char depth[80];
    std::snprintf(depth, sizeof depth, "by %.3g m, %.0f %% of the smaller radius", -contact.gap,
                  -100.0 * contact.gap / radius);
    throw Error{ErrorKind::usage, source.where,
                source.label() + " adds " + name_of(bodies, contact.b, known) + ", which overlaps " +
                    name_of(bodies, contact.a, known) + " " + depth +
                    "; move the source or that body apart, or set simulation.allow_overlap = true"};
  }
  births_.clear();
}

}  // namespace scree
