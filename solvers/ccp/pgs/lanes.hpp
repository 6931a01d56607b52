// Vectors of three in four lanes, so that one instruction works on a whole
// vector. Lane 3 is free for a scalar; products and sums leave it in peace as
// long as one factor has a zero there.
#pragma once

#include <cstring>

namespace scree::pgs {

using Lanes = double __attribute__((vector_size(32)));

/// Four doubles from anywhere; lane 3 is what follows the vector.
inline Lanes load(const double* from) {
  Lanes out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

inline Lanes all(double x) { return Lanes{x, x, x, x}; }

/// (x, y, z, 0).
inline Lanes without_last(const Lanes& a) { return __builtin_shufflevector(a, Lanes{}, 0, 1, 2, 7); }

inline Lanes cross(const Lanes& a, const Lanes& b) {
  const Lanes a1 = __builtin_shufflevector(a, a, 1, 2, 0, 3);
  const Lanes b1 = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const Lanes c = a * b1 - a1 * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

/// (a . v, b . v, c . v, 0); lane 3 of v must be zero.
inline Lanes dots(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& v) {
  const Lanes av = a * v, bv = b * v, cv = c * v;
  const Lanes ab = __builtin_shufflevector(av, bv, 0, 4, 2, 6) + __builtin_shufflevector(av, bv, 1, 5, 3, 7);
  const Lanes c0 = __builtin_shufflevector(cv, Lanes{}, 0, 4, 2, 6) + __builtin_shufflevector(cv, Lanes{}, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, c0, 0, 1, 4, 5) + __builtin_shufflevector(ab, c0, 2, 3, 6, 7);
}

}  // namespace scree::pgs
