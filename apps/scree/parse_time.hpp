// Times of the command line.
#pragma once

#include <string>
#include <vector>

namespace scree {

/// "5", "5 s", "200 ms" in seconds. @throws Error (usage) that names `option`, for what is no time above 0 s.
[[nodiscard]] double parse_time(const std::string& text, const std::string& option);

/// Times as `--record-ccp` and `--at` have them: "t=0.1,0.5", "200 ms", any number of such words. [s], ascending, each
/// once. @throws Error as parse_time() does.
[[nodiscard]] std::vector<double> parse_times(const std::vector<std::string>& words, const std::string& option);

}  // namespace scree
