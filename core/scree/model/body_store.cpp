#include "scree/model/body_store.hpp"

#include <xxhash.h>

#include <algorithm>

#include "scree/base/error.hpp"
#include "scree/base/require.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

template <class T>
void compact(std::vector<T>& column, std::span<const char> keep) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) column[next++] = column[i];
  }
  column.resize(next);
}

template <class T>
std::uint64_t mix(std::uint64_t hash, std::span<const T> values) {
  return XXH3_64bits_withSeed(values.data(), values.size_bytes(), hash);
}

/// Small integers travel through checkpoints as 64-bit ones.
template <class T>
std::vector<std::uint64_t> widen(const std::vector<T>& values) {
  std::vector<std::uint64_t> wide;
  wide.reserve(values.size());
  for (const T value : values) wide.push_back(static_cast<std::uint64_t>(value));
  return wide;
}

template <class T>
std::vector<T> narrow(const std::vector<std::uint64_t>& wide) {
  std::vector<T> values;
  values.reserve(wide.size());
  for (const std::uint64_t value : wide) values.push_back(static_cast<T>(value));
  return values;
}

std::vector<Vec3> column_of(const std::vector<Twist>& twists, Vec3 Twist::*part) {
  std::vector<Vec3> values;
  values.reserve(twists.size());
  for (const Twist& twist : twists) values.push_back(twist.*part);
  return values;
}

std::vector<Twist> twists(const std::vector<Vec3>& linear, const std::vector<Vec3>& angular) {
  if (linear.size() != angular.size()) {
    throw Error{ErrorKind::io, "the checkpoint's columns of bodies differ in length; the file is damaged"};
  }
  std::vector<Twist> values;
  values.reserve(linear.size());
  for (std::size_t i = 0; i < linear.size(); ++i) values.push_back({linear[i], angular[i]});
  return values;
}

}  // namespace

BodyId BodyStore::add(const NewBody& body) {
  id_.push_back(next_id_);
  motion_.push_back(body.motion);
  shape_.push_back(body.shape);
  material_.push_back(body.material);
  position_.push_back(body.pose.position);
  orientation_.push_back(body.pose.orientation);
  velocity_.push_back(body.velocity);
  angular_velocity_.push_back(body.angular_velocity);
  mass_.push_back(body.mass);
  inertia_.push_back(body.inertia);
  radius_.push_back(body.radius);
  collision_group_.push_back(body.collision_group);
  if (!surface_motion_.empty() || body.surface_motion != Twist{}) {
    surface_motion_.resize(id_.size());
    surface_motion_.back() = body.surface_motion;
  }
  attributes_.append_body();
  for (const auto& [column, value] : body.attributes) attributes_.column(column).back() = value;
  return next_id_++;
}

void BodyStore::reserve(std::size_t count) {
  const auto fit = [count](auto&... column) { (column.reserve(count), ...); };
  fit(id_, motion_, shape_, material_, position_, orientation_, velocity_, angular_velocity_, mass_, inertia_, radius_,
      collision_group_);
  if (!surface_motion_.empty()) surface_motion_.reserve(count);
  attributes_.reserve(count);
}

void BodyStore::remove(std::span<const char> remove) {
  SCREE_REQUIRE(remove.size() == size(), "BodyStore::remove needs one flag per body");
  std::vector<char> keep(remove.size());
  std::transform(remove.begin(), remove.end(), keep.begin(), [](char r) { return static_cast<char>(r == 0); });
  compact(id_, keep);
  compact(motion_, keep);
  compact(shape_, keep);
  compact(material_, keep);
  compact(position_, keep);
  compact(orientation_, keep);
  compact(velocity_, keep);
  compact(angular_velocity_, keep);
  compact(mass_, keep);
  compact(inertia_, keep);
  compact(radius_, keep);
  compact(collision_group_, keep);
  if (!surface_motion_.empty()) compact(surface_motion_, keep);
  attributes_.compact(keep);
}

BodyView BodyStore::view() const {
  return {id_,   motion_,  shape_,  material_,    position_,        orientation_,   velocity_, angular_velocity_,
          mass_, inertia_, radius_, &attributes_, collision_group_, surface_motion_};
}

BodyState BodyStore::state() { return {view(), position_, orientation_, velocity_, angular_velocity_}; }

std::int64_t BodyStore::find(BodyId id) const {
  const auto found = std::lower_bound(id_.begin(), id_.end(), id);
  return found != id_.end() && *found == id ? found - id_.begin() : -1;
}

