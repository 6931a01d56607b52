#include "scree/ccp/fclib/fclib_export.hpp"

#include <Eigen/Sparse>
#include <array>

#include "scree/base/error.hpp"
#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/twist.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {

namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triplets = std::vector<Eigen::Triplet<double>>;

[[noreturn]] void refuse(const std::string& what) {
  throw Error{ErrorKind::usage, "this problem cannot be kept as an FCLIB file: " + what +
                                    ", and FCLIB knows contacts of one sort and bilateral constraints only"};
}

/// Where the rows of a problem stand in FCLIB, contacts first.
struct Order {
  std::vector<std::size_t> contact_rows, bilateral_rows;  ///< rows of the problem
  std::size_t each = 0;                                   ///< rows a contact
};

void add_contact(FclibProblem& out, Order& order, std::size_t first, std::size_t rows, double mu, double rolling) {
  if (order.each != 0 && order.each != rows) refuse("it has contacts of different numbers of rows");
  order.each = rows;
  out.mu.push_back(mu);
  if (rows == 5) out.rolling.push_back(rolling);
  for (std::size_t k = 0; k < rows; ++k) order.contact_rows.push_back(first + k);
}

Order order_of(const CcpProblem& problem, FclibProblem& out) {
  Order order;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    add_contact(out, order, 3 * i, 3, problem.contacts[i].friction, 0.0);
  }
  for (const CcpBlock& block : problem.blocks) {
    const std::size_t first = problem.contact_rows() + block.first_row;
    if (block.kind == CcpKind::free) {
      for (std::size_t k = 0; k < block.rows; ++k) order.bilateral_rows.push_back(first + k);
    } else if (block.kind == CcpKind::cone && (block.rows == 2 || block.rows == 3 || block.rows == 5)) {
      add_contact(out, order, first, block.rows, block.friction, block.rolling);
    } else {
      refuse(block.kind == CcpKind::cone ? "it has contacts of 1 or 6 rows" : "it has limits or motors");
    }
  }
  return order;
}

void add_twist(Triplets& out, std::size_t row, std::size_t body, const Twist& t) {
  const std::array values{t.linear.x, t.linear.y, t.linear.z, t.angular.x, t.angular.y, t.angular.z};
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k] != 0.0) out.emplace_back(static_cast<int>(row), static_cast<int>(6 * body + k), values[k]);
  }
}

/// The Jacobian D^T, rows by bodies.
Sparse jacobian_of(const CcpProblem& problem) {
  Triplets entries;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const CcpContact& c = problem.contacts[i];
    const ContactFrame frame = contact_frame(c.normal);
    const std::array directions{frame.normal, frame.tangent1, frame.tangent2};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& d = directions[k];
      add_twist(entries, 3 * i + k, c.a, {-d, -cross(c.arm_a, d)});
      add_twist(entries, 3 * i + k, c.b, {d, cross(c.arm_b, d)});
    }
  }
  for (const CcpBlock& block : problem.blocks) {
    for (std::size_t k = 0; k < block.rows; ++k) {
      const CcpRow& row = problem.block_rows[block.first_row + k];
      add_twist(entries, problem.contact_rows() + block.first_row + k, block.a, row.a);
      add_twist(entries, problem.contact_rows() + block.first_row + k, block.b, row.b);
    }
  }
  Sparse out(static_cast<Eigen::Index>(problem.rows()), static_cast<Eigen::Index>(6 * problem.bodies()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Sparse inverse_masses(const CcpProblem& problem) {
  Triplets entries;
  for (std::size_t body = 0; body < problem.bodies(); ++body) {
    const Mat3& j = problem.inverse_inertia[body];
    const double m = problem.inverse_mass[body];
    const std::array rows{Twist{{m, 0, 0}, {}}, Twist{{0, m, 0}, {}}, Twist{{0, 0, m}, {}},
                          Twist{{}, j.row0},    Twist{{}, j.row1},    Twist{{}, j.row2}};
    for (std::size_t k = 0; k < rows.size(); ++k) add_twist(entries, 6 * body + k, body, rows[k]);
  }
  const auto size = static_cast<Eigen::Index>(6 * problem.bodies());
  Sparse out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// N without compliance, by its entries.
std::vector<MatrixEntry> entries_of(const CcpProblem& problem) {
  std::vector<MatrixEntry> entries;
  const auto add = [&](std::size_t row, std::size_t column, double value) {
    entries.push_back({static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), value});
  };
  if (problem.matrix.empty()) {
    const Sparse jacobian = jacobian_of(problem);
    const Sparse n = jacobian * inverse_masses(problem) * jacobian.transpose();
    for (Eigen::Index i = 0; i < n.outerSize(); ++i) {
      for (Sparse::InnerIterator e(n, i); e; ++e) {
        add(static_cast<std::size_t>(e.row()), static_cast<std::size_t>(e.col()), e.value());
      }
    }
    return entries;
  }
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    for (std::size_t k = problem.matrix.first[i]; k < problem.matrix.first[i + 1]; ++k) {
      const CcpBlock &row = problem.blocks[i], &column = problem.blocks[problem.matrix.column[k]];
      const double* value = problem.matrix.values.data() + problem.matrix.value[k];
      for (std::size_t a = 0; a < row.rows; ++a) {
        for (std::size_t b = 0; b < column.rows; ++b) add(row.first_row + a, column.first_row + b, *value++);
      }
    }
  }
  return entries;
}

}  // namespace

