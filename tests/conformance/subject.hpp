// Subject: one entry of the plugin library that scree-conformance looks at, and how far it can be brought to life.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "scree/interfaces/plugin_library.hpp"
#include "support/fake_scene_services.hpp"

namespace scree::test {

/// An entry, with settings under which it can be made.
struct Subject {
  PluginEntry entry;
  std::optional<Options> options;  ///< nothing when its required settings keep it from being made here
  bool needs_scene = false;        ///< setup() asks for what a scene without bodies, materials and fields lacks
  std::string failure;             ///< what escaped while it was made or set up, and should not have; else empty

  /// A new one, not set up. Call it only when there are options. @throws Error when it cannot be made.
  [[nodiscard]] std::unique_ptr<Plugin> make() const { return entry.make(*options); }
  /// "force_field_push", a word of GoogleTest's.
  [[nodiscard]] std::string word() const { return entry.kind + "_" + entry.name; }
};

inline std::ostream& operator<<(std::ostream& out, const Subject& subject) { return out << subject.word(); }

inline std::string subject_case_name(const testing::TestParamInfo<Subject>& info) { return info.param.word(); }

/// True when a scene has to set it: no default, and not optional.
[[nodiscard]] bool has_to_be_set(const Parameter& parameter);

/// Calls the setup() of the plugin's interface, when it has one. Observers get no folder.
void set_up(Plugin& plugin, std::string_view kind, FakeSceneServices& services);

/// Loads the library as a run would, and tries each entry; says which checks an entry goes without, and why.
/// @throws Error (usage) when the host refuses the file.
void load_subjects(const std::string& file);

/// All entries of the library.
[[nodiscard]] const std::vector<Subject>& subjects();
/// Those that can be made and, unless they stay as made, set up.
[[nodiscard]] std::vector<Subject> living_subjects();
/// The living ones of an interface.
[[nodiscard]] std::vector<Subject> living_subjects(std::string_view kind);

}  // namespace scree::test
