#include "scree/simulation/scene_motion.hpp"

#include <algorithm>
#include <string>

#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/validate.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {
namespace {

/// `by`, a function with values of `unit`, or `speed`, of `unit` over seconds.
std::vector<Parameter> way_parameters(const std::string& unit, const char* by, const char* speed) {
  return {TimeFunction::parameter("by", unit, by).optional(),
          TimeFunction::parameter("speed", unit + "/s", speed).optional()};
}

BodyId kinematic_body(const SceneModel& model, const Options& o) {
  const std::string& name = o.text("body");
  const auto found = std::ranges::find(model.bodies, name, &SceneBody::name);
  if (name.empty() || found == model.bodies.end()) {
    std::vector<std::string> names;
    for (const SceneBody& body : model.bodies) {
      if (body.body.motion == Motion::kinematic && !body.name.empty()) names.push_back(body.name);
    }
    throw o.error("body", "is '" + name + "', which is no body of the scene; named kinematic bodies are " +
                              list_of(names) + suggestion(name, names));
  }
  if (found->body.motion != Motion::kinematic) {
    throw o.error("body", "is '" + name + "', which is " + found->options.text("motion") +
                              "; only kinematic bodies move as told, so set its motion = \"kinematic\"");
  }
  for (const char* key : {"velocity", "angular_velocity"}) {
    if (norm(found->options.vector(key)) > 0.0) {
      throw found->options.error(key, "is not zero, but a [[prescribed_motion]] moves body '" + name + "'; keep one");
    }
  }
  return static_cast<BodyId>(found - model.bodies.begin());
}

Vec3 read_axis(const Options& o, const char* key) {
  const Vec3 axis = o.vector(key);
  if (!(norm(axis) > 0.0)) throw o.error(key, "is zero and so no direction; write for example [0.0, 0.0, 1.0]");
  return normalized(axis);
}

Way read_way(const Options& o, const std::string& unit, double step) {
  if (o.has("by") == o.has("speed")) {
    throw o.error(std::string{"needs either 'by', the "} + (unit == "m" ? "way" : "angle") +
                  " as a function of time, or 'speed', its rate, but has " + (o.has("by") ? "both" : "neither"));
  }
  if (o.has("by")) return Way::by(read_time_function(o, "by", unit));
  return Way::at_speed(read_time_function(o, "speed", unit + "/s"), step);
}

PrescribedMotion read_motion(const SceneModel& model, const Options& o) {
  const BodyId body = kinematic_body(model, o);
  const Pose& written = model.bodies[body].body.pose;
  const std::vector<Options>& shifts = o.tables("translation");
  const std::vector<Options>& turns = o.tables("rotation");
  const bool has_parts = !shifts.empty() || !turns.empty();
  if (has_parts == o.has("path")) {
    throw o.error(has_parts
                      ? "has a 'path' beside 'translation' or 'rotation'; a path says the whole motion, so keep one"
                      : "needs at least one of 'translation', 'rotation' and 'path'");
  }
  if (o.has("path")) return {body, written, PosePath::read(o.path("path"), o.location("path"))};
  const double step = model.simulation.number("time_step");
  std::vector<MotionPart> parts;
  for (const Options& shift : shifts) parts.push_back({read_axis(shift, "along"), read_way(shift, "m", step), {}});
  for (const Options& turn : turns) {
    const Vec3 through = turn.has("through") ? turn.vector("through") : written.position;
    parts.push_back({read_axis(turn, "about"), read_way(turn, "rad", step), through});
  }
  return {body, written, std::move(parts)};
}

}  // namespace

std::vector<Parameter> prescribed_motion_parameters() {
  std::vector<Parameter> shift{Parameter::vector("along", "1", "direction, world frame")};
  std::ranges::move(way_parameters("m", "way from the written position", "rate of the way, which is 0 at t = 0"),
                    std::back_inserter(shift));
  std::vector<Parameter> turn{
      Parameter::vector("about", "1", "axis, world frame"),
      Parameter::vector("through", "m", "a point of the axis; the body's position when left out").optional()};
  std::ranges::move(way_parameters("rad", "angle from the written rotation", "rate of the angle, which is 0 at t = 0"),
                    std::back_inserter(turn));
  return {
      Parameter::text("body", "name of a kinematic body"),
      Parameter::tables("translation", std::move(shift), "shifts, which add up").optional(),
      Parameter::tables("rotation", std::move(turn), "turns about fixed axes, one after the other, before the shifts")
          .optional(),
      Parameter::path("path",
                      "text file with a row of time [s], x, y, z [m] and, if it turns, qw, qx, qy, qz a line, in "
                      "place of the others")
          .optional()};
}

void read_prescribed_motions(const SceneTable& root, SceneModel& model) {
  for (const SceneTable& table : root.tables("prescribed_motion")) {
    Options o = validate(table, scene_section("prescribed_motion").parameters, "[[prescribed_motion]]");
    PrescribedMotion motion = read_motion(model, o);
    if (std::ranges::find(model.motions, motion.body(), &PrescribedMotion::body) != model.motions.end()) {
      throw o.error("body", "is '" + o.text("body") +
                                "', which an earlier [[prescribed_motion]] moves already; one can hold " +
                                "several translations and rotations");
    }
    model.motions.push_back(std::move(motion));
    model.motion_options.push_back(std::move(o));
  }
  for (PrescribedMotion& motion : model.motions) model.bodies[motion.body()].body.pose = motion.pose(0.0);
}

}  // namespace scree
