#include "scree/config/describe_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "scree/config/parameter_text.hpp"

namespace scree {
namespace {

constexpr std::size_t kColumns = 5;
constexpr std::size_t kGap = 2;  // spaces between columns
using Row = std::array<std::string, kColumns>;

// Characters, not bytes, so that a degree sign does not shift the columns after it.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string_view kind_word(ValueKind kind) {
  switch (kind) {
    case ValueKind::boolean:
      return "boolean";
    case ValueKind::integer:
      return "integer";
    case ValueKind::number:
      return "number";
    case ValueKind::text:
      return "text";
    case ValueKind::choice:
      return "choice";
    case ValueKind::path:
      return "file";
    case ValueKind::vector:
      return "vector";
    case ValueKind::numbers:
      return "numbers";
    case ValueKind::texts:
      return "texts";
    case ValueKind::table:
      return "table";
    case ValueKind::tables:
      return "list of tables";
    case ValueKind::variant:
      return "table with type";
    case ValueKind::variants:
      return "list of tables with type";
    case ValueKind::columns:
      return "table of free keys";
  }
  return "";
}

bool has_unit(ValueKind kind) {
  return kind == ValueKind::number || kind == ValueKind::vector || kind == ValueKind::numbers;
}

std::string default_text(const Parameter& parameter) {
  if (!std::holds_alternative<std::monostate>(parameter.default_value)) return toml_text(parameter.default_value);
  if (!parameter.required) return "optional";
  return parameter.kind == ValueKind::table ? "" : "required";
}

std::string valid_text(const Parameter& parameter) {
  std::string text = valid_range(parameter);
  for (const std::string& word : parameter.words) text += (text.empty() ? "" : " | ") + word;
  std::string entries;
  if (parameter.count >= 0) entries = std::to_string(parameter.count) + " entries";
  if (parameter.minimum_count > 0) entries = "at least " + std::to_string(parameter.minimum_count) + " entries";
  if (!entries.empty()) text += (text.empty() ? "" : ", ") + entries;
  return text;
}

void add_rows(std::span<const Parameter> parameters, const std::string& indent, std::vector<Row>& rows) {
  for (const Parameter& parameter : parameters) {
    std::string kind{kind_word(parameter.kind)};
    if (has_unit(parameter.kind)) kind += " [" + parameter.unit + "]";
    rows.push_back({indent + parameter.name, kind, default_text(parameter), valid_text(parameter), parameter.help});
    add_rows(parameter.members, indent + "  ", rows);
    for (const Variant& alternative : parameter.alternatives) {
      const bool shorthand = alternative.type == parameter.shorthand_type;
      rows.push_back({indent + "  type = " + quote(alternative.type), "", "",
                      shorthand ? "or plain: " + parameter.shorthand_member : "", alternative.help});
      add_rows(alternative.members, indent + "    ", rows);
    }
  }
}

}  // namespace

std::string describe_parameters(std::span<const Parameter> parameters) {
  std::vector<Row> rows;
  add_rows(parameters, "  ", rows);
  std::array<std::size_t, kColumns> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < kColumns; ++i) {
      const std::size_t gap = widths[i] == 0 ? 0 : widths[i] + kGap;  // a column that nobody fills takes no room
      line += row[i] + std::string(gap - std::min(gap, width_of(row[i])), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace scree
