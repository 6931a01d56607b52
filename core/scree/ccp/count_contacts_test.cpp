// What counts as a contact of a contact problem.
#include "scree/ccp/count_contacts.hpp"

#include <gtest/gtest.h>

#include <array>

namespace scree {
namespace {

CcpBlock block(CcpKind kind, std::uint8_t rows) {
  CcpBlock block;
  block.kind = kind;
  block.rows = rows;
  return block;
}

std::size_t count(std::span<const CcpContact> contacts, std::span<const CcpBlock> blocks) {
  CcpProblem problem{};
  problem.contacts = contacts;
  problem.blocks = blocks;
  return count_contacts(problem);
}

TEST(count_contacts, counts_cones_of_any_number_of_rows) {
  const std::array<CcpContact, 2> plain{};
  const std::array blocks{block(CcpKind::cone, 5), block(CcpKind::cone, 6), block(CcpKind::cone, 1)};
  EXPECT_EQ(count(plain, blocks), 5U);
  EXPECT_EQ(count({}, blocks), 3U);
  EXPECT_EQ(count(plain, {}), 2U);
}

TEST(count_contacts, counts_no_joints_limits_or_motors) {
  const std::array blocks{block(CcpKind::free, 6), block(CcpKind::nonnegative, 1), block(CcpKind::box, 1),
                          block(CcpKind::cone, 6)};
  EXPECT_EQ(count({}, blocks), 1U);
}

}  // namespace
}  // namespace scree
