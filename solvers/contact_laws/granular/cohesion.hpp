// Cohesion: attraction of surfaces that touch, added to any repulsion.
//
//   sced   simple cohesion energy density: density times the area of the circle in which two spheres cut each other,
//          F = kappa 2 pi R x, to first order in the overlap x
//   dmt    Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53 (1975) 314: F = 2 pi w R while the surfaces touch
//   jkr    scree/solvers/contact_laws/granular/jkr_neck.hpp; for laws that know an elastic modulus
//
// R effective radius [m]. Friction is limited by the force that presses the surfaces together, attraction included: with sced
// and dmt by mu (F + attraction), as in Derjaguin's law of friction; with jkr by mu (F + 2 pull-off force), Thornton and Yin,
// Powder Technology 65 (1991) 153, and Marshall, J. Comput. Phys. 228 (2009) 1541, eq. 43.
#pragma once

#include <optional>

#include "granular/contact_lanes.hpp"
#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"
#include "scree/interfaces/contact_reader.hpp"
#include "scree/model/material.hpp"

namespace scree::granular {

enum class Cohesion { none, sced, dmt, jkr };

/// The setting `cohesion`; `knows_modulus` lists jkr too.
[[nodiscard]] Parameter cohesion_parameter(bool knows_modulus);
[[nodiscard]] Cohesion cohesion_of(const Options& options);

/// What the law needs of each pair: J/m3 for sced, J/m2 for dmt and jkr.
[[nodiscard]] double cohesion_of_pair(Cohesion cohesion, const ContactMaterial& pair);

/// The quantity of attraction of a pair that `cohesion` does not read, when the pair lacks the one that it reads: a scene may
/// state both, and choose a model that reads one. `knows_modulus` as above.
[[nodiscard]] std::optional<UnreadValue> unread_cohesion(Cohesion cohesion, const ContactMaterial& pair,
                                                         bool knows_modulus);

/// A warning, for the log, when bodies are to attract each other and no pair of `materials` says how strongly; else nothing.
/// `where` is the place of the setting.
[[nodiscard]] std::optional<std::string> idle_cohesion(Cohesion cohesion, const Materials& materials,
                                                       const SourceLocation& where);

/// Takes the attraction of sced or dmt from lanes.normal, where lanes.stiffness says that surfaces act on each other.
void add_cohesion(Cohesion cohesion, const PairColumn& column, const ContactBatch& batch, ContactLanes& lanes);

}  // namespace scree::granular
