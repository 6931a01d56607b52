// The picture of `scree decompose`: a solid and the spheres that stand for it, seen along the three axes.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "scree/geometry/sphere.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Draws the solid as a grey shape with its contour and sharp edges, and the spheres over it, as SVG or PNG by the ending of
/// `file`. @throws Error (usage) for another ending, (io) when it cannot be written.
void draw_decomposition(const std::filesystem::path& file, const std::string& title, const std::string& note,
                        const TriangleMesh& surface, std::span<const Sphere> spheres);

}  // namespace scree
