#include "scree/geometry/scan_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <span>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/geometry/number_table.hpp"

namespace scree {
namespace {

constexpr double kMillimetre = 1e-3;          // [m]
constexpr double kMilligram = 1e-6;           // [kg]
constexpr double kInertiaUnit = 1e-12;        // mg mm2 in kg m2
constexpr double kLargest = 1e9;              // [mm, mg, mg mm2]: a particle of a kilometre is none
constexpr double kMeasured = 1.05;            // errors of measurement in moments [1]
constexpr double kConvex = 0.99;              // area of an outline over that of its hull [1]
constexpr std::size_t kMostCorners = 100000;  // of an outline
constexpr std::array kColumns{"material id", "particle id", "thickness", "mass", "I1", "I2", "I3", "N"};

/// Why a row is refused; thrown within this file only.
struct Refusal {
  std::string reason;
};

std::string text_of(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

long long whole(double x, const char* what) {
  if (std::isfinite(x) && x == std::floor(x) && std::abs(x) < 9e15) return static_cast<long long>(x);
  throw Refusal{std::string{"its "} + what + " is " + text_of(x) + ", which is no whole number"};
}

double positive(double x, const char* what) {
  if (std::isfinite(x) && x > 0.0 && x < kLargest) return x;
  throw Refusal{std::string{"its "} + what + " is " + text_of(x) + ", but must be above zero" +
                (x >= kLargest ? " and below 1e9" : "")};
}

using Numbers = std::span<const double>;

bool all_nan(Numbers numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isnan(x); });
}

/// x and y of the corners, with NaN behind them at most.
std::pair<Numbers, Numbers> split_coordinates(Numbers rest, std::size_t n) {
  const std::size_t half = rest.size() / 2;
  // Filled up behind everything, or x and y each.
  if (rest.size() >= 2 * n && all_nan(rest.subspan(2 * n))) return {rest.first(n), rest.subspan(n, n)};
  if (rest.size() % 2 == 0 && half > n && all_nan(rest.subspan(n, half - n)) && all_nan(rest.subspan(half + n))) {
    return {rest.first(n), rest.subspan(half, n)};
  }
  throw Refusal{"N = " + std::to_string(n) + " corners need " + std::to_string(2 * n) + " coordinates, but it has " +
                std::to_string(rest.size()) + " (what is over must be NaN)"};
}

/// The corners [mm] of a row, as written.
std::vector<Vec3> read_corners(Numbers rest, std::size_t n) {
  auto [x, y] = split_coordinates(rest, n);
  while (!x.empty() && std::isnan(x.back()) && std::isnan(y.back())) {
    x = x.first(x.size() - 1);
    y = y.first(y.size() - 1);
  }
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || std::abs(x[i]) > kLargest || std::abs(y[i]) > kLargest) {
      throw Refusal{"corner " + std::to_string(i + 1) + " of its outline is (" + text_of(x[i]) + ", " + text_of(y[i]) +
                    "), which is no point"};
    }
    corners.push_back({x[i], y[i], 0.0});
  }
  return corners;
}

