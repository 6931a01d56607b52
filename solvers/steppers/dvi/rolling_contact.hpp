// RollingContact: a contact that resists rolling and spinning too, as a cone
// block of six rows (Tasora & Anitescu 2013, Meccanica 48).
//
//     rows      normal, tangent 1, tangent 2      relative velocity of the surfaces [m/s]
//               spin, rolling 1, rolling 2        L times the relative angular velocity about normal and tangents [m/s]
//     impulses  g_n, t_1, t_2 [N s]; s, rho_1, rho_2 [N s], of which L makes moments [N m s]
//     cone      ||t|| <= mu g_n,  |s| <= (mu_s / L) g_n,  ||rho|| <= (mu_r / L) g_n
//
// The length L is the radius of the smaller of the two bodies (of the sphere of
// its volume): a speed of rolling is then one of its rim, as large as a speed of
// sliding, and one residual judges both.
#pragma once

#include <span>

#include "scree/ccp/problem.hpp"
#include "scree/collision/contact.hpp"
#include "scree/math/twist.hpp"
#include "scree/model/body.hpp"

namespace scree {
struct ContactMaterial;
}  // namespace scree

namespace scree::dvi {

/// The radius of the smaller of the bodies of `c` that forces move [m]; infinite when they move none.
[[nodiscard]] double smaller_radius(const BodyView& bodies, const Contact& c);

/// True when contacts of the pair are cones of six rows.
[[nodiscard]] bool resists_rolling(const ContactMaterial& material);

struct RollingContact {
  static constexpr std::uint8_t kRows = 6;

  CcpContact contact;   ///< frame, arms, sliding friction, bodies of the problem
  double length = 1.0;  ///< L [m]

  /// The block, with coefficients over L.
  [[nodiscard]] CcpBlock block(const ContactMaterial& material, std::uint32_t first_row) const;
  /// Its Jacobian.
  void write_rows(std::span<CcpRow, kRows> rows) const;
  /// Rows 3 to 5 for the angular velocities of a and b [rad/s], world.
  [[nodiscard]] Vec3 rolling_velocity(const Vec3& a, const Vec3& b) const;
};

}  // namespace scree::dvi
