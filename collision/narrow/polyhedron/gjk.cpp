#include "gjk.hpp"

#include <limits>

#include "simplex.hpp"

namespace scree::polyhedron {
namespace {

/// Nearer than this, in sizes of the smaller solid, direction and distance are left to the separating axes.
constexpr double kTouching = 1e-8;
/// The walk ends when the distance is known to this part of itself; it is exact after finitely many corners anyway.
constexpr double kPrecision = 1e-13;
constexpr int kMostSteps = 100;
/// Directions that are tried before the walk; they settle nine pairs of ten that do not meet.
constexpr int kGuesses = 3;

void write_ends(const Simplex& simplex, Distance& out) {
  Vec3 on_a, on_b;
  out.count = simplex.count;
  for (std::uint32_t k = 0; k < simplex.count; ++k) {
    const SimplexCorner& c = simplex.corner[k];
    on_a += simplex.weight[k] * c.a;
    on_b += simplex.weight[k] * (c.a + c.w);
    out.corner_a[k] = c.of_a;
    out.corner_b[k] = c.of_b;
  }
  out.on_a = on_a;
  out.on_b = on_b;
}

/// True when one of a few guesses at a direction proves that the distance exceeds `limit`: that between the middles, and
/// then each one mirrored at the corner of B - A which spoilt it (Chung and Wang, "Quick collision detection of polytopes in
/// virtual environments", 1996). Leaves the last direction in `v`.
bool guess(const PlacedPair& pair, double limit, Vec3& v) {
  for (int k = 0; k < kGuesses; ++k) {
    const Vec3 w = pair.corner_b(pair.lowest_of_b(v)) - pair.a.corner(farthest(pair.a, v));
    const double vw = dot(v, w);
    if (vw > 0.0) return vw * vw > limit * limit * squared_norm(v);
    const double w2 = squared_norm(w);
    if (w2 == 0.0) return false;
    v -= (2.0 * vw / w2) * w;
  }
  return false;
}

}  // namespace

Distance distance(const PlacedPair& pair, double limit) {
  Distance out;
  Simplex simplex;
  Vec3 v = pair.centre_b() - pair.centre_a();
  if (guess(pair, limit, v)) return out;
  // Half of those that are left meet: their faces come in while the walk goes on.
  fetch_faces(pair.a);
  fetch_faces(pair.b);
  const double touching = kTouching * pair.size;
  double least = std::numeric_limits<double>::infinity();  // squared length of v, once v is a point of B - A
  bool apart = false;
  for (int step = 0; step < kMostSteps; ++step) {
    SimplexCorner c;
    c.of_a = farthest(pair.a, v);
    c.of_b = pair.lowest_of_b(v);
    c.a = pair.a.corner(c.of_a);
    c.w = pair.corner_b(c.of_b) - c.a;
    const double vw = dot(v, c.w);
    const double v2 = squared_norm(v);
    if (vw > 0.0 && vw * vw > limit * limit * v2) return out;
    apart = apart || (vw > 0.0 && vw * vw > touching * touching * v2);
    // No corner lies deeper than v itself: v is the nearest point.
    const bool known = simplex.count > 0 && v2 - vw <= kPrecision * v2;
    Simplex next = simplex;
    if (known || !next.add(c)) break;
    const Vec3 nearer = next.reduce(apart);
    const double d2 = squared_norm(nearer);
    if (d2 >= least) break;  // rounding: no progress any more, and v is still that of the simplex before
    simplex = next;
    if (d2 <= touching * touching) {
      write_ends(simplex, out);
      out.approach = Approach::touching;
      return out;
    }
    least = d2;
    v = nearer;
  }
  write_ends(simplex, out);
  out.length = norm(v);
  out.normal = v / out.length;
  out.approach = out.length < limit ? Approach::apart : Approach::beyond;
  return out;
}

}  // namespace scree::polyhedron
