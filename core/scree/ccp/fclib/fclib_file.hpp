// Files of the Frictional Contact Library (HDF5), read and written.
//
// Groups and datasets, with [ ] for what may be missing:
//
//     fclib_local/    W/ [V/ R/]  vectors/{q, mu, [s], [mu_r]}      spacedim  [info/{title, description, math_info}, attributes]
//     fclib_global/   M/ H/ [G/]  vectors/{f, w, mu, [b], [mu_r]}   spacedim  [info/]
//     [guesses/{number_of_guesses, 1/, 2/ ...}]  [solution/]        each {r, [u], [v], [l]}
//
// Problems with rolling friction stand in groups of these names, or in fclib_local_rolling and fclib_global_rolling. A matrix
// is a group {m, n, nz, nzmax, p, i, x, [comment, conditioning, determinant, rank]}. nz = -1 packs columns, -2 rows: p has
// where each begins in i and x. Otherwise nz is the number of entries with rows i and columns p, as in CSparse. (FCLIB's
// header says rows p and columns i: that is understood where only that fits m and n.)
#pragma once

#include <cstdint>
#include <filesystem>

#include "scree/ccp/fclib/fclib_problem.hpp"

namespace scree {

/// What a file may hold that somebody takes for a contact problem.
enum class ProblemKind : std::uint8_t {
  no_hdf5,  ///< missing, a folder, or of another format
  damaged,  ///< an HDF5 file that cannot be opened
  fclib,    ///< a group of one of FCLIB's names
  scree,    ///< written by scree, whatever it is
  other,    ///< any other HDF5 file
};
[[nodiscard]] ProblemKind problem_kind(const std::filesystem::path& file);

/// Reads a problem with its guesses and its solution. @throws Error (io) that names file and dataset when something is
/// missing, of a wrong size or kind, not finite, out of range, when friction is negative, or when the file is damaged.
[[nodiscard]] FclibProblem read_fclib_file(const std::filesystem::path& file);

/// Writes `problem` as a whole or not at all. @throws Error (io).
void write_fclib_file(const std::filesystem::path& file, const FclibProblem& problem);

}  // namespace scree
