#include "scree/results/result_claims.hpp"

#include <algorithm>

#include "scree/interfaces/scene_services.hpp"
#include "scree/results/output_file.hpp"

namespace scree {
namespace {

constexpr const char* kTheRun = "the run itself";
constexpr std::size_t kLongest = 200;  ///< characters; file systems take 255, and a number and ".part" come behind

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// True for a pattern with one `*`, or none, and a name that it stands for.
bool stands_for(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == name;
  const std::string_view head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  if (name.size() <= head.size() + tail.size() || !name.starts_with(head) || !name.ends_with(tail)) return false;
  return std::ranges::all_of(name.substr(head.size(), name.size() - head.size() - tail.size()), is_digit);
}

/// A file is first written under its name with ".part" behind.
std::string_view without_part(std::string_view file) {
  const std::string_view part = kPartOfFile;
  return file.ends_with(part) ? file.substr(0, file.size() - part.size()) : file;
}

bool meet(std::string_view one, std::string_view other) {
  one = without_part(one), other = without_part(other);
  return one == other || stands_for(one, other) || stands_for(other, one);
}

}  // namespace

ResultClaims::ResultClaims() {
  for (const char* file :
       {kStepsFile, kRemovedFile, kJointsFile, kRunFile, kCheckpointFile, kLastStateFile, "ccp_*.h5", ".scree_results"})
    claims_.emplace_back(kTheRun, file);
}

std::string ResultClaims::fault_of(std::string_view file) {
  if (file.empty() || file == "." || file == "..") return "is no name of a file";
  if (file.find('/') != std::string_view::npos)
    return "has a slash in it, but all files of a run lie in its own folder";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  if (std::ranges::any_of(file, is_control)) return "has a control character in it";
  if (file.size() > kLongest) return "is longer than " + std::to_string(kLongest) + " characters";
  return {};
}

std::string ResultClaims::claim(const std::string& owner, const std::string& file) {
  for (const auto& [other, taken] : claims_) {
    if (other != owner && meet(file, taken)) return other;
  }
  claims_.emplace_back(owner, file);
  return {};
}

bool ResultClaims::has(std::string_view file) const {
  return std::ranges::any_of(claims_, [&](const auto& claim) { return meet(claim.second, file); });
}

ResultRegistry::~ResultRegistry() = default;

void claim_results(SceneServices& services, std::string_view stem, const std::vector<std::string>& endings) {
  auto* registry = dynamic_cast<ResultRegistry*>(&services);
  if (registry == nullptr) return;
  for (const std::string& ending : endings) registry->claim_result(std::string{stem} + ending);
}

}  // namespace scree
