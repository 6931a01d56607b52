#include "scree/ccp/packed/packed_problem.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::packed {
namespace {

void put(Lanes3& lanes, std::size_t lane, const Vec3& v) {
  lanes.x[lane] = v.x;
  lanes.y[lane] = v.y;
  lanes.z[lane] = v.z;
}

Vec3 get(const Lanes3& lanes, std::size_t lane) { return {lanes.x[lane], lanes.y[lane], lanes.z[lane]}; }

/// n . N_ii n, the normal's own part of the diagonal block [1/kg].
double normal_diagonal(const CcpProblem& problem, std::size_t i) {
  const CcpContact& c = problem.contacts[i];
  const Vec3 a = cross(c.arm_a, c.normal), b = cross(c.arm_b, c.normal);
  double sum = problem.inverse_mass[c.a] + problem.inverse_mass[c.b] + dot(a, problem.inverse_inertia[c.a] * a) +
               dot(b, problem.inverse_inertia[c.b] * b);
  if (!problem.compliance.empty()) sum += problem.compliance[3 * i];
  return sum;
}

/// A metric as it is stored: any positive number near enough will do.
float stored(double mass) { return static_cast<float>(std::clamp(mass, 1e-30, 1e30)); }

/// Contact `lane` of group `at` of a run of contacts first .. last - 1; >= last: none.
std::size_t contact_at(std::size_t first, std::size_t last, std::size_t at, std::size_t lane) {
  const std::size_t quarter = (last - first + 3) / 4, within = at - first / 4;
  return first + lane * quarter + within;
}

}  // namespace

void PackedProblem::build(const DelassusOperator& delassus, Scaling scaling) {
  delassus_ = &delassus;
  const CcpProblem& p = problem();
  SCREE_REQUIRE(delassus.partition().slot_count() <= kMostSlots,
                "PackedProblem: more bodies than 32-bit offsets reach");
  const std::size_t groups = (p.contacts.size() + 3) / 4;
  groups_.resize(groups);
  scale_.resize(groups);
  compliance_.assign(p.compliance.empty() ? 0 : groups, GroupCompliance{});
  slots_.assign(delassus.partition().slot_count(), Slot{});
  row_mass_.resize(p.rows() - p.contact_rows());
  block_metric_.resize(p.blocks.size());
  looks_.resize(runs());
  build_bodies();
  double mean = 0.0;
  for (const double trace : delassus.traces()) mean += trace;
  mean /= static_cast<double>(std::max<std::size_t>(p.rows(), 1));
  delassus.for_chunks(p.contacts.size(),
                      [&](std::size_t first, std::size_t last) { build_run(first, last, scaling, mean); });
  for (std::size_t k = 0; k < p.blocks.size(); ++k) build_block(k, scaling, mean);
}

void PackedProblem::release_memory() {
  release(groups_, compliance_, scale_, bodies_, first_slot_, slots_, row_mass_, block_metric_);
}

void PackedProblem::build_bodies() {
  const CcpProblem& p = problem();
  const std::size_t n = p.bodies();
  bodies_.resize((n + 3) / 4);
  const std::span<const std::uint32_t> first = delassus_->partition().first_slot();
  first_slot_.assign(4 * bodies_.size() + 1, n > 0 ? first.back() : 0);
  std::copy(first.begin(), first.end(), first_slot_.begin());
  for (std::size_t at = 0; at < bodies_.size(); ++at) {
    BodyGroup& group = bodies_[at] = BodyGroup{};
    for (std::size_t lane = 0; lane < 4 && 4 * at + lane < n; ++lane) {
      const std::size_t k = 4 * at + lane;
      const Mat3& j = p.inverse_inertia[k];
      group.mass[lane] = p.inverse_mass[k];
      group.xx[lane] = j.row0.x, group.yy[lane] = j.row1.y, group.zz[lane] = j.row2.z;
      group.xy[lane] = j.row0.y, group.xz[lane] = j.row0.z, group.yz[lane] = j.row1.z;
    }
  }
}

