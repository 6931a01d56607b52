#include "scree/simulation/scene_machine.hpp"

#include <algorithm>
#include <cmath>

#include "scree/collision/collision_filter.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/validate.hpp"
#include "scree/machine/joint_type.hpp"

namespace scree {
namespace {

std::string in_quotes(const std::string& word) { return "'" + word + "'"; }

/// z along `axis`, x as near to `reference` as it can be.
Quat frame_orientation(const Options& o) {
  const Vec3 z = normalized(o.vector("axis"));
  if (z == Vec3{}) throw o.error("axis", "is zero and so has no direction; give it one, such as [0, 0, 1]");
  if (!o.has("reference")) return rotation_between({0, 0, 1}, z);
  const Vec3 given = o.vector("reference"), x = normalized(given - dot(given, z) * z);
  if (!(norm(given - dot(given, z) * z) > 1e-9 * norm(given))) {
    throw o.error("reference", "has no part that is square to `axis`; give a direction across the axis");
  }
  const Quat to_z = rotation_between({0, 0, 1}, z);
  const Vec3 now = rotate(to_z, {1, 0, 0});
  const double angle = std::atan2(dot(cross(now, x), z), dot(now, x));
  return normalized(from_rotation_vector(angle * z) * to_z);
}

/// One entry of `between`.
struct WrittenEnd {
  BodyId body = kWorld;
  bool has_frame = false;
  Pose frame;  ///< in the body frame
};

/// Reads one scene's machine.
class MachineReader {
 public:
  explicit MachineReader(SceneModel& model) : model_{model} {}

  void read_joint(const Options& o);
  void read_motor(const Options& o);
  void read_coupling(const Options& o);

 private:
  [[nodiscard]] WrittenEnd end_of(const Options& o, const std::string& written) const;
  [[nodiscard]] const SceneBody& body(BodyId id) const { return model_.bodies[id]; }
  [[nodiscard]] std::vector<std::string> body_names() const;
  void place(const Options& o, std::array<WrittenEnd, 2> ends, Joint& joint) const;
  void check_ends(const Options& o, const Joint& joint) const;
  [[nodiscard]] CoordinateLaw law(const Options& o, const Joint& joint, Coordinate c) const;
  [[nodiscard]] std::uint32_t joint_by_name(const Options& o, const char* key, const std::string& name) const;
  void check_name(const Options& o) const;
  [[nodiscard]] Coordinate only_coordinate(const Options& o, std::uint32_t joint) const;
  void check_coupled_bodies(const Options& o, const Coupling& c) const;

