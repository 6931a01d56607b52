#include "contact_study/followed_bodies.hpp"

#include <algorithm>

namespace scree {

void FollowedBodies::setup(const Options& options, std::string_view key, const SceneServices& services) {
  for (const std::string& name : options.texts(key)) {
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) {
      throw options.error(key, "lists '" + name + "' twice; list each body once");
    }
    ids_.push_back(services.body(name).id);
    names_.push_back(name);
  }
}

void FollowedBodies::locate(const BodyView& bodies) {
  slots_.assign(bodies.size(), kNone);
  indices_.assign(ids_.size(), kGone);
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    const auto found = std::lower_bound(bodies.id.begin(), bodies.id.end(), ids_[k]);
    if (found == bodies.id.end() || *found != ids_[k]) continue;
    indices_[k] = static_cast<BodyIndex>(found - bodies.id.begin());
    slots_[indices_[k]] = static_cast<std::uint32_t>(k);
  }
}

}  // namespace scree