void PackedProblem::build_run(std::size_t first, std::size_t last, Scaling scaling, double mean) {
  const auto sink = static_cast<std::uint32_t>(delassus_->partition().first_slot().back() + first / kRun);
  for (std::size_t at = first / 4; at < first / 4 + (last - first + 3) / 4; ++at) {
    groups_[at] = Group{};
    groups_[at].m_n = groups_[at].m_t = Floats{1.0F, 1.0F, 1.0F, 1.0F};
    groups_[at].a.fill(offset_of(sink));
    groups_[at].b.fill(offset_of(sink));
    scale_[at] = Lanes{};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const std::size_t contact = contact_at(first, last, at, lane);
      if (contact < last) put_contact(contact, at, lane, scaling, mean);
    }
  }
}

void PackedProblem::put_contact(std::size_t i, std::size_t at, std::size_t lane, Scaling scaling, double mean) {
  const CcpProblem& p = problem();
  const double trace = delassus_->traces()[i];
  if (!(trace > 0.0)) return;
  const CcpContact& c = p.contacts[i];
  Group& group = groups_[at];
  double d_n = mean, d_t = mean;
  if (scaling == Scaling::unit) d_n = d_t = trace / 3.0;
  if (scaling == Scaling::block) {
    d_n = normal_diagonal(p, i);
    d_t = 0.5 * (trace - d_n);
    // A direction that nothing moves in: no impulse along it changes anything, whatever its metric.
    if (!(d_n > 0.0) || !(d_t > 0.0)) d_n = d_t = trace / 3.0;
  }
  put(group.normal, lane, c.normal);
  put(group.arm_a, lane, c.arm_a);
  put(group.arm_b, lane, c.arm_b);
  put(group.r, lane, in_world(c, load_block(p.r, i)));
  group.friction[lane] = c.friction;
  group.m_n[lane] = stored(1.0 / d_n);
  group.m_t[lane] = stored(1.0 / d_t);
  group.a[lane] = offset_of(delassus_->partition().slots()[i].a);
  group.b[lane] = offset_of(delassus_->partition().slots()[i].b);
  scale_[at][lane] = 3.0 / trace;
  if (compliance_.empty()) return;
  put(compliance_[at].tangent1, lane, contact_frame(c.normal).tangent1);
  put(compliance_[at].e, lane, load_block(p.compliance, i));
}

void PackedProblem::build_block(std::size_t block, Scaling scaling, double mean) {
  const CcpProblem& p = problem();
  const CcpBlock& b = p.blocks[block];
  const double trace = delassus_->traces()[p.contacts.size() + block], own = trace / b.rows;
  std::array<double, CcpBlock::kMostRows * CcpBlock::kMostRows> n{};
  diagonal_block_of_block(p, block, n);
  BlockVector d{};
  for (std::size_t k = 0; k < b.rows; ++k) {
    d[k] = scaling == Scaling::none ? mean : scaling == Scaling::unit ? own : n[k * (std::size_t{b.rows} + 1)];
    if (!(d[k] > 0.0)) d[k] = own;
  }
  BlockMetric& metric = block_metric_[block] = BlockMetric{};
  if (b.kind == CcpKind::cone) {
    // Directions that share one coefficient share one weight, or the nearest point would not lie in the plane of both.
    const auto share = [&](std::size_t first) { d[first] = d[first + 1] = 0.5 * (d[first] + d[first + 1]); };
    if (b.rows == 3 || b.rows >= 5) share(1);
    if (b.rows >= 5) share(b.rows - std::size_t{2});
    metric.normal = d[0];
    if (b.rows >= 2) metric.tangent = d[1];
    if (b.rows == 6) metric.spin = d[3];
    if (b.rows >= 5) metric.rolling = d[b.rows - std::size_t{1}];
  }
  // What no impulse moves stays where it is.
  for (std::size_t k = 0; k < b.rows; ++k) row_mass_[b.first_row + k] = trace > 0.0 ? 1.0 / d[k] : 0.0;
  if (!(trace > 0.0)) metric = BlockMetric{};
}

