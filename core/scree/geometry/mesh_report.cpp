// What a MeshReport says.
#include <cstdio>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {
namespace {

std::string count(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string describe_crossings(const MeshReport& report) {
  char place[120];
  std::snprintf(place, sizeof place, "near (%.6g, %.6g, %.6g) m", report.crossing_at.x, report.crossing_at.y,
                report.crossing_at.z);
  return "the surface passes through itself or lies on itself: " +
         count(report.crossings, "pair of triangles crosses, ", "pairs of triangles cross, the first ") + place +
         "; unite its parts (a boolean union), or write them as parts of a compound";
}

}  // namespace

bool MeshReport::is_solid() const { return problems().empty(); }

std::vector<std::string> MeshReport::problems() const {
  std::vector<std::string> all;
  const auto add = [&](bool fault, const std::string& sentence) {
    if (fault) all.push_back(sentence);
  };
  add(bad_vertices > 0, count(bad_vertices, "vertex is", "vertices are") + " no finite numbers; export the mesh again");
  add(bad_indices > 0,
      count(bad_indices, "triangle names", "triangles name") + " a vertex that does not exist; export the mesh again");
  if (!all.empty()) return all;
  add(degenerate_triangles > 0, count(degenerate_triangles, "triangle has", "triangles have") +
                                    " no area; remove what is degenerate (mesh cleanup, merge by distance)");
  add(open_edges > 0,
      count(open_edges, "edge has", "edges have") + " one triangle only: the surface has holes or a rim; close them");
  add(crowded_edges > 0, count(crowded_edges, "edge joins", "edges join") +
                             " more than two triangles; separate the parts, or remove what is double or inside");
  add(one_sided,
      "the surface has one side only, like a Moebius strip, so that it bounds nothing; cut it or rebuild it");
  add(misoriented_edges > 0 && !one_sided, count(misoriented_edges, "edge joins", "edges join") +
                                               " triangles of opposite sense: some are turned over; unify the normals");
  add(crossings > 0, describe_crossings(*this));
  add(inside_out, "the surface is inside out: its normals point inwards; flip them");
  add(misplaced_shells > 0 && !inside_out,
      std::to_string(misplaced_shells) + " of " + count(shells, "shell", "shells") +
          " is inside out, or lies in another that faces the same way; flip or remove such shells");
  if (all.empty() && !(volume > 0.0)) all.emplace_back("it encloses no volume; a solid needs at least four triangles");
  return all;
}

std::string MeshReport::problem() const {
  const std::vector<std::string> all = problems();
  return all.empty() ? std::string{} : all.front();
}

}  // namespace scree
