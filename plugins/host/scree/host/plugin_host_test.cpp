// Every way in which a plugin file can be wrong, against the sentence that the user gets. The files are built from
// tests/fixtures/plugins.
#include "scree/host/plugin_host.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "scree/host/search_path.hpp"
#include "scree/interfaces/force_field.hpp"

namespace scree {
namespace {

std::filesystem::path fixture(const std::string& name, const std::string& folder = {}) {
  return std::filesystem::path{SCREE_FIXTURE_PLUGINS} / (folder.empty() ? name : folder) / (name + ".so");
}

/// The sentence with which `file` is refused, without its path in front; empty when it is accepted.
std::string refusal_of(const std::filesystem::path& file) {
  try {
    (void)open_plugin_file(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with(file.string() + ": ")) << text;
    return text.substr(std::min(text.size(), file.string().size() + 2));
  }
  return {};
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(plugin_file, reads_a_good_library) {
  const PluginFile file = open_plugin_file(fixture("good"));
  EXPECT_EQ(file.name, "good");
  EXPECT_EQ(file.version, "1.2.3");
  ASSERT_EQ(file.entries.size(), 1u);
  EXPECT_EQ(file.entries[0].kind, "force_field");
  EXPECT_EQ(file.entries[0].name, "push");
  EXPECT_EQ(file.entries[0].version, "1.2.3");
  EXPECT_EQ(to_string(file.entries[0]), "force_field:push (good.so)");
}

TEST(plugin_file, a_made_plugin_is_its_interface_across_the_library_boundary) {
  const PluginFile file = open_plugin_file(fixture("good"));
  Options options;
  options.set("push", Parameter::Value{Vec3{0, 0, 2}});
  const std::unique_ptr<Plugin> plugin = file.entries[0].make(options);
  const auto* field = dynamic_cast<const ForceField*>(plugin.get());
  ASSERT_NE(field, nullptr);
  const std::vector<Motion> motion{Motion::dynamic, Motion::fixed};
  const std::vector<BodyId> id{0, 1};
  const std::vector<double> mass{3.0, 5.0};
  BodyView bodies;
  bodies.id = id;
  bodies.motion = motion;
  bodies.mass = mass;
  std::vector<Vec3> force(2), torque(2);
  field->add_forces(bodies, 0.0, {force, torque});
  EXPECT_EQ(force[0], (Vec3{0, 0, 6}));  // m a, exact in binary
  EXPECT_EQ(force[1], (Vec3{0, 0, 0}));
}

TEST(plugin_file, refuses_a_missing_file) { EXPECT_EQ(refusal_of(fixture("nowhere")), "there is no such plugin file"); }

TEST(plugin_file, refuses_a_text_file) {
  EXPECT_EQ(
      refusal_of(fixture("text")),
      "this is not a shared library that can be loaded (invalid ELF header); build plugins with scree_add_plugin()");
}

TEST(plugin_file, refuses_a_library_without_the_symbol) {
  EXPECT_EQ(refusal_of(fixture("no_symbol")),
            "this shared library is not a scree plugin: it exports no symbol scree_plugin_library; define it with "
            "scree::describe_library()");
}

TEST(plugin_file, refuses_an_old_abi_and_names_both_numbers) {
  EXPECT_EQ(refusal_of(fixture("old_abi")),
            "this plugin was built for plugin interface 0, this scree has plugin "
            "interface " +
                std::to_string(kPluginAbi) + "; rebuild the plugin against this scree");
}

TEST(plugin_file, refuses_another_fingerprint_and_prints_both_sides) {
  const std::string sentence = refusal_of(fixture("other_fingerprint"));
  const std::string compiler = build_fingerprint().compiler;
  EXPECT_NE(sentence.find("compiler gcc 4 in the plugin, " + compiler + " here"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("_GLIBCXX_USE_CXX11_ABI 0 in the plugin, 1 here"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("0123456789abcdef in the plugin"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find("pointer"), std::string::npos) << "says nothing of what agrees: " << sentence;
}

TEST(plugin_file, refuses_an_undefined_symbol_and_names_it_readably) {
  EXPECT_EQ(refusal_of(fixture("undefined_symbol")),
            "this plugin needs 'elsewhere::forgotten(int)', which nothing that it is linked with defines; link the "
            "library that has it");
}

TEST(plugin_file, refuses_a_library_that_throws_while_listing) {
  EXPECT_EQ(refusal_of(fixture("throws_in_list")), "this plugin could not list what it holds: the shelf is empty");
}

TEST(plugin_file, refuses_names_that_are_not_lower_snake) {
  EXPECT_EQ(refusal_of(fixture("bad_name")),
            "the name 'force_field:Dead Calm' is not valid; use lower-case letters, digits and underscores");
}

TEST(plugin_file, an_exception_while_a_plugin_is_made_names_plugin_file_and_place) {
  PluginHost host;
  host.load(fixture("throws_while_made"));
  Options options;
  options.set_location({"scene.toml", 4, 1});
  EXPECT_EQ(message_of([&] { (void)host.entry("force_field", "touchy", {}).make(options); }),
            "scene.toml:4:1: force_field:touchy (throws_while_made.so): the coil is missing");
  EXPECT_EQ(message_of([&] { (void)host.entry("force_field", "rude", {}).make(options); }),
            "scene.toml:4:1: force_field:rude (throws_while_made.so): threw something that is no std::exception");
}

TEST(plugin_host, a_second_plugin_of_a_name_is_left_out_with_its_whole_file) {
  PluginHost host;
  host.search(fixture("twin_one", "twins").parent_path());
  EXPECT_EQ(host.entry("force_field", "twin", {}).library, fixture("twin_one", "twins").string());
  ASSERT_EQ(host.refused().size(), 1u);
  EXPECT_EQ(host.refused()[0], fixture("twin_two", "twins").string() + ": 'force_field:twin' exists already, from " +
                                   fixture("twin_one", "twins").string() +
                                   "; rename one of them or take one of the files away");
  EXPECT_EQ(host.entries().size(), 2u);
}

TEST(plugin_host, a_named_file_that_does_not_fit_is_an_error_at_the_place_that_named_it) {
  PluginHost host;
  EXPECT_EQ(message_of([&] {
              host.load(fixture("throws_in_list"), {"scene.toml", 1, 12});
            }),
            "scene.toml:1:12: " + fixture("throws_in_list").string() +
                ": this plugin could not list what it holds: the shelf is empty");
}

TEST(plugin_host, the_same_file_twice_is_no_duplicate) {
  PluginHost host;
  host.load(fixture("good"));
  host.load(fixture("good").parent_path() / ".." / "good" / "good.so");
  host.search(fixture("good").parent_path());
  EXPECT_EQ(host.entries().size(), 1u);
  EXPECT_TRUE(host.refused().empty());
}

TEST(plugin_host, an_unknown_name_lists_what_exists_a_suggestion_and_the_folders) {
  PluginHost host;
  const std::string folder = fixture("good").parent_path().string();
  const std::string broken = fixture("no_symbol").parent_path().string();
  host.search(folder);
  host.search("/nowhere/at/all");
  host.search(broken);
  EXPECT_EQ(message_of([&] {
              (void)host.entry("force_field", "pusch", {"scene.toml", 7, 8});
            }),
            "scene.toml:7:8: there is no force_field 'pusch' (did you mean 'push'?); valid: 'push'; searched in " +
                folder + ", /nowhere/at/all (does not exist), " + broken +
                "; name other places in the scene's `plugins`, with --plugin-dir or in SCREE_PLUGIN_PATH; left out " +
                fixture("no_symbol").string() + ": " + refusal_of(fixture("no_symbol")));
}

TEST(plugin_host, many_files_left_out_do_not_drown_the_sentence) {
  PluginHost host;
  host.search(fixture("no_symbol").parent_path());
  host.search(fixture("old_abi").parent_path());
  const std::string sentence = message_of([&] { (void)host.entry("force_field", "push", {}); });
  EXPECT_NE(sentence.find("left out 2 files, the first: " + fixture("no_symbol").string()), std::string::npos)
      << sentence;
  EXPECT_EQ(sentence.find("old_abi.so"), std::string::npos) << sentence;
  EXPECT_EQ(host.refused().size(), 2u) << "every reason stays to be asked for";
}

TEST(search_path, earlier_places_win_and_missing_named_places_are_errors) {
  PluginHost host;
  const std::vector<NamedPlace> scene{{fixture("twin_two", "twins"), {"scene.toml", 1, 1}}};
  const std::vector<NamedPlace> command_line{{fixture("twin_one", "twins").parent_path(), {"--plugin-dir", 0, 0}}};
  find_plugins(host, scene, command_line);
  EXPECT_EQ(host.entry("force_field", "twin", {}).library, fixture("twin_two", "twins").string());
  const std::vector<NamedPlace> missing{{"/nowhere/at/all", {"--plugin-dir", 0, 0}}};
  EXPECT_EQ(message_of([&] { find_plugins(host, {}, missing); }),
            "--plugin-dir: there is no plugin file or folder /nowhere/at/all");
}

TEST(search_path, the_environment_comes_before_the_default_folder) {
  ASSERT_EQ(setenv("SCREE_PLUGIN_PATH", "/first::/second", 1), 0);
  PluginHost host;
  find_plugins(host, {}, {});
  ASSERT_EQ(unsetenv("SCREE_PLUGIN_PATH"), 0);
  ASSERT_EQ(host.searched().size(), 3u);
  EXPECT_EQ(host.searched()[0], "/first");
  EXPECT_EQ(host.searched()[1], "/second");
  EXPECT_EQ(host.searched()[2], default_plugin_folder());
  EXPECT_TRUE(default_plugin_folder().string().ends_with("/scree/plugins"));
}

}  // namespace
}  // namespace scree
