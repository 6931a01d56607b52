#include "contact_study/contact_log.hpp"

#include <algorithm>
#include <cmath>

#include "contact_study/contact_motion.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

// One that begins with a pull counts as one that begins with a push.
double weight_of(const Vec3& impulse) { return impulse.x != 0.0 ? std::abs(impulse.x) : norm(impulse); }

}  // namespace

void ContactLog::look(const BodyView& bodies, const ContactView& contacts) {
  before_.swap(loaded_);
  loaded_.clear();
  share_.assign(contacts.size(), 0.0);
  auto old = before_.begin();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!acts(contacts, k)) continue;
    const ContactKey key = contact_key(bodies, contacts.contact[k]);
    loaded_.push_back(key);
    while (old != before_.end() && *old < key) ++old;
    if (old == before_.end() || *old != key) share_[k] = weight_of(contacts.impulse[k]);
  }
  share_out(contacts);
}

// Contacts of a pair lie side by side.
void ContactLog::share_out(const ContactView& contacts) {
  for (std::size_t first = 0; first < contacts.size();) {
    const Contact& pair = contacts.contact[first];
    std::size_t last = first;
    double sum = 0.0;
    for (; last < contacts.size() && contacts.contact[last].a == pair.a && contacts.contact[last].b == pair.b; ++last) {
      sum += share_[last];
    }
    for (; first < last; ++first) {
      if (sum > 0.0) share_[first] /= sum;
    }
  }
}

void ContactLog::save(StateWriter& out) const {
  std::vector<std::uint64_t> numbers;
  numbers.reserve(5 * loaded_.size());
  for (const ContactKey& key : loaded_) {
    numbers.insert(numbers.end(), {key.a, key.b, key.primitive_a, key.primitive_b, key.feature});
  }
  out.write("loaded", std::span<const std::uint64_t>{numbers});
}

void ContactLog::load(const StateReader& in) {
  const std::vector<std::uint64_t> numbers = in.integers("loaded");
  loaded_.clear();
  for (std::size_t i = 0; i + 4 < numbers.size(); i += 5) {
    loaded_.push_back({numbers[i], numbers[i + 1], static_cast<std::uint32_t>(numbers[i + 2]),
                       static_cast<std::uint32_t>(numbers[i + 3]), numbers[i + 4]});
  }
}

}  // namespace scree
