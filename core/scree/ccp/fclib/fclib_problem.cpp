#include "scree/ccp/fclib/fclib_problem.hpp"

namespace scree {

std::size_t FclibProblem::contact_rows() const {
  if (const auto* global = std::get_if<FclibGlobal>(&form)) return global->H.columns;
  return std::get<FclibLocal>(form).W.rows;
}

std::size_t FclibProblem::bilateral_rows() const {
  if (const auto* global = std::get_if<FclibGlobal>(&form)) return global->G.columns;
  return std::get<FclibLocal>(form).V.columns;
}

std::size_t FclibProblem::freedoms() const {
  const auto* global = std::get_if<FclibGlobal>(&form);
  return global != nullptr ? global->M.rows : 0;
}

std::size_t FclibProblem::rows_per_contact() const {
  return mu.empty() ? static_cast<std::size_t>(spacedim) : contact_rows() / mu.size();
}

}  // namespace scree
