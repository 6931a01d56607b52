#include "siconos_problem.hpp"

#include <NumericsMatrix.h>

#include <array>
#include <cstdlib>
#include <map>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {
namespace {

/// Three rows of a contact at one of its bodies: impulse directions and their moments.
struct Side {
  std::size_t contact = 0;
  std::array<Vec3, 3> linear, angular;
};

Side side_of(const CcpProblem& p, std::size_t i, bool second) {
  const CcpContact& c = p.contacts[i];
  const double sign = second ? 1.0 : -1.0;
  const ContactFrame frame = contact_frame(c.normal);
  Side side{i, {sign * frame.normal, sign * frame.tangent1, sign * frame.tangent2}, {}};
  for (std::size_t k = 0; k < 3; ++k) side.angular[k] = cross(second ? c.arm_b : c.arm_a, side.linear[k]);
  return side;
}

/// The sides that lie on each movable body.
std::vector<std::vector<Side>> sides_of_bodies(const CcpProblem& p) {
  std::vector<std::vector<Side>> out(p.bodies());
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    for (const bool second : {false, true}) {
      const std::uint32_t body = second ? p.contacts[i].b : p.contacts[i].a;
      if (p.inverse_mass[body] > 0.0) out[body].push_back(side_of(p, i, second));
    }
  }
  return out;
}

NumericsMatrixPtr triplet_matrix(std::size_t rows, std::size_t columns, std::size_t entries) {
  NumericsMatrixPtr matrix{NM_create(NM_SPARSE, static_cast<int>(rows), static_cast<int>(columns))};
  NM_triplet_alloc(matrix.get(), static_cast<CS_INT>(entries));
  return matrix;
}

void add(NumericsMatrix* matrix, std::size_t row, std::size_t column, double value) {
  NM_entry(matrix, static_cast<int>(row), static_cast<int>(column), value);
}

std::vector<double> friction_of(const CcpProblem& p) {
  std::vector<double> out;
  out.reserve(p.contacts.size());
  for (const CcpContact& c : p.contacts) out.push_back(c.friction);
  return out;
}

void refuse_blocks(const CcpProblem& p) {
  if (!p.blocks.empty()) throw Error{ErrorKind::usage, "only problems of contacts alone can be given to Siconos"};
}

// The inverse of a regular symmetric matrix: rows of the adjugate over the determinant.
Mat3 inverse(const Mat3& a) {
  const Vec3 x = cross(a.row1, a.row2), y = cross(a.row2, a.row0), z = cross(a.row0, a.row1);
  const double determinant = dot(a.row0, x);
  return transpose(Mat3{x / determinant, y / determinant, z / determinant});
}

double component(const Vec3& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

}  // namespace

void FreeNumericsMatrix::operator()(NumericsMatrix* matrix) const {
  NM_clear(matrix);
  std::free(matrix);
}

LocalForm::LocalForm(const CcpProblem& p) : q(p.r.begin(), p.r.end()), friction{friction_of(p)} {
  refuse_blocks(p);
  const std::vector<std::vector<Side>> of_body = sides_of_bodies(p);
  // Two contacts may share two bodies: their block is summed first, since Siconos reads one entry of each place.
  std::map<std::pair<std::size_t, std::size_t>, std::array<double, 9>> blocks;
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    for (const Side& i : of_body[body]) {
      for (const Side& j : of_body[body]) {
        std::array<double, 9>& block = blocks[{i.contact, j.contact}];
        for (std::size_t k = 0; k < 9; ++k) {
          block[k] += p.inverse_mass[body] * dot(i.linear[k / 3], j.linear[k % 3]) +
                      dot(i.angular[k / 3], p.inverse_inertia[body] * j.angular[k % 3]);
        }
      }
    }
  }
  for (std::size_t row = 0; row < p.compliance.size(); ++row)
    blocks.at({row / 3, row / 3})[4 * (row % 3)] += p.compliance[row];
  w = triplet_matrix(p.rows(), p.rows(), 9 * blocks.size());
  for (const auto& [at, block] : blocks) {
    for (std::size_t k = 0; k < 9; ++k) add(w.get(), 3 * at.first + k / 3, 3 * at.second + k % 3, block[k]);
  }
}

GlobalForm::GlobalForm(const CcpProblem& p) : b(p.r.begin(), p.r.end()), friction{friction_of(p)} {
  refuse_blocks(p);
  if (!p.compliance.empty()) throw Error{ErrorKind::usage, "the global form of Siconos has no place for compliance"};
  const std::vector<std::vector<Side>> of_body = sides_of_bodies(p);
  std::size_t movable = 0, sides = 0;
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    movable += p.inverse_mass[body] > 0.0 ? 1 : 0;
    sides += of_body[body].size();
  }
  m = triplet_matrix(6 * movable, 6 * movable, 12 * movable);
  h = triplet_matrix(6 * movable, p.rows(), 18 * sides);
  q.assign(6 * movable, 0.0);
  std::size_t first = 0;
  for (std::size_t body = 0; body < of_body.size(); ++body) {
    if (!(p.inverse_mass[body] > 0.0)) continue;
    const Mat3 inertia = inverse(p.inverse_inertia[body]);
    for (std::size_t k = 0; k < 3; ++k) {
      add(m.get(), first + k, first + k, 1.0 / p.inverse_mass[body]);
      const Vec3 row = k == 0 ? inertia.row0 : k == 1 ? inertia.row1 : inertia.row2;
      for (std::size_t l = 0; l < 3; ++l) add(m.get(), first + 3 + k, first + 3 + l, component(row, l));
    }
    for (const Side& side : of_body[body]) {
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t k = 0; k < 3; ++k) {
          add(h.get(), first + k, 3 * side.contact + row, component(side.linear[row], k));
          add(h.get(), first + 3 + k, 3 * side.contact + row, component(side.angular[row], k));
        }
      }
    }
    first += 6;
  }
}

}  // namespace scree
