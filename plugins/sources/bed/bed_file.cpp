#include "bed_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "scree/base/error.hpp"

namespace scree {
namespace {

constexpr std::string_view kBlank = " \t\r";

/// Reads the non-empty lines of a file, one after the other.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& file) : name_{file.string()}, in_{file} {
    if (!in_) throw Error{ErrorKind::io, "cannot read the bed file '" + name_ + "'; give the path of an existing file"};
  }
  /// False at the end of the file.
  bool next() {
    while (std::getline(in_, text_)) {
      ++line_;
      text_.resize(std::min(text_.size(), text_.find('#')));
      if (text_.find_first_not_of(kBlank) != std::string::npos) return true;
    }
    if (in_.bad()) throw Error{ErrorKind::io, "the bed file '" + name_ + "' could not be read to its end"};
    return false;
  }
  /// Exactly as many finite numbers as `values` holds.
  template <std::size_t n>
  void numbers(std::array<double, n>& values, const char* expected) const {
    std::string_view rest = text_;
    for (double& value : values) {
      rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(kBlank)));
      if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
      const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
      if (status != std::errc{} || !std::isfinite(value)) refuse(expected);
      rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
      if (!rest.empty() && kBlank.find(rest.front()) == std::string_view::npos) refuse(expected);
    }
    if (rest.find_first_not_of(kBlank) != std::string_view::npos) refuse(expected);
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    throw Error{ErrorKind::usage, {name_, line_, 1}, "'" + text_.substr(0, 80) + "' is not " + expected};
  }
  /// At the last line that was read.
  [[noreturn]] void wrong_count(const std::string& sentence) const {
    throw Error{ErrorKind::usage, {name_, line_, 1}, sentence};
  }

 private:
  std::string name_;
  std::ifstream in_;
  std::string text_;
  int line_ = 0;
};

constexpr const char* kHead = "the head of a bed: the number of spheres and the side of the box [m], both above zero";
constexpr const char* kRow = "a sphere: x y z r vx vy vz in SI units, seven finite numbers with r > 0";

}  // namespace

Bed read_bed(const std::filesystem::path& file, std::size_t limit) {
  Lines lines{file};
  std::array<double, 2> head{};
  if (!lines.next()) lines.wrong_count("the bed file is empty; its first line has to be " + std::string{kHead});
  lines.numbers(head, kHead);
  if (head[0] < 1.0 || head[0] != std::floor(head[0]) || head[0] > 1e9 || head[1] <= 0.0) lines.refuse(kHead);
  const auto promised = static_cast<std::size_t>(head[0]);
  const std::string promise = "the first line promises " + std::to_string(promised) + " spheres, ";

  Bed bed{head[1], {}};
  bed.spheres.reserve(std::min(limit, promised));
  while (bed.spheres.size() < limit && lines.next()) {
    std::array<double, 7> row{};
    lines.numbers(row, kRow);
    if (row[3] <= 0.0) lines.refuse(kRow);
    if (bed.spheres.size() == promised) lines.wrong_count(promise + "but there are more rows; correct the first line");
    bed.spheres.push_back({{row[0], row[1], row[2]}, row[3], {row[4], row[5], row[6]}});
  }
  if (bed.spheres.size() < std::min(limit, promised)) {
    lines.wrong_count(promise + "but the file ends after " + std::to_string(bed.spheres.size()) +
                      "; correct the first line, or complete the file");
  }
  return bed;
}

}  // namespace scree
