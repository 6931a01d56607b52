#include "scree/ccp/direct/elimination.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace scree::direct {
namespace {

using Structure = std::vector<std::vector<std::uint32_t>>;  ///< rows below the diagonal, per column, ascending
constexpr std::uint32_t kNone = 0xffffffffU;

/// A front may be so much larger for the sake of fewer, wider supernodes: unknowns that are zero, over all.
constexpr double kAllowedZeros = 0.2;
/// Supernodes up to so many unknowns are joined whatever it costs.
constexpr std::uint32_t kNarrow = 24;

/// Nodes in the order of elimination.
std::vector<std::uint32_t> minimum_degree(std::size_t nodes, std::span<const Edge> edges) {
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(2 * edges.size() + nodes);
  for (const Edge& e : edges) {
    const int a = static_cast<int>(e.a), b = static_cast<int>(e.b);
    entries.emplace_back(a, b, 1.0);
    entries.emplace_back(b, a, 1.0);
  }
  for (std::size_t k = 0; k < nodes; ++k) entries.emplace_back(static_cast<int>(k), static_cast<int>(k), 1.0);
  const int n = static_cast<int>(nodes);
  Eigen::SparseMatrix<double, Eigen::ColMajor, int> pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>{}(pattern, order);
  std::vector<std::uint32_t> nodes_in_order(nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    nodes_in_order[k] = static_cast<std::uint32_t>(order.indices()[static_cast<Eigen::Index>(k)]);
  }
  return nodes_in_order;
}

/// Rows of each column of the factor, for nodes numbered in elimination order.
Structure structure_of(std::size_t nodes, std::span<const Edge> edges) {
  Structure rows(nodes);
  for (const Edge& e : edges) rows[std::min(e.a, e.b)].push_back(std::max(e.a, e.b));
  std::vector<std::vector<std::uint32_t>> children(nodes);
  std::vector<std::uint32_t> seen(nodes, kNone);
  for (std::uint32_t j = 0; j < nodes; ++j) {
    std::vector<std::uint32_t> own;
    seen[j] = j;
    const auto take = [&](const std::vector<std::uint32_t>& from) {
      for (const std::uint32_t i : from) {
        if (seen[i] != j) own.push_back(i), seen[i] = j;
      }
    };
    take(rows[j]);
    for (const std::uint32_t child : children[j]) take(rows[child]);
    std::sort(own.begin(), own.end());
    rows[j] = std::move(own);
    if (!rows[j].empty()) children[rows[j].front()].push_back(j);
  }
  return rows;
}

/// New place of each column so that every subtree is contiguous and children come before their parent.
std::vector<std::uint32_t> postorder(const Structure& rows) {
  const auto nodes = static_cast<std::uint32_t>(rows.size());
  std::vector<std::uint32_t> subtree(nodes, 1), end(nodes), place(nodes);
  for (std::uint32_t j = 0; j < nodes; ++j) {
    if (!rows[j].empty()) subtree[rows[j].front()] += subtree[j];
  }
  // From the last column on: a parent has its place before its children look for theirs.
  std::uint32_t roots_end = nodes;
  for (std::uint32_t j = nodes; j-- > 0;) {
    std::uint32_t& top = rows[j].empty() ? roots_end : end[rows[j].front()];
    place[j] = top - 1;
    end[j] = top - 1;
    top -= subtree[j];
  }
  return place;
}

/// Unknowns of `positions`.
std::uint32_t unknowns(const Elimination& out, std::span<const std::uint32_t> positions) {
  std::uint32_t sum = 0;
  for (const std::uint32_t p : positions) sum += out.offset[p + 1] - out.offset[p];
  return sum;
}

/// Cuts the columns into supernodes. Column j joins those before it when it is the parent of the last one and little is lost.
void find_supernodes(const Structure& rows, Elimination& out) {
  const auto nodes = static_cast<std::uint32_t>(rows.size());
  double zeros = 0.0;  // of the supernode that is growing
  for (std::uint32_t j = 0; j < nodes; ++j) {
    const bool child = j > 0 && !rows[j - 1].empty() && rows[j - 1].front() == j;
    if (child) {
      Supernode& s = out.supernodes.back();
      const double columns = out.offset[j] - out.offset[s.first], own = out.offset[j + 1] - out.offset[j];
      const double below = unknowns(out, rows[j]);
      const double missing = own + below - unknowns(out, rows[j - 1]);  // rows that the columns before did not have
      const double all = (columns + own) * (columns + own + below);
      if (columns + own <= kNarrow || zeros + missing * columns <= kAllowedZeros * all) {
        zeros += missing * columns;
        s.last = j + 1;
        continue;
      }
    }
    zeros = 0.0;
    out.supernodes.push_back({.first = j, .last = j + 1});
  }
  for (Supernode& s : out.supernodes) {
    s.first_below = static_cast<std::uint32_t>(out.below.size());
    out.below.insert(out.below.end(), rows[s.last - 1].begin(), rows[s.last - 1].end());
    s.last_below = static_cast<std::uint32_t>(out.below.size());
    s.columns = out.offset[s.last] - out.offset[s.first];
    s.size = s.columns + unknowns(out, rows[s.last - 1]);
    s.panel = out.panel_size;
    out.panel_size += std::size_t{s.size} * s.columns;
    out.largest_front = std::max(out.largest_front, std::size_t{s.size});
  }
}

/// Row of the front of `s` where position p begins.
std::uint32_t row_in_front(const Elimination& out, const Supernode& s, std::uint32_t p) {
  if (p < s.last) return out.offset[p] - out.offset[s.first];
  const auto begin = out.below.begin() + s.first_below, end = out.below.begin() + s.last_below;
  const auto at = std::lower_bound(begin, end, p);
  return s.columns + unknowns(out, {begin, at});
}

/// Parents, where updates go, and how much of them waits at a time.
void link(Elimination& out, std::span<const std::uint32_t> supernode_of) {
  out.below_target.resize(out.below.size());
  std::vector<std::size_t> waiting(out.supernodes.size(), 0);  // updates of the children of each
  std::size_t stack = 0;
  for (std::uint32_t k = 0; k < out.supernodes.size(); ++k) {
    Supernode& s = out.supernodes[k];
    stack -= waiting[k];
    const std::size_t update = std::size_t{s.size - s.columns} * (s.size - s.columns);
    s.parent = update == 0 ? k : supernode_of[out.below[s.first_below]];
    if (update == 0) continue;
    stack += update;
    waiting[s.parent] += update;
    out.stack_size = std::max(out.stack_size, stack);
    Supernode& parent = out.supernodes[s.parent];
    ++parent.children;
    for (std::uint32_t i = s.first_below; i < s.last_below; ++i) {
      out.below_target[i] = row_in_front(out, parent, out.below[i]);
    }
  }
}

}  // namespace

