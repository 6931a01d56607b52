#include "single_sweep.hpp"

#include <algorithm>
#include <functional>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/sweep/local_step.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/math/lanes.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kAhead = 3;    // groups whose bodies are asked for early
constexpr std::size_t kGrain = 256;  // groups that a thread fills at a time

void put(single::Lanes3& lanes, std::size_t k, const Vec3& v) {
  lanes.x[k] = static_cast<float>(v.x), lanes.y[k] = static_cast<float>(v.y), lanes.z[k] = static_cast<float>(v.z);
}

using Half = float __attribute__((vector_size(16)));

struct Pair {
  Lanes linear, angular;
};

Pair widen(const single::Body& body) {
  const auto low = __builtin_shufflevector(body, body, 0, 1, 2, 3),
             high = __builtin_shufflevector(body, body, 4, 5, 6, 7);
  return {__builtin_convertvector(low, Lanes), __builtin_convertvector(high, Lanes)};
}

double sum_of(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace

bool SingleSweep::takes(const CcpProblem& problem) {
  const auto is_isotropic = [](const Mat3& j) { return j == Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x}); };
  return problem.blocks.empty() && problem.compliance.empty() &&
         std::all_of(problem.inverse_inertia.begin(), problem.inverse_inertia.end(), is_isotropic);
}

template <class Visit>
void SingleSweep::for_groups(const Visit& visit) const {
  const auto several = [&](std::size_t first, std::size_t last) {
    for (std::size_t at = first; at < last; ++at) visit(at);
  };
  if (executor_ == nullptr) return several(0, groups_.size());
  executor_->for_chunks(groups_.size(), kGrain, std::cref(several));
}

void SingleSweep::start(const CcpProblem& problem, std::span<const double> gamma, std::span<const Twist> w,
                        const Executor* executor) {
  executor_ = executor;
  sequence_.build_spread(problem);
  grouping_.build(problem, sequence_);
  fill(problem);
  for_groups([&](std::size_t at) {
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t i = grouping_.groups[at][k];
      if (i != sweep::kNoContact) scree::put(groups_[at].g, k, load_block(gamma, i));
    }
    history_[at] = {groups_[at].g, groups_[at].g};
  });
  y_.assign(bodies_count_ + 1, single::Body{});
  old_ = y_;
  correct(w);
  y_ = old_ = bodies_;
  step_ = {};
  momentum_ = false;
  linear_z_ = 0.0;
  for (std::size_t i = 0; i < gamma.size(); ++i) linear_z_ += problem.r[i] * gamma[i];
  linear_y_ = linear_old_ = linear_z_;
}

void SingleSweep::fill(const CcpProblem& problem) {
  bodies_count_ = problem.bodies();
  contacts_ = problem.contacts.size();
  bodies_.assign(bodies_count_ + 1, single::Body{});
  for (std::size_t k = 0; k < bodies_count_; ++k) {
    bodies_[k][3] = static_cast<float>(problem.inverse_mass[k]);
    bodies_[k][7] = static_cast<float>(problem.inverse_inertia[k].row0.x);
  }
  groups_.resize(grouping_.groups.size());
  history_.resize(groups_.size());
  for_groups([&](std::size_t at) {
    groups_[at] = single::Group{};
    groups_[at].a.fill(static_cast<std::uint32_t>(bodies_count_));
    groups_[at].b.fill(static_cast<std::uint32_t>(bodies_count_));
    for (std::size_t k = 0; k < 8; ++k) {
      if (grouping_.groups[at][k] != sweep::kNoContact) put(problem, at, k, grouping_.groups[at][k]);
    }
  });
}

void SingleSweep::put(const CcpProblem& problem, std::size_t at, std::size_t lane, std::uint32_t i) {
  const CcpContact& c = problem.contacts[i];
  const sweep::LocalStep step = sweep::block_step(diagonal_block(problem, i), c.friction, 1.0);
  single::Group& group = groups_[at];
  scree::put(group.normal, lane, c.normal);
  scree::put(group.tangent1, lane, contact_frame(c.normal).tangent1);
  scree::put(group.arm_a, lane, c.arm_a);
  scree::put(group.arm_b, lane, c.arm_b);
  scree::put(group.r, lane, load_block(problem.r, i));
  group.step_n[lane] = static_cast<float>(step.normal), group.step_t[lane] = static_cast<float>(step.tangent);
  group.along[lane] = static_cast<float>(step.weights.along);
  group.across[lane] = static_cast<float>(step.weights.across);
  group.friction[lane] = static_cast<float>(c.friction);
  // Immovable bodies are the one that stands for nothing.
  if (problem.inverse_mass[c.a] > 0.0) group.a[lane] = c.a;
  if (problem.inverse_mass[c.b] > 0.0) group.b[lane] = c.b;
}

double SingleSweep::advance(double speed) {
  momentum_ ? go_with_momentum() : go();
  momentum_ ? sweep_forward<true>() : sweep_forward<false>();
  const auto least = static_cast<float>(speed);
  momentum_ ? sweep_backward<true>(least) : sweep_backward<false>(least);
  measure();
  return 0.5 * products_[5] + linear_z_;
}

