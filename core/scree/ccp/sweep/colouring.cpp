#include "scree/ccp/sweep/colouring.hpp"

#include <algorithm>
#include <bit>

namespace scree::sweep {

void Colouring::build(const CcpProblem& problem, const Sequence& sequence) {
  const std::size_t chunk_count = sequence.chunks();
  colours_of_body_.assign(problem.bodies(), 0);
  colour_.resize(chunk_count);
  std::uint32_t colours = 0;
  const auto bodies_of = [&](std::size_t chunk, auto&& visit) {
    for (std::size_t at = sequence.first()[chunk]; at < sequence.first()[chunk + 1]; ++at) {
      const CcpContact& contact = problem.contacts[sequence.contacts()[at]];
      for (const std::uint32_t body : {contact.a, contact.b}) {
        if (problem.inverse_mass[body] > 0.0 && sequence.hub(body) == Sequence::kNoHub) visit(body);
      }
    }
  };
  for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) {
    std::uint64_t taken = 0;
    bodies_of(chunk, [&](std::uint32_t body) { taken |= colours_of_body_[body]; });
    const auto colour = static_cast<std::uint32_t>(std::countr_one(taken));
    colour_[chunk] = colour;
    if (colour == kMaxColours) continue;
    bodies_of(chunk, [&](std::uint32_t body) { colours_of_body_[body] |= std::uint64_t{1} << colour; });
    colours = std::max(colours, colour + 1);
  }

  // Counting sort by colour; those without one come last.
  first_.assign(colours + 1, 0);
  cursor_.assign(kMaxColours + 2, 0);
  for (const std::uint32_t colour : colour_) ++cursor_[colour + 1];
  for (std::size_t c = 1; c < cursor_.size(); ++c) cursor_[c] += cursor_[c - 1];
  for (std::size_t c = 0; c <= colours; ++c) first_[c] = cursor_[c];
  chunks_.resize(chunk_count);
  for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) {
    chunks_[cursor_[colour_[chunk]]++] = static_cast<std::uint32_t>(chunk);
  }
}

}  // namespace scree::sweep
