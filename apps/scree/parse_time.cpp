#include "parse_time.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scree/base/error.hpp"
#include "scree/config/units.hpp"

namespace scree {
namespace {

Error usage_error(const std::string& option, const std::string& sentence) {
  return Error{ErrorKind::usage, {option, 0, 0}, sentence};
}

}  // namespace

double parse_time(const std::string& text, const std::string& option) {
  if (text.empty()) throw usage_error(option, "'' is not a time, for example '5 s'");
  double seconds = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, seconds);
  if (failure != std::errc{} || rest != end) {  // not a plain number of seconds
    try {
      seconds = parse_quantity(text, "s");
    } catch (const Error& problem) {
      throw usage_error(option, problem.what());
    }
  }
  if (!(seconds > 0.0 && std::isfinite(seconds))) throw usage_error(option, "'" + text + "' is not above 0 s");
  return seconds;
}

std::vector<double> parse_times(const std::vector<std::string>& words, const std::string& option) {
  std::vector<double> times;
  for (const std::string& word : words) {
    std::string rest = word.starts_with("t=") ? word.substr(2) : word;
    while (true) {
      const std::size_t comma = rest.find(',');
      times.push_back(parse_time(rest.substr(0, comma), option));
      if (comma == std::string::npos) break;
      rest.erase(0, comma + 1);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace scree
