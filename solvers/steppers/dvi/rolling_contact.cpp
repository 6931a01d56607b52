#include "rolling_contact.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "scree/ccp/twist.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/model/material.hpp"

namespace scree::dvi {

double smaller_radius(const BodyView& bodies, const Contact& c) {
  const auto size_of = [&](BodyIndex i) {
    return bodies.motion[i] == Motion::dynamic ? bodies.radius[i] : std::numeric_limits<double>::infinity();
  };
  return std::min(size_of(c.a), size_of(c.b));
}

bool resists_rolling(const ContactMaterial& material) {
  return material.rolling_friction > 0.0 || material.spinning_friction > 0.0;
}

CcpBlock RollingContact::block(const ContactMaterial& material, std::uint32_t first_row) const {
  return {.kind = CcpKind::cone,
          .rows = kRows,
          .first_row = first_row,
          .a = contact.a,
          .b = contact.b,
          .friction = contact.friction,
          .spinning = material.spinning_friction / length,
          .rolling = material.rolling_friction / length};
}

void RollingContact::write_rows(std::span<CcpRow, kRows> rows) const {
  const ContactFrame frame = contact_frame(contact.normal);
  const std::array<Vec3, 3> axes = {frame.normal, frame.tangent1, frame.tangent2};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& e = axes[k];
    rows[k] = {{-e, -cross(contact.arm_a, e)}, {e, cross(contact.arm_b, e)}};
    rows[k + 3] = {{{}, -length * e}, {{}, length * e}};
  }
}

Vec3 RollingContact::rolling_velocity(const Vec3& a, const Vec3& b) const { return length * in_frame(contact, b - a); }

}  // namespace scree::dvi
