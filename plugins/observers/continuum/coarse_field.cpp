#include "coarse_field.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact_study/contact_motion.hpp"
#include "scree/base/error.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

// Where the sums of a cell begin, as the header lists them.
constexpr std::size_t kWeight = 0, kSquares = 1, kVolume = 2, kMass = 3, kMomentum = 4, kPlace = 7, kVV = 10, kXX = 16,
                      kVX = 22, kStress = 31;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// The six different products of a vector with itself: xx, yy, zz, xy, xz, yz.
void add_square(double* sums, const Vec3& v, double m) {
  sums[0] += m * v.x * v.x;
  sums[1] += m * v.y * v.y;
  sums[2] += m * v.z * v.z;
  sums[3] += m * v.x * v.y;
  sums[4] += m * v.x * v.z;
  sums[5] += m * v.y * v.z;
}

void add_product(double* sums, const Vec3& a, const Vec3& b, double m) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sums[3 * i + j] += m * a[i] * b[j];
  }
}

Eigen::Matrix3d symmetric(const double* s) {
  Eigen::Matrix3d m;
  m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
  return m;
}

Eigen::Matrix3d full(const double* s) { return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{s}; }

Mat3 to_mat3(const Eigen::Matrix3d& m) {
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

// The inverse in the directions in which the places have extent, and zero in the others.
Eigen::Matrix3d inverse_where_wide(const Eigen::Matrix3d& spread, double range) {
  constexpr double kFlat = 1e-6;  // of the squared range: grains of one layer differ by less
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes{spread};
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (axes.eigenvalues()[k] > kFlat * range * range) inverse[k] = 1.0 / axes.eigenvalues()[k];
  }
  return axes.eigenvectors() * inverse.asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace

CoarseField::CoarseField(const CellGrid& grid, const Kernel& kernel)
    : lattice_{grid},
      kernel_{kernel},
      cell_volume_{grid.spacing().x * grid.spacing().y * grid.spacing().z},
      sums_(grid.size() * kSums, 0.0) {}

void CoarseField::clear() {
  std::fill(sums_.begin(), sums_.end(), 0.0);
  looks_ = 0.0;
}

void CoarseField::add(std::span<const Grain> grains, std::span<const BranchPoint> branches, const Executor& executor) {
  constexpr std::size_t kGrains = 512, kLayers = 2;  // of a chunk
  const auto normalise = [&](const auto& points, std::vector<double>& norm) {
    norm.resize(points.size());
    executor.for_chunks(points.size(), kGrains, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) norm[i] = lattice_.normalisation(kernel_, points[i].place);
    });
  };
  normalise(grains, grain_norm_);
  normalise(branches, branch_norm_);
  // Each chunk owns its layers of cells and walks all grains in order, so that no sum depends on the number of threads.
  executor.for_chunks(static_cast<std::size_t>(lattice_.count()[2]), kLayers, [&](std::size_t first, std::size_t last) {
    spread_layers(grains, branches, static_cast<long>(first), static_cast<long>(last));
  });
  looks_ += 1.0;
}

void CoarseField::spread_layers(std::span<const Grain> grains, std::span<const BranchPoint> branches, long first,
                                long last) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (grain_norm_[i] > 0.0) spread(grains[i], grain_norm_[i], first, last);
  }
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (branch_norm_[i] > 0.0) spread(branches[i], branch_norm_[i], first, last);
  }
}

namespace {

// Calls `cell(x, y, z, weight, place from the centre)` for the cells of the layers that a point reaches.
template <class Cell>
void for_cells(const Lattice& lattice, const Kernel& kernel, const Vec3& place, double normalisation, long first,
               long last, Cell&& cell) {
  const CellRange cells = lattice.within_grid(lattice.around(place, kernel.range()));
  for (long z = std::max(first, cells.first[2]); z < std::min(last, cells.last[2]); ++z) {
    for (long y = cells.first[1]; y < cells.last[1]; ++y) {
      for (long x = cells.first[0]; x < cells.last[0]; ++x) {
        const Vec3 off = place - lattice.centre(x, y, z);
        const double weight = normalisation * kernel(squared_norm(off));
        if (weight > 0.0) cell(lattice.index(x, y, z), weight, off);
      }
    }
  }
}

}  // namespace

