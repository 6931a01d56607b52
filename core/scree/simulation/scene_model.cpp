#include "scree/simulation/scene_model.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/validate.hpp"
#include "scree/simulation/scene_filter.hpp"
#include "scree/simulation/scene_machine.hpp"
#include "scree/simulation/scene_motion.hpp"
#include "scree/simulation/scene_sections.hpp"
#include "scree/simulation/shape_builder.hpp"

namespace scree {
namespace {

std::string in_quotes(const std::string& word) { return "'" + word + "'"; }

Options read_single(const SceneTable& root, std::string_view section) {
  const auto& parameters = scene_section(section).parameters;
  if (root.has(section)) return validate(root.table(section), parameters, "[" + std::string{section} + "]");
  Options defaults = default_options(parameters);
  defaults.set_location(root.location());
  return defaults;
}

ContactMaterial contact_material(const Options& o) {
  return {.friction = o.number("friction"),
          .restitution = o.number("restitution"),
          .rolling_friction = o.number("rolling_friction"),
          .spinning_friction = o.number("spinning_friction"),
          .compliance = o.number("compliance"),
          .damping = o.number("damping"),
          .surface_energy = o.number("surface_energy"),
          .cohesion_energy_density = o.number("cohesion_energy_density")};
}

PairRule pair_rule(const std::string& word) {
  static const std::map<std::string, PairRule> rules{{"minimum", PairRule::minimum},
                                                     {"maximum", PairRule::maximum},
                                                     {"mean", PairRule::mean},
                                                     {"geometric_mean", PairRule::geometric_mean}};
  return rules.at(word);
}

std::uint32_t find_material(const Materials& materials, const std::string& name, const Options& o, const char* key) {
  const std::int64_t index = materials.find(name);
  if (index >= 0) return static_cast<std::uint32_t>(index);
  throw o.error(key, "is " + in_quotes(name) + ", which is no material of the scene; it has " +
                         list_of(materials.names()) + suggestion(name, materials.names()));
}

void read_materials(const SceneTable& root, SceneModel& model) {
  model.materials.set_rule(pair_rule(model.contacts.text("unlisted_pair")));
  for (const auto& [name, table] : root.named_tables("material")) {
    Options o = validate(table, scene_section("material").parameters, "material " + in_quotes(name));
    Material material{.name = name,
                      .density = o.number("density"),
                      .contact = contact_material(o),
                      .attributes = {},
                      .young_modulus = o.number("young_modulus"),
                      .poisson_ratio = o.number("poisson_ratio")};
    if (o.has("attributes")) {
      for (const std::string& key : o.table("attributes").names()) {
        material.attributes.emplace_back(key, o.table("attributes").number(key));
      }
    }
    model.materials.add(std::move(material));
    model.material_options.push_back({name, std::move(o)});
  }
  for (const SceneTable& table : root.tables("material_pair")) {
    Options o = validate(table, scene_section("material_pair").parameters, "[[material_pair]]");
    const std::vector<std::string>& names = o.texts("between");
    const std::uint32_t a = find_material(model.materials, names[0], o, "between");
    const std::uint32_t b = find_material(model.materials, names[1], o, "between");
    if (model.materials.is_listed(a, b)) {
      throw o.error("between", "is " + list_of(names) + ", which an earlier [[material_pair]] lists already; keep one");
    }
    model.materials.set_pair(a, b, contact_material(o));
    model.pair_options.push_back(std::move(o));
  }
}

void read_shapes(const SceneTable& root, SceneModel& model) {
  const std::vector<Variant> variants = shape_variants();
  for (const auto& [name, entry] : root.named_tables("shape")) {
    const std::string type = entry.text("type");
    const auto variant =
        std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.type == type; });
    if (variant == variants.end()) {
      std::vector<std::string> types;
      for (const Variant& v : variants) types.push_back(v.type);
      throw Error{ErrorKind::usage, entry.location("type"),
                  "unknown shape type " + in_quotes(type) + "; valid are " + list_of(types) + suggestion(type, types)};
    }
    static constexpr std::array<std::string_view, 1> kType{"type"};
    Options o = validate(entry.without(kType), variant->members, "shape " + in_quotes(name));
    o.set_type(type);
    model.shape_options.push_back({name, std::move(o)});
  }
}

const NamedOptions& find_shape(const SceneModel& model, const Options& body) {
  std::vector<std::string> names;
  for (const NamedOptions& shape : model.shape_options) {
    names.push_back(shape.name);
    if (shape.name == body.text("shape")) return shape;
  }
  throw body.error("shape", "is " + in_quotes(body.text("shape")) + ", which is no shape of the scene; it has " +
                                list_of(names) + suggestion(body.text("shape"), names));
}

