#include "scree/config/validate.hpp"

#include <algorithm>
#include <stdexcept>

#include "scree/config/parameter_text.hpp"
#include "scree/config/scene_node.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/units.hpp"
#include "scree/config/value_reader.hpp"

namespace scree {
namespace {

using Members = std::vector<Parameter>;

enum class Missing { refuse, leave_out };  // what to do about a required setting without a value

Options read_table(const SceneNode& table, const Members& members, const std::string& what, bool has_type);
Options::Entry absent_entry(const Parameter& parameter, const SceneNode& table, const std::string& what,
                            Missing missing);

Options::Entry entry_at(const SceneNode& node) {
  Options::Entry entry;
  entry.base = node.origin->base;
  entry.where = node.where();
  return entry;
}

const Variant* find_alternative(const Parameter& parameter, const std::string& type) {
  const auto found = std::ranges::find(parameter.alternatives, type, &Variant::type);
  return found == parameter.alternatives.end() ? nullptr : &*found;
}

std::vector<std::string> types_of(const Parameter& parameter) {
  std::vector<std::string> types;
  for (const Variant& alternative : parameter.alternatives) types.push_back(alternative.type);
  return types;
}

// All members at their defaults, but `given` set: what a shorthand stands for.
Options alternative_with(const Variant& alternative, const SceneNode& place, const std::string& what,
                         const std::string& given_name, const Options::Entry& given) {
  Options result;
  result.set_type(alternative.type);
  result.set_location(place.where());
  for (const Parameter& member : alternative.members) {
    result.set(member.name, member.name == given_name ? given : absent_entry(member, place, what, Missing::refuse));
  }
  return result;
}

const Parameter& shorthand_member(const Parameter& parameter, const Variant& alternative) {
  const auto found = std::ranges::find(alternative.members, parameter.shorthand_member, &Parameter::name);
  if (found == alternative.members.end())
    throw std::logic_error{"the shorthand of parameter '" + parameter.name + "' names no member"};
  return *found;
}

[[noreturn]] void refuse_type(const SceneNode& word, const Parameter& parameter, const std::string& subject) {
  const std::vector<std::string> types = types_of(parameter);
  const std::string near = nearest_word(word.text, types);
  throw Error{ErrorKind::usage, word.where(),
              subject + " has the unknown type " + quote(word.text) +
                  (near.empty() ? "; valid are " : "; did you mean '" + near + "'? Valid are ") + list_of(types)};
}

// A plain value in place of a table: the name of a type, or the value of the shorthand's member.
Options read_shorthand(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind == SceneKind::text) {
    if (const Variant* named = find_alternative(parameter, node.text))
      return alternative_with(*named, node, subject, {}, {});
  }
  const Variant* alternative = find_alternative(parameter, parameter.shorthand_type);
  if (alternative == nullptr && node.kind == SceneKind::text) refuse_type(node, parameter, subject);
  if (alternative == nullptr) refuse_kind(node, parameter, subject);
  const Parameter& member = shorthand_member(parameter, *alternative);
  Options::Entry given = entry_at(node);
  given.value = read_plain_value(node, member, subject);
  if (member.unit == kAnyUnit) given.written = node.text;
  return alternative_with(*alternative, node, subject, member.name, given);
}

Options read_variant(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::table) return read_shorthand(node, parameter, subject);
  const std::vector<std::string> types = types_of(parameter);
  const SceneNode::Member* type = node.find("type");
  if (type == nullptr)
    throw Error{ErrorKind::usage, node.where(), subject + " needs a 'type'; valid are " + list_of(types)};
  if (type->value->kind != SceneKind::text)
    throw Error{ErrorKind::usage, type->value->where(),
                "'type' of " + subject + " must be a string, one of " + list_of(types) + ", but is " +
                    std::string{kind_name(type->value->kind)}};
  const Variant* alternative = find_alternative(parameter, type->value->text);
  if (alternative == nullptr) refuse_type(*type->value, parameter, subject);
  Options result = read_table(node, alternative->members, subject, true);
  result.set_type(alternative->type);
  return result;
}

Options::Entry read_table_list(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  Options::Entry entry = entry_at(node);
  entry.is_list = true;
  const auto read_item = [&](const SceneNode& item, const std::string& name) {
    if (parameter.kind == ValueKind::variants) return read_variant(item, parameter, name);
    if (item.kind != SceneKind::table) refuse_kind(item, parameter, name);
    return read_table(item, parameter.members, name, false);
  };
  if (node.kind == SceneKind::table) {  // a plain table counts as a list of one
    SceneNode list = node;
    list.kind = SceneKind::list;
    list.items = {std::make_shared<SceneNode>(node)};
    check_count(list, parameter, subject);
    entry.tables.push_back(read_item(node, subject));
    return entry;
  }
  if (node.kind != SceneKind::list) refuse_kind(node, parameter, subject);
  check_count(node, parameter, subject);
  for (const auto& item : node.items) {
    entry.tables.push_back(read_item(*item, "entry " + std::to_string(entry.tables.size()) + " of " + subject));
  }
  return entry;
}

Options::Entry read_entry(const SceneNode& node, const Parameter& parameter, const std::string& what);

/// Columns have their names in checkpoints, where a slash would divide them.
void refuse_column_name(const std::string& key, const SceneNode& value, const std::string& subject) {
  const bool fine = !key.empty() && key != "." &&
                    std::ranges::none_of(key, [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; });
  if (fine) return;
  throw Error{ErrorKind::usage, value.where(),
              subject + " has the name '" + key +
                  "' in it; a name has at least one sign, and neither slashes nor control characters"};
}