void PackedProblem::project(std::size_t block, std::span<double> g) const {
  project_block(problem().blocks[block], block_metric_[block], g);
}

void PackedProblem::block_product(std::size_t block, std::span<const double> x, std::span<double> product) const {
  const CcpProblem& p = problem();
  const CcpBlock& b = p.blocks[block];
  const SlotPair slot = delassus_->partition().slots()[p.contacts.size() + block];
  scree::relative_velocity(jacobian_of(p, b), slots_[slot.a].velocity, slots_[slot.b].velocity, product);
  if (!compliant()) return;
  const std::size_t row = first_row(p, b);
  for (std::size_t k = 0; k < b.rows; ++k) product[k] += p.compliance[row + k] * x[k];
}

void PackedProblem::block_velocity(std::size_t block, std::span<const double> x, std::span<double> u) const {
  block_product(block, x, u);
  const std::span<const double> r = scree::rows_of(problem(), problem().blocks[block], problem().r);
  for (std::size_t k = 0; k < r.size(); ++k) u[k] += r[k];
}

double PackedProblem::block_compliance(std::size_t block, std::span<const double> d) const {
  if (!compliant()) return 0.0;
  const std::span<const double> e = scree::rows_of(problem(), problem().blocks[block], problem().compliance);
  double sum = 0.0;
  for (std::size_t k = 0; k < d.size(); ++k) sum += d[k] * e[k] * d[k];
  return sum;
}

void PackedProblem::add_impulse(std::size_t block, std::span<const double> g) {
  const CcpProblem& p = problem();
  const SlotPair slot = delassus_->partition().slots()[p.contacts.size() + block];
  scree::add_impulse(jacobian_of(p, p.blocks[block]), g, slots_[slot.a].sum, slots_[slot.b].sum);
}

void PackedProblem::pack(std::span<const double> gamma, Impulses& x) const {
  const CcpProblem& p = problem();
  x.contacts.assign(groups_.size(), Lanes3{});
  delassus_->for_chunks(p.contacts.size(), [&](std::size_t first, std::size_t last) {
    const std::size_t quarter = (last - first + 3) / 4;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t group = first / 4 + (i - first) % quarter, lane = (i - first) / quarter;
      if (!(scale_[group][lane] > 0.0)) continue;
      put(x.contacts[group], lane, in_world(p.contacts[i], load_block(gamma, i)));
    }
  });
  const std::span<const double> rows = gamma.subspan(p.contact_rows());
  x.rows.assign(rows.begin(), rows.end());
}

void PackedProblem::copy(const Impulses& from, Impulses& to) const {
  delassus_->for_chunks(from.contacts.size(), [&](std::size_t first, std::size_t last) {
    std::copy(from.contacts.data() + first, from.contacts.data() + last, to.contacts.data() + first);
  });
  std::copy(from.rows.begin(), from.rows.end(), to.rows.begin());
}

void PackedProblem::unpack(const Impulses& x, std::span<double> gamma) const {
  const CcpProblem& p = problem();
  delassus_->for_chunks(p.contacts.size(), [&](std::size_t first, std::size_t last) {
    const std::size_t quarter = (last - first + 3) / 4;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t group = first / 4 + (i - first) % quarter, lane = (i - first) / quarter;
      if (!(scale_[group][lane] > 0.0)) continue;
      const Vec3 g = in_frame(p.contacts[i], get(x.contacts[group], lane));
      store_block(gamma, i, project_cone3(g, p.contacts[i].friction));
    }
  });
  std::copy(x.rows.begin(), x.rows.end(), gamma.begin() + static_cast<std::ptrdiff_t>(p.contact_rows()));
}

void PackedProblem::clear_sinks() {
  for (std::size_t s = first_slot_.back(); s < slots_.size(); ++s) slots_[s].sum = Twist{};
}

}  // namespace scree::packed
