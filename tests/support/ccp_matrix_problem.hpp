// A contact problem with its N written out: the form without bodies.
#pragma once

#include <algorithm>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/delassus.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {

/// N - E of a problem, column by column [1/kg].
inline std::vector<std::vector<double>> columns_of(CcpProblem problem) {
  problem.compliance = {};
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  const std::size_t rows = problem.rows();
  std::vector<std::vector<double>> columns(rows, std::vector<double>(rows));
  std::vector<double> unit(rows, 0.0);
  for (std::size_t j = 0; j < rows; ++j) {
    unit[j] = 1.0;
    delassus.apply(unit, columns[j]);
    unit[j] = 0.0;
  }
  return columns;
}

/// The same problem without bodies, with the same rows in the same order; contacts become cones of three rows.
inline TestingProblem with_matrix(const TestingProblem& problem) {
  TestingProblem out;
  out.r = problem.r;
  out.compliance = problem.compliance;
  for (const CcpContact& contact : problem.contacts) {
    out.blocks.push_back(block_of(contact));
    out.blocks.back().first_row = static_cast<std::uint32_t>(3 * (out.blocks.size() - 1));
  }
  for (CcpBlock block : problem.blocks) {
    block.first_row += static_cast<std::uint32_t>(3 * problem.contacts.size());
    out.blocks.push_back(block);
  }
  for (CcpBlock& block : out.blocks) block.a = block.b = 0;

  const std::vector<std::vector<double>> columns = columns_of(problem.view());
  out.matrix_first.push_back(0);
  for (const CcpBlock& row : out.blocks) {
    for (std::uint32_t column = 0; column < out.blocks.size(); ++column) {
      const CcpBlock& other = out.blocks[column];
      std::vector<double> values;
      for (std::size_t i = row.first_row; i < row.first_row + std::size_t{row.rows}; ++i) {
        for (std::size_t j = other.first_row; j < other.first_row + std::size_t{other.rows}; ++j) {
          values.push_back(0.5 * (columns[j][i] + columns[i][j]));  // symmetric to the bit
        }
      }
      if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; })) continue;
      out.matrix_column.push_back(column);
      out.matrix_value.push_back(out.matrix_values.size());
      out.matrix_values.insert(out.matrix_values.end(), values.begin(), values.end());
    }
    out.matrix_first.push_back(static_cast<std::uint32_t>(out.matrix_column.size()));
  }
  return out;
}

}  // namespace scree::test