void check_exportable(const CcpProblem& problem) {
  FclibProblem ignored;
  (void)order_of(problem, ignored);
}

FclibProblem export_to_fclib(const CcpProblem& problem, std::span<const double> gamma) {
  FclibProblem out;
  const Order order = order_of(problem, out);
  const std::size_t m = order.contact_rows.size(), p = order.bilateral_rows.size();
  out.spacedim = order.each == 2 ? 2 : 3;
  std::vector<std::size_t> place(problem.rows());
  for (std::size_t k = 0; k < m; ++k) place[order.contact_rows[k]] = k;
  for (std::size_t k = 0; k < p; ++k) place[order.bilateral_rows[k]] = m + k;

  std::vector<double> u(m + p), g(m + p);
  for (std::size_t k = 0; k < problem.rows(); ++k) {
    u[place[k]] = problem.r[k];
    g[place[k]] = gamma[k];
  }
  FclibLocal local;
  local.q.assign(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(m));
  local.s.assign(u.begin() + static_cast<std::ptrdiff_t>(m), u.end());
  local.W = {.rows = m, .columns = m, .storage = FclibStorage::rows};
  if (p > 0) {
    local.V = {.rows = m, .columns = p, .storage = FclibStorage::rows};
    local.R = {.rows = p, .columns = p, .storage = FclibStorage::rows};
  }
  std::vector<MatrixEntry> entries = entries_of(problem);
  for (std::uint32_t k = 0; k < problem.compliance.size(); ++k) entries.push_back({k, k, problem.compliance[k]});
  for (const MatrixEntry& e : entries) {
    const std::size_t row = place[e.row], column = place[e.column];
    u[row] += e.value * g[column];
    if (row >= m && column < m) continue;  // V^T
    FclibMatrix& into = row >= m ? local.R : column >= m ? local.V : local.W;
    into.entries.push_back({static_cast<std::uint32_t>(row >= m ? row - m : row),
                            static_cast<std::uint32_t>(column >= m ? column - m : column), e.value});
  }
  out.form = std::move(local);
  const auto contacts_of = [m](const std::vector<double>& all) {
    return std::vector<double>{all.begin(), all.begin() + static_cast<std::ptrdiff_t>(m)};
  };
  std::vector<double> lambda{g.begin() + static_cast<std::ptrdiff_t>(m), g.end()};
  out.solution = FclibSolution{{}, contacts_of(u), contacts_of(g), std::move(lambda)};
  return out;
}

}  // namespace scree
