#include "neighbour_index.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nanoflann.hpp>

#include "scree/parallel/executor.hpp"

namespace scree {

namespace {

/// The particles as the tree wants to see them.
struct Cloud {
  std::span<const Placed> particles;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return particles.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return particles[index].position[static_cast<int>(axis)];
  }
  template <class Box>
  [[nodiscard]] bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

/// Counts of neighbours, which add up to the same in any order.
struct Counts {
  std::uint64_t neighbours = 0;
  std::uint64_t unlike = 0;
};

/// Searches for one chunk of particles, with workspace of its own.
class Search {
 public:
  Search(std::span<const Placed> particles, const Neighbourhood& rule, const Tree& tree, double largest)
      : particles_{particles},
        rule_{rule},
        tree_{tree},
        largest_{largest},
        index_(rule.nearest + 1),
        squared_(rule.nearest + 1) {}

  void count(std::size_t particle) {
    const Vec3& p = particles_[particle].position;
    const std::array<double, 3> place{p.x, p.y, p.z};
    if (rule_.nearest > 0) {
      // One more than wanted, for the particle itself is the nearest.
      const std::size_t found = tree_.knnSearch(place.data(), index_.size(), index_.data(), squared_.data());
      for (std::size_t k = 0, left = rule_.nearest; k < found && left > 0; ++k) {
        if (index_[k] == particle) continue;
        add(particle, index_[k]);
        --left;
      }
      return;
    }
    const double radius = particles_[particle].radius, reach = rule_.reach * (radius + largest_);
    tree_.radiusSearch(place.data(), reach * reach, matches_, nanoflann::SearchParams{0, 0.0f, false});
    for (const auto& [other, squared] : matches_) {
      const double limit = rule_.reach * (radius + particles_[other].radius);
      if (other != particle && squared <= limit * limit) add(particle, other);
    }
  }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  void add(std::size_t particle, std::size_t other) {
    ++counts_.neighbours;
    if (particles_[other].of != particles_[particle].of) ++counts_.unlike;
  }

  std::span<const Placed> particles_;
  const Neighbourhood& rule_;
  const Tree& tree_;
  double largest_;  // radius [m]
  std::vector<std::uint32_t> index_;
  std::vector<double> squared_;  // [m2]
  std::vector<std::pair<std::uint32_t, double>> matches_;
  Counts counts_;
};

Counts count_neighbours(std::span<const Placed> particles, const Neighbourhood& rule, const Executor& executor) {
  const Cloud cloud{particles};
  const Tree tree{3, cloud};
  double largest = 0.0;
  for (const Placed& particle : particles) largest = std::max(largest, particle.radius);
  constexpr std::size_t kGrain = 1024;
  std::vector<Counts> of_chunk(Executor::chunk_count(particles.size(), kGrain));
  executor.for_chunks(particles.size(), kGrain, [&](std::size_t first, std::size_t last) {
    Search search{particles, rule, tree, largest};
    for (std::size_t i = first; i < last; ++i) search.count(i);
    of_chunk[first / kGrain] = search.counts();
  });
  Counts sum;
  for (const Counts& counts : of_chunk) {
    sum.neighbours += counts.neighbours;
    sum.unlike += counts.unlike;
  }
  return sum;
}

}  // namespace

NeighbourIndex neighbour_index(std::span<const Placed> particles, const Neighbourhood& rule, const Executor& executor) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (particles.size() < 2) return {kNone, 0.0};
  const Counts counts = count_neighbours(particles, rule, executor);
  const auto n = static_cast<double>(particles.size());
  const auto first = static_cast<double>(
      std::count_if(particles.begin(), particles.end(), [](const Placed& p) { return p.of == BodyClass::first; }));
  const double expected = 2.0 * first * (n - first) / (n * (n - 1.0));
  const auto neighbours = static_cast<double>(counts.neighbours);
  const bool defined = expected > 0.0 && counts.neighbours > 0;
  return {defined ? static_cast<double>(counts.unlike) / neighbours / expected : kNone, neighbours / n};
}

}  // namespace scree
