#include "second_look.hpp"

#include <algorithm>
#include <tuple>

#include "rolling_contact.hpp"

namespace scree::dvi {
namespace {

/// Farther than this a body must not come without a look [radii].
constexpr double kUnforeseen = 0.5;
/// A surface crossed by less pushes back in the next step [radii].
constexpr double kCrossed = 0.25;

auto place(const Contact& c) { return std::tuple{c.a, c.b, c.primitive_a, c.primitive_b, c.feature}; }

bool before(const Contact& l, const Contact& r) { return place(l) < place(r); }

/// How far the surfaces are apart at a contact after `dt` [m]; negative when they cross.
double gap_after(const BodyView& bodies, const Contact& c, const Velocities& v, double dt) {
  const auto at = [&](BodyIndex i) { return v.linear[i] + cross(v.angular[i], c.point - bodies.position[i]); };
  return c.gap + dt * dot(c.normal, at(c.b) - at(c.a));
}

}  // namespace

void find_struck(const BodyView& bodies, std::span<const BodyIndex> numbers, std::span<const Twist> w, double dt,
                 std::vector<BodyIndex>& struck) {
  struck.clear();
  for (std::size_t k = 0; k < w.size(); ++k) {
    const BodyIndex i = numbers[k];
    const double far = kUnforeseen * bodies.radius[i];
    if (dt * dt * squared_norm(w[k].linear) > far * far && bodies.motion[i] == Motion::dynamic) struck.push_back(i);
  }
  std::ranges::sort(struck);
}

bool add_crossed(const BodyView& bodies, std::span<const Contact> found, const Velocities& after, double dt,
                 std::vector<Contact>& contacts) {
  const std::size_t known = contacts.size();
  for (const Contact& c : found) {
    if ((bodies.motion[c.a] == Motion::dynamic) == (bodies.motion[c.b] == Motion::dynamic)) continue;
    if (gap_after(bodies, c, after, dt) > -kCrossed * smaller_radius(bodies, c)) continue;
    const auto end = contacts.begin() + static_cast<std::ptrdiff_t>(known);
    if (!std::binary_search(contacts.begin(), end, c, before)) contacts.push_back(c);
  }
  std::inplace_merge(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(known), contacts.end(), before);
  return contacts.size() > known;
}

}  // namespace scree::dvi
