// Impulses follow their contacts from step to step, whatever else comes or goes.
#include "scree/ccp/contact_memory.hpp"

#include <gtest/gtest.h>

#include "support/memory_state.hpp"

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

TEST(contact_memory, angular_impulses_go_with_their_contacts_and_through_a_checkpoint) {
  std::vector<ContactKey> keys = {{1, 2, 0, 0, 0}, {1, 3, 0, 0, 0}};
  std::vector<Vec3> impulse = {{1, 0, 0}, {2, 0, 0}}, angular = {{0, 3, 0}, {0, 4, 0}};
  ContactMemory memory;
  memory.store(keys, impulse, angular);
  test::MemoryState state;
  test::MemoryWriter writer{state};
  memory.save(writer);
  ContactMemory loaded;
  loaded.load(test::MemoryReader{state});

  const std::vector<ContactKey> now = {{1, 3, 0, 0, 0}, {2, 3, 0, 0, 0}};
  for (const ContactMemory* one : {&memory, &loaded}) {
    std::vector<Vec3> found(2, Vec3{7, 7, 7}), turned(2, Vec3{7, 7, 7});
    one->recall(now, found, turned);
    EXPECT_EQ(found, (std::vector<Vec3>{{2, 0, 0}, {}}));
    EXPECT_EQ(turned, (std::vector<Vec3>{{0, 4, 0}, {}}));
  }
}

// A step in which nothing resists rolling forgets what earlier ones stored.
TEST(contact_memory, angular_impulses_do_not_outlive_their_step) {
  std::vector<ContactKey> keys = {{1, 2, 0, 0, 0}};
  std::vector<Vec3> impulse = {{1, 0, 0}}, angular = {{0, 3, 0}};
  ContactMemory memory;
  memory.store(keys, impulse, angular);
  keys = {{1, 2, 0, 0, 0}};
  impulse = {{5, 0, 0}};
  memory.store(keys, impulse);
  std::vector<Vec3> found(1), turned(1, Vec3{7, 7, 7});
  memory.recall(std::vector<ContactKey>{{1, 2, 0, 0, 0}}, found, turned);
  EXPECT_EQ(found[0], (Vec3{5, 0, 0}));
  EXPECT_EQ(turned[0], Vec3{});
}

}  // namespace
}  // namespace scree
