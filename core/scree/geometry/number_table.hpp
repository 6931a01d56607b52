// Rows of numbers in plain text, as measuring instruments and spreadsheets write them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// The numbers of a line.
struct NumberRow {
  std::vector<double> numbers;  ///< [any unit]; NaN and infinite ones included
  std::string bad_word;         ///< the first word that is no number; empty when all are
  std::size_t word = 0;         ///< which word that is, from 1
};

/// Reads the numbers of a line: apart by blanks, tabs, commas or semicolons, whatever the system's language; `#` and `%` begin
/// comments. Reading ends at the first word that is no number. "nan" in any case is one; a leading plus sign is allowed.
[[nodiscard]] NumberRow read_numbers(std::string_view line);

}  // namespace scree
