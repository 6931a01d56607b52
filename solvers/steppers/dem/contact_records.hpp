// ContactRecords: what a ContactView of the last step refers to.
#pragma once

#include <tuple>
#include <vector>

#include "scree/collision/contact.hpp"

namespace scree::dem {

struct ContactRecords {
  std::vector<Contact> contact;
  std::vector<Vec3> impulse;          ///< [N s], contact frame
  std::vector<Vec3> angular_impulse;  ///< [N m s]; empty when the law does not resist rolling
  std::vector<Vec3> before;           ///< [m/s], contact frame
  std::vector<Vec3> after;
  std::vector<double> work;        ///< [J]
  std::vector<ContactLoad> loads;  ///< of a whole step, by body

  [[nodiscard]] std::size_t size() const { return contact.size(); }

  void clear() { resize(0, false); }
  void resize(std::size_t n, bool rolls) {
    contact.resize(n), impulse.resize(n), before.resize(n), after.resize(n), work.resize(n);
    angular_impulse.resize(rolls ? n : 0);
  }
  void append(const ContactRecords& from, std::size_t k) {
    contact.push_back(from.contact[k]);
    impulse.push_back(from.impulse[k]);
    if (!from.angular_impulse.empty()) angular_impulse.push_back(from.angular_impulse[k]);
    before.push_back(from.before[k]);
    after.push_back(from.after[k]);
    work.push_back(from.work[k]);
  }
  /// Takes two sorted ones.
  void merge(const ContactRecords& one, const ContactRecords& other) {
    clear();
    const auto key = [](const Contact& c) { return std::tie(c.a, c.b, c.primitive_a, c.primitive_b, c.feature); };
    std::size_t i = 0, j = 0;
    while (i < one.size() || j < other.size()) {
      const bool first = j == other.size() || (i < one.size() && key(one.contact[i]) < key(other.contact[j]));
      if (first) {
        append(one, i++);
      } else {
        append(other, j++);
      }
    }
  }
  [[nodiscard]] ContactView view() const {
    return {.contact = contact,
            .impulse = impulse,
            .velocity_before = before,
            .velocity_after = after,
            .angular_impulse = angular_impulse,
            .work = work,
            .loads = loads};
  }
};

}  // namespace scree::dem
