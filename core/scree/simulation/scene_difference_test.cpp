#include "scree/simulation/scene_difference.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(differing_settings, names_each_difference_once) {
  const auto differing = [](const char* one, const char* other) {
    std::vector<std::string> there = differing_settings(one, other);
    EXPECT_EQ(there, differing_settings(other, one));
    return there;
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(differing(R"({"simulation": {"time_step": 1, "end_time": 2}, "observer": [{"type": "a"}]})",
                      R"({"simulation": {"time_step": 2, "end_time": 3}, "observer": []})"),
            Keys{"simulation.time_step"});
  // Another solver has other settings, which nobody has set.
  EXPECT_EQ(differing(R"({"ccp_solver": [{"type": "pgs", "name": "pgs", "relaxation": 1}]})",
                      R"({"ccp_solver": [{"type": "apgd", "name": "apgd", "growth": 2}]})"),
            Keys{"ccp_solver.0.type"});
  // A list of another length: not the entries that have moved on.
  EXPECT_EQ(differing(R"({"body": [{"shape": "a"}, {"shape": "b"}]})", R"({"body": [{"shape": "b"}]})"), Keys{"body"});
  EXPECT_EQ(differing(R"({"body": [{"position": [0, 0, 0]}]})", R"({"body": [{"position": [0, 1, 2]}]})"),
            Keys{"body.0.position"});
  EXPECT_EQ(differing(R"({"material_pair": [{"friction": 1}]})", R"({"material_pair": [{"friction": 2}]})"),
            Keys{"material_pair"});
  EXPECT_EQ(differing(R"({"material": {"a": {"friction": 1}}, "material_pair": [{"friction": 1}]})",
                      R"({"material": {"a": {"friction": 2}}, "material_pair": [{"friction": 2}]})"),
            Keys{"material.a.friction"});
  EXPECT_EQ(differing("no JSON", "{}"), Keys{});
}

}  // namespace
}  // namespace scree
