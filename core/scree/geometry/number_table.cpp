#include "scree/geometry/number_table.hpp"

#include <charconv>

namespace scree {
namespace {

constexpr std::string_view kSeparators = " \t,;\r\v\f";

}  // namespace

NumberRow read_numbers(std::string_view line) {
  line = line.substr(0, line.find_first_of("#%"));
  NumberRow row;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) return row;
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(kSeparators));
    line.remove_prefix(word.size());
    ++row.word;

    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    const char* const first = word.data() + (plus ? 1 : 0);
    const char* const last = word.data() + word.size();
    double value = 0.0;
    const auto [end, fault] = std::from_chars(first, last, value);
    if (fault != std::errc{} || end != last) {
      row.bad_word = word;
      return row;
    }
    row.numbers.push_back(value);
  }
}

}  // namespace scree
