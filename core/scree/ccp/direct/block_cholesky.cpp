#include "scree/ccp/direct/block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

namespace scree::direct {
namespace {

using Matrix = Eigen::MatrixXd;
using Stride = Eigen::OuterStride<>;
using Block = Eigen::Map<Matrix, 0, Stride>;
using ConstBlock = Eigen::Map<const Matrix, 0, Stride>;

}  // namespace

void BlockCholesky::analyse(std::span<const std::uint32_t> size, std::span<const Edge> edges) {
  elimination_ = eliminate(size, edges);
  size_.assign(size.begin(), size.end());
  edges_.assign(edges.begin(), edges.end());
  first_.assign(size.size() + 1, 0);
  diagonal_at_.assign(1, 0);
  for (std::size_t k = 0; k < size.size(); ++k) {
    first_[k + 1] = first_[k] + size[k];
    diagonal_at_.push_back(diagonal_at_.back() + std::size_t{size[k]} * size[k]);
  }
  edge_at_.assign(1, diagonal_at_.back());
  for (const Edge& e : edges) edge_at_.push_back(edge_at_.back() + std::size_t{size[e.a]} * size[e.b]);
  values_.assign(edge_at_.back(), 0.0);

  const std::size_t supernodes = elimination_.supernodes.size(), blocks = size.size() + edges.size();
  const auto supernode_of = [&](std::size_t k) {
    return (k < size.size() ? elimination_.diagonal[k] : elimination_.edge[k - size.size()]).supernode;
  };
  first_entry_.assign(supernodes + 1, 0);
  for (std::size_t k = 0; k < blocks; ++k) ++first_entry_[supernode_of(k) + 1];
  for (std::size_t s = 0; s < supernodes; ++s) first_entry_[s + 1] += first_entry_[s];
  std::vector<std::uint32_t> next(first_entry_.begin(), first_entry_.end());
  entry_.resize(blocks);
  for (std::size_t k = 0; k < blocks; ++k) entry_[next[supernode_of(k)]++] = static_cast<std::uint32_t>(k);

  panel_.resize(elimination_.panel_size);
  front_.resize(elimination_.largest_front * elimination_.largest_front);
  stack_.resize(elimination_.stack_size);
  x_.resize(first_.back());
  below_.resize(elimination_.largest_front);
}

void BlockCholesky::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

std::span<double> BlockCholesky::diagonal(std::size_t node) {
  return {values_.data() + diagonal_at_[node], std::size_t{size_[node]} * size_[node]};
}

std::span<double> BlockCholesky::off_diagonal(std::size_t edge) {
  return {values_.data() + edge_at_[edge], edge_at_[edge + 1] - edge_at_[edge]};
}

// Puts the blocks of the matrix that belong to a supernode into its front.
void BlockCholesky::assemble(std::uint32_t supernode, double* front) const {
  const Supernode& s = elimination_.supernodes[supernode];
  Block f(front, s.size, s.size, Stride(s.size));
  for (std::uint32_t k = first_entry_[supernode]; k < first_entry_[supernode + 1]; ++k) {
    const std::size_t block = entry_[k];
    const bool on_diagonal = block < size_.size();
    const std::size_t edge = block - size_.size();
    const Place& at = on_diagonal ? elimination_.diagonal[block] : elimination_.edge[edge];
    const std::uint32_t rows = on_diagonal ? size_[block] : size_[edges_[edge].b];
    const std::uint32_t columns = on_diagonal ? size_[block] : size_[edges_[edge].a];
    const double* const values = values_.data() + (on_diagonal ? diagonal_at_[block] : edge_at_[edge]);
    const ConstBlock given(values, rows, columns, Stride(rows));
    if (at.transposed) {
      f.block(at.row, at.column, columns, rows) += given.transpose();
    } else {
      f.block(at.row, at.column, rows, columns) += given;
    }
  }
}

void BlockCholesky::add_update(const Supernode& child, const Supernode& parent, const double* update,
                               double* front) const {
  const std::uint32_t below = child.size - child.columns;
  const ConstBlock given(update, below, below, Stride(below));
  Block f(front, parent.size, parent.size, Stride(parent.size));
  std::uint32_t column = 0;
  for (std::uint32_t j = child.first_below; j < child.last_below; ++j) {
    const std::uint32_t pj = elimination_.below[j], width = elimination_.offset[pj + 1] - elimination_.offset[pj];
    std::uint32_t row = column;
    for (std::uint32_t i = j; i < child.last_below; ++i) {
      const std::uint32_t pi = elimination_.below[i], height = elimination_.offset[pi + 1] - elimination_.offset[pi];
      f.block(elimination_.below_target[i], elimination_.below_target[j], height, width) +=
          given.block(row, column, height, width);
      row += height;
    }
    column += width;
  }
}

bool BlockCholesky::factor() {
  std::size_t top = 0;  // of the stack
  std::vector<Supernode>& supernodes = elimination_.supernodes;
  waiting_.clear();
  for (std::uint32_t k = 0; k < supernodes.size(); ++k) {
    const Supernode& s = supernodes[k];
    const std::uint32_t below = s.size - s.columns;
    double* const front = front_.data();
    std::fill(front, front + std::size_t{s.size} * s.size, 0.0);
    assemble(k, front);
    for (std::uint32_t c = 0; c < s.children; ++c) {
      const Supernode& child = supernodes[waiting_.back()];
      waiting_.pop_back();
      top -= std::size_t{child.size - child.columns} * (child.size - child.columns);
      add_update(child, s, stack_.data() + top, front);
    }
    Block f(front, s.size, s.size, Stride(s.size));
    Eigen::Ref<Matrix, 0, Stride> own = f.topLeftCorner(s.columns, s.columns);
    const Eigen::LLT<Eigen::Ref<Matrix, 0, Stride>> llt(own);
    if (llt.info() != Eigen::Success || !own.diagonal().allFinite()) return false;
    Block panel(panel_.data() + s.panel, s.size, s.columns, Stride(s.size));
    if (below > 0) {
      auto update = f.bottomRightCorner(below, below);
      auto side = f.bottomLeftCorner(below, s.columns);
      own.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(side);
      update.selfadjointView<Eigen::Lower>().rankUpdate(side, -1.0);
      Block(stack_.data() + top, below, below, Stride(below)).triangularView<Eigen::Lower>() = update;
      top += std::size_t{below} * below;
      waiting_.push_back(k);
    }
    panel = f.leftCols(s.columns);
  }
  return true;
}

// x_ = x in elimination order, or back.
void BlockCholesky::permute(std::span<double> x, bool back) {
  for (std::size_t k = 0; k < size_.size(); ++k) {
    double* const ordered = x_.data() + elimination_.offset[elimination_.position[k]];
    double* const given = x.data() + first_[k];
    if (back) {
      std::copy(ordered, ordered + size_[k], given);
    } else {
      std::copy(given, given + size_[k], ordered);
    }
  }
}

void BlockCholesky::solve(std::span<double> x) {
  permute(x, false);
  const std::vector<Supernode>& supernodes = elimination_.supernodes;
  const auto visit_below = [&](const Supernode& s, const auto& visit) {
    std::uint32_t row = 0;
    for (std::uint32_t i = s.first_below; i < s.last_below; ++i) {
      const std::uint32_t p = elimination_.below[i];
      for (std::uint32_t at = elimination_.offset[p]; at < elimination_.offset[p + 1]; ++at) visit(row++, at);
    }
  };
  for (std::size_t k = 0; k < supernodes.size(); ++k) {
    const Supernode& s = supernodes[k];
    const ConstBlock panel(panel_.data() + s.panel, s.size, s.columns, Stride(s.size));
    Eigen::Map<Eigen::VectorXd> own(x_.data() + elimination_.offset[s.first], s.columns);
    panel.topRows(s.columns).triangularView<Eigen::Lower>().solveInPlace(own);
    Eigen::Map<Eigen::VectorXd> below(below_.data(), s.size - s.columns);
    below.noalias() = panel.bottomRows(s.size - s.columns) * own;
    visit_below(s, [&](std::uint32_t row, std::uint32_t at) { x_[at] -= below_[row]; });
  }
  for (std::size_t k = supernodes.size(); k-- > 0;) {
    const Supernode& s = supernodes[k];
    const ConstBlock panel(panel_.data() + s.panel, s.size, s.columns, Stride(s.size));
    Eigen::Map<Eigen::VectorXd> own(x_.data() + elimination_.offset[s.first], s.columns);
    Eigen::Map<Eigen::VectorXd> below(below_.data(), s.size - s.columns);
    visit_below(s, [&](std::uint32_t row, std::uint32_t at) { below_[row] = x_[at]; });
    own.noalias() -= panel.bottomRows(s.size - s.columns).transpose() * below;
    panel.topRows(s.columns).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  permute(x, true);
}

}  // namespace scree::direct
