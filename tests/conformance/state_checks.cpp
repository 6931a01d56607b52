// Every entry that can be made and set up: that it is, and that its checkpoint holds all that it saves.
#include <gtest/gtest.h>

#include <bit>

#include "conformance/subject.hpp"
#include "scree/state/memory_state.hpp"
#include "support/memory_state.hpp"

namespace scree::test {
namespace {

class Made : public testing::TestWithParam<Subject> {};
class State : public testing::TestWithParam<Subject> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Made);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(State);

std::vector<Subject> makeable() {
  std::vector<Subject> some = subjects();
  std::erase_if(some, [](const Subject& subject) { return !subject.options; });
  return some;
}

/// What a plugin saves, bit by bit.
struct Saved {
  explicit Saved(const Plugin& plugin) {
    test::MemoryState state;
    MemoryWriter writer{state};
    plugin.save(writer);
    for (const auto& [name, values] : state.doubles) {
      std::vector<std::uint64_t>& out = bits[name];
      for (const double value : values) out.push_back(std::bit_cast<std::uint64_t>(value));
    }
    integers = state.integers;
    texts = state.texts;
  }
  bool operator==(const Saved&) const = default;

  std::map<std::string, std::vector<std::uint64_t>> bits;
  std::map<std::string, std::vector<std::uint64_t>> integers;
  std::map<std::string, std::string> texts;
};

TEST_P(Made, from_its_settings_twice) {
  ASSERT_EQ(GetParam().failure, "");
  const std::unique_ptr<Plugin> one = GetParam().make();
  const std::unique_ptr<Plugin> two = GetParam().make();
  ASSERT_NE(one, nullptr);
  ASSERT_NE(two, nullptr);
  EXPECT_NE(one, two) << "two parts of a scene must not share an object";
  EXPECT_EQ(one->version(), two->version());
}

// Law: a new part that loads a checkpoint saves that very checkpoint, also when it held something before.
TEST_P(State, saved_and_loaded_is_saved_the_same) {
  FakeSceneServices services;
  FakeSceneServices other_services;
  const std::unique_ptr<Plugin> one = GetParam().make();
  const std::unique_ptr<Plugin> two = GetParam().make();
  set_up(*one, GetParam().entry.kind, services);
  set_up(*two, GetParam().entry.kind, other_services);
  scree::MemoryState checkpoint;
  one->save(checkpoint.writer());
  for (int time = 0; time < 2; ++time) {
    two->load(checkpoint.reader());
    EXPECT_TRUE(Saved{*two} == Saved{*one}) << "loaded " << time + 1 << " times";
  }
}

INSTANTIATE_TEST_SUITE_P(entry, Made, testing::ValuesIn(makeable()), subject_case_name);
INSTANTIATE_TEST_SUITE_P(entry, State, testing::ValuesIn(living_subjects()), subject_case_name);

}  // namespace
}  // namespace scree::test
