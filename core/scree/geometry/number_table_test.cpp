#include "scree/geometry/number_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scree {
namespace {

TEST(read_numbers, takes_numbers_apart_by_what_instruments_write) {
  EXPECT_EQ(read_numbers("1 2.5\t-3e-2;4,  +5\r").numbers, (std::vector<double>{1, 2.5, -0.03, 4, 5}));
  EXPECT_TRUE(read_numbers("").numbers.empty());
  EXPECT_TRUE(read_numbers(" \t ").numbers.empty());
}

TEST(read_numbers, ends_at_comments) {
  EXPECT_EQ(read_numbers("1 2 # 3").numbers, (std::vector<double>{1, 2}));
  EXPECT_TRUE(read_numbers("% material particle").numbers.empty());
}

TEST(read_numbers, nan_is_a_number_and_words_are_not) {
  const NumberRow row = read_numbers("1 NaN nan 2mm 3");
  EXPECT_EQ(row.numbers.size(), 3u);
  EXPECT_TRUE(std::isnan(row.numbers[1]) && std::isnan(row.numbers[2]));
  EXPECT_EQ(row.bad_word, "2mm");
  EXPECT_EQ(row.word, 4u);
  for (const char* word : {"x", "1e", "--1", "+-1", "+", "0x10", "1e999", "1.2.3"}) {
    EXPECT_EQ(read_numbers(word).bad_word, word);
  }
}

}  // namespace
}  // namespace scree
