#include "scree/host/plugin_file.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "scree/host/fingerprint_text.hpp"

namespace scree {
namespace {

Error refusal(const std::filesystem::path& file, const std::string& reason) {
  return Error{ErrorKind::usage, {file.string(), 0, 0}, reason};
}

std::string demangled(const std::string& symbol) {
  int status = 0;
  char* text = abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status);
  std::string readable = status == 0 && text != nullptr ? text : symbol;
  std::free(text);
  return readable;
}

/// The dynamic loader's message without the file's path, which the sentence already begins with.
std::string loader_message(const std::filesystem::path& file) {
  const char* text = dlerror();
  std::string message = text != nullptr ? text : "no reason given";
  const std::string prefix = file.string() + ": ";
  if (message.starts_with(prefix)) message.erase(0, prefix.size());
  return message;
}

void* open_library(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw refusal(file, "there is no such plugin file");
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library != nullptr) return library;
  const std::string message = loader_message(file);
  const std::string undefined = "undefined symbol: ";
  if (message.starts_with(undefined)) {
    throw refusal(file, "this plugin needs '" + demangled(message.substr(undefined.size())) +
                            "', which nothing that it is linked with defines; link the library that has it");
  }
  throw refusal(
      file, "this is not a shared library that can be loaded (" + message + "); build plugins with scree_add_plugin()");
}

const PluginLibrary& read_library(void* library, const std::filesystem::path& file) {
  const void* symbol = dlsym(library, "scree_plugin_library");
  if (symbol == nullptr) {
    throw refusal(file,
                  "this shared library is not a scree plugin: it exports no symbol scree_plugin_library; define it "
                  "with scree::describe_library()");
  }
  const auto& found = *static_cast<const PluginLibrary*>(symbol);
  // The number comes first in the record and is all that may be read while it differs.
  if (found.abi != kPluginAbi) {
    throw refusal(file, "this plugin was built for plugin interface " + std::to_string(found.abi) +
                            ", this scree has plugin interface " + std::to_string(kPluginAbi) +
                            "; rebuild the plugin against this scree");
  }
  const std::string differences = fingerprint_differences(found.fingerprint, build_fingerprint());
  if (!differences.empty()) {
    throw refusal(file, "this plugin was built in another way than this scree: " + differences +
                            "; rebuild the plugin with the compiler, flags and headers of this scree");
  }
  if (found.name == nullptr || found.version == nullptr || found.list == nullptr) {
    throw refusal(file, "this plugin's scree_plugin_library lacks its name, its version or its list of plugins");
  }
  return found;
}

bool is_lower_snake(const std::string& word) {
  return !word.empty() &&
         std::ranges::all_of(word, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

/// What the library says that it holds.
std::vector<PluginEntry> list_entries(const PluginLibrary& library, const std::filesystem::path& file) {
  PluginList list;
  try {
    library.list(list);
  } catch (const std::exception& failure) {
    throw refusal(file, "this plugin could not list what it holds: " + std::string{failure.what()});
  } catch (...) {
    throw refusal(file, "this plugin could not list what it holds: it threw something that is no std::exception");
  }
  if (list.entries().empty()) throw refusal(file, "this plugin library holds no plugin");
  return list.entries();
}

void check_names(const std::vector<PluginEntry>& entries, const std::filesystem::path& file) {
  std::set<std::string> names;
  for (const PluginEntry& entry : entries) {
    const std::string name = entry.kind + ":" + entry.name;
    if (!is_lower_snake(entry.kind) || !is_lower_snake(entry.name)) {
      throw refusal(file, "the name '" + name + "' is not valid; use lower-case letters, digits and underscores");
    }
    if (!names.insert(name).second) throw refusal(file, "this plugin library lists '" + name + "' twice");
  }
}

/// Makes the plugin, and tells which one it was when that fails. Errors of the configuration carry their place
/// already and pass as they are.
std::unique_ptr<Plugin> make_guarded(const PluginEntry& entry, const Options& options) {
  std::string reason = "made nothing";
  try {
    if (auto plugin = entry.make(options)) return plugin;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failure) {
    reason = failure.what();
  } catch (...) {
    reason = "threw something that is no std::exception";
  }
  throw Error{ErrorKind::usage, options.location(), to_string(entry) + ": " + reason};
}

}  // namespace

PluginFile open_plugin_file(const std::filesystem::path& file) {
  const std::filesystem::path absolute = std::filesystem::absolute(file).lexically_normal();
  const PluginLibrary& library = read_library(open_library(absolute), absolute);
  PluginFile result{absolute, library.name, library.version, list_entries(library, absolute)};
  check_names(result.entries, absolute);
  for (PluginEntry& entry : result.entries) {
    entry.library = absolute.string();
    entry.version = library.version;
    entry.make = [unguarded = entry](const Options& options) { return make_guarded(unguarded, options); };
  }
  return result;
}

std::string to_string(const PluginEntry& entry) {
  return entry.kind + ":" + entry.name + " (" + std::filesystem::path{entry.library}.filename().string() + ")";
}

}  // namespace scree
