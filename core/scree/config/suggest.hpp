// "Did you mean ...?"
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

/// The candidate nearest to `word` in edit distance (transpositions count one), or empty when none is near.
[[nodiscard]] std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'x'?" with the nearest candidate, or nothing when none is near: the end of a sentence.
[[nodiscard]] std::string suggestion(std::string_view word, std::span<const std::string> candidates);

/// "'a', 'b' and 'c'" for messages; "none" for an empty list.
[[nodiscard]] std::string list_of(std::span<const std::string> words);

}  // namespace scree