  SceneModel& model_;
};

std::vector<std::string> MachineReader::body_names() const {
  std::vector<std::string> names{"world"};
  for (const SceneBody& b : model_.bodies) {
    if (!b.name.empty()) names.push_back(b.name);
  }
  return names;
}

WrittenEnd MachineReader::end_of(const Options& o, const std::string& written) const {
  if (written == "world") {
    const auto same = std::ranges::find(model_.bodies, "world", &SceneBody::name);
    if (same == model_.bodies.end()) return {};
    throw o.error("between", "names 'world', but a body has that name; give the body another one");
  }
  for (BodyId id = 0; id < model_.bodies.size(); ++id) {
    const SceneBody& b = body(id);
    if (b.name.empty()) continue;
    if (b.name == written) return {id, false, {}};
    if (!written.starts_with(b.name + ".")) continue;
    const std::string frame = written.substr(b.name.size() + 1);
    std::vector<std::string> names;
    for (const Options& f : b.options.tables("frames")) {
      names.push_back(f.text("name"));
      if (f.text("name") != frame) continue;
      const Pose as_written{f.vector("position"), frame_orientation(f)};
      return {id, true, inverse(model_.shapes.body_to_shape(b.body.shape)) * as_written};
    }
    throw o.error("between", "names " + in_quotes(written) + ", but body " + in_quotes(b.name) + " has no frame " +
                                 in_quotes(frame) + "; its frames are " + list_of(names) + suggestion(frame, names));
  }
  throw o.error("between", "names " + in_quotes(written) + ", which is no body of the scene; named bodies are " +
                               list_of(body_names()) + suggestion(written, body_names()));
}

// Ends without a frame of their own get that of the other end, or the one that the joint describes in the world.
void MachineReader::place(const Options& o, std::array<WrittenEnd, 2> ends, Joint& joint) const {
  const auto pose_of_body = [&](const WrittenEnd& e) { return e.body == kWorld ? Pose{} : body(e.body).body.pose; };
  const bool any = ends[0].has_frame || ends[1].has_frame, all = ends[0].has_frame && ends[1].has_frame;
  if (!o.has("position") && !any) {
    throw o.error("joint " + in_quotes(joint.name) +
                  " has no place; give its `position` in the world, or name frames of its bodies in `between`");
  }
  for (const char* key : {"position", "axis", "reference"}) {
    if (all && o.given(key)) {
      throw o.error(key,
                    "is given, but both ends of joint " + in_quotes(joint.name) + " name frames; keep one of the two");
    }
  }
  Pose world{o.has("position") ? o.vector("position") : Vec3{}, frame_orientation(o)};
  if (any && !o.has("position")) {
    const WrittenEnd& known = ends[ends[0].has_frame ? 0 : 1];
    world = pose_of_body(known) * known.frame;
  }
  for (std::size_t k = 0; k < 2; ++k) {
    JointEnd& end = k == 0 ? joint.a : joint.b;
    end.body = ends[k].body;
    Pose here = world;
    if (k == 1 && o.has("position_b")) here.position = o.vector("position_b");
    end.frame = ends[k].has_frame ? ends[k].frame : inverse(pose_of_body(ends[k])) * here;
  }
  if (o.has("position_b") && joint.type->equations.size() + (joint.type->stretches ? 1 : 0) != 1) {
    throw o.error("position_b", "belongs to distance and spring_damper; the points of a " +
                                    std::string{joint.type->name} + " joint are one");
  }
}

void MachineReader::check_ends(const Options& o, const Joint& joint) const {
  if (joint.a.body == joint.b.body) {
    throw o.error("between", "names " + in_quotes(o.texts("between")[0]) + " and " + in_quotes(o.texts("between")[1]) +
                                 ", one and the same; a joint ties two bodies");
  }
  const auto moves = [&](const JointEnd& e) { return e.body != kWorld && body(e.body).body.motion == Motion::dynamic; };
  if (moves(joint.a) || moves(joint.b)) return;
  throw o.error("between", "names " + in_quotes(o.texts("between")[0]) + " and " + in_quotes(o.texts("between")[1]) +
                               ", and no force moves either; set motion = \"dynamic\" for one of them");
}

CoordinateLaw MachineReader::law(const Options& o, const Joint& joint, Coordinate c) const {
  const char* key = c == Coordinate::rotation ? "rotation" : "translation";
  CoordinateLaw law;
  if (!o.has(key)) return law;
  if (!joint.type->has(c)) {
    throw o.error(key, "is given, but a " + std::string{joint.type->name} + " joint has no " + key);
  }
  const Options& t = o.table(key);
  law.spring = {t.number("stiffness"), t.number("damping")};
  law.rest = t.number("rest");
  law.preload = t.number("preload");
  law.stop_restitution = t.number("restitution");
  if (law.preload != 0.0 && !law.spring.acts()) {
    throw t.error("preload", "needs a spring: give `stiffness` or `damping`, or use a motor with a constant effort");
  }
  if (t.has("lower")) law.lower = t.number("lower");
  if (t.has("upper")) law.upper = t.number("upper");
  if (law.lower > law.upper) throw t.error("lower", "lies above `upper`; exchange them");
  return law;
}

void MachineReader::check_name(const Options& o) const {
  const std::string& name = o.text("name");
  const auto taken = [&](const auto& list) {
    return std::ranges::any_of(list, [&](const auto& e) { return e.name == name; });
  };
  if (name.empty()) throw o.error("name", "is empty; joints, motors and couplings need one");
  const MachineDescription& m = model_.machine;
  if (taken(m.joints) || taken(m.motors) || taken(m.couplings)) {
    throw o.error("name", "is that of an earlier joint, motor or coupling, " + in_quotes(name) + "; names must differ");
  }
}

void MachineReader::read_joint(const Options& o) {
  check_name(o);
  Joint joint{.name = o.text("name"), .type = find_joint_type(o.text("type"))};
  const std::vector<std::string>& between = o.texts("between");
  place(o, {end_of(o, between[0]), end_of(o, between[1])}, joint);
  check_ends(o, joint);
  const auto spring = [&](const char* compliance, const char* damping) {
    const double c = o.number(compliance), d = o.number(damping);
    if (c == 0.0 && d > 0.0) {
      throw o.error(damping, std::string{"acts with a compliance only; set `"} + compliance + "` above zero");
    }
    return SpringLaw{c > 0.0 ? 1.0 / c : 0.0, d};
  };
  joint.shift = spring("compliance", "damping");
  joint.tilt = spring("angular_compliance", "angular_damping");
  const bool distance = joint.type->name == "distance";
  if (o.has("distance") && !distance) throw o.error("distance", "belongs to joints of type distance");
  if (distance) {
    const auto point = [&](const JointEnd& e) {
      return transform(e.body == kWorld ? Pose{} : body(e.body).body.pose, e.frame.position);
    };
    joint.distance = o.has("distance") ? o.number("distance") : norm(point(joint.b) - point(joint.a));
    if (joint.distance == 0.0) {
      throw o.error("joint " + in_quotes(joint.name) +
                    " has a distance of zero; set `position_b`, or make it spherical");
    }
  }
  for (const Coordinate c : {Coordinate::rotation, Coordinate::translation}) {
    joint.law[static_cast<std::size_t>(c)] = law(o, joint, c);
  }
  if (o.has("breaking_force")) joint.breaking_force = o.number("breaking_force");
  if (o.has("breaking_torque")) joint.breaking_torque = o.number("breaking_torque");
  model_.machine.joints.push_back(std::move(joint));
}

std::uint32_t MachineReader::joint_by_name(const Options& o, const char* key, const std::string& name) const {
  std::vector<std::string> names;
  const auto& joints = model_.machine.joints;
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (joints[j].name == name) return j;
    names.push_back(joints[j].name);
  }
  throw o.error(key, "names " + in_quotes(name) + ", which is no joint of the scene; it has " + list_of(names) +
                         suggestion(name, names));
}

void MachineReader::read_motor(const Options& o) {
  struct Way {
    const char* key;
    const char* unit;
    Coordinate coordinate;
    Drive drive;
  };
  static constexpr std::array<Way, 6> kWays{{{"angle", "rad", Coordinate::rotation, Drive::position},
                                             {"angular_speed", "rad/s", Coordinate::rotation, Drive::speed},
                                             {"torque", "N m", Coordinate::rotation, Drive::effort},
                                             {"position", "m", Coordinate::translation, Drive::position},
                                             {"speed", "m/s", Coordinate::translation, Drive::speed},
                                             {"force", "N", Coordinate::translation, Drive::effort}}};
  check_name(o);
  Motor motor{.name = o.text("name"), .joint = joint_by_name(o, "joint", o.text("joint"))};
  const Way* chosen = nullptr;
  for (const Way& way : kWays) {
    if (!o.has(way.key)) continue;
    if (chosen != nullptr) {
      throw o.error(way.key, std::string{"and `"} + chosen->key + "` are both given for motor " +
                                 in_quotes(motor.name) + "; a motor imposes one of them");
    }
    chosen = &way;
  }
  if (chosen == nullptr) {
    throw o.error("motor " + in_quotes(motor.name) +
                  " imposes nothing; give one of angle, angular_speed, torque, position, speed, force");
  }
  const Joint& joint = model_.machine.joints[motor.joint];
  motor.coordinate = chosen->coordinate;
  motor.drive = chosen->drive;
  const bool turns = motor.coordinate == Coordinate::rotation;
  if (!joint.type->has(motor.coordinate)) {
    throw o.error(chosen->key, "drives a " + std::string{turns ? "rotation" : "translation"} + ", which joint " +
                                   in_quotes(joint.name) + " of type " + std::string{joint.type->name} +
                                   " does not have");
  }
  for (const Motor& other : model_.machine.motors) {
    if (other.joint != motor.joint || other.coordinate != motor.coordinate) continue;
    throw o.error("joint", "is " + in_quotes(joint.name) + ", whose " + (turns ? "rotation" : "translation") +
                               " motor " + in_quotes(other.name) +
                               " drives already; two would contradict each other, keep one");
  }
  const char* limit = turns ? "torque_limit" : "force_limit";
  const char* other_limit = turns ? "force_limit" : "torque_limit";
  if (o.has(other_limit)) {
    throw o.error(other_limit, "does not fit a motor of a " + std::string{turns ? "rotation" : "translation"} +
                                   "; give `" + limit + "`");
  }
  if (o.has(limit)) motor.limit = o.number(limit);
  const CoordinateLaw& law = joint.along(motor.coordinate);
  const bool has_stops = std::isfinite(law.lower) || std::isfinite(law.upper);
  if (has_stops && !std::isfinite(motor.limit) && motor.drive != Drive::effort) {
    throw o.error(chosen->key, "imposes a motion on joint " + in_quotes(joint.name) +
                                   ", which has stops, and would break through them; give the motor a `" + limit + "`");
  }
  motor.value = read_time_function(o, chosen->key, chosen->unit);
  model_.machine.motors.push_back(std::move(motor));
}

Coordinate MachineReader::only_coordinate(const Options& o, std::uint32_t joint) const {
  const JointType& type = *model_.machine.joints[joint].type;
  const bool turns = type.has(Coordinate::rotation), slides = type.has(Coordinate::translation);
  if (turns != slides) return turns ? Coordinate::rotation : Coordinate::translation;
  throw o.error("joints", "names " + in_quotes(model_.machine.joints[joint].name) + ", a " + std::string{type.name} +
                              (turns ? " joint, which turns and slides; say with `along` which of the two counts"
                                     : " joint, which neither turns about an axis nor slides along one"));
}

void MachineReader::read_coupling(const Options& o) {
  check_name(o);
  const std::vector<std::string>& names = o.texts("joints");
  Coupling c{.name = o.text("name"),
             .first = joint_by_name(o, "joints", names[0]),
             .second = joint_by_name(o, "joints", names[1])};
  const auto along = [&](std::size_t k, std::uint32_t joint) {
    if (!o.has("along")) return only_coordinate(o, joint);
    const std::string& word = o.texts("along")[k];
    if (word != "rotation" && word != "translation") {
      throw o.error("along", "says " + in_quotes(word) + "; valid are 'rotation' and 'translation'");
    }
    const Coordinate coordinate = word == "rotation" ? Coordinate::rotation : Coordinate::translation;
    if (model_.machine.joints[joint].type->has(coordinate)) return coordinate;
    throw o.error("along", "says " + in_quotes(word) + " of joint " + in_quotes(names[k]) + ", which has none");
  };
  c.of_first = along(0, c.first);
  c.of_second = along(1, c.second);
  if (c.first == c.second && c.of_first == c.of_second) {
    throw o.error("joints", "names one joint twice; a screw couples its 'rotation' with its 'translation'");
  }
  const bool first_turns = c.of_first == Coordinate::rotation, second_turns = c.of_second == Coordinate::rotation;
  const char* unit = first_turns == second_turns ? "1" : (first_turns ? "m/rad" : "rad/m");
  c.ratio = o.number_in("ratio", unit);
  check_coupled_bodies(o, c);
  model_.machine.couplings.push_back(std::move(c));
}

void MachineReader::check_coupled_bodies(const Options& o, const Coupling& c) const {
  std::vector<BodyId> moving;
  for (const std::uint32_t j : {c.first, c.second}) {
    for (const JointEnd* e : {&model_.machine.joints[j].a, &model_.machine.joints[j].b}) {
      if (e->body == kWorld || body(e->body).body.motion != Motion::dynamic) continue;
      if (std::ranges::find(moving, e->body) == moving.end()) moving.push_back(e->body);
    }
  }
  if (moving.size() <= 2) return;
  throw o.error("joints", "couples " + std::to_string(moving.size()) +
                              " bodies that forces move; at most two can be: let the joints' common frame be fixed, "
                              "kinematic or the world");
}

}  // namespace

void read_machine(const SceneTable& root, SceneModel& model) {
  MachineReader reader{model};
  const auto each = [&](const char* section, auto&& read) {
    for (const SceneTable& table : root.tables(section)) {
      Options o = validate(table, scene_section(section).parameters, "[[" + std::string{section} + "]]");
      read(o);
      model.machine_options.emplace_back(section, std::move(o));
    }
  };
  each("joint", [&](const Options& o) { reader.read_joint(o); });
  each("motor", [&](const Options& o) { reader.read_motor(o); });
  each("coupling", [&](const Options& o) { reader.read_coupling(o); });
}

}  // namespace scree
