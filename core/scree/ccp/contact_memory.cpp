#include "scree/ccp/contact_memory.hpp"

#include "scree/base/error.hpp"
#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

void ContactMemory::recall(std::span<const ContactKey> keys, std::span<Vec3> impulse, std::span<Vec3> angular) const {
  std::size_t old = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    while (old < keys_.size() && keys_[old] < keys[i]) ++old;
    const bool known = old < keys_.size() && keys_[old] == keys[i];
    impulse[i] = known ? impulse_[old] : Vec3{};
    if (!angular.empty()) angular[i] = known && !angular_.empty() ? angular_[old] : Vec3{};
  }
}

void ContactMemory::store(std::vector<ContactKey>& keys, std::vector<Vec3>& impulse) {
  SCREE_REQUIRE(keys.size() == impulse.size(), "ContactMemory: keys and impulses differ in number");
  keys_.swap(keys);
  impulse_.swap(impulse);
  angular_.clear();
}

void ContactMemory::store(std::vector<ContactKey>& keys, std::vector<Vec3>& impulse, std::vector<Vec3>& angular) {
  SCREE_REQUIRE(angular.empty() || angular.size() == keys.size(),
                "ContactMemory: keys and angular impulses differ in number");
  store(keys, impulse);
  angular_.swap(angular);
}

void ContactMemory::clear() { release(keys_, impulse_, angular_); }

void ContactMemory::save(StateWriter& out) const {
  std::vector<std::uint64_t> packed;
  packed.reserve(5 * keys_.size());
  for (const ContactKey& k : keys_) {
    packed.insert(packed.end(), {k.a, k.b, std::uint64_t{k.primitive_a}, std::uint64_t{k.primitive_b}, k.feature});
  }
  out.write("contact_keys", std::span<const std::uint64_t>{packed});
  out.write("contact_impulses", std::span<const Vec3>{impulse_});
  if (!angular_.empty()) out.write("contact_angular_impulses", std::span<const Vec3>{angular_});
}

void ContactMemory::load(const StateReader& in) {
  const std::vector<std::uint64_t> packed = in.integers("contact_keys");
  impulse_ = in.vectors("contact_impulses");
  angular_.clear();
  if (in.has("contact_angular_impulses")) angular_ = in.vectors("contact_angular_impulses");
  if (packed.size() != 5 * impulse_.size() || (!angular_.empty() && angular_.size() != impulse_.size())) {
    throw Error(ErrorKind::io,
                "The checkpoint's contact keys and impulses differ in number; it cannot be resumed from");
  }
  keys_.clear();
  keys_.reserve(impulse_.size());
  for (std::size_t i = 0; i < packed.size(); i += 5) {
    keys_.push_back({packed[i], packed[i + 1], static_cast<std::uint32_t>(packed[i + 2]),
                     static_cast<std::uint32_t>(packed[i + 3]), packed[i + 4]});
  }
}

}  // namespace scree
