#include "log_watch.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace scree {
namespace {

constexpr std::string_view kMark = "warning: ";

/// The line without the mark, when it has one.
std::optional<std::string> warning_of(const std::string& line) {
  if (line.starts_with(kMark)) return line.substr(kMark.size());
  const std::size_t place = line.find(": " + std::string{kMark});
  if (place == std::string::npos) return {};
  return line.substr(0, place + 2) + line.substr(place + 2 + kMark.size());
}

}  // namespace

std::vector<std::string> LogWatch::news(const std::vector<std::string>& log) {
  std::vector<std::string> found;
  for (; seen_ < log.size(); ++seen_) {
    const std::optional<std::string> warning = warning_of(log[seen_]);
    if (!warning || std::ranges::find(told_, *warning) != told_.end()) continue;
    if (told_.size() == kMost) {
      ++untold_;
      continue;
    }
    told_.push_back(*warning);
    found.push_back(*warning);
  }
  return found;
}

}  // namespace scree