std::uint64_t BodyStore::hash() const {
  std::uint64_t hash = mix(next_id_, std::span{id_});
  hash = mix(hash, std::span{position_});
  hash = mix(hash, std::span{orientation_});
  hash = mix(hash, std::span{velocity_});
  hash = mix(hash, std::span{angular_velocity_});
  hash = mix(hash, std::span{mass_});
  // Only where groups are used, so that a column of zeros counts as none.
  if (std::ranges::any_of(collision_group_, [](CollisionGroup g) { return g != 0; })) {
    hash = mix(hash, std::span{collision_group_});
  }
  if (!surface_motion_.empty()) hash = mix(hash, std::span{surface_motion_});
  // By name: an observer may have declared columns among the others.
  std::vector<AttributeId> columns;
  for (AttributeId id = 0; id < attributes_.count(); ++id) {
    const std::vector<std::string>& writers = attributes_.info(id).writers;
    const auto observes = [](const std::string& writer) { return writer.starts_with("observer:"); };
    if (!std::ranges::all_of(writers, observes)) columns.push_back(id);
  }
  std::ranges::sort(columns, {}, [&](AttributeId id) { return attributes_.info(id).name; });
  for (const AttributeId id : columns) {
    hash = mix(hash, std::span{attributes_.info(id).name});
    hash = mix(hash, attributes_.column(id));
  }
  return hash;
}

void BodyStore::save(StateWriter& out) const {
  out.write("next_id", next_id_);
  out.write("id", std::span<const std::uint64_t>{id_});
  out.write("motion", std::span<const std::uint64_t>{widen(motion_)});
  out.write("shape", std::span<const std::uint64_t>{widen(shape_)});
  out.write("material", std::span<const std::uint64_t>{widen(material_)});
  out.write("position", std::span<const Vec3>{position_});
  out.write("orientation", std::span<const Quat>{orientation_});
  out.write("velocity", std::span<const Vec3>{velocity_});
  out.write("angular_velocity", std::span<const Vec3>{angular_velocity_});
  out.write("mass", std::span<const double>{mass_});
  out.write("inertia", std::span<const Vec3>{inertia_});
  out.write("radius", std::span<const double>{radius_});
  out.write("collision_group", std::span<const std::uint64_t>{widen(collision_group_)});
  out.write("surface_velocity", std::span<const Vec3>{column_of(surface_motion_, &Twist::linear)});
  out.write("surface_angular_velocity", std::span<const Vec3>{column_of(surface_motion_, &Twist::angular)});
  const auto columns = out.group("attributes");
  for (AttributeId c = 0; c < attributes_.count(); ++c) columns->write(attributes_.info(c).name, attributes_.column(c));
}

void BodyStore::load(const StateReader& in) {
  next_id_ = in.integer("next_id");
  id_ = in.integers("id");
  motion_ = narrow<Motion>(in.integers("motion"));
  shape_ = narrow<std::uint32_t>(in.integers("shape"));
  material_ = narrow<std::uint32_t>(in.integers("material"));
  position_ = in.vectors("position");
  orientation_ = in.quaternions("orientation");
  velocity_ = in.vectors("velocity");
  angular_velocity_ = in.vectors("angular_velocity");
  mass_ = in.doubles("mass");
  inertia_ = in.vectors("inertia");
  radius_ = in.doubles("radius");
  collision_group_ = narrow<CollisionGroup>(in.integers("collision_group"));
  surface_motion_ = twists(in.vectors("surface_velocity"), in.vectors("surface_angular_velocity"));
  const auto same = [n = id_.size()](const auto&... column) { return ((column.size() == n) && ...); };
  if (!same(motion_, shape_, material_, position_, orientation_, velocity_, angular_velocity_, mass_, inertia_, radius_,
            collision_group_) ||
      (!surface_motion_.empty() && !same(surface_motion_))) {
    throw Error{ErrorKind::io, "the checkpoint's columns of bodies differ in length; the file is damaged"};
  }
  attributes_.resize(id_.size());
  const auto columns = in.group("attributes");
  for (AttributeId c = 0; c < attributes_.count(); ++c) {
    // A column that an observer added since the checkpoint keeps its initial values.
    if (!columns->has(attributes_.info(c).name)) continue;
    const std::vector<double> values = columns->doubles(attributes_.info(c).name);
    if (values.size() != id_.size()) throw Error{ErrorKind::io, "the checkpoint's attribute columns differ in length"};
    std::copy(values.begin(), values.end(), attributes_.column(c).begin());
  }
}

}  // namespace scree
