// Who may write which file of a run.
#include "scree/results/result_claims.hpp"

#include <gtest/gtest.h>

namespace scree {
namespace {

TEST(result_claims, a_file_belongs_to_the_first_who_claims_it) {
  ResultClaims claims;
  EXPECT_EQ(claims.claim("one", "energy_series.csv"), "");
  EXPECT_EQ(claims.claim("one", "energy_series.csv"), "");
  EXPECT_EQ(claims.claim("other", "energy_series.csv"), "one");
  EXPECT_EQ(claims.claim("other", "energy_series_2.csv"), "");
}

TEST(result_claims, the_run_has_its_own_files) {
  for (const char* file : {kStepsFile, kRemovedFile, kJointsFile, kRunFile, kCheckpointFile, kLastStateFile,
                           "ccp_12.h5", ".scree_results"}) {
    EXPECT_EQ(ResultClaims{}.claim("one", file), "the run itself") << file;
    EXPECT_EQ(ResultClaims{}.claim("one", std::string{file} + ".part"), "the run itself") << file;
  }
  EXPECT_EQ(ResultClaims{}.claim("one", "ccp_a.h5"), "");
}

TEST(result_claims, a_star_stands_for_a_number) {
  ResultClaims claims;
  EXPECT_EQ(claims.claim("frames", "walls_*.vtp"), "");
  EXPECT_EQ(claims.claim("other", "walls_00000012.vtp"), "frames");
  EXPECT_EQ(claims.claim("other", "walls_*.vtp"), "frames");
  for (const char* file : {"walls_.vtp", "walls_a.vtp", "walls_1_2.vtp", "walls_upper_*.vtp", "walls_1.vti"}) {
    EXPECT_EQ(claims.claim("other", file), "") << file;
  }
  EXPECT_TRUE(claims.has("walls_3.vtp"));
  EXPECT_FALSE(claims.has("balls_3.vtp"));
}

TEST(result_claims, a_file_lies_in_the_folder_of_results) {
  for (const char* file : {"", ".", "..", "../up.csv", "/tmp/x.csv", "sub/x.csv", "./x.csv", "a\nb.csv"}) {
    EXPECT_NE(ResultClaims::fault_of(file), "") << file;
  }
  EXPECT_NE(ResultClaims::fault_of(std::string(250, 'a') + ".csv"), "");
  for (const char* file : {"x.csv", "in and out (2).csv", "x_*.vtp"}) EXPECT_EQ(ResultClaims::fault_of(file), "");
}

}  // namespace
}  // namespace scree
