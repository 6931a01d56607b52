#include "scree/base/error.hpp"

namespace scree {

std::string to_prefix(const SourceLocation& where) {
  if (where.file.empty()) return {};
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text + ": ";
}

Error::Error(ErrorKind kind, const std::string& sentence) : std::runtime_error{sentence}, kind_{kind} {}

Error::Error(ErrorKind kind, const SourceLocation& where, const std::string& sentence)
    : std::runtime_error{to_prefix(where) + sentence}, kind_{kind} {}

}  // namespace scree