/// The shape of a body. A fixed, a moving and a ghost body of one shape have different geometry records.
std::uint32_t shape_record(SceneModel& model, const NamedOptions& shape, Motion motion, bool collides) {
  const bool principal = motion == Motion::dynamic;
  const std::string name = shape.name + (principal ? "" : " (as written)") + (collides ? "" : " (ghost)");
  const std::int64_t known = model.shapes.find(name);
  if (known >= 0) return static_cast<std::uint32_t>(known);
  ShapeData data =
      build_shape(shape.name, shape.options, principal ? ShapeFrame::principal : ShapeFrame::as_written, model.remarks);
  data.name = name;
  for (PrimitiveData& part : data.primitives) part.primitive.collides = collides;
  return model.shapes.add(data);
}

Motion motion_of(const std::string& word) {
  return word == "dynamic" ? Motion::dynamic : (word == "kinematic" ? Motion::kinematic : Motion::fixed);
}

SceneBody read_body(SceneModel& model, const Options& o) {
  SceneBody entry{o.text("name"), {}, o.text("shape"), o};
  NewBody& body = entry.body;
  body.motion = motion_of(o.text("motion"));
  body.material = find_material(model.materials, o.text("material"), o, "material");
  body.collision_group = find_collision_group(model, o);
  body.shape = shape_record(model, find_shape(model, o), body.motion, o.boolean("collides"));
  const Shape& shape = model.shapes.shapes()[body.shape];
  body.pose = pose_of(o) * model.shapes.body_to_shape(body.shape);
  body.radius = shape.equivalent_radius;
  if (body.motion == Motion::fixed) {
    for (const char* key : {"velocity", "angular_velocity"}) {
      if (norm(o.vector(key)) > 0.0) {
        throw o.error(key, "is not zero, but the body is fixed; set motion = \"kinematic\" to move it");
      }
    }
  }
  body.velocity = o.vector("velocity");
  body.angular_velocity = o.vector("angular_velocity");
  const Pose frame = model.shapes.body_to_shape(body.shape);
  const Vec3 turning = o.vector("surface_angular_velocity");
  body.surface_motion = {rotate_back(frame.orientation, o.vector("surface_velocity") + cross(turning, frame.position)),
                         rotate_back(frame.orientation, turning)};
  const double density = model.materials[body.material].density;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  body.mass = body.motion == Motion::dynamic ? density * shape.volume : kInfinity;
  body.inertia = body.motion == Motion::dynamic ? density * shape.unit_inertia : Vec3{kInfinity, kInfinity, kInfinity};
  return entry;
}

void read_bodies(const SceneTable& root, SceneModel& model) {
  for (const SceneTable& table : root.tables("body")) {
    const Options o = validate(table, scene_section("body").parameters, "[[body]]");
    SceneBody entry = read_body(model, o);
    for (const SceneBody& other : model.bodies) {
      if (!entry.name.empty() && entry.name == other.name) {
        throw o.error("name", "is that of an earlier body, " + in_quotes(entry.name) + "; names must differ");
      }
    }
    model.bodies.push_back(std::move(entry));
  }
}

}  // namespace

void check_section_names(const SceneDocument& document) {
  std::vector<std::string> valid{"include", "plugins"};
  for (const SceneSection& section : scene_sections()) valid.emplace_back(section.name);
  for (const std::string& key : document.root().keys()) {
    if (std::find(valid.begin(), valid.end(), key) != valid.end()) continue;
    throw Error{ErrorKind::usage, document.root().location(key),
                "unknown section " + in_quotes(key) + "; valid are " + list_of(valid) + suggestion(key, valid)};
  }
}

SceneModel read_scene_model(const SceneDocument& document) {
  const SceneTable root = document.root();
  SceneModel model;
  model.simulation = read_single(root, "simulation");
  if (!root.has("simulation")) {
    throw Error{ErrorKind::usage, root.location(),
                "the scene has no [simulation]; add at least\n    [simulation]\n    end_time = \"1 s\""};
  }
  model.contacts = read_single(root, "contacts");
  model.output = read_single(root, "output");
  read_materials(root, model);
  read_shapes(root, model);
  read_collision_groups(root, model);
  read_bodies(root, model);
  read_excluded_pairs(root, model);
  read_prescribed_motions(root, model);
  read_machine(root, model);
  return model;
}

}  // namespace scree
