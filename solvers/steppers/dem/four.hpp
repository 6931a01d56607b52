// Records of doubles, four at a time: a vector and what lies behind it in one register.
#pragma once

#include <cstddef>
#include <cstring>

#include "scree/math/lanes.hpp"
#include "scree/math/vec3.hpp"

namespace scree::dem {

/// Four doubles of a record, from its `quadruple`-th one on.
template <class Record>
Lanes four_of(const Record& record, std::size_t quadruple = 0) {
  Lanes out;
  std::memcpy(&out, reinterpret_cast<const char*>(&record) + quadruple * sizeof out, sizeof out);
  return out;
}
template <class Record>
void set_four(const Lanes& values, Record& record, std::size_t quadruple = 0) {
  std::memcpy(reinterpret_cast<char*>(&record) + quadruple * sizeof values, &values, sizeof values);
}
inline Lanes four_of(const Vec3& v, double fourth) { return Lanes{v.x, v.y, v.z, fourth}; }

}  // namespace scree::dem
