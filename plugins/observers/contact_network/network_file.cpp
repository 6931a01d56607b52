// The network as a file: a segment for every link.
#include <vector>

#include "contact_network.hpp"
#include "vtp/poly_data.hpp"

namespace scree {

namespace {

/// Columns of the links of a file.
struct LinkColumns {
  std::vector<double> normal, tangential, mobilised;
  std::vector<std::int32_t> sliding, wall;

  [[nodiscard]] std::vector<DataArray> arrays() const {
    const auto real = [](const char* name, const std::vector<double>& values) {
      return to_array(name, values, Precision::double_precision);
    };
    return {real("normal_force", normal), real("tangential_force", tangential), real("mobilisation", mobilised),
            to_array("slides", sliding), to_array("wall", wall)};
  }
};

}  // namespace

// From centre to centre; from the centre of a grain to its contact with what does not move by forces, whose centre may be
// anywhere.
void ContactNetwork::write_file(const Observation& now) {
  LinkColumns columns;
  PolyData data;
  std::vector<Vec3> points;
  std::size_t first = 0;
  for (const Link& link : network_.links) {
    // Points of contact of the pair, of which the first stands for all towards walls.
    while (now.contacts.contact[first].a != link.a || now.contacts.contact[first].b != link.b) ++first;
    if (!counts(network_, link)) continue;
    const Vec3& touch = now.contacts.contact[first].point;
    const bool a_moves = now.bodies.motion[link.a] == Motion::dynamic,
               b_moves = now.bodies.motion[link.b] == Motion::dynamic;
    const auto from = static_cast<std::uint32_t>(points.size());
    points.push_back(a_moves ? now.bodies.position[link.a] : touch);
    points.push_back(b_moves ? now.bodies.position[link.b] : touch);
    data.lines.push_back({from, from + 1});
    columns.normal.push_back(link.normal_force);
    columns.tangential.push_back(link.tangential_force);
    columns.mobilised.push_back(link.mobilisation);
    columns.sliding.push_back(link.slides ? 1 : 0);
    columns.wall.push_back(a_moves && b_moves ? 0 : 1);
  }
  data.time = now.time;
  data.vertices = false;
  data.point_count = points.size();
  data.points = to_array("Points", std::span<const Vec3>{points}, Precision::double_precision);
  data.cell_data = columns.arrays();
  const std::string file = numbered_file(stem_, now.step);
  write_vtp(data, results_ / file);
  series_.add(now.time, 0, file);
  series_.write(results_ / (stem_ + ".pvd"));
}

}  // namespace scree
