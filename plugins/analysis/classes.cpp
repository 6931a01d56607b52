#include "analysis/classes.hpp"

#include <algorithm>

#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "_") + word;
  return text;
}

BodyClass above(double value, double threshold) { return value < threshold ? BodyClass::first : BodyClass::second; }

}  // namespace

std::vector<Parameter> TwoClasses::parameters() {
  const Parameter at =
      Parameter::number("at", "s",
                        "bodies are asked until this time and keep their class afterwards; later ones are asked "
                        "when they appear")
          .at_least(0.0)
          .by_default(0.0);
  std::vector<Variant> rules{
      {"material",
       "by material",
       {Parameter::texts("first", "materials of the first class").with_at_least_count(1),
        Parameter::texts("second", "materials of the second class; all others when left out")
            .by_default(std::vector<std::string>{}),
        at}},
      {"side",
       "by the side of a plane on which a body lies; the second class lies on the side of the normal",
       {Parameter::vector("point", "m", "a point of the plane").by_default(Vec3{}),
        Parameter::vector("normal", "1", "of the plane, of any length"), at}},
      {"size",
       "by the diameter of the sphere of equal volume; the first class is smaller than the threshold",
       {Parameter::number("threshold", "m", "smallest diameter of the second class").above(0.0), at}},
      {"attribute",
       "by a body attribute; the first class is smaller than the threshold",
       {Parameter::text("attribute", "name of the column"),
        Parameter::number("threshold", "any", "smallest value of the second class"), at}}};
  return {Parameter::variant("classes", std::move(rules), "how bodies are parted into two classes"),
          Parameter::texts("class_names", "of the two classes, for headers and figures; after the rule when left out")
              .by_default(std::vector<std::string>{})};
}

TwoClasses::TwoClasses(const Options& options, SceneServices& services) {
  const Options& rule = options.table("classes");
  at_ = rule.number("at");
  if (rule.type() == "material") {
    set_materials(rule, services);
    const auto& second = rule.texts("second");
    set_names(options, {joined(rule.texts("first")), second.empty() ? "others" : joined(second)});
  } else if (rule.type() == "side") {
    rule_ = BySide{rule.vector("point"), rule.vector("normal")};
    if (norm(rule.vector("normal")) <= 0.0)
      throw rule.error("normal", "must not be zero; [1, 0, 0] parts at a plane across x");
    set_names(options, {"behind", "in_front"});
  } else if (rule.type() == "size") {
    rule_ = BySize{rule.number("threshold")};
    set_names(options, {"small", "large"});
  } else {
    const std::string& name = rule.text("attribute");
    const AttributeId column = services.require_attribute(name, "1", "parts bodies into two classes");
    rule_ = ByAttribute{column, rule.number("threshold")};
    set_names(options, {"low_" + name, "high_" + name});
  }
}

void TwoClasses::set_materials(const Options& rule, SceneServices& services) {
  const auto& second = rule.texts("second");
  ByMaterial by;
  by.of_material.assign(services.materials().size(), second.empty() ? BodyClass::second : BodyClass::neither);
  for (const std::string& name : second) by.of_material[services.material(name)] = BodyClass::second;
  for (const std::string& name : rule.texts("first")) {
    if (std::find(second.begin(), second.end(), name) != second.end()) {
      throw rule.error("second", "names '" + name + "', which is in 'first' already; a material belongs to one class");
    }
    by.of_material[services.material(name)] = BodyClass::first;
  }
  rule_ = std::move(by);
}

void TwoClasses::set_names(const Options& options, const std::array<std::string, 2>& plain) {
  const auto& given = options.texts("class_names");
  if (!given.empty() && (given.size() != 2 || given[0] == given[1])) {
    throw options.error("class_names", "must be two different names, such as [\"red\", \"blue\"]");
  }
  for (std::size_t c = 0; c < 2; ++c) names_[c] = lower_snake(given.empty() ? plain[c] : given[c]);
}

BodyClass TwoClasses::ask(const BodyView& bodies, BodyIndex body) const {
  if (const auto* material = std::get_if<ByMaterial>(&rule_)) return material->of_material[bodies.material[body]];
  if (const auto* side = std::get_if<BySide>(&rule_))
    return above(dot(bodies.position[body] - side->point, side->normal), 0.0);
  if (const auto* size = std::get_if<BySize>(&rule_)) return above(2.0 * bodies.radius[body], size->diameter);
  const auto& attribute = std::get<ByAttribute>(rule_);
  return above(bodies.attribute(attribute.column)[body], attribute.threshold);
}

void TwoClasses::look(const BodyView& bodies, double time) {
  of_dynamic_.clear();
  memory_.walk(bodies, [&](BodyIndex i, Remembered& body, bool is_new) {
    if (is_new || time <= at_) body.value = ask(bodies, i);
    of_dynamic_.push_back(body.value);
  });
}

}  // namespace scree