template <bool momentum>
void SingleSweep::sweep_forward() {
  single::Body* const bodies = bodies_.data();
  const std::size_t n = groups_.size();
  const single::Lanes a = single::Lanes{} + static_cast<float>(step_.a);
  const single::Lanes b = single::Lanes{} + (momentum ? beta_ : static_cast<float>(step_.b));
  for (std::size_t k = 0; k < n; ++k) {
    if (k + kAhead < n) single::prefetch(groups_[k + kAhead], bodies);
    const single::Lanes3 y = history_[k].y, z = groups_[k].g;
    const single::Lanes3 next = momentum ? z + b * (z - history_[k].old) : y + a * (z - y) + b * (y - history_[k].old);
    history_[k] = {next, momentum ? z : y};
    single::update(groups_[k], next, bodies);
  }
}

template <bool momentum>
void SingleSweep::sweep_backward(float speed) {
  single::Body* const bodies = bodies_.data();
  const single::Lanes least = single::Lanes{} + speed;
  Lanes linear{}, against{};
  single::Count count{};
  for (std::size_t k = groups_.size(); k-- > 0;) {
    if (k >= kAhead) single::prefetch(groups_[k - kAhead], bodies);
    const single::Lanes3 from = groups_[k].g;
    single::update(groups_[k], from, bodies);
    count += single::exceeds(groups_[k], from, least);
    const auto [low, high] = widen(dot(groups_[k].r, groups_[k].g));
    linear += low + high;
    if (!momentum) continue;
    const Pair product =
        widen(single::metric_product(groups_[k], history_[k].y - groups_[k].g, groups_[k].g - history_[k].old));
    against += product.linear + product.angular;
  }
  linear_z_ = sum_of(linear);
  against_ = sum_of(against);
  std::int64_t moved = 0;
  for (int k = 0; k < 8; ++k) moved -= count[k];
  missing_ = static_cast<double>(moved) / static_cast<double>(contacts_);
}

void SingleSweep::begin_momentum() {
  momentum_ = true;
  beta_ = 0.0F;
  for (std::size_t k = 0; k < groups_.size(); ++k) history_[k].old = groups_[k].g;
  old_ = bodies_;
}

void SingleSweep::undo() {
  for (std::size_t k = 0; k < groups_.size(); ++k) groups_[k].g = history_[k].old;
  bodies_ = old_;
}

void SingleSweep::go_with_momentum() {
  for (std::size_t k = 0; k < bodies_count_; ++k) {
    const single::Body z = bodies_[k];
    bodies_[k] = z + beta_ * (z - old_[k]);
    old_[k] = z;
  }
}

// Bodies from z to the start of the next pair.
void SingleSweep::go() {
  const auto a = static_cast<float>(step_.a), b = static_cast<float>(step_.b);
  for (std::size_t k = 0; k < bodies_count_; ++k) {
    // The masses' lanes are equal in all: their differences are zero.
    const single::Body y = y_[k];
    bodies_[k] = y + a * (bodies_[k] - y) + b * (y - old_[k]);
    old_[k] = y;
    y_[k] = bodies_[k];
  }
  const double next = linear_y_ + step_.a * (linear_z_ - linear_y_) + step_.b * (linear_y_ - linear_old_);
  linear_old_ = linear_y_;
  linear_y_ = next;
}

void SingleSweep::measure() {
  std::array<Lanes, 6> sums{};
  for (std::size_t k = 0; k < bodies_count_; ++k) {
    const Pair z = widen(bodies_[k]), y = widen(y_[k]), old = widen(old_[k]);
    const double mass = z.linear[3] > 0.0 ? 1.0 / z.linear[3] : 0.0,
                 moment = z.angular[3] > 0.0 ? 1.0 / z.angular[3] : 0.0;
    const Lanes by_mass{mass, mass, mass, 0.0}, by_moment{moment, moment, moment, 0.0};
    const Pair d{z.linear - y.linear, z.angular - y.angular}, p{y.linear - old.linear, y.angular - old.angular};
    const auto product = [&](const Pair& s, const Pair& t) {
      return by_mass * s.linear * t.linear + by_moment * s.angular * t.angular;
    };
    sums[0] += product(d, d);
    sums[1] += product(d, p);
    sums[2] += product(p, p);
    sums[3] += product(y, d);
    sums[4] += product(y, p);
    sums[5] += product(z, z);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) products_[i] = sum_of(sums[i]);
}

bool SingleSweep::choose() {
  if (step_.choose(products_, linear_z_, linear_y_, linear_old_)) return true;
  step_ = {};
  return false;
}

void SingleSweep::impulses(const CcpProblem& problem, std::span<double> gamma) const {
  for_groups([&](std::size_t at) {
    const single::Lanes3& g = groups_[at].g;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t i = grouping_.groups[at][k];
      if (i == sweep::kNoContact) continue;
      store_block(gamma, i, project_cone3({g.x[k], g.y[k], g.z[k]}, problem.contacts[i].friction));
    }
  });
}

void SingleSweep::correct(std::span<const Twist> w) {
  for (std::size_t k = 0; k < bodies_count_; ++k) {
    const single::Body z = bodies_[k];
    const auto& [v, omega] = w[k];
    const Lanes linear{v.x, v.y, v.z, z[3]}, angular{omega.x, omega.y, omega.z, z[7]};
    const auto low = __builtin_convertvector(linear, Half);
    const auto high = __builtin_convertvector(angular, Half);
    const single::Body exact = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    y_[k] += exact - z;
    old_[k] += exact - z;
    bodies_[k] = exact;
  }
}

}  // namespace scree
