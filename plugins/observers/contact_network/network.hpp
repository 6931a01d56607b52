// Network: who presses on whom, and how hard, at one moment.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/region.hpp"
#include "contact_study/contact_motion.hpp"
#include "scree/math/mat3.hpp"

namespace scree {

/// A force between two bodies: all loaded contacts of the pair together.
struct Link {
  BodyIndex a = 0, b = 0;
  double normal_force = 0.0;      ///< sum over the points of the pair [N]; negative where cohesion pulls
  double tangential_force = 0.0;  ///< length of the sum over the points [N]
  double mobilisation = 0.0;      ///< of the point with the greatest, |f_t| / (mu f_n) [1]
  bool slides = false;            ///< one of the points does
  Vec3 normal;                    ///< from a to b, mean of the points weighed by force, unit [1]
};

/// The loaded pairs of a step, and the bodies whose coordination counts.
struct Network {
  std::vector<Link> links;            ///< in the order of contacts
  std::vector<char> grain;            ///< by body: dynamic, and in the region
  std::vector<std::uint32_t> degree;  ///< by body: links, those to walls too
};

/// Fills `network`; workspaces are kept.
void build_network(const BodyView& bodies, const ContactView& contacts, double dt, const Materials& materials,
                   const Region& region, Network& network);

/// Coordination of grains: mean number of links of a grain.
struct Coordination {
  std::size_t grains = 0;
  double mean = 0.0;                   ///< all grains
  double mean_without_rattlers = 0.0;  ///< of grains that are held, counting links among them and walls
  std::size_t rattlers = 0;
  std::vector<std::uint64_t> distribution;  ///< grains with k links, all of them
};

/// Rattlers have fewer than `least` links; they are taken away again and again until none is left (O'Hern et al. 2003).
[[nodiscard]] Coordination coordination(const Network& network, std::uint32_t least);

/// The fabric tensor F = 1/N sum n n^T [1] over links of grains (Satake 1982): trace 1, diag(1/3, 1/3, 1/3) when isotropic.
struct Fabric {
  Mat3 tensor;  ///< [1]
  double anisotropy =
      0.0;  ///< sqrt(3/2 D : D) of D = 15/2 (F - 1/3) [1]: normals are distributed as 1 + D : n n to second
            ///< order (Kanatani 1984, fabric tensor of the third kind); 0 when isotropic
};

[[nodiscard]] Fabric fabric(const Network& network);

/// True when a link counts for a grain: one of its ends is one.
[[nodiscard]] inline bool counts(const Network& network, const Link& link) {
  return network.grain[link.a] != 0 || network.grain[link.b] != 0;
}

}  // namespace scree