double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The convex hull of points of the plane, counter-clockwise, without points on its sides (Andrew's monotone chain, 1979).
std::vector<Vec3> planar_hull(std::vector<Vec3> points) {
  std::ranges::sort(points, {}, [](const Vec3& p) { return std::pair{p.x, p.y}; });
  std::vector<Vec3> hull;
  const auto add = [&](const Vec3& p, std::size_t least) {
    while (hull.size() >= least + 2 && twice_area(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec3& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();
  return hull;
}

/// Signed area [mm2] and centre [mm] of a polygon, summed about its first corner.
std::pair<double, Vec3> area_and_centre(const std::vector<Vec3>& polygon) {
  double area = 0.0;
  Vec3 moment;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double part = 0.5 * twice_area(polygon[0], polygon[i], polygon[i + 1]);
    area += part;
    moment += (part / 3.0) * ((polygon[i] - polygon[0]) + (polygon[i + 1] - polygon[0]));
  }
  return {area, area == 0.0 ? Vec3{} : polygon[0] + moment / area};
}

/// Fills in outline and area. @throws Refusal.
void take_outline(const std::vector<Vec3>& written, ScannedParticle& particle) {
  if (written.size() < 3)
    throw Refusal{"its outline has " + std::to_string(written.size()) + " corners; 3 are the least"};
  const std::vector<Vec3> hull = planar_hull(written);
  double extent = 0.0;
  for (const Vec3& p : hull) extent = std::max(extent, norm(p - hull[0]));
  const auto [area, centre] = hull.size() < 3 ? std::pair{0.0, Vec3{}} : area_and_centre(hull);
  if (!(area > 1e-6 * extent * extent))
    throw Refusal{"its outline has no area: all corners lie on a line or in a point"};
  const double written_area = std::abs(area_and_centre(written).first);
  if (written_area < kConvex * area) {
    throw Refusal{"its outline is not convex, or crosses itself: it encloses " + text_of(written_area) +
                  " mm2, its convex hull " + text_of(area) + " mm2"};
  }
  particle.area = kMillimetre * kMillimetre * area;
  for (const Vec3& p : hull) particle.outline.push_back(kMillimetre * (p - centre));
}

/// No body can have larger moments than one whose mass sits in the furthest corners. @throws Refusal.
void check_inertia(const ScannedParticle& particle) {
  const Vec3& i = particle.inertia;
  if (i.x > kMeasured * (i.y + i.z) || i.y > kMeasured * (i.z + i.x) || i.z > kMeasured * (i.x + i.y)) {
    throw Refusal{"one of its moments of inertia is larger than the sum of the other two, which no body has"};
  }
  Vec3 most;
  const double up = 0.25 * particle.thickness * particle.thickness;
  for (const Vec3& p : particle.outline) {
    most.x = std::max(most.x, p.y * p.y + up);
    most.y = std::max(most.y, p.x * p.x + up);
    most.z = std::max(most.z, p.x * p.x + p.y * p.y);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double bound = particle.mass * most[axis];
    if (i[axis] <= kMeasured * bound) continue;
    throw Refusal{"its moment of inertia I" + std::to_string(axis + 1) + " is " + text_of(i[axis] / kInertiaUnit) +
                  " mg mm2, but a body of its mass and outline has at most " + text_of(bound / kInertiaUnit) +
                  "; check the units"};
  }
}

ScannedParticle read_particle(const NumberRow& row, int line) {
  if (!row.bad_word.empty()) {
    throw Refusal{"'" + row.bad_word.substr(0, 40) + "' in column " + std::to_string(row.word) + " is no number"};
  }
  const std::vector<double>& numbers = row.numbers;
  if (numbers.size() < kColumns.size()) {
    throw Refusal{"it ends after " + std::to_string(numbers.size()) + " columns, before its " +
                  kColumns[numbers.size()]};
  }
  ScannedParticle particle;
  particle.line = line;
  particle.material = whole(numbers[0], kColumns[0]);
  particle.id = whole(numbers[1], kColumns[1]);
  particle.thickness = kMillimetre * positive(numbers[2], kColumns[2]);
  particle.mass = kMilligram * positive(numbers[3], kColumns[3]);
  for (int axis = 0; axis < 3; ++axis) {
    const auto column = static_cast<std::size_t>(axis) + 4;
    particle.inertia[axis] = kInertiaUnit * positive(numbers[column], kColumns[column]);
  }
  const long long n = whole(numbers[7], kColumns[7]);
  if (n < 3 || static_cast<unsigned long long>(n) > kMostCorners) {
    throw Refusal{"its N is " + std::to_string(n) + "; an outline has 3 to " + std::to_string(kMostCorners) +
                  " corners"};
  }
  take_outline(read_corners(Numbers{numbers}.subspan(8), static_cast<std::size_t>(n)), particle);
  check_inertia(particle);
  return particle;
}

bool is_heading(std::string_view line) {
  // A heading has no number at all: reading stops at its first word, and dropping words one by one finds none.
  while (!line.empty()) {
    if (!read_numbers(line).numbers.empty()) return false;
    const std::size_t begin = line.find_first_not_of(" \t,;\r");
    if (begin == std::string_view::npos) return true;
    const std::size_t end = line.find_first_of(" \t,;\r", begin);
    if (end == std::string_view::npos) return true;
    line.remove_prefix(end);
  }
  return true;
}

}  // namespace

std::vector<Vec3> ScannedParticle::corners() const {
  std::vector<Vec3> all;
  for (const Vec3& p : outline) {
    all.push_back({p.x, p.y, -0.5 * thickness});
    all.push_back({p.x, p.y, 0.5 * thickness});
  }
  return all;
}

ScanTable read_scan_table(std::istream& in) {
  ScanTable table;
  std::map<std::pair<long long, long long>, int> seen;  // line of each material and particle id
  std::string text;
  bool first = true;
  for (int line = 1; std::getline(in, text); ++line) {
    const NumberRow row = read_numbers(text);
    if (row.numbers.empty() && row.bad_word.empty()) continue;
    if (std::exchange(first, false) && row.numbers.empty() && is_heading(text)) continue;
    try {
      ScannedParticle particle = read_particle(row, line);
      const auto [place, fresh] = seen.try_emplace({particle.material, particle.id}, line);
      if (!fresh) {
        throw Refusal{"particle " + std::to_string(particle.id) + " of material " + std::to_string(particle.material) +
                      " stands in line " + std::to_string(place->second) + " already"};
      }
      table.particles.push_back(std::move(particle));
    } catch (const Refusal& refusal) {
      table.refused.push_back({line, refusal.reason});
    }
  }
  return table;
}

ScanTable read_scan_file(const std::filesystem::path& file) {
  std::error_code code;
  std::ifstream in{file};
  if (!std::filesystem::is_regular_file(file, code) || !in) {
    throw Error{ErrorKind::io, "the table of scanned particles '" + file.string() + "' cannot be read; check the path"};
  }
  ScanTable table = read_scan_table(in);
  if (table.particles.empty() && table.refused.empty()) {
    throw Error{ErrorKind::usage, "the table of scanned particles '" + file.string() + "' holds no particle"};
  }
  return table;
}

}  // namespace scree