// Free keys: each a variant, or a number where the description has no variants or the scene writes a plain one.
Options read_columns(const SceneNode& node, const Parameter& parameter, const std::string& subject) {
  if (node.kind != SceneKind::table) refuse_kind(node, parameter, subject);
  std::vector<std::string> keys = node.keys();
  std::ranges::sort(keys);
  Options result;
  result.set_location(node.where());
  for (const std::string& key : keys) {
    const SceneNode& value = *node.find(key)->value;
    refuse_column_name(key, value, subject);
    Parameter column = parameter;
    column.name = key;
    const bool plain = value.kind != SceneKind::table && parameter.shorthand_type.empty() &&
                       !(value.kind == SceneKind::text && find_alternative(parameter, value.text) != nullptr);
    column.kind = parameter.alternatives.empty() || plain ? ValueKind::number : ValueKind::variant;
    result.set(key, read_entry(value, column, subject));
  }
  return result;
}

Options::Entry read_entry(const SceneNode& node, const Parameter& parameter, const std::string& what) {
  const std::string subject = "'" + parameter.name + "' of " + what;
  Options::Entry entry = entry_at(node);
  switch (parameter.kind) {
    case ValueKind::table:
      if (node.kind != SceneKind::table) refuse_kind(node, parameter, subject);
      entry.tables.push_back(read_table(node, parameter.members, subject, false));
      break;
    case ValueKind::tables:
    case ValueKind::variants:
      return read_table_list(node, parameter, subject);
    case ValueKind::variant:
      entry.tables.push_back(read_variant(node, parameter, subject));
      break;
    case ValueKind::columns:
      entry.tables.push_back(read_columns(node, parameter, subject));
      break;
    default:
      entry.value = read_plain_value(node, parameter, subject);
      if (parameter.unit == kAnyUnit) entry.written = node.text;
  }
  return entry;
}

void refuse_unknown_keys(const SceneNode& table, const Members& members, const std::string& what, bool has_type) {
  for (const SceneNode::Member& written : table.members) {
    if (has_type && written.key == "type") continue;
    if (std::ranges::find(members, written.key, &Parameter::name) != members.end()) continue;
    std::vector<std::string> valid;
    if (has_type) valid.emplace_back("type");
    for (const Parameter& member : members) valid.push_back(member.name);
    const std::string near = nearest_word(written.key, valid);
    throw Error{ErrorKind::usage, written.where(),
                what + " has no key '" + written.key + "'" +
                    (near.empty() ? "; valid keys: " : "; did you mean '" + near + "'? Valid keys: ") + list_of(valid)};
  }
}

Options read_table(const SceneNode& table, const Members& members, const std::string& what, bool has_type) {
  refuse_unknown_keys(table, members, what, has_type);
  Options result;
  result.set_location(table.where());
  for (const Parameter& parameter : members) {
    const SceneNode::Member* written = table.find(parameter.name);
    result.set(parameter.name, written != nullptr ? read_entry(*written->value, parameter, what)
                                                  : absent_entry(parameter, table, what, Missing::refuse));
  }
  return result;
}

Options all_defaults(const Members& members, const SceneNode& place, const std::string& what, Missing missing) {
  Options result;
  result.set_location(place.where());
  for (const Parameter& member : members) result.set(member.name, absent_entry(member, place, what, missing));
  return result;
}

// The default of a variant: the name of a type, or the value of its shorthand.
Options default_variant(const Parameter& parameter, const SceneNode& place, const std::string& what, Missing missing) {
  const auto* type = std::get_if<std::string>(&parameter.default_value);
  const Variant* named = type == nullptr ? nullptr : find_alternative(parameter, *type);
  const Variant* alternative = named != nullptr ? named : find_alternative(parameter, parameter.shorthand_type);
  if (alternative == nullptr)
    throw std::logic_error{"the default of parameter '" + parameter.name + "' names none of its types"};
  Options result = all_defaults(alternative->members, place, what, named != nullptr ? missing : Missing::leave_out);
  result.set_type(alternative->type);
  if (named == nullptr) {
    Options::Entry entry = entry_at(place);
    entry.value = parameter.default_value;
    entry.given = false;
    result.set(shorthand_member(parameter, *alternative).name, std::move(entry));
  }
  return result;
}

Options::Entry absent_entry(const Parameter& parameter, const SceneNode& table, const std::string& what,
                            Missing missing) {
  Options::Entry entry = entry_at(table);
  entry.given = false;
  const bool optional = !parameter.required && std::holds_alternative<std::monostate>(parameter.default_value);
  if (parameter.kind == ValueKind::table && !optional) {
    entry.tables.push_back(all_defaults(parameter.members, table, "'" + parameter.name + "' of " + what, missing));
  } else if (parameter.kind == ValueKind::variant && !parameter.required && !optional) {
    entry.tables.push_back(default_variant(parameter, table, what, missing));
  } else if (optional || (parameter.required && missing == Missing::leave_out)) {
    entry.present = false;
  } else if (parameter.required) {
    throw Error{ErrorKind::usage, table.where(),
                what + " lacks the required key '" + parameter.name + "' (" + parameter.help +
                    "); add for example: " + example_line(parameter)};
  } else {
    entry.value = parameter.default_value;
  }
  return entry;
}

}  // namespace

Options validate(const SceneTable& table, const Members& parameters, std::string_view what) {
  return read_table(table.node(), parameters, std::string{what}, false);
}

Options default_options(const Members& parameters) {
  const SceneOrigin nowhere;
  SceneNode empty;
  empty.origin = &nowhere;
  return all_defaults(parameters, empty, "the defaults", Missing::leave_out);
}

Options options_from_text(std::string_view toml, const Members& parameters) {
  const SceneDocument document = SceneDocument::parse(toml);
  return validate(document.root(), parameters, "the table");
}

}  // namespace scree
