#include "scree/config/scene_document.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "scree/config/scene_node.hpp"

namespace scree {

struct SceneDocument::Contents {
  SceneStore store;
  std::shared_ptr<SceneNode> root;
  std::filesystem::path file;
  std::filesystem::path folder;
};

namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file, const SourceLocation& asked_at) {
  const auto refuse = [&](const std::string& why) {
    throw Error{ErrorKind::io, asked_at, "scene file '" + file.string() + "' cannot be read: " + why};
  };
  std::error_code failure;
  if (fs::is_directory(file, failure)) refuse("it is a folder");
  errno = 0;
  std::ifstream stream{file, std::ios::binary};
  if (!stream) refuse(std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>{stream}, std::istreambuf_iterator<char>{}};
  if (stream.bad()) refuse(std::strerror(errno));
  return text;
}

// A table counts as a list of one where the other side has a list.
std::vector<std::shared_ptr<SceneNode>> as_list(const std::shared_ptr<SceneNode>& node) {
  return node->kind == SceneKind::list ? node->items : std::vector{node};
}

// Puts `beneath` under `own`: keys of `own` win, tables merge, lists of tables follow those of `beneath`.
void merge(SceneNode& own, const SceneNode& beneath) {
  for (const SceneNode::Member& member : beneath.members) {
    SceneNode::Member* mine = own.find(member.key);
    if (mine == nullptr) {
      own.members.push_back(member);
      continue;
    }
    const bool lists = mine->value->is_table_list() || member.value->is_table_list();
    const auto tabular = [](const SceneNode& node) { return node.kind == SceneKind::table || node.is_table_list(); };
    if (!tabular(*mine->value) || !tabular(*member.value)) continue;
    if (!lists) {
      merge(*mine->value, *member.value);
      continue;
    }
    auto joined = std::make_shared<SceneNode>();
    joined->kind = SceneKind::list;
    joined->origin = mine->value->origin;
    joined->line = mine->value->line;
    joined->column = mine->value->column;
    joined->items = as_list(member.value);
    std::ranges::copy(as_list(mine->value), std::back_inserter(joined->items));
    mine->value = std::move(joined);
  }
}

// Reads a file and what it includes; a file that several others include is merged once.
class Loader {
 public:
  explicit Loader(SceneStore& store) : store_{store} {}

  std::shared_ptr<SceneNode> load(const fs::path& file, const SourceLocation& asked_at) {
    const fs::path identity = fs::weakly_canonical(fs::absolute(file));
    refuse_cycle(identity, asked_at);
    if (std::ranges::find(done_, identity) != done_.end()) return nullptr;
    const std::string text = read_file(file, asked_at);
    open_.push_back(identity);
    auto root = with_includes(text, *store_.add(file.string(), identity.parent_path()), file.parent_path());
    open_.pop_back();
    done_.push_back(identity);
    return root;
  }

  std::shared_ptr<SceneNode> with_includes(std::string_view text, const SceneOrigin& origin, const fs::path& folder) {
    std::shared_ptr<SceneNode> root = read_toml(text, origin);
    const SceneNode::Member* member = root->find("include");
    if (member == nullptr) return root;
    std::shared_ptr<SceneNode> beneath;
    for (const auto& item : as_list(member->value)) {
      if (item->kind != SceneKind::text || item->text.empty())
        throw Error{ErrorKind::usage, item->where(),
                    "'include' must be a list of file names, but one entry is " + std::string{kind_name(item->kind)}};
      auto included = load((folder / item->text).lexically_normal(), item->where());
      if (included == nullptr) continue;
      if (beneath != nullptr) merge(*included, *beneath);
      beneath = std::move(included);
    }
    std::erase_if(root->members, [](const SceneNode::Member& each) { return each.key == "include"; });
    if (beneath != nullptr) merge(*root, *beneath);
    return root;
  }

 private:
  void refuse_cycle(const fs::path& identity, const SourceLocation& asked_at) const {
    if (std::ranges::find(open_, identity) == open_.end()) return;
    std::string chain;
    for (const fs::path& file : open_) chain += file.filename().string() + " -> ";
    throw Error{ErrorKind::usage, asked_at,
                "the includes form a cycle: " + chain + identity.filename().string() + "; remove one of them"};
  }

  SceneStore& store_;
  std::vector<fs::path> open_;
  std::vector<fs::path> done_;
};

}  // namespace

SceneDocument::SceneDocument(std::unique_ptr<Contents> contents) : contents_{std::move(contents)} {}
SceneDocument::SceneDocument(SceneDocument&&) noexcept = default;
SceneDocument& SceneDocument::operator=(SceneDocument&&) noexcept = default;
SceneDocument::~SceneDocument() = default;

SceneDocument SceneDocument::load(const fs::path& file, std::span<const std::string> overrides) {
  auto contents = std::make_unique<Contents>();
  contents->file = file;
  contents->folder = fs::absolute(file).lexically_normal().parent_path();
  contents->root = Loader{contents->store}.load(file, {});
  for (const std::string& assignment : overrides) apply_override(*contents->root, "--set", assignment, contents->store);
  return SceneDocument{std::move(contents)};
}

SceneDocument SceneDocument::parse(std::string_view toml, const std::string& name,
                                   std::span<const std::string> overrides, const std::string& option) {
  auto contents = std::make_unique<Contents>();
  contents->file = name;
  contents->folder = fs::current_path();
  const SceneOrigin& origin = *contents->store.add(name, contents->folder);
  contents->root = Loader{contents->store}.with_includes(toml, origin, {});
  for (const std::string& assignment : overrides) apply_override(*contents->root, option, assignment, contents->store);
  return SceneDocument{std::move(contents)};
}

SceneTable SceneDocument::root() const { return SceneTable{contents_->root.get()}; }
const fs::path& SceneDocument::folder() const { return contents_->folder; }
const fs::path& SceneDocument::file() const { return contents_->file; }

}  // namespace scree
