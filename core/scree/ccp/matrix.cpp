#include "scree/ccp/matrix.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scree/base/require.hpp"

namespace scree {

namespace {

/// Block row and block column.
using Place = std::pair<std::uint32_t, std::uint32_t>;

std::size_t index_of(const CcpMatrix& matrix, const Place& place) {
  const auto begin = matrix.column.begin() + matrix.first[place.first];
  const auto end = matrix.column.begin() + matrix.first[place.first + 1];
  const auto found = std::lower_bound(begin, end, place.second);
  SCREE_REQUIRE(found != end && *found == place.second, "a matrix needs the block (j, i) wherever it has (i, j)");
  return static_cast<std::size_t>(found - matrix.column.begin());
}

/// Calls visit(value of N_kl, value of N_lk) as indices of values, for all entries.
template <class Visit>
void for_pairs(const CcpMatrix& matrix, std::span<const CcpBlock> blocks, const Visit& visit) {
  for (std::uint32_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) {
      const std::uint32_t j = matrix.column[k];
      const std::size_t here = matrix.value[k], there = matrix.value[index_of(matrix, {j, i})];
      const std::size_t rows = blocks[i].rows, columns = blocks[j].rows;
      for (std::size_t a = 0; a < rows; ++a) {
        for (std::size_t b = 0; b < columns; ++b) visit(here + a * columns + b, there + b * rows + a);
      }
    }
  }
}

/// The blocks that are not zero, the diagonal, and their mirror images, in order.
std::vector<Place> places(std::span<const std::uint32_t> block_of, std::span<const MatrixEntry> entries,
                          std::size_t blocks) {
  std::vector<Place> found;
  found.reserve(2 * entries.size() + blocks);
  for (std::uint32_t i = 0; i < blocks; ++i) found.emplace_back(i, i);
  for (const MatrixEntry& e : entries) {
    const std::uint32_t i = block_of[e.row], j = block_of[e.column];
    if (i == j || e.value == 0.0) continue;
    // Entries of one block often follow each other.
    if (found.size() > 1 && found[found.size() - 2] == Place{i, j}) continue;
    found.emplace_back(i, j);
    found.emplace_back(j, i);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

CcpMatrixStore make_matrix(std::span<const CcpBlock> blocks, std::span<const MatrixEntry> entries) {
  std::vector<std::uint32_t> block_of;
  for (std::uint32_t i = 0; i < blocks.size(); ++i) block_of.insert(block_of.end(), blocks[i].rows, i);
  for (const MatrixEntry& e : entries) {
    SCREE_REQUIRE(e.row < block_of.size() && e.column < block_of.size(),
                  "make_matrix: an entry is outside of the rows");
  }
  CcpMatrixStore store;
  store.first.assign(blocks.size() + 1, 0);
  std::size_t size = 0;
  for (const auto& [i, j] : places(block_of, entries, blocks.size())) {
    ++store.first[i + 1];
    store.column.push_back(j);
    store.value.push_back(size);
    size += std::size_t{blocks[i].rows} * blocks[j].rows;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) store.first[i + 1] += store.first[i];
  store.values.assign(size, 0.0);
  for (const MatrixEntry& e : entries) {
    if (e.value == 0.0) continue;
    const std::uint32_t i = block_of[e.row], j = block_of[e.column];
    const std::size_t start = store.value[index_of(store.view(), {i, j})];
    store.values[start + (e.row - blocks[i].first_row) * blocks[j].rows + (e.column - blocks[j].first_row)] += e.value;
  }
  return store;
}

double asymmetry(const CcpMatrix& matrix, std::span<const CcpBlock> blocks) {
  double difference = 0.0, largest = 0.0;
  for_pairs(matrix, blocks, [&](std::size_t here, std::size_t there) {
    difference = std::max(difference, std::abs(matrix.values[here] - matrix.values[there]));
    largest = std::max(largest, std::abs(matrix.values[here]));
  });
  return largest > 0.0 ? difference / largest : 0.0;
}

std::vector<double> symmetric_values(const CcpMatrix& matrix, std::span<const CcpBlock> blocks) {
  std::vector<double> values(matrix.values.size());
  for_pairs(matrix, blocks, [&](std::size_t here, std::size_t there) {
    values[here] = 0.5 * (matrix.values[here] + matrix.values[there]);
  });
  return values;
}

}  // namespace scree
