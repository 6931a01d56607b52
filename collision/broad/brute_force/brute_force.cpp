// Broad phase `brute_force`: every box against every other, the reference for the others.
#include <algorithm>

#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {

/// n (n - 1) / 2 comparisons.
class BruteForce : public BroadPhase {
 public:
  void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) override {
    const std::size_t n = boxes.size();
    found_.resize(Executor::chunk_count(n, kBlock));
    executor.for_chunks(n, kBlock, [&](std::size_t first, std::size_t last) {
      std::vector<CandidatePair>& found = found_[first / kBlock];
      found.clear();
      // Beside a block of a's, each b is read once.
      for (std::size_t b = first + 1; b < n; ++b) {
        for (std::size_t a = first; a < std::min(last, b); ++a) {
          if (wanted(boxes, a, b)) found.push_back({static_cast<ColliderIndex>(a), static_cast<ColliderIndex>(b)});
        }
      }
    });
    for (const std::vector<CandidatePair>& found : found_) out.insert(out.end(), found.begin(), found.end());
  }

 private:
  static constexpr std::size_t kBlock = 64;

  static bool wanted(const BoxView& boxes, std::size_t a, std::size_t b) {
    return overlap(boxes.box[a], boxes.box[b]) && (boxes.movable[a] != 0 || boxes.movable[b] != 0) &&
           boxes.owner[a] != boxes.owner[b];
  }

  std::vector<std::vector<CandidatePair>> found_;  // per block
};

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::BruteForce>("brute_force", "Every box against every other: the reference.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("brute_force", "1.0.0", &list)};
