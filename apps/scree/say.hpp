// Text on standard output, warnings on standard error.
#pragma once

#include <fmt/format.h>

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

/// Prints what is no reason to stop.
inline void warn(const std::string& sentence) { std::fprintf(stderr, "scree: warning: %s\n", sentence.c_str()); }

}  // namespace scree
