#include "tracker.hpp"

#include <algorithm>
#include <bit>

#include "scree/base/error.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

Tracker::Tracker(std::size_t categories, Categorise categorise, CategoriseRemoved categorise_removed)
    : categories_{categories},
      categorise_{std::move(categorise)},
      categorise_removed_{std::move(categorise_removed)},
      fed_{categories, 1},
      binned_{categories, 1} {}

void Tracker::lose(const std::string& sink, const std::string& reason, CategoryMask mask, double mass) {
  auto loss = std::find_if(losses_.begin(), losses_.end(),
                           [&](const Loss& known) { return known.sink == sink && known.reason == reason; });
  if (loss == losses_.end()) loss = losses_.insert(loss, {sink, reason, TallyTable{categories_, 1}});
  loss->amounts.add(mask, 0, mass);
}

// Bodies that sinks took: a loss, unless they had come into a bin before.
void Tracker::account_removed(std::span<const RemovedBody> removed) {
  constexpr std::int64_t kAccounted = 1;  // any state of a binned body: nothing more will be counted
  for (const RemovedBody& gone : removed) {
    const auto known = std::lower_bound(tracked_.begin(), tracked_.end(), gone.id,
                                        [](const Tracked& body, BodyId id) { return body.id < id; });
    if (known == tracked_.end() || known->id != gone.id) {
      // Ids grow: an unknown body below was accounted for already, before a checkpoint was read, say.
      if (gone.id < next_unseen_) continue;
      next_unseen_ = gone.id + 1;
      const CategoryMask mask = categorise_removed_(gone.material);
      fed_.add(mask, 0, gone.mass);
      lose(gone.sink, gone.reason, mask, gone.mass);
    } else if (known->state <= 0) {
      lose(gone.sink, gone.reason, known->mask, known->mass);
      known->state = kAccounted;
    }
  }
}

Tracker::Tracked Tracker::first_seen(const Observation& now, BodyIndex body) {
  const BodyView& bodies = now.bodies;
  const CategoryMask mask = categorise_(bodies, body);
  fed_.add(mask, 0, bodies.mass[body]);
  next_unseen_ = std::max(next_unseen_, bodies.id[body] + 1);
  // Fed at the beginning of this step: it came from where its velocity says.
  const double passed = now.step == 0 ? 0.0 : now.dt;
  return {bodies.id[body], bodies.position[body] - passed * bodies.velocity[body], bodies.mass[body], mask, 0};
}

void Tracker::step(Tracked& body, const Vec3& position, const Observation& now, const Collector& collector,
                   std::vector<Binned>& binned) {
  if (body.state <= 0) {
    if (const auto crossing = collector.crossing(body.position, position)) {
      const std::int64_t bin = collector.bin(*crossing);
      body.state = bin < 0 ? -1 : bin + 1;
      if (bin >= 0) {
        binned_.add(body.mask, 0, body.mass);
        const double time = now.time - (1.0 - crossing->fraction) * now.dt;
        binned.push_back({static_cast<std::size_t>(bin), crossing->a, time, body.mask, body.mass});
      }
    }
  }
  body.position = position;
}

void Tracker::look(const Observation& now, const Collector& collector, std::vector<Binned>& binned) {
  account_removed(now.removed);
  const auto vanished = [&](const Tracked& body) {
    if (body.state <= 0) lose("", "vanished without a sink", body.mask, body.mass);
  };
  next_.clear();
  auto known = tracked_.begin();  // both lists ascend by id: one walk meets every body
  for (BodyIndex i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies.motion[i] != Motion::dynamic) continue;
    for (; known != tracked_.end() && known->id < now.bodies.id[i]; ++known) vanished(*known);
    const bool is_known = known != tracked_.end() && known->id == now.bodies.id[i];
    next_.push_back(is_known ? *known++ : first_seen(now, i));
    step(next_.back(), now.bodies.position[i], now, collector, binned);
  }
  std::for_each(known, tracked_.end(), vanished);
  tracked_.swap(next_);
}

void Tracker::write_column(const BodyView& bodies, std::span<double> column) const {
  auto known = tracked_.begin();
  for (std::size_t i = 0; i < bodies.size() && known != tracked_.end(); ++i) {
    if (known->id == bodies.id[i]) column[i] = static_cast<double>(known++->state);
  }
}

Tally Tracker::lost(std::size_t category) const {
  Tally total;
  for (const Loss& loss : losses_) total += loss.amounts.at(category);
  return total;
}

TallyTable Tracker::in_flight() const {
  TallyTable amounts{categories_, 1};
  for (const Tracked& body : tracked_) {
    if (body.state <= 0) amounts.add(body.mask, 0, body.mass);
  }
  return amounts;
}

void Tracker::save(StateWriter& out) const {
  std::vector<std::uint64_t> id, mask, state;
  std::vector<Vec3> position;
  std::vector<double> mass;
  for (const Tracked& body : tracked_) {
    id.push_back(body.id);
    position.push_back(body.position);
    mass.push_back(body.mass);
    mask.push_back(body.mask);
    state.push_back(static_cast<std::uint64_t>(body.state + 1));  // -1 becomes 0
  }
  out.write("id", id);
  out.write("position", position);
  out.write("mass", mass);
  out.write("mask", mask);
  out.write("state", state);
  fed_.save(out, "fed");
  binned_.save(out, "binned");
  out.write("next_unseen", next_unseen_);
  out.write("losses", std::uint64_t{losses_.size()});
  for (std::size_t k = 0; k < losses_.size(); ++k) {
    const auto group = out.group("loss_" + std::to_string(k));
    group->write("sink", losses_[k].sink);
    group->write("reason", losses_[k].reason);
    losses_[k].amounts.save(*group, "amounts");
  }
}

void Tracker::load(const StateReader& in) {
  const auto id = in.integers("id"), mask = in.integers("mask"), state = in.integers("state");
  const auto position = in.vectors("position");
  const auto mass = in.doubles("mass");
  if (mask.size() != id.size() || state.size() != id.size() || position.size() != id.size() ||
      mass.size() != id.size()) {
    throw Error{ErrorKind::io, "the bins in the checkpoint are damaged: their columns differ in length."};
  }
  tracked_.clear();
  for (std::size_t i = 0; i < id.size(); ++i) {
    tracked_.push_back({id[i], position[i], mass[i], mask[i], static_cast<std::int64_t>(state[i]) - 1});
  }
  fed_.load(in, "fed");
  binned_.load(in, "binned");
  next_unseen_ = in.integer("next_unseen");
  losses_.clear();
  for (std::uint64_t k = 0; k < in.integer("losses"); ++k) {
    const auto group = in.group("loss_" + std::to_string(k));
    losses_.push_back({group->text("sink"), group->text("reason"), TallyTable{categories_, 1}});
    losses_.back().amounts.load(*group, "amounts");
  }
}

}  // namespace scree
