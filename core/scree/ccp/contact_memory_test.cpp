// Impulses follow their contacts from step to step, whatever else comes or goes.
#include "scree/ccp/contact_memory.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(contact_memory, impulses_follow_their_keys_and_new_contacts_start_at_zero) {
  std::vector<ContactKey> old = {{1, 2, 0, 0, 0}, {1, 2, 0, 1, 0}, {1, 2, 0, 1, 5}, {1, 9, 0, 0, 0}, {4, 7, 0, 0, 3}};
  std::vector<Vec3> impulse = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}};
  ContactMemory memory;
  memory.store(old, impulse);

  const std::vector<ContactKey> now = {
      {0, 1, 0, 0, 0}, {1, 2, 0, 1, 5}, {1, 3, 0, 0, 0}, {4, 7, 0, 0, 3}, {8, 9, 0, 0, 0}};
  std::vector<Vec3> found(now.size(), Vec3{7, 7, 7});
  memory.recall(now, found);
  EXPECT_EQ(found, (std::vector<Vec3>{{}, {3, 0, 0}, {}, {5, 0, 0}, {}}));
}

TEST(contact_memory, nothing_is_recalled_after_clear) {
  std::vector<ContactKey> keys = {{1, 2, 0, 0, 0}};
  std::vector<Vec3> impulse = {{1, 2, 3}};
  ContactMemory memory;
  memory.store(keys, impulse);
  memory.clear();
  keys = {{1, 2, 0, 0, 0}};
  std::vector<Vec3> found(1, Vec3{7, 7, 7});
  memory.recall(keys, found);
  EXPECT_EQ(found[0], Vec3{});
}

}  // namespace
}  // namespace scree
