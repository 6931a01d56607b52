#include "wear_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "contact_study/contact_motion.hpp"
#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

std::vector<SeriesColumn> columns(const std::vector<std::string>& names) {
  return {{"time", "s"},           {"body", "", names}, {"sliding_volume", "m3"},
          {"impact_volume", "m3"}, {"volume", "m3"},    {"volume_rate", "m3/s"},
          {"mass", "kg"},          {"deepest", "m"},    {"sliding_energy", "J"},
          {"impact_energy", "J"},  {"impacts"}};
}

}  // namespace

WearObserver::WearObserver(const Options& options)
    : options_{options},
      face_options_{static_cast<int>(options.integer("segments")), options.number("plane_size"),
                    options.has("largest_face") ? options.number("largest_face") : 0.0},
      min_impact_speed_{options.number("min_impact_speed")},
      moving_{options.text("frame") == "world"} {}

std::vector<Parameter> WearObserver::parameters() {
  std::vector<Parameter> list{
      Parameter::texts("bodies", "names of the scene bodies that wear").with_at_least_count(1),
      Parameter::number("interval", "s", "simulated time between rows of the table; 0: every step")
          .at_least(0.0)
          .by_default(0.01),
      Parameter::number("field_interval", "s", "simulated time between files of the field; only the end when left out")
          .above(0.0)
          .optional(),
      Parameter::number(
          "largest_face", "m",
          "faces are divided until no edge is longer; when left out, simple shapes into fortieths of their "
          "extent, while meshes and hulls keep their faces")
          .above(0.0)
          .optional(),
      Parameter::number(
          "density", "kg/m3",
          "of what is worn off; when left out that of each body's material, which is 1000 kg/m3 where the "
          "scene states none")
          .above(0.0)
          .optional(),
      Parameter::integer("segments", "of a full circle of round shapes").at_least(8).at_most(512).by_default(64),
      Parameter::number("plane_size", "m",
                        "edge of the square that stands for an unbounded plane; wear beyond it counts "
                        "on the nearest face")
          .above(0.0)
          .by_default(1.0),
      Parameter::number("min_impact_speed", "m/s", "a new contact that closes faster is an impact")
          .above(0.0)
          .by_default(0.05),
      Parameter::choice("frame", {"world", "body"},
                        "in which the field is written: with the moving bodies, or in theirs")
          .by_default("world")};
  for (Parameter& parameter : WearTable::parameters()) list.push_back(std::move(parameter));
  return list;
}

void WearObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  followed_.setup(options_, "bodies", services);
  laws_.setup(options_, services);
  shapes_ = &services.shapes();
  materials_ = &services.materials();
  make_maps(services);
  row_every_ = steps_between(options_.number("interval"), services.time_step());
  field_every_ =
      options_.has("field_interval") ? steps_between(options_.number("field_interval"), services.time_step()) : 0;
  stem_ = result_stem("wear", "wear", services.part_name());
  claim_results(services, stem_, {".csv", "_*.vtp", ".pvd", ".svg", ".png"});
  results_ = results;
  row_volume_.assign(followed_.size(), 0.0);
  body_materials_.assign(followed_.size(), 0);
  table_ = SeriesTable{columns(followed_.names())};
  if (!results.empty()) table_.open(results / (stem_ + ".csv"));
}

std::unique_ptr<FaceMap> WearObserver::map_of(const Shape& shape, const std::string& body) const {
  try {
    return std::make_unique<FaceMap>(*shapes_, shape, face_options_);
  } catch (const TooManyFaces& many) {
    const std::string what = fmt::format(
        "the surface of '{}' is divided into about {:.2g} faces, more than the {} that are "
        "possible; ",
        body, many.count, kMostFaces);
    throw options_.error(
        options_.has("largest_face") ? "largest_face" : "bodies",
        "is refused: " + what +
            (many.proposed > 0.0 ? fmt::format("with largest_face = {:.3g} m they are {}", many.proposed, many.possible)
                                 : "take fewer segments or a coarser mesh"));
  }
}

void WearObserver::make_maps(SceneServices& services) {
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const NamedBody body = services.body(followed_.name(k));
    const std::int64_t shape = shapes_->find(body.shape);
    SCREE_REQUIRE(shape >= 0, "wear: the shape of a body of the scene has a name");
    maps_.push_back(map_of(shapes_->shapes()[static_cast<std::size_t>(shape)], followed_.name(k)));
    if (maps_.back()->size() == 0) {
      throw options_.error("bodies", "names '" + followed_.name(k) + "', which has no surface that anything touches");
    }
    accounts_.emplace_back(maps_.back()->size());
    poses_.push_back(body.pose);
  }
}

