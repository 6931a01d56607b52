#include "scree/simulation/scene_filter.hpp"

#include <algorithm>

#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/validate.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {
namespace {

CollisionGroup group_by_name(const SceneModel& model, const std::string& name, const Options& o, const char* key) {
  const auto& names = model.collision_groups;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<CollisionGroup>(at - names.begin());
  throw o.error(key, "names '" + name + "', which is no collision group of the scene; it has " + list_of(names) +
                         suggestion(name, names));
}

BodyId body_by_name(const SceneModel& model, const std::string& name, const Options& o) {
  std::vector<std::string> names;
  for (BodyId id = 0; id < model.bodies.size(); ++id) {
    if (model.bodies[id].name.empty()) continue;
    if (model.bodies[id].name == name) return id;
    names.push_back(model.bodies[id].name);
  }
  throw o.error("between", "names '" + name + "', which is no body of the scene; named bodies are " + list_of(names) +
                               suggestion(name, names));
}

}  // namespace

void read_collision_groups(const SceneTable& root, SceneModel& model) {
  for (const auto& [name, table] : root.named_tables("collision_group")) {
    Options o = validate(table, scene_section("collision_group").parameters, "collision group '" + name + "'");
    if (name != "default") {
      if (model.collision_groups.size() == CollisionFilter::kMostGroups) {
        throw o.error("is collision group " + std::to_string(CollisionFilter::kMostGroups + 1) + " of the scene, '" +
                      name + "'; at most 32 are possible with 'default'");
      }
      model.collision_groups.push_back(name);
    }
    model.collision_group_options.push_back({name, std::move(o)});
  }
  // When all names are known.
  for (const auto& [name, o] : model.collision_group_options) {
    if (!o.has("collides_with")) continue;
    for (const std::string& other : o.texts("collides_with")) {
      static_cast<void>(group_by_name(model, other, o, "collides_with"));
    }
  }
}

void read_excluded_pairs(const SceneTable& root, SceneModel& model) {
  for (const SceneTable& table : root.tables("excluded_pair")) {
    Options o = validate(table, scene_section("excluded_pair").parameters, "[[excluded_pair]]");
    const std::vector<std::string>& names = o.texts("between");
    if (body_by_name(model, names[0], o) == body_by_name(model, names[1], o)) {
      throw o.error("between", "names '" + names[0] + "' twice; a body never touches itself, so name two bodies");
    }
    model.excluded_pair_options.push_back(std::move(o));
  }
}

CollisionGroup find_collision_group(const SceneModel& model, const Options& options) {
  return group_by_name(model, options.text("collision_group"), options, "collision_group");
}

void fill_filter(const SceneModel& model, CollisionFilter& filter) {
  for (const auto& [name, o] : model.collision_group_options) {
    if (!o.has("collides_with")) continue;
    const std::vector<std::string>& meets = o.texts("collides_with");
    const CollisionGroup group = group_by_name(model, name, o, "collides_with");
    for (CollisionGroup other = 0; other < model.collision_groups.size(); ++other) {
      if (std::ranges::find(meets, model.collision_groups[other]) == meets.end()) {
        filter.set_groups_meet(group, other, false);
      }
    }
  }
  for (const Options& o : model.excluded_pair_options) {
    const std::vector<std::string>& names = o.texts("between");
    filter.exclude(body_by_name(model, names[0], o), body_by_name(model, names[1], o));
  }
}

}  // namespace scree
