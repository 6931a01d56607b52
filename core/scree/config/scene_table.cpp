#include <algorithm>

#include "scree/config/scene_node.hpp"
#include "scree/config/suggest.hpp"

namespace scree {

const SceneOrigin* SceneStore::add(std::string name, std::filesystem::path base) {
  origins.push_back({std::move(name), std::move(base), this});
  return &origins.back();
}

const SceneNode::Member* SceneTable::Node::find(std::string_view key) const {
  const auto found = std::ranges::find(members, key, &Member::key);
  return found == members.end() ? nullptr : &*found;
}

SceneNode::Member* SceneTable::Node::find(std::string_view key) {
  const auto found = std::ranges::find(members, key, &Member::key);
  return found == members.end() ? nullptr : &*found;
}

std::vector<std::string> SceneTable::Node::keys() const {
  std::vector<std::string> result;
  for (const Member& member : members) result.push_back(member.key);
  return result;
}

bool SceneTable::Node::is_table_list() const {
  return kind == SceneKind::list && !items.empty() &&
         std::ranges::all_of(items, [](const auto& item) { return item->kind == SceneKind::table; });
}

std::string_view kind_name(SceneKind kind) {
  switch (kind) {
    case SceneKind::table:
      return "a table";
    case SceneKind::list:
      return "a list";
    case SceneKind::text:
      return "a string";
    case SceneKind::integer:
      return "an integer";
    case SceneKind::number:
      return "a number";
    case SceneKind::boolean:
      return "a boolean";
    case SceneKind::date:
      return "a date";
  }
  return "unknown";
}

namespace {

const SceneNode::Member& demand(const SceneNode& table, std::string_view key) {
  const SceneNode::Member* member = table.find(key);
  if (member != nullptr) return *member;
  const std::vector<std::string> keys = table.keys();
  throw Error{ErrorKind::usage, table.where(),
              "the required key '" + std::string{key} + "' is missing; the table has " + list_of(keys)};
}

[[noreturn]] void refuse_kind(const SceneNode::Member& member, const std::string& wanted, SceneKind kind) {
  throw Error{ErrorKind::usage, member.where(),
              "'" + member.key + "' must be " + wanted + ", but is " + std::string{kind_name(kind)}};
}

}  // namespace

SourceLocation SceneTable::location() const { return node_->where(); }
std::vector<std::string> SceneTable::keys() const { return node_->keys(); }
bool SceneTable::has(std::string_view key) const { return node_->find(key) != nullptr; }

SceneTable SceneTable::table(std::string_view key) const {
  const SceneNode::Member& member = demand(*node_, key);
  const SceneNode* value = member.value.get();
  if (value->is_table_list() && value->items.size() == 1) value = value->items.front().get();
  if (value->kind != SceneKind::table) refuse_kind(member, "one table [" + member.key + "]", value->kind);
  return SceneTable{value};
}

std::vector<SceneTable> SceneTable::tables(std::string_view key) const {
  const SceneNode::Member* member = node_->find(key);
  if (member == nullptr) return {};
  const SceneNode& value = *member->value;
  if (value.kind == SceneKind::table) return {SceneTable{&value}};
  if (value.kind != SceneKind::list) refuse_kind(*member, "a list of tables [[" + member->key + "]]", value.kind);
  std::vector<SceneTable> result;
  for (const auto& item : value.items) {
    if (item->kind != SceneKind::table) refuse_kind(*member, "a list of tables only", item->kind);
    result.emplace_back(item.get());
  }
  return result;
}

std::vector<std::pair<std::string, SceneTable>> SceneTable::named_tables(std::string_view key) const {
  const SceneNode::Member* section = node_->find(key);
  if (section == nullptr) return {};
  const std::string form = "[" + section->key + ".NAME]";
  if (section->value->kind != SceneKind::table) {
    refuse_kind(*section, "written as " + form + ", a table for each name", section->value->kind);
  }
  std::vector<std::pair<std::string, SceneTable>> result;
  for (const SceneNode::Member& member : section->value->members) {
    if (member.value->kind != SceneKind::table) {
      refuse_kind(member, "a table, as [" + section->key + "] holds only names: write " + form, member.value->kind);
    }
    result.emplace_back(member.key, SceneTable{member.value.get()});
  }
  return result;
}

std::string SceneTable::text(std::string_view key) const {
  const SceneNode::Member& member = demand(*node_, key);
  if (member.value->kind != SceneKind::text) refuse_kind(member, "a string", member.value->kind);
  return member.value->text;
}

SourceLocation SceneTable::location(std::string_view key) const { return demand(*node_, key).where(); }

SceneTable SceneTable::without(std::span<const std::string_view> keys) const {
  auto copy = std::make_shared<Node>(*node_);
  std::erase_if(copy->members,
                [&](const Node::Member& member) { return std::ranges::find(keys, member.key) != keys.end(); });
  SceneStore& store = *node_->origin->store;
  const std::lock_guard guard{store.lock};
  store.copies.push_back(std::move(copy));
  return SceneTable{store.copies.back().get()};
}

}  // namespace scree
