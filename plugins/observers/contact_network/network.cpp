#include "network.hpp"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

// All points of one pair, which lie side by side; their impulses as forces.
Link link_of(const ContactView& contacts, std::size_t first, std::size_t last, double dt, double friction) {
  Link link;
  link.a = contacts.contact[first].a;
  link.b = contacts.contact[first].b;
  Vec3 shear;
  for (std::size_t k = first; k < last; ++k) {
    const Vec3& impulse = contacts.impulse[k];
    if (impulse.x == 0.0) continue;
    const ContactFrame frame = contact_frame(contacts.contact[k].normal);
    link.normal_force += impulse.x / dt;
    link.normal += std::abs(impulse.x / dt) * frame.normal;
    shear += to_world(frame, {0.0, impulse.y / dt, impulse.z / dt});
    link.mobilisation = std::max(link.mobilisation, mobilisation(impulse, friction));
    link.slides = link.slides || slides(impulse, friction);
  }
  link.tangential_force = norm(shear);
  link.normal = normalized(link.normal);
  return link;
}

}  // namespace

void build_network(const BodyView& bodies, const ContactView& contacts, double dt, const Materials& materials,
                   const Region& region, Network& network) {
  network.links.clear();
  network.grain.assign(bodies.size(), 0);
  network.degree.assign(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    network.grain[i] = bodies.motion[i] == Motion::dynamic && region.contains(bodies.position[i]) ? 1 : 0;
  }
  for (std::size_t first = 0; first < contacts.size();) {
    const Contact& pair = contacts.contact[first];
    std::size_t last = first;
    while (last < contacts.size() && contacts.contact[last].a == pair.a && contacts.contact[last].b == pair.b) ++last;
    const double friction = materials.pair(bodies.material[pair.a], bodies.material[pair.b]).friction;
    const Link link = link_of(contacts, first, last, dt, friction);
    first = last;
    if (link.normal == Vec3{}) continue;
    network.links.push_back(link);
    ++network.degree[link.a];
    ++network.degree[link.b];
  }
}

Coordination coordination(const Network& network, std::uint32_t least) {
  Coordination out;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < network.grain.size(); ++i) {
    if (network.grain[i] == 0) continue;
    const std::uint32_t links = network.degree[i];
    if (out.distribution.size() <= links) out.distribution.resize(links + 1, 0);
    ++out.distribution[links];
    ++out.grains;
    sum += links;
  }
  if (out.grains > 0) out.mean = static_cast<double>(sum) / static_cast<double>(out.grains);

  std::vector<std::uint32_t> degree = network.degree;
  std::vector<char> loose(network.grain.size(), 0);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < loose.size(); ++i) {
      if (network.grain[i] == 0 || loose[i] != 0 || degree[i] >= least) continue;
      loose[i] = 1;
      ++out.rattlers;
      again = true;
    }
    if (!again) break;
    degree.assign(degree.size(), 0);
    for (const Link& link : network.links) {
      if (loose[link.a] != 0 || loose[link.b] != 0) continue;
      ++degree[link.a];
      ++degree[link.b];
    }
  }
  std::uint64_t held = 0;
  for (std::size_t i = 0; i < loose.size(); ++i) {
    if (network.grain[i] != 0 && loose[i] == 0) held += degree[i];
  }
  const std::size_t left = out.grains - out.rattlers;
  if (left > 0) out.mean_without_rattlers = static_cast<double>(held) / static_cast<double>(left);
  return out;
}

Fabric fabric(const Network& network) {
  Fabric out;
  Vec3 diagonal, beside;  // xx yy zz, yz xz xy
  std::size_t count = 0;
  for (const Link& link : network.links) {
    if (!counts(network, link)) continue;
    const Vec3& n = link.normal;
    diagonal += Vec3{n.x * n.x, n.y * n.y, n.z * n.z};
    beside += Vec3{n.y * n.z, n.x * n.z, n.x * n.y};
    ++count;
  }
  if (count == 0) return out;
  diagonal = diagonal / static_cast<double>(count);
  beside = beside / static_cast<double>(count);
  out.tensor = {{diagonal.x, beside.z, beside.y}, {beside.z, diagonal.y, beside.x}, {beside.y, beside.x, diagonal.z}};
  const Vec3 deviator = diagonal - Vec3{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  out.anisotropy = 7.5 * std::sqrt(1.5 * (squared_norm(deviator) + 2.0 * squared_norm(beside)));
  return out;
}

}  // namespace scree