void CoarseField::spread(const Grain& grain, double normalisation, long first, long last) {
  for_cells(lattice_, kernel_, grain.place, normalisation, first, last,
            [&](std::size_t index, double weight, const Vec3& off) {
              double* s = &sums_[index * kSums];
              const double m = weight * grain.mass;
              const Vec3& v = grain.velocity;
              s[kWeight] += weight;
              s[kSquares] += weight * weight;
              s[kVolume] += weight * grain.volume;
              s[kMass] += m;
              for (int k = 0; k < 3; ++k) {
                s[kMomentum + static_cast<std::size_t>(k)] += m * v[k];
                s[kPlace + static_cast<std::size_t>(k)] += m * off[k];
              }
              add_square(s + kVV, v, m);
              add_square(s + kXX, off, m);
              add_product(s + kVX, v, off, m);
            });
}

void CoarseField::spread(const BranchPoint& point, double normalisation, long first, long last) {
  for_cells(lattice_, kernel_, point.place, normalisation, first, last,
            [&](std::size_t index, double weight, const Vec3&) {
              double* s = &sums_[index * kSums + kStress];
              const std::array rows{point.moment.row0, point.moment.row1, point.moment.row2};
              for (std::size_t r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) s[3 * r + static_cast<std::size_t>(c)] += weight * rows[r][c];
              }
            });
}

CoarseCell CoarseField::cell(std::size_t index, bool remove_gradient, double least) const {
  const double* s = &sums_[index * kSums];
  CoarseCell cell;
  const double per = looks_ > 0.0 ? 1.0 / (looks_ * cell_volume_) : 0.0;
  cell.solid_fraction = s[kVolume] * per;
  cell.density = s[kMass] * per;
  cell.contact_stress = to_mat3(per * full(s + kStress));
  cell.samples = s[kSquares] > 0.0 ? s[kWeight] * s[kWeight] / s[kSquares] : 0.0;
  cell.velocity = {kNone, kNone, kNone};
  cell.temperature = kNone;
  cell.kinetic_stress = {cell.velocity, cell.velocity, cell.velocity};
  if (!(s[kMass] > 0.0)) return cell;
  const double m = s[kMass];
  const Eigen::Vector3d u = Eigen::Map<const Eigen::Vector3d>{s + kMomentum} / m,
                        x = Eigen::Map<const Eigen::Vector3d>{s + kPlace} / m;
  cell.velocity = {u[0], u[1], u[2]};
  if (cell.samples < least) return cell;
  Eigen::Matrix3d spread = symmetric(s + kVV) / m - u * u.transpose();
  if (remove_gradient) {
    const Eigen::Matrix3d vx = full(s + kVX) / m - u * x.transpose();
    const Eigen::Matrix3d xx = symmetric(s + kXX) / m - x * x.transpose();
    spread -= vx * inverse_where_wide(xx, kernel_.range()) * vx.transpose();
  }
  cell.temperature = std::max(0.0, spread.trace() / 3.0);  // below zero by rounding only
  cell.kinetic_stress = to_mat3(cell.density * spread);
  return cell;
}

void CoarseField::save(StateWriter& out) const {
  out.write("looks", looks_);
  out.write("sums", sums_);
}

void CoarseField::load(const StateReader& in) {
  std::vector<double> sums = in.doubles("sums");
  if (sums.size() != sums_.size()) {
    throw Error{ErrorKind::io,
                "the continuum fields in the checkpoint are of another grid; resume with the grid they are of."};
  }
  sums_ = std::move(sums);
  looks_ = in.number("looks");
}

void append_branches(const Observation& now, std::vector<BranchPoint>& out) {
  // Gauss-Legendre with three points on [0, 1].
  const double off = 0.5 * std::sqrt(0.6);
  const std::array<std::array<double, 2>, 3> points{
      {{0.5 - off, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + off, 5.0 / 18.0}}};
  for (std::size_t k = 0; k < now.contacts.size(); ++k) {
    const Contact& contact = now.contacts.contact[k];
    const Vec3 force_on_b = (1.0 / now.dt) * impulse_on_b(now.contacts, k).linear;
    if (force_on_b == Vec3{}) continue;
    for (const auto& [body, force] : {std::pair{contact.a, -force_on_b}, std::pair{contact.b, force_on_b}}) {
      if (now.bodies.motion[body] != Motion::dynamic) continue;
      const Vec3 centre = pose_at_contacts(now.bodies, body, now.contacts.age).position;
      const Vec3 branch = contact.point - centre;
      for (const auto& [part, weight] : points) {
        const Vec3 f = -weight * force;
        out.push_back({centre + part * branch, {f.x * branch, f.y * branch, f.z * branch}});
      }
    }
  }
}

}  // namespace scree
