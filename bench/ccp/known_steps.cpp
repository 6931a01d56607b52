#include "known_steps.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "methods.hpp"
#include "scree/ccp/twist.hpp"

namespace scree::bench {
namespace {

constexpr double kSameNormal = 0.9;  // cosine [1]

/// The inverse masses of a contact's bodies, the smaller one first.
using Bodies = std::pair<double, double>;

struct Oriented {
  Bodies bodies;
  double sign;  ///< of the normal from the body of smaller to that of larger inverse mass
};

Oriented oriented(const CcpRecord& record, const CcpContact& c) {
  const double a = record.inverse_mass[c.a], b = record.inverse_mass[c.b];
  return a < b ? Oriented{{a, b}, 1.0} : Oriented{{b, a}, -1.0};
}

void check(const CcpRecord& record, const std::string& file) {
  if (!record.blocks.empty()) throw std::runtime_error{file + ": has blocks; only contacts are known again"};
  std::vector<double> masses;
  for (const double m : record.inverse_mass) {
    if (m > 0.0) masses.push_back(m);
  }
  std::sort(masses.begin(), masses.end());
  if (std::adjacent_find(masses.begin(), masses.end()) != masses.end()) {
    throw std::runtime_error{file + ": two bodies have the same mass; record a scene whose grains all differ in size"};
  }
}

// `impulse` turned as `from` turns to `to`, unit vectors less than a right angle apart.
Vec3 turned(const Vec3& impulse, const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  const double cosine = dot(from, to);
  return cosine * impulse + cross(axis, impulse) + (dot(axis, impulse) / (1.0 + cosine)) * axis;
}

}  // namespace

KnownStep read_known_step(const std::string& file) {
  KnownStep out{read_ccp_file(file), {}};
  check(out.record, file);
  out.solution = out.record.guess;
  SolveContext context;
  context.tolerance = kExact;
  context.max_iterations = kMostSweeps;
  const SolveSummary summary = make_solver("asgs")->solve(out.record.problem(), context, out.solution);
  if (summary.status != SolveStatus::converged) throw std::runtime_error{file + ": asgs does not reach 1e-7 m/s"};
  return out;
}

std::vector<double> carry(const CcpRecord& from, std::span<const double> gamma, const CcpRecord& to, Carried how) {
  std::multimap<Bodies, std::size_t> known;
  for (std::size_t i = 0; i < from.contacts.size(); ++i) known.emplace(oriented(from, from.contacts[i]).bodies, i);
  std::vector<double> out(3 * to.contacts.size(), 0.0);
  for (std::size_t i = 0; i < to.contacts.size(); ++i) {
    const CcpContact& now = to.contacts[i];
    const auto [bodies, sign] = oriented(to, now);
    double nearest = kSameNormal;
    const auto [first, last] = known.equal_range(bodies);
    for (auto it = first; it != last; ++it) {
      const CcpContact& then = from.contacts[it->second];
      const double flip = sign * oriented(from, then).sign, cosine = flip * dot(then.normal, now.normal);
      if (cosine <= nearest) continue;
      nearest = cosine;
      Vec3 impulse = flip * in_world(then, load_block(gamma, it->second));
      if (how == Carried::with_contact) impulse = turned(impulse, flip * then.normal, now.normal);
      store_block(std::span{out}, i, in_frame(now, impulse));
    }
  }
  return out;
}

}  // namespace scree::bench
