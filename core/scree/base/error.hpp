// Error: what scree throws when an input cannot be used, with the place and the way out in its sentence.
#pragma once

#include <stdexcept>
#include <string>

namespace scree {

/// A place in a scene file; line 0 means "no line known" (for example a value from the command line).
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column: ", or what of it is known; empty for no place.
[[nodiscard]] std::string to_prefix(const SourceLocation& where);

/// Which exit code a failure becomes (docs/architecture.md, errors).
enum class ErrorKind {
  usage = 2,     ///< command line, scene or plugin: the user can correct it
  diverged = 3,  ///< NaN, overflow or exploding energy during a step
  io = 4,        ///< a file could not be read or written
};

/// The one exception type of scree. Its text is complete: place, what is wrong, what is valid, what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& sentence);
  Error(ErrorKind kind, const SourceLocation& where, const std::string& sentence);

  [[nodiscard]] ErrorKind kind() const { return kind_; }
  [[nodiscard]] int exit_code() const { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

}  // namespace scree
