// The colours of all drawings.
#pragma once

#include <array>

#include "plot/canvas.hpp"

namespace scree::plot {

/// For what is told apart, in this order: readable with colour blindness (Okabe and Ito 2008).
inline constexpr std::array kColours{Colour{0.835, 0.369, 0.0}, Colour{0.0, 0.447, 0.698}, Colour{0.0, 0.620, 0.451},
                                     Colour{0.902, 0.624, 0.0}, Colour{0.8, 0.475, 0.655}, Colour{0.337, 0.706, 0.914}};
inline constexpr Colour kInk{0.1, 0.1, 0.1};
inline constexpr Colour kGuide{0.35, 0.35, 0.35};
inline constexpr Colour kGrid{0.88, 0.88, 0.88};
inline constexpr Colour kPaper{1.0, 1.0, 1.0};

}  // namespace scree::plot
