#include "impact_book.hpp"

#include <algorithm>

#include "contact_study/contact_motion.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

constexpr std::size_t kNumbers = 5;  // of a Collision, besides its materials

Collision begin_collision(const BodyView& bodies, const ContactView& contacts, std::size_t k, double share) {
  const Contact& contact = contacts.contact[k];
  const Vec3& before = contacts.velocity_before[k];
  Collision c;
  c.material_a = std::min(bodies.material[contact.a], bodies.material[contact.b]);
  c.material_b = std::max(bodies.material[contact.a], bodies.material[contact.b]);
  c.mass = share * effective_mass(bodies, contact);
  c.speed = std::max(0.0, -before.x);
  c.normal_energy = 0.5 * c.mass * c.speed * c.speed;
  c.tangential_energy = 0.5 * c.mass * (before.y * before.y + before.z * before.z);
  return c;
}

}  // namespace

// One walk through the open contacts and those of the step, both sorted by key.
void ImpactBook::look(const BodyView& bodies, const ContactView& contacts, std::vector<Collision>& ended) {
  log_.look(bodies, contacts);
  next_keys_.clear();
  next_open_.clear();
  std::size_t old = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!acts(contacts, k)) continue;
    const ContactKey key = contact_key(bodies, contacts.contact[k]);
    for (; old < keys_.size() && keys_[old] < key; ++old) ended.push_back(open_[old]);
    const bool goes_on = old < keys_.size() && keys_[old] == key;
    next_keys_.push_back(key);
    next_open_.push_back(goes_on ? open_[old++] : begin_collision(bodies, contacts, k, log_.share(k)));
    next_open_.back().dissipated += dissipated(contacts, k);
  }
  for (; old < keys_.size(); ++old) ended.push_back(open_[old]);
  keys_.swap(next_keys_);
  open_.swap(next_open_);
}

void ImpactBook::save(StateWriter& out) const {
  log_.save(*out.group("contacts"));
  std::vector<std::uint64_t> keys;
  std::vector<double> numbers;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    const ContactKey& key = keys_[k];
    const Collision& c = open_[k];
    keys.insert(keys.end(), {key.a, key.b, key.primitive_a, key.primitive_b, key.feature, c.material_a, c.material_b});
    numbers.insert(numbers.end(), {c.normal_energy, c.tangential_energy, c.dissipated, c.mass, c.speed});
  }
  out.write("keys", std::span<const std::uint64_t>{keys});
  out.write("numbers", std::span<const double>{numbers});
}

void ImpactBook::load(const StateReader& in) {
  log_.load(*in.group("contacts"));
  const std::vector<std::uint64_t> keys = in.integers("keys");
  const std::vector<double> numbers = in.doubles("numbers");
  keys_.clear();
  open_.clear();
  for (std::size_t k = 0; 7 * k < keys.size(); ++k) {
    const std::uint64_t* key = &keys[7 * k];
    const double* n = &numbers.at(kNumbers * (k + 1) - 1) - (kNumbers - 1);
    keys_.push_back({key[0], key[1], static_cast<std::uint32_t>(key[2]), static_cast<std::uint32_t>(key[3]), key[4]});
    open_.push_back(
        {static_cast<std::uint32_t>(key[5]), static_cast<std::uint32_t>(key[6]), n[0], n[1], n[2], n[3], n[4]});
  }
}

}  // namespace scree
