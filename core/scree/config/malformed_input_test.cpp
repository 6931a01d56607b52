// Whatever bytes a scene holds, reading it ends in a document or in an Error: no crash, no other exception.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "scree/config/resolved.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/units.hpp"
#include "scree/config/validate.hpp"

namespace scree {
namespace {

constexpr std::uint32_t kSeed = 20250101;  // fixed, so that a failure comes back
constexpr int kTrials = 3000;

constexpr std::string_view kScene = R"(radius = "3 mm"
steps = 20
law = "stokes"
wind = [1, "20 cm/s", -0.5]
groups = ["metal", 'plastic']
zone = { width = 2e-3 }
size = { type = "uniform", from = "1 mm", to = "2 mm" }
attributes.charge = "2 nC"
[[segments]]
length = 1
[[segments]]
length = "1 cm"
)";

std::vector<Parameter> scene_parameters() {
  const std::vector<Variant> sizes{
      {"constant", "", {Parameter::number("value", "m", "").above(0.0)}},
      {"uniform", "", {Parameter::number("from", "m", ""), Parameter::number("to", "m", "").by_default(1.0)}}};
  return {Parameter::number("radius", "m", "").above(0.0).by_default(1.0),
          Parameter::integer("steps", "").at_most(100).optional(),
          Parameter::choice("law", {"stokes", "newton"}, "").by_default("newton"),
          Parameter::vector("wind", "m/s", "").optional(),
          Parameter::texts("groups", "").optional(),
          Parameter::table("zone", {Parameter::number("width", "m", "").by_default(0.5)}, ""),
          Parameter::variant("size", sizes, "").with_shorthand("constant", "value").by_default(0.003),
          Parameter::columns("attributes", sizes, "any", "").optional(),
          Parameter::tables("segments", {Parameter::number("length", "m", "")}, "").optional()};
}

// True when it was accepted; anything but an Error escapes and fails the test.
bool read_scene(const std::string& text) {
  try {
    const Options options = options_from_text(text, scene_parameters());
    EXPECT_FALSE(to_json_text(options).empty());
    return true;
  } catch (const Error& failure) {
    EXPECT_NE(std::string{failure.what()}, "");
    return false;
  }
}

class Mutator {
 public:
  int below(std::size_t bound) { return static_cast<int>(random_() % bound); }

  std::string bytes() {
    std::string text(static_cast<std::size_t>(below(200)), ' ');
    for (char& c : text) c = static_cast<char>(below(256));
    return text;
  }

  // Changes, removes, doubles or swaps a few stretches, or puts in a piece of TOML where it does not belong.
  std::string mutated(std::string text) {
    static constexpr std::string_view kPieces[] = {"[",
                                                   "]]",
                                                   "{",
                                                   "}",
                                                   "\"\"\"",
                                                   "=",
                                                   "nan",
                                                   "-inf",
                                                   "1e999",
                                                   "#",
                                                   "\\u0",
                                                   "\xff",
                                                   "\r",
                                                   "'''",
                                                   "0x",
                                                   "1979-05-27",
                                                   "true",
                                                   ".",
                                                   ",",
                                                   "3 kg",
                                                   "include = ['x']\n",
                                                   "9223372036854775808"};
    for (int edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
      const auto at = static_cast<std::size_t>(below(text.size()));
      const auto length = static_cast<std::size_t>(below(12));
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(static_cast<std::size_t>(below(text.size())), length));
          break;
        default:
          text.insert(at, kPieces[below(std::size(kPieces))]);
      }
    }
    return text;
  }

 private:
  std::mt19937 random_{kSeed};
};

TEST(malformed_input, random_bytes_are_read_or_refused) {
  Mutator mutator;
  for (int trial = 0; trial < kTrials; ++trial) (void)read_scene(mutator.bytes());
}

TEST(malformed_input, damaged_scenes_are_read_or_refused) {
  ASSERT_TRUE(read_scene(std::string{kScene}));
  Mutator mutator;
  int accepted = 0;
  for (int trial = 0; trial < kTrials; ++trial) accepted += read_scene(mutator.mutated(std::string{kScene})) ? 1 : 0;
  // Some damage is harmless (inside a name or a number), most is not: otherwise this test looks at nothing.
  EXPECT_GT(accepted, kTrials / 100);
  EXPECT_LT(accepted, kTrials / 2);
}

TEST(malformed_input, damaged_quantities_are_read_or_refused) {
  Mutator mutator;
  for (int trial = 0; trial < kTrials; ++trial) {
    for (const char* quantity : {"2.5 g/cm3", "44.8 rpm", "1e-3 kg m2/s2", "-30 kV/(m s)"}) {
      try {
        (void)parse_quantity(mutator.mutated(quantity), trial % 2 == 0 ? "kg/m3" : kAnyUnit);
      } catch (const Error&) {
      }
    }
  }
}

TEST(malformed_input, damaged_overrides_are_read_or_refused) {
  Mutator mutator;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::vector<std::string> overrides{mutator.mutated("segments.1.length=\"30 cm\"")};
    try {
      const SceneDocument document = SceneDocument::parse(kScene, "scene.toml", overrides);
      (void)validate(document.root(), scene_parameters(), "the scene");
    } catch (const Error&) {
    }
  }
}

TEST(malformed_input, deep_nesting_is_refused) {
  EXPECT_FALSE(read_scene("wind = " + std::string(100000, '[')));
  EXPECT_FALSE(read_scene("zone = " + std::string(1000, '[') + std::string(1000, ']')));
  std::string dotted = "a";
  for (int i = 0; i < 100000; ++i) dotted += ".a";
  EXPECT_FALSE(read_scene(dotted + " = 1"));
  EXPECT_FALSE(read_scene("[" + dotted + "]"));
}

}  // namespace
}  // namespace scree