void WearObserver::remember_poses(const BodyView& bodies) {
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const BodyIndex i = followed_.index(k);
    if (i == FollowedBodies::kGone) continue;
    poses_[k] = {bodies.position[i], bodies.orientation[i]};
    body_materials_[k] = bodies.material[i];
  }
}

void WearObserver::observe(const Observation& now, Attributes&) {
  followed_.locate(now.bodies);
  remember_poses(now.bodies);
  log_.look(now.bodies, now.contacts);
  followed_.visit(now.contacts, [&](const BodyContact& c) {
    if (acts(now.contacts, c.contact)) wear_by(now, c);
  });
  if (now.step % row_every_ == 0) add_rows(now.time);
  if (field_every_ > 0 && now.step % field_every_ == 0) write_field(now.time, now.step);
}

// Sliding counts what slides, and all the way of an impact; what rests within the cone of friction does not slide, though the
// velocity before the solve has a step of gravity in it.
void WearObserver::wear_by(const Observation& now, const BodyContact& c) {
  const ContactView& contacts = now.contacts;
  const Contact& contact = contacts.contact[c.contact];
  const Vec3 &impulse = contacts.impulse[c.contact], &before = contacts.velocity_before[c.contact];
  const std::uint32_t worn = now.bodies.material[c.self], by = now.bodies.material[c.other];
  const bool impact = log_.is_new(c.contact) && -before.x > min_impact_speed_;
  if (!impact && !slides(impulse, materials_->pair(worn, by).friction)) return;
  const WearPair& law = laws_.pair(worn, by);
  const Vec3 mean = mean_velocity(contacts, c.contact);
  WearAmount amount;
  amount.sliding_volume = archard_volume(law, std::max(0.0, impulse.x) * tangential(mean));
  amount.sliding_energy = -(impulse.y * mean.y + impulse.z * mean.z);
  double impacts = 0.0;
  if (impact) {
    impacts = log_.share(c.contact);
    const double mass = impacts * effective_mass(now.bodies, contact);
    amount.impact_volume = finnie_volume(law, mass, -before.x, tangential(before));
    amount.impact_energy = 0.5 * mass * before.x * before.x;
  }
  const Pose pose = pose_at_contacts(now.bodies, c.self, contacts.age);
  const std::size_t face = maps_[c.slot]->nearest(c.primitive, transform_back(pose, contact.point));
  accounts_[c.slot].add(face, amount, impacts);
}

double WearObserver::density(std::size_t slot) const {
  return options_.has("density") ? options_.number("density") : (*materials_)[body_materials_[slot]].density;
}

double WearObserver::deepest(std::size_t slot) const {
  double depth = 0.0;
  const std::vector<WearAmount>& faces = accounts_[slot].faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (maps_[slot]->areas()[f] > 0.0) depth = std::max(depth, faces[f].volume() / maps_[slot]->areas()[f]);
  }
  return depth;
}

void WearObserver::add_rows(double time) {
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const WearAmount& all = accounts_[k].total();
    const double rate = time > row_time_ ? (all.volume() - row_volume_[k]) / (time - row_time_) : 0.0;
    table_.add(std::array{time, static_cast<double>(k), all.sliding_volume, all.impact_volume, all.volume(), rate,
                          density(k) * all.volume(), deepest(k), all.sliding_energy, all.impact_energy,
                          accounts_[k].impacts()});
    row_volume_[k] = all.volume();
  }
  row_time_ = time;
}

void WearObserver::finish(const Observation& last) {
  if (last.time > row_time_) add_rows(last.time);
  table_.close();
  if (results_.empty()) return;
  if (last.step != last_field_) write_field(last.time, last.step);
  write_figure();
}

void WearObserver::save(StateWriter& out) const {
  table_.save(*out.group("table"));
  log_.save(*out.group("contacts"));
  series_.save(out, "frames");
  out.write("times", std::span<const double>{std::array{marked_, row_time_}});
  out.write("row_volume", std::span<const double>{row_volume_});
  for (std::size_t k = 0; k < followed_.size(); ++k) accounts_[k].save(*out.group("body_" + std::to_string(k)));
}

void WearObserver::load(const StateReader& in) {
  table_.load(*in.group("table"));
  log_.load(*in.group("contacts"));
  series_.load(in, "frames", results_);
  const std::vector<double> times = in.doubles("times");
  marked_ = times.at(0);
  row_time_ = times.at(1);
  row_volume_ = in.doubles("row_volume");
  for (std::size_t k = 0; k < followed_.size(); ++k) accounts_[k].load(*in.group("body_" + std::to_string(k)));
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::WearObserver>(
      "wear", "Wear of named bodies by sliding (Archard) and impacts (Finnie), on every face of their surfaces.",
      scree::WearObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("wear", "1.0.0", &list)};
