// What BallContacts keeps when bodies come and go, and from one run to the next.
#include <algorithm>

#include "ball_contacts.hpp"
#include "scree/state/state_io.hpp"

namespace scree::dem {

void BallContacts::renumber(std::span<const BodyIndex> index) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < list_.pairs.size(); ++p) {
    const BodyPair pair{index[list_.pairs[p].a], index[list_.pairs[p].b]};
    if (pair.a == kGone || pair.b == kGone) continue;
    list_.pairs[kept] = pair;
    list_.place[kept++] = list_.place[p];
  }
  list_.pairs.resize(kept);
  list_.place.resize(kept);
}

void BallContacts::save(StateWriter& out, std::span<const BodyId> ids) const {
  std::vector<std::uint64_t> bodies;
  std::vector<std::uint64_t> leaving;
  std::vector<double> history;
  for (std::size_t p = 0; p < list_.pairs.size(); ++p) {
    const std::uint32_t at = list_.place[p];
    if ((list_.flags[at] & kTouching) == 0) continue;
    leaving.push_back((list_.flags[at] & kLeaving) != 0 ? 1 : 0);
    bodies.push_back(ids[list_.pairs[p].a]);
    bodies.push_back(ids[list_.pairs[p].b]);
    for (std::size_t j = 0; j < history_; ++j) history.push_back(list_.records[stride_ * at + j / 4][j % 4]);
  }
  out.write("ball_bodies", bodies);
  out.write("ball_leaving", leaving);
  out.write("ball_history", history);
}

void BallContacts::load(const StateReader& in, std::span<const BodyId> ids) {
  const std::vector<std::uint64_t> bodies = in.integers("ball_bodies");
  const std::vector<std::uint64_t> leaving = in.integers("ball_leaving");
  const std::vector<double> history = in.doubles("ball_history");
  const std::size_t m = bodies.size() / 2;
  const auto index = [&](BodyId id) { return static_cast<BodyIndex>(std::ranges::lower_bound(ids, id) - ids.begin()); };
  list_.pairs.resize(m), list_.place.resize(m);
  list_.records.assign(stride_ * m, Lanes{});
  list_.flags.assign(m, kTouching);
  list_.before.assign(m, Vec3{});
  for (std::size_t p = 0; p < m; ++p) {
    list_.pairs[p] = {index(bodies[2 * p]), index(bodies[2 * p + 1])};
    list_.place[p] = static_cast<std::uint32_t>(p);
    if (leaving[p] != 0) list_.flags[p] |= kLeaving;
    for (std::size_t j = 0; j < history_; ++j) list_.records[stride_ * p + j / 4][j % 4] = history[history_ * p + j];
  }
}

}  // namespace scree::dem
