// CcpRecord: a contact problem that owns its numbers, and its file.
//
// `scree run --record-ccp` writes one as an HDF5 file of plain one-dimensional datasets (n bodies, m contacts):
//
//     inverse_mass n           [1/kg]         inverse_inertia 9 n, by rows, world   [1/(kg m2)]
//     body_a, body_b m         indices        normal 3 m, world                     [1]
//     arm_a, arm_b 3 m, world  [m]            friction m                            [1]
//     r 3 m                    [m/s]          compliance 3 m, or none               [1/kg]
//     guess 3 m                [N s]          time, step, tolerance, max_iterations
//
// and, where it has blocks of other kinds than contacts (k of them, q rows; r, compliance and guess then have q more):
//
//     block_kind k             0 free, 1 nonnegative, 2 box, 3 cone       block_size k, rows of each
//     block_a, block_b k       indices        block_friction, block_spinning, block_rolling k     [1]
//     block_lower, block_upper k [N s]        block_row_a, block_row_b 6 q, linear then angular   [1, m]
//
// A reader of another format fills in a CcpRecord and lets check_ccp_record() judge it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scree/ccp/matrix.hpp"
#include "scree/ccp/problem.hpp"

namespace scree {

/// Where a problem comes from, and how it was to be solved there.
struct CcpOrigin {
  std::string scene_hash;     ///< of the resolved scene; empty when unknown
  std::string scree_version;  ///< that wrote it
  double time = 0.0;          ///< end of the step [s]
  std::uint64_t step = 0;     ///< as in steps.csv
  double tolerance = 1e-3;    ///< ccp_residual at which the scene's solver stopped [m/s]
  int max_iterations = 1000;  ///< of the scene's solver
};

/// A contact problem with everything that it refers to.
struct CcpRecord {
  std::vector<double> inverse_mass;   ///< per body [1/kg]
  std::vector<Mat3> inverse_inertia;  ///< per body, world frame [1/(kg m2)]
  std::vector<CcpContact> contacts;   ///< m of them
  std::vector<double> r;              ///< one a row [m/s]
  std::vector<double> compliance;     ///< one a row [1/kg]; empty for none
  std::vector<double> guess;          ///< one a row [N s], what the solver started from
  CcpOrigin origin;
  std::vector<CcpBlock> blocks = {};    ///< behind the contacts
  std::vector<CcpRow> block_rows = {};  ///< Jacobian of the blocks; empty with a matrix
  CcpMatrixStore matrix = {};           ///< of a problem without bodies

  /// A view of it; valid while the record is neither moved nor changed.
  [[nodiscard]] CcpProblem problem() const {
    return {inverse_mass, inverse_inertia, contacts, r, compliance, blocks, block_rows, matrix.view()};
  }
};

/// A copy of `problem`, which has bodies, with its first guess `guess` (one a row) [N s].
[[nodiscard]] CcpRecord make_ccp_record(const CcpProblem& problem, std::span<const double> guess, CcpOrigin origin);

/// Checks sizes, indices, that all numbers are finite, that masses, inertias, friction and compliance are not negative,
/// that normal and tangent are perpendicular unit vectors, and the kinds, sizes and bounds of blocks. @throws Error (io) that begins with `place`, "the contact
/// problem FILE", and names the first entry that does not fit.
void check_ccp_record(const CcpRecord& record, const std::string& place);

/// Writes `record`, which has no matrix, as a whole or not at all. @throws Error (io).
void write_ccp_file(const std::filesystem::path& file, const CcpRecord& record);

/// Reads a record; the same bits as were written. @throws Error (io) for a file that is missing, damaged, cut short or
/// something else, and for all that check_ccp_record() finds.
[[nodiscard]] CcpRecord read_ccp_file(const std::filesystem::path& file);

}  // namespace scree
