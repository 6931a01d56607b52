// Text on standard output, warnings on standard error; numbers of things.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

namespace scree {

/// Prints like fmt::print, but a failure does not throw: a run whose reader went away still writes its results. The
/// program looks at std::ferror(stdout) before it ends.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

/// "1 body", "2 bodies".
inline std::string counted(std::size_t number, const char* one, const char* several) {
  return fmt::format("{} {}", number, number == 1 ? one : several);
}

/// Prints what is no reason to stop.
inline void warn(const std::string& sentence) { std::fprintf(stderr, "scree: warning: %s\n", sentence.c_str()); }

}  // namespace scree
