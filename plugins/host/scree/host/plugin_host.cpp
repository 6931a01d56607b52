#include "scree/host/plugin_host.hpp"

#include <algorithm>

#include "scree/config/suggest.hpp"

namespace scree {
namespace {

/// The regular files `*.so` of a folder, by name.
std::vector<std::filesystem::path> library_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code failure;
  for (const auto& item : std::filesystem::directory_iterator{folder, failure}) {
    if (item.path().extension() == ".so" && !item.is_directory(failure)) files.push_back(item.path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

void PluginHost::load(const std::filesystem::path& file, const SourceLocation& where) {
  std::error_code failure;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, failure);
  if (std::ranges::find(loaded_, canonical) != loaded_.end()) return;
  try {
    add(open_plugin_file(file));
  } catch (const Error& refusal) {
    throw Error{refusal.kind(), where, refusal.what()};
  }
  loaded_.push_back(canonical);
}

void PluginHost::search(const std::filesystem::path& folder) {
  const std::filesystem::path absolute = std::filesystem::absolute(folder).lexically_normal();
  if (std::ranges::find(searched_, absolute) != searched_.end()) return;
  searched_.push_back(absolute);
  for (const auto& file : library_files(absolute)) {
    try {
      load(file);
    } catch (const Error& refusal) {
      refused_.emplace_back(refusal.what());
    }
  }
}

void PluginHost::add(PluginFile file) {
  // All or nothing: a file with one name too many adds none.
  for (const PluginEntry& entry : file.entries) {
    const auto existing = entries_.find({entry.kind, entry.name});
    if (existing == entries_.end()) continue;
    throw Error{ErrorKind::usage,
                {file.file.string(), 0, 0},
                "'" + entry.kind + ":" + entry.name + "' exists already, from " + existing->second.library +
                    "; rename one of them or take one of the files away"};
  }
  for (PluginEntry& entry : file.entries) {
    Key key{entry.kind, entry.name};
    entries_.emplace(std::move(key), std::move(entry));
  }
}

std::vector<std::string> PluginHost::names_of(std::string_view kind) const {
  std::vector<std::string> names;
  for (const auto& [key, entry] : entries_) {
    if (key.first == kind) names.push_back(key.second);
  }
  return names;
}

std::string PluginHost::unknown(std::string_view kind, std::string_view name) const {
  const std::vector<std::string> names = names_of(kind);
  std::string text = "there is no " + std::string{kind} + " '" + std::string{name} + "'";
  const std::string nearest = nearest_word(name, names);
  if (!nearest.empty()) text += " (did you mean '" + nearest + "'?)";
  text += "; valid: " + list_of(names) + "; searched in ";
  for (std::size_t i = 0; i < searched_.size(); ++i) {
    text += (i == 0 ? "" : ", ") + searched_[i].string();
    if (!std::filesystem::exists(searched_[i])) text += " (does not exist)";
  }
  if (searched_.empty()) text += "no folder";
  text += "; name other places in the scene's `plugins`, with --plugin-dir or in SCREE_PLUGIN_PATH";
  if (refused_.size() == 1) text += "; left out " + refused_.front();
  if (refused_.size() > 1) {
    text += "; left out " + std::to_string(refused_.size()) + " files, the first: " + refused_.front();
  }
  return text;
}

const PluginEntry& PluginHost::entry(std::string_view kind, std::string_view name, const SourceLocation& where) const {
  const auto found = entries_.find({std::string{kind}, std::string{name}});
  if (found == entries_.end()) throw Error{ErrorKind::usage, where, unknown(kind, name)};
  return found->second;
}

std::vector<const PluginEntry*> PluginHost::entries() const {
  std::vector<const PluginEntry*> all;
  for (const auto& [key, entry] : entries_) all.push_back(&entry);
  return all;
}

}  // namespace scree
