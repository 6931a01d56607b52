// Text on standard output.
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

}  // namespace scree