Elimination eliminate(std::span<const std::uint32_t> size, std::span<const Edge> edges) {
  const std::size_t nodes = size.size();
  Elimination out;
  out.offset.assign(nodes + 1, 0);
  if (nodes == 0) return out;
  out.position.resize(nodes);
  const std::vector<std::uint32_t> order = minimum_degree(nodes, edges);
  for (std::uint32_t k = 0; k < nodes; ++k) out.position[order[k]] = k;
  std::vector<Edge> renamed(edges.size());
  const auto rename = [&] {
    for (std::size_t e = 0; e < edges.size(); ++e) renamed[e] = {out.position[edges[e].a], out.position[edges[e].b]};
  };
  rename();
  const std::vector<std::uint32_t> place = postorder(structure_of(nodes, renamed));
  for (std::uint32_t& p : out.position) p = place[p];
  rename();

  for (std::size_t k = 0; k < nodes; ++k) out.offset[out.position[k] + 1] = size[k];
  for (std::size_t k = 0; k < nodes; ++k) out.offset[k + 1] += out.offset[k];
  find_supernodes(structure_of(nodes, renamed), out);

  std::vector<std::uint32_t> supernode_of(nodes);
  for (std::uint32_t k = 0; k < out.supernodes.size(); ++k) {
    for (std::uint32_t j = out.supernodes[k].first; j < out.supernodes[k].last; ++j) supernode_of[j] = k;
  }
  link(out, supernode_of);
  const auto place_of = [&](std::uint32_t row, std::uint32_t column) {
    const std::uint32_t k = supernode_of[std::min(row, column)];
    const Supernode& s = out.supernodes[k];
    return Place{k, row_in_front(out, s, std::max(row, column)), row_in_front(out, s, std::min(row, column)),
                 row < column};
  };
  for (const std::uint32_t p : out.position) out.diagonal.push_back(place_of(p, p));
  for (const Edge& e : renamed) out.edge.push_back(place_of(e.b, e.a));
  return out;
}

}  // namespace scree::direct
