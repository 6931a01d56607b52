#include "scree/simulation/parts.hpp"

#include <algorithm>
#include <string_view>

#include "scree/config/scene_document.hpp"
#include "scree/config/validate.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {
namespace {

/// Core's own keys of a plugin section, validated apart from the plugin's.
Options core_options(const SceneTable& table, std::string_view section,
                     const std::vector<std::string_view>& plugin_keys) {
  return validate(table.without(plugin_keys), scene_section(section).parameters, "[" + std::string{section} + "]");
}

/// Calls the factory of an entry, with the options that the part has.
template <class Interface>
void make_plugin(Part<Interface>& part, const PluginEntry& entry) {
  std::unique_ptr<Plugin> plugin = guarded(part.info, ErrorKind::usage, [&] { return entry.make(part.options); });
  part.plugin.reset(dynamic_cast<Interface*>(plugin.get()));
  if (part.plugin == nullptr) {
    throw Error{ErrorKind::usage, part.info.label_with_library() + " is not a " + part.info.kind +
                                      "; the library registered it under the wrong kind"};
  }
  static_cast<void>(plugin.release());
}

/// The name that the scene gives a part, or its type. It names a group of checkpoints, where a slash would divide it.
std::string name_of(const Options& core, const std::string& type) {
  const std::vector<std::string> keys = core.names();
  if (std::find(keys.begin(), keys.end(), "name") == keys.end() || core.text("name").empty()) return type;
  const std::string& name = core.text("name");
  const auto bad = std::ranges::find_if(name, [](char c) { return c == '/' || static_cast<unsigned char>(c) < ' '; });
  if (bad != name.end()) {
    throw core.error("name", "is '" + name + "', which has " +
                                 (*bad == '/' ? "a slash" : "a line break, a tab or another control character") +
                                 " in it; letters, digits, spaces and other signs may stand in a name");
  }
  return name;
}

template <class Interface>
Part<Interface> make_part(const SceneTable& table, const PluginCatalog& catalog, Options* core = nullptr) {
  const std::string kind = Interface::kKind;
  const std::string type = table.text("type");
  const PluginEntry& entry = catalog.entry(kind, type, table.location("type"));

  std::vector<std::string_view> core_keys{"type"};
  for (const Parameter& parameter : scene_section(kind).parameters) core_keys.push_back(parameter.name);
  std::vector<std::string> keys = table.keys();
  std::vector<std::string_view> plugin_keys;
  for (const std::string& key : keys) {
    const bool is_core = key != "type" && std::find(core_keys.begin(), core_keys.end(), key) != core_keys.end();
    if (!is_core) plugin_keys.push_back(key);
  }
  const Options own = core_options(table, kind, plugin_keys);
  if (core != nullptr) *core = own;

  Part<Interface> part;
  part.info = {kind, type, type, entry.library, entry.version, table.location()};
  part.info.name = name_of(own, type);
  part.core = own;
  part.options = validate(table.without(core_keys), entry.parameters, part.info.label());
  part.options.set_type(type);
  make_plugin(part, entry);
  return part;
}

/// The narrow phases of a scene that names none: those that have a place in the chain, with their defaults.
std::vector<Part<NarrowPhase>> default_chain(const SceneTable& root, const PluginCatalog& catalog) {
  std::vector<const PluginEntry*> entries;
  for (const PluginEntry* entry : catalog.entries()) {
    if (entry->kind == NarrowPhase::kKind && entry->default_place > 0) entries.push_back(entry);
  }
  std::ranges::stable_sort(entries, {}, &PluginEntry::default_place);
  std::vector<Part<NarrowPhase>> chain;
  for (const PluginEntry* entry : entries) {
    Part<NarrowPhase>& part = chain.emplace_back();
    part.info = {entry->kind, entry->name, entry->name, entry->library, entry->version, root.location()};
    part.options = default_options(entry->parameters);
    part.options.set_type(entry->name);
    make_plugin(part, *entry);
  }
  return chain;
}

template <class Interface>
Part<Interface> make_required(const SceneTable& root, const PluginCatalog& catalog) {
  const std::string kind = Interface::kKind;
  if (root.has(kind)) return make_part<Interface>(root.table(kind), catalog);
  std::string known;
  for (const PluginEntry* entry : catalog.entries()) {
    if (entry->kind == kind) known += (known.empty() ? "" : ", ") + entry->name;
  }
  throw Error{ErrorKind::usage, root.location(),
              "the scene has no [" + kind +
                  "]; add one with `type` set to one of: " + (known.empty() ? "(none found)" : known)};
}

template <class Interface>
std::vector<Part<Interface>> make_list(const SceneTable& root, const PluginCatalog& catalog) {
  std::vector<Part<Interface>> parts;
  for (const SceneTable& table : root.tables(Interface::kKind)) {
    Part<Interface> part = make_part<Interface>(table, catalog);
    for (const auto& other : parts) {
      if (other.info.name != part.info.name) continue;
      throw Error{ErrorKind::usage, table.location(),
                  "two " + part.info.kind + "s are called '" + part.info.name + "'; give one of them another `name`"};
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The `file` that a part was told to write, by the convention of observers; empty for none.
std::string file_of(const Part<Observer>& part) {
  const Options::Entry* entry = part.options.find("file");
  const auto* file = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->value);
  return file == nullptr ? std::string{} : *file;
}

/// Names go into the names of files, where only letters, digits and underscores are left of them.
void refuse_shared_files(const std::vector<Part<Observer>>& observers) {
  for (std::size_t b = 0; b < observers.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const PartInfo &one = observers[a].info, &other = observers[b].info;
      const std::string both = one.label() + " and " + other.label();
      const std::string file = file_of(observers[b]);
      if (!file.empty() && file == file_of(observers[a])) {
        throw Error{ErrorKind::usage, other.where,
                    both + " would both write the file '" + file + "'; give one of them another `file`"};
      }
      if (one.type == other.type && lower_snake(one.name) == lower_snake(other.name)) {
        throw Error{ErrorKind::usage, other.where,
                    both + " would write the same files; give them names that differ in more than case and signs"};
      }
    }
  }
}

}  // namespace

Parts make_parts(const SceneDocument& document, const PluginCatalog& catalog) {
  const SceneTable root = document.root();
  Parts parts;
  parts.stepper = make_required<TimeStepper>(root, catalog);
  if (root.has("ccp_solver")) {
    Options core;
    parts.solver = make_part<CcpSolver>(root.table("ccp_solver"), catalog, &core);
    parts.solver_tolerance = core.number("tolerance");
    parts.solver_iterations = static_cast<int>(core.integer("max_iterations"));
    parts.active_set = core.boolean("active_set");
  }
  if (root.has("contact_law")) parts.law = make_part<ContactLaw>(root.table("contact_law"), catalog);
  parts.broad = make_required<BroadPhase>(root, catalog);
  parts.narrow = make_list<NarrowPhase>(root, catalog);
  if (parts.narrow.empty()) parts.narrow = default_chain(root, catalog);
  parts.electric = make_list<ElectricField>(root, catalog);
  parts.forces = make_list<ForceField>(root, catalog);
  parts.sources = make_list<Source>(root, catalog);
  parts.sinks = make_list<Sink>(root, catalog);
  parts.observers = make_list<Observer>(root, catalog);
  refuse_shared_files(parts.observers);
  return parts;
}

}  // namespace scree
