#include "scree/ccp/sweep/cone_sweep.hpp"

#include "scree/ccp/block_rows.hpp"

namespace scree::sweep {
namespace {

/// Where row i of a cone of 5 or 6 rows is in a group.
std::size_t place(std::size_t rows, std::size_t i) { return rows == 5 && i > 2 ? i + 1 : i; }

/// A cone of 5 or 6 rows, that something can move, whose rows are those of a contact.
bool fits(const CcpProblem& problem, const BlockSteps& steps, const CcpBlock& block) {
  if (block.kind != CcpKind::cone || block.rows < 5 || block.a == block.b || !problem.matrix.empty()) return false;
  if (!(steps.stiffness()[block.first_row] > 0.0)) return false;
  const std::span<const CcpRow> rows = jacobian_of(problem, block);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CcpRow& row = rows[i];
    if (!(row.a.linear == -row.b.linear)) return false;
    if (i > 2 && !(row.b.linear == Vec3{} && row.a.angular == -row.b.angular)) return false;
  }
  return true;
}

void put_lane(Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; }

void load(const ConeGroup& group, std::span<const double> rows, ConeRows& out) {
  for (int lane = 0; lane < 4; ++lane) {
    const auto k = static_cast<std::size_t>(lane);
    if (group.row[k] == kNoContact) continue;
    const double* const from = rows.data() + group.row[k];
    out[0][lane] = from[0], out[1][lane] = from[1], out[2][lane] = from[2];
    const std::size_t rest = group.rows[k] - 2;
    out[3][lane] = group.rows[k] == 6 ? from[3] : 0.0;
    out[4][lane] = from[rest], out[5][lane] = from[rest + 1];
  }
}

void store(const ConeGroup& group, const ConeRows& from, std::span<double> rows) {
  for (int lane = 0; lane < 4; ++lane) {
    const auto k = static_cast<std::size_t>(lane);
    if (group.row[k] == kNoContact) continue;
    double* const to = rows.data() + group.row[k];
    to[0] = from[0][lane], to[1] = from[1][lane], to[2] = from[2][lane];
    if (group.rows[k] == 6) to[3] = from[3][lane];
    const std::size_t rest = group.rows[k] - 2;
    to[rest] = from[4][lane], to[rest + 1] = from[5][lane];
  }
}

}  // namespace

// Cones are grouped as contacts of the same bodies would be.
void ConeSweep::bind(const CcpProblem& problem, ContactSweep& contacts, const BlockSteps& steps,
                     std::vector<std::uint32_t>& others) {
  contacts_ = &contacts;
  groups_.clear();
  others.clear();
  std::vector<std::uint32_t> cones;
  std::vector<CcpContact> pairs;
  for (std::uint32_t k = 0; k < problem.blocks.size(); ++k) {
    const CcpBlock& block = problem.blocks[k];
    const bool taken = fits(problem, steps, block);
    (taken ? cones : others).push_back(k);
    if (taken) pairs.push_back({{}, {}, {}, 0.0, block.a, block.b});
  }
  if (cones.empty()) return;
  CcpProblem alike;
  alike.inverse_mass = problem.inverse_mass;
  alike.contacts = pairs;
  Sequence sequence;
  sequence.build_spread(alike);
  Grouping grouping;
  grouping.build(alike, sequence);
  groups_.assign(grouping.groups.size(), ConeGroup{});
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    ConeGroup& group = groups_[at];
    group.a.fill(static_cast<std::uint32_t>(problem.bodies()));
    group.b = group.a;
    group.row.fill(kNoContact);
    group.d_n = group.d_t = group.d_s = group.d_r = Lanes{1.0, 1.0, 1.0, 1.0};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const std::uint32_t member = grouping.groups[at][lane];
      if (member != kNoContact) put(problem, steps, cones[member], group, static_cast<int>(lane));
    }
  }
}

void ConeSweep::put(const CcpProblem& problem, const BlockSteps& steps, std::size_t k, ConeGroup& group,
                    int lane) const {
  const CcpBlock& block = problem.blocks[k];
  const std::size_t n = block.rows;
  const auto at = static_cast<std::size_t>(lane);
  if (problem.inverse_mass[block.a] > 0.0) group.a[at] = block.a;
  if (problem.inverse_mass[block.b] > 0.0) group.b[at] = block.b;
  group.row[at] = block.first_row, group.rows[at] = block.rows;
  const std::span<const double> d = steps.stiffness().subspan(block.first_row, n), a = steps.matrix(k);
  group.d_n[lane] = d[0], group.d_t[lane] = d[1], group.d_r[lane] = d[n - 1];
  group.friction[lane] = block.friction, group.rolling[lane] = block.rolling;
  if (n == 6) group.d_s[lane] = d[3], group.spinning[lane] = block.spinning;
  const std::span<const CcpRow> rows = jacobian_of(problem, block);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t p = place(n, i);
    if (i < 3) {
      put_lane(group.along[p], lane, rows[i].b.linear);
      put_lane(group.turn_a[p], lane, rows[i].a.angular);
      put_lane(group.turn_b[p], lane, rows[i].b.angular);
    } else {
      put_lane(group.turn[p - 3], lane, rows[i].b.angular);
    }
    for (std::size_t j = 0; j < n; ++j) group.matrix[6 * p + place(n, j)][lane] = a[i * n + j];
  }
}

void ConeSweep::sweep(bool backward, const BlockSteps& steps, std::span<const double> r,
                      std::span<const double> compliance, std::span<double> g) {
  if (groups_.empty()) return;
  constexpr std::size_t kAhead = 3;
  const std::size_t count = groups_.size();
  const auto at = [&](std::size_t k) { return backward ? count - 1 - k : k; };
  contacts_->with_layout([&]<bool isotropic, bool compliant>(const Layout<isotropic, compliant>& layout) {
    Body* const bodies = layout.bodies;
    for (std::size_t k = 0; k < count; ++k) {
      if (k + kAhead < count) {
        prefetch_bodies(bodies, groups_[at(k + kAhead)].a);
        prefetch_bodies(bodies, groups_[at(k + kAhead)].b);
      }
      const ConeGroup& group = groups_[at(k)];
      Four a = gather(bodies, group.a), b = gather(bodies, group.b);
      ConeRows u, x{}, extra{};
      velocities_of(group, a, b, u);
      load(group, g, x);
      load(group, r, extra);
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += extra[i];
      if (!compliance.empty()) {
        load(group, compliance, extra);
        for (std::size_t i = 0; i < u.size(); ++i) u[i] += extra[i] * x[i];
      }
      ConeRows change = x;
      step_group(group, steps.relaxation(), steps.cone_steps(), BlockSteps::kSmallChange, u, x);
      for (std::size_t i = 0; i < u.size(); ++i) change[i] = x[i] - change[i];
      store(group, x, g);
      push_group<isotropic>(group, change, layout.inertias, a, b);
      scatter(a, group.a, bodies);
      scatter(b, group.b, bodies);
    }
  });
}

}  // namespace scree::sweep
