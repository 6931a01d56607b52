#include "scree/geometry/decomposition_cache.hpp"

#include <xxhash.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/results/output_file.hpp"

namespace scree {
namespace {

// Raise it when decompositions come out differently: older files are then passed over.
constexpr const char* kVersion = "scree sphere decomposition 1";

std::string hash_of(const std::string& content) {
  const XXH128_hash_t hash = XXH3_128bits(content.data(), content.size());
  char text[40];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

/// A decomposition as text, every bit of it: numbers are hexadecimal.
std::string to_text(const SphereDecomposition& d) {
  char line[160];
  std::string text = std::string{kVersion} + "\n";
  std::snprintf(line, sizeof line, "%zu %a %a %a\n", d.spheres.size(), d.volume_error, d.hausdorff,
                d.hausdorff_of_equivalent);
  text += line;
  for (const Sphere& s : d.spheres) {
    std::snprintf(line, sizeof line, "%a %a %a %a\n", s.centre.x, s.centre.y, s.centre.z, s.radius);
    text += line;
  }
  return text + hash_of(text) + "\n";
}

std::optional<SphereDecomposition> from_text(const std::string& text) {
  constexpr std::size_t kSumLength = 33;  // with its line end
  if (text.size() < kSumLength) return {};
  const std::string body = text.substr(0, text.size() - kSumLength);
  if (text.substr(body.size()) != hash_of(body) + "\n") return {};
  std::istringstream in{body};
  std::string version, count, word;
  std::getline(in, version);
  in >> count;
  if (version != kVersion) return {};
  const auto number = [&] {
    in >> word;  // streams do not read hexadecimal numbers
    return std::strtod(word.c_str(), nullptr);
  };
  SphereDecomposition d;
  d.spheres.resize(std::strtoul(count.c_str(), nullptr, 10));
  d.volume_error = number();
  d.hausdorff = number();
  d.hausdorff_of_equivalent = number();
  for (Sphere& s : d.spheres) {
    for (int axis = 0; axis < 3; ++axis) s.centre[axis] = number();
    s.radius = number();
  }
  if (!in || d.spheres.empty()) return {};
  return d;
}

std::optional<SphereDecomposition> read(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  if (!in) return {};
  return from_text({std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{}});
}

void write(const std::filesystem::path& file, const SphereDecomposition& d) {
  std::error_code ignored;
  std::filesystem::create_directories(file.parent_path(), ignored);
  try {
    replace_file(file, to_text(d));
  } catch (const Error&) {  // a full disk or a folder of somebody else: the answer stands without it
  }
}

}  // namespace

DecompositionCache& DecompositionCache::of_program() {
  static DecompositionCache cache;
  return cache;
}

void DecompositionCache::keep_in(std::filesystem::path folder) {
  const std::lock_guard lock{mutex_};
  folder_ = std::move(folder);
}

SphereDecomposition DecompositionCache::find_or(const std::string& content,
                                                const std::function<SphereDecomposition()>& compute) {
  const std::string hash = hash_of(content);
  std::promise<SphereDecomposition> promise;
  std::filesystem::path file;
  std::unique_lock lock{mutex_};
  const auto [place, fresh] = known_.try_emplace(hash);
  if (!fresh) {
    ++counts_.remembered;
    const std::shared_future<SphereDecomposition> answer = place->second;
    lock.unlock();
    return answer.get();
  }
  place->second = promise.get_future().share();
  if (!folder_.empty()) file = folder_ / "decompositions" / (hash + ".txt");
  lock.unlock();
  try {
    std::optional<SphereDecomposition> found;
    if (!file.empty()) found = read(file);
    const bool is_kept = found.has_value();
    SphereDecomposition answer = is_kept ? *std::move(found) : compute();
    if (!is_kept && !file.empty()) write(file, answer);
    lock.lock();
    ++(is_kept ? counts_.read : counts_.computed);
    lock.unlock();
    promise.set_value(answer);
    return answer;
  } catch (...) {
    promise.set_exception(std::current_exception());
    lock.lock();
    known_.erase(hash);
    throw;
  }
}

DecompositionCache::Counts DecompositionCache::counts() const {
  const std::lock_guard lock{mutex_};
  return counts_;
}

void DecompositionCache::forget() {
  const std::lock_guard lock{mutex_};
  known_.clear();
}

std::filesystem::path user_cache_folder() {
  const char* const folder = std::getenv("SCREE_CACHE");  // NOLINT(concurrency-mt-unsafe): read once, at the start
  return folder == nullptr ? "" : folder;
}

}  // namespace scree
