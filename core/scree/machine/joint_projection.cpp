#include "scree/machine/joint_projection.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <vector>

namespace scree {

struct JointProjection::Matrix {
  using Sparse = Eigen::SparseMatrix<double>;
  Sparse n;
  Eigen::SimplicialLDLT<Sparse> factors;
  Eigen::VectorXd added;  // to the diagonal
  Eigen::VectorXd first;  // solution
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<std::vector<std::uint32_t>> rows_of;  // by body
  std::vector<std::array<int, 2>> analysed;         // bodies of the rows whose pattern is known
};

JointProjection::JointProjection() : matrix_{std::make_unique<Matrix>()} {}
JointProjection::~JointProjection() = default;

namespace {

double product(const BodyInertia& body, const Twist& p, const Twist& q) {
  return body.inverse_mass * dot(p.linear, q.linear) + dot(p.angular, body.inverse_inertia * q.angular);
}

/// The part of a row that belongs to a body; both when it is the same body twice.
Twist part_of(const MachineRow& row, int body) {
  Twist part;
  if (row.a == body) part += row.row.a;
  if (row.b == body) part += row.row.b;
  return part;
}

}  // namespace

bool JointProjection::bind(std::span<const MachineRow> rows, std::span<const double> compliance,
                           std::span<const BodyInertia> bodies) {
  constexpr double kRegularisation = 1e-9;
  Matrix& m = *matrix_;
  m.rows_of.resize(bodies.size());
  for (auto& list : m.rows_of) list.clear();
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    for (const int body : {rows[i].a, rows[i].a == rows[i].b ? -1 : rows[i].b}) {
      if (body >= 0) m.rows_of[static_cast<std::size_t>(body)].push_back(i);
    }
  }
  m.entries.clear();
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies[body].inverse_mass == 0.0) continue;
    for (const std::uint32_t i : m.rows_of[body]) {
      const Twist p = part_of(rows[i], static_cast<int>(body));
      for (const std::uint32_t k : m.rows_of[body]) {
        const double value = product(bodies[body], p, part_of(rows[k], static_cast<int>(body)));
        m.entries.emplace_back(static_cast<int>(i), static_cast<int>(k), value);
      }
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (compliance[i] > 0.0) m.entries.emplace_back(static_cast<int>(i), static_cast<int>(i), compliance[i]);
  }
  const auto size = static_cast<Eigen::Index>(rows.size());
  m.n.resize(size, size);
  m.n.setFromTriplets(m.entries.begin(), m.entries.end());
  m.added = kRegularisation * m.n.diagonal();
  m.n.diagonal() += m.added;
  const auto same = [](const MachineRow& row, const std::array<int, 2>& known) {
    return row.a == known[0] && row.b == known[1];
  };
  if (!std::ranges::equal(rows, m.analysed, same)) {
    m.factors.analyzePattern(m.n);
    m.analysed.clear();
    for (const MachineRow& row : rows) m.analysed.push_back({row.a, row.b});
  }
  m.factors.factorize(m.n);
  return m.factors.info() == Eigen::Success;
}

void JointProjection::solve(std::span<const double> defect, std::span<double> impulse) {
  Matrix& m = *matrix_;
  const auto size = static_cast<Eigen::Index>(defect.size());
  const Eigen::Map<const Eigen::VectorXd> d(defect.data(), size);
  m.first = m.factors.solve(d);
  // N x = (N + e) x - e x.
  m.first = d - m.added.cwiseProduct(m.first);
  Eigen::Map<Eigen::VectorXd>(impulse.data(), size) = -m.factors.solve(m.first);
}

}  // namespace scree
