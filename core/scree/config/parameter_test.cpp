#include "scree/config/parameter.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "scree/config/suggest.hpp"

namespace scree {
namespace {

TEST(parameter, a_default_makes_it_optional_and_takes_the_kind) {
  const Parameter whole = Parameter::number("radius", "m", "of the roll").by_default(1);
  EXPECT_FALSE(whole.required);
  EXPECT_EQ(std::get<double>(whole.default_value), 1.0);
  const Parameter axis = Parameter::vector("axis", "1", "of the roll").by_default(std::vector<double>{0, 0, 1});
  EXPECT_EQ(std::get<Vec3>(axis.default_value).z, 1.0);
  EXPECT_TRUE(Parameter::text("name", "of the roll").required);
}

TEST(parameter, a_default_of_another_kind_is_a_programming_error) {
  EXPECT_THROW((void)Parameter::number("radius", "m", "").by_default("wide"), std::logic_error);
  EXPECT_THROW((void)Parameter::integer("count", "").by_default(0.5), std::logic_error);
  EXPECT_THROW((void)Parameter::choice("law", {"a", "b"}, "").by_default("c"), std::logic_error);
}

TEST(suggest, one_typing_mistake_is_recognised) {
  const std::vector<std::string> words{"radius", "length", "law", "max_iterations"};
  EXPECT_EQ(nearest_word("raduis", words), "radius");  // transposed
  EXPECT_EQ(nearest_word("radus", words), "radius");   // left out
  EXPECT_EQ(nearest_word("lenght", words), "length");
  EXPECT_EQ(nearest_word("Law", words), "law");
  EXPECT_EQ(nearest_word("max", words), "max_iterations");  // begun
  EXPECT_EQ(nearest_word("temperature", words), "");
  EXPECT_EQ(nearest_word("", words), "");
}

TEST(suggest, lists_read_as_a_sentence) {
  EXPECT_EQ(list_of(std::vector<std::string>{}), "none");
  EXPECT_EQ(list_of(std::vector<std::string>{"a"}), "'a'");
  EXPECT_EQ(list_of(std::vector<std::string>{"a", "b", "c"}), "'a', 'b' and 'c'");
}

}  // namespace
}  // namespace scree
