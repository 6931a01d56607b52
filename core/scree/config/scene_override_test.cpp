#include <gtest/gtest.h>

#include "scree/config/scene_document.hpp"
#include "scree/config/validate.hpp"

namespace scree {
namespace {

constexpr const char* kScene = R"(
title = "overridden"
weights = [1, 2]
[electrode]
voltage = "20 kV"
[[source]]
type = "emitter"
name = "left"
rate = 1
[[source]]
type = "emitter"
name = "right"
rate = 2
[[source]]
type = "bed"
[stepper]
type = "dvi"
step = 1
)";

SceneDocument with(std::vector<std::string> overrides) { return SceneDocument::parse(kScene, "scene.toml", overrides); }

double voltage_after(const std::string& assignment) {
  const SceneDocument document = with({assignment});
  return validate(document.root().table("electrode"), {Parameter::number("voltage", "V", "of the electrode")},
                  "electrode")
      .number("voltage");
}

TEST(scene_override, values_are_toml_or_else_strings) {
  EXPECT_EQ(voltage_after("electrode.voltage=30000"), 30000.0);
  EXPECT_EQ(voltage_after("electrode.voltage=\"30 kV\""), 30000.0);
  EXPECT_EQ(voltage_after("electrode.voltage=30 kV"), 30000.0);
  EXPECT_EQ(voltage_after(" electrode . voltage = 3e4 "), 30000.0);
  EXPECT_EQ(with({"title=a=b"}).root().text("title"), "a=b");
  EXPECT_EQ(with({"title="}).root().text("title"), "");
  EXPECT_EQ(with({"title=1\nother = 2"}).root().text("title"), "1\nother = 2");  // no second key slips in
  EXPECT_EQ(with({"title=1979-05-27"}).root().text("title"), "1979-05-27");
}

TEST(scene_override, list_entries_are_found_by_index_name_or_type) {
  EXPECT_EQ(with({"source.1.name=east"}).root().tables("source")[1].text("name"), "east");
  EXPECT_EQ(with({"source.left.name=west"}).root().tables("source")[0].text("name"), "west");
  EXPECT_EQ(with({"source.bed.name=floor"}).root().tables("source")[2].text("name"), "floor");
  EXPECT_EQ(with({"stepper.dvi.name=x"}).root().table("stepper").text("name"), "x");
  EXPECT_EQ(with({"stepper.0.name=x"}).root().table("stepper").text("name"), "x");
}

TEST(scene_override, later_overrides_win_and_tables_can_be_set) {
  EXPECT_EQ(with({"title=one", "title=two"}).root().text("title"), "two");
  EXPECT_EQ(with({"electrode={ shape = 'rod' }"}).root().table("electrode").text("shape"), "rod");
  EXPECT_EQ(with({"electrode={ shape = 'rod' }", "electrode.shape=wire"}).root().table("electrode").text("shape"),
            "wire");
}

TEST(scene_override, places_name_the_command_line) {
  const SceneDocument document = with({"electrode.voltage=30 kg"});
  const SourceLocation place = document.root().table("electrode").location("voltage");
  EXPECT_EQ(place.file, "--set electrode.voltage=30 kg");
  EXPECT_EQ(place.line, 0);
}

std::string refusal(const std::string& assignment) {
  try {
    (void)with({assignment});
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::usage);
    return failure.what();
  }
  return "accepted";
}

TEST(scene_override, paths_that_name_nothing_are_refused_with_a_suggestion) {
  EXPECT_EQ(refusal("electrod.voltage=1"),
            "--set electrod.voltage=1: the scene has no table 'electrod'; did you mean 'electrode'? Valid are 'title', "
            "'weights', 'electrode', 'source' and 'stepper'");
  EXPECT_EQ(refusal("source.3.rate=1"),
            "--set source.3.rate=1: 'source' has 3 entries, counted from 0; there is no entry 3");
  EXPECT_EQ(refusal("source.rihgt.rate=1"),
            "--set source.rihgt.rate=1: 'source' has no entry 'rihgt'; did you mean 'right'? Valid are 'left', 'right' "
            "and 'bed'");
  EXPECT_EQ(refusal("source.emitter.rate=1"),
            "--set source.emitter.rate=1: 2 entries of 'source' have the type 'emitter'; address one by its index, for "
            "example source.0");
  EXPECT_EQ(refusal("title.voltage=1"), "--set title.voltage=1: 'title' is a string and has no key 'voltage'");
  EXPECT_EQ(refusal("electrode.gap.width=1"),
            "--set electrode.gap.width=1: 'electrode' has no table 'gap'; valid are 'voltage'");
  for (const char* malformed : {"title", "=1", "a..b=1", ".=1", ""}) {
    EXPECT_EQ(refusal(malformed), "--set " + std::string{malformed} +
                                      ": an override must have the form key=value, for example "
                                      "electrode.voltage=\"30 kV\"");
  }
}

}  // namespace
}  // namespace scree
