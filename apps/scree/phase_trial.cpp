#include "phase_trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <tuple>

#include "scree/config/validate.hpp"
#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

template <class Interface>
std::unique_ptr<Interface> make_phase(const PluginCatalog& catalog, const std::string& name) {
  const PluginEntry& entry = catalog.entry(Interface::kKind, name, {"--vary", 0, 0});
  std::unique_ptr<Plugin> plugin = entry.make(default_options(entry.parameters));
  auto* const phase = dynamic_cast<Interface*>(plugin.get());
  if (phase == nullptr) {
    throw Error{ErrorKind::usage, std::string{Interface::kKind} + ":" + name + " of " + entry.library + " is none"};
  }
  static_cast<void>(plugin.release());
  return std::unique_ptr<Interface>{phase};
}

/// The smaller radius of the bodies that can move [m].
double smaller_radius(const BodyView& bodies, const Contact& contact) {
  double radius = 0.0;
  for (const BodyIndex body : {contact.a, contact.b}) {
    if (bodies.motion[body] != Motion::dynamic) continue;
    radius = radius == 0.0 ? bodies.radius[body] : std::min(radius, bodies.radius[body]);
  }
  return radius;
}

auto pair_of(const Contact& c) { return std::tuple{c.a, c.b, c.primitive_a, c.primitive_b}; }

/// The deepest contact of each pair of primitives, sorted by pair.
std::vector<Contact> deepest(std::span<const Contact> contacts) {
  std::vector<Contact> out;
  for (const Contact& contact : contacts) {
    if (out.empty() || pair_of(out.back()) != pair_of(contact)) {
      out.push_back(contact);
    } else if (contact.gap < out.back().gap) {
      out.back() = contact;
    }
  }
  return out;
}

}  // namespace

std::string PhaseNames::narrow() const {
  std::string text;
  for (const std::string& name : chain) text += (text.empty() ? "" : "+") + name;
  return text;
}

ContactDifference difference_of(std::span<const Contact> contacts, std::span<const Contact> reference,
                                const BodyView& bodies) {
  constexpr double kDeep = 1e-6;
  ContactDifference out;
  const std::vector<Contact> ours = deepest(contacts), theirs = deepest(reference);
  auto mine = ours.begin();
  auto other = theirs.begin();
  const auto deep = [&](const Contact& c) { return -c.gap > kDeep * smaller_radius(bodies, c); };
  while (mine != ours.end() || other != theirs.end()) {
    if (other == theirs.end() || (mine != ours.end() && pair_of(*mine) < pair_of(*other))) {
      out.extra += deep(*mine++);
    } else if (mine == ours.end() || pair_of(*other) < pair_of(*mine)) {
      out.missed += deep(*other++);
    } else {
      if (deep(*mine) || deep(*other)) {
        out.gap = std::max(out.gap, std::abs(mine->gap - other->gap) / smaller_radius(bodies, *mine));
        const double sine = norm(cross(mine->normal, other->normal));
        out.normal_angle = std::max(out.normal_angle, std::atan2(sine, dot(mine->normal, other->normal)));
      }
      ++mine;
      ++other;
    }
  }
  return out;
}

PhaseTrial try_phases(const PluginCatalog& catalog, const PhaseNames& names, PhaseScene& scene, int frames,
                      const Executor& executor) {
  PhaseTrial trial{.names = names, .counts = {}, .contacts = {}, .difference = {}};
  const auto broad = make_phase<BroadPhase>(catalog, names.broad);
  std::vector<std::unique_ptr<NarrowPhase>> narrow;
  std::vector<NarrowPhase*> chain;
  for (const std::string& name : names.chain) {
    narrow.push_back(make_phase<NarrowPhase>(catalog, name));
    chain.push_back(narrow.back().get());
  }
  CollisionPipeline pipeline{*scene.shapes, *broad, chain, executor};
  pipeline.filter() = scene.filter;
  const BodyState bodies = scene.bodies.state();
  pipeline.check_support(bodies.view);
  const std::vector<Vec3> here{bodies.position.begin(), bodies.position.end()};
  std::vector<double> seconds;
  std::span<const Contact> found;
  // An even number of further frames ends where the first one was.
  for (int frame = 0; frame <= 2 * ((std::max(frames, 1) + 1) / 2); ++frame) {
    const double ahead = frame % 2 == 0 ? 0.0 : scene.dt;
    for (std::size_t i = 0; i < here.size(); ++i) bodies.position[i] = here[i] + ahead * bodies.velocity[i];
    const auto start = std::chrono::steady_clock::now();
    found = pipeline.find(bodies.view, bodies.velocity, bodies.angular_velocity, scene.dt);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  trial.counts = pipeline.counts();
  trial.contacts.assign(found.begin(), found.end());
  trial.first_frame = seconds[0];
  trial.frame = *std::min_element(seconds.begin() + 1, seconds.end());
  for (const auto& phase : narrow) trial.fallbacks += phase->fallbacks();
  return trial;
}

}  // namespace scree
