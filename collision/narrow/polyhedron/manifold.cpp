#include "manifold.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "clip.hpp"
#include "scree/collision/contact.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::polyhedron {
namespace {

// All lengths below are in sizes of the smaller solid.
/// A face normal explains a meeting when it separates as far as the meeting's own normal, to this.
constexpr double kSameGap = 1e-6;
/// Nearly parallel to a face (0.6 degrees), an edge's normal has to be better than the face's by more than this.
constexpr double kNearFaceGap = 1e-4;
constexpr double kNearFaceCosine = 0.99994517;
/// A corner that is outside of the reference face by less than this is over it.
constexpr double kClipSlack = 1e-6;
/// Points nearer than this are one.
constexpr double kSamePoint = 1e-5;
/// A corner belongs to a face when it is this near to its plane, in sizes of the solid.
constexpr double kOnFace = 1e-6;
/// Sine below which two edges touch along a line.
constexpr double kParallelEdges = 0.005;
/// Points that are kept, beside the deepest, where there are more of them.
constexpr int kDirections = 7;

/// Of the faces that meet in a corner, the one that looks most along n. kNoFace when there is none.
std::uint32_t facing(const Polytope& solid, const Vec3& n, std::uint32_t corner) {
  const Vec3 at = solid.corner(corner);
  std::uint32_t best = kNoFace;
  double most = -1.0;
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const double cosine = dot(solid.faces[f].normal, n);
    if (cosine <= most || std::abs(dot(solid.faces[f].normal, at) - solid.faces[f].offset) > kOnFace * solid.size)
      continue;
    most = cosine;
    best = f;
  }
  return best;
}

void sort_by_feature(std::vector<ManifoldPoint>& points) {
  std::sort(points.begin(), points.end(),
            [](const ManifoldPoint& l, const ManifoldPoint& r) { return l.feature < r.feature; });
}

/// A reference face that explains a meeting.
struct Reference {
  std::uint32_t face = kNoFace;
  std::uint32_t deepest = 0;  // corner of the other solid
  Vec3 out;                   // its normal in the frame of a
  double separation = -std::numeric_limits<double>::infinity();
};

bool explains(const PlacedPair& pair, const Meeting& meeting, double separation, double cosine) {
  if (separation >= meeting.gap - kSameGap * pair.size) return true;
  return pair.radii() == 0.0 && cosine >= kNearFaceCosine && separation >= meeting.gap - kNearFaceGap * pair.size;
}

Reference reference_of_a(const PlacedPair& pair, const Meeting& meeting) {
  Reference r;
  if (pair.a.faces.empty()) return r;
  const std::uint32_t face = facing(pair.a, meeting.normal, farthest(pair.a, meeting.normal));
  if (face == kNoFace) return r;
  r.out = pair.a.faces[face].normal;
  r.deepest = pair.lowest_of_b(r.out);
  r.separation = dot(r.out, pair.corner_b(r.deepest)) - pair.a.faces[face].offset;
  if (explains(pair, meeting, r.separation, dot(r.out, meeting.normal))) r.face = face;
  return r;
}

Reference reference_of_b(const PlacedPair& pair, const Meeting& meeting) {
  Reference r;
  if (pair.b.faces.empty()) return r;
  const Vec3 inwards = -(pair.turn_back * meeting.normal);
  const std::uint32_t face = facing(pair.b, inwards, farthest(pair.b, inwards));
  if (face == kNoFace) return r;
  r.out = pair.turn * pair.b.faces[face].normal;
  r.deepest = farthest(pair.a, -r.out);
  r.separation = dot(r.out, pair.a.corner(r.deepest) - pair.shift) - pair.b.faces[face].offset;
  if (explains(pair, meeting, r.separation, -dot(r.out, meeting.normal))) r.face = face;
  return r;
}

/// Collects the points of one manifold.
class Maker {
 public:
  Maker(const PlacedPair& pair, double reach, Manifold& out) : pair_{pair}, reach_{reach}, out_{out} {}

  /// A point between on_a and on_b, which lie `core_gap` apart along the normal.
  void add(const Vec3& on_a, const Vec3& on_b, double core_gap, std::uint32_t feature) {
    const double gap = core_gap - pair_.radii();
    if (!(gap < reach_)) return;
    const Vec3 at = 0.5 * (on_a + on_b) + 0.5 * (pair_.a.radius - pair_.b.radius) * out_.normal;
    const double same = kSamePoint * pair_.size;
    for (ManifoldPoint& known : out_.points) {
      if (squared_norm(known.at - at) > same * same) continue;
      if (gap < known.gap) {
        known.at = at;
        known.gap = gap;
        least_ = std::min(least_, core_gap);
      }
      return;
    }
    out_.points.push_back({at, gap, feature});
    least_ = std::min(least_, core_gap);
  }
  /// The same for a point of one solid over the plane of the other's face.
  void add_over(const Reference& reference, bool of_a, const Vec3& at, double height, std::uint32_t feature) {
    const Vec3 foot = at - height * reference.out;
    add(of_a ? foot : at, of_a ? at : foot, height, feature);
  }
  /// False while no point is as near as the meeting itself.
  [[nodiscard]] bool has(double core_gap) const { return least_ <= core_gap + kSamePoint * pair_.size; }

 private:
  const PlacedPair& pair_;
  double reach_;
  Manifold& out_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// What of the incident face lies over the reference face.
void face_points(const PlacedPair& pair, const Reference& reference, bool of_a, Manifold& out, Maker& maker) {
  const Polytope& other = of_a ? pair.b : pair.a;
  const Polytope& own = of_a ? pair.a : pair.b;
  const Vec3 inwards = of_a ? -(pair.turn_back * reference.out) : -reference.out;
  const Vec3 on_plane = of_a ? own.faces[reference.face].offset * reference.out
                             : pair.shift + own.faces[reference.face].offset * reference.out;
  const std::uint32_t incident = other.faces.empty() ? kNoFace : facing(other, inwards, reference.deepest);
  if (other.faces.empty() || incident != kNoFace) {
    clip(pair, {of_a, reference.face, incident}, kClipSlack * pair.size, out);
    for (const ClipCorner& c : out.polygon) {
      maker.add_over(reference, of_a, c.at, dot(reference.out, c.at - on_plane), feature_of(pair, c));
    }
  }
}

/// The corner of the other solid that is deepest below the face, beside it.
Vec3 deepest_of(const PlacedPair& pair, const Reference& reference, bool of_a) {
  return of_a ? pair.corner_b(reference.deepest) : pair.a.corner(reference.deepest);
}

/// Whether a point lies in the reference solid, or no farther outside than the swept solids overlap.
bool is_at(const PlacedPair& pair, bool of_a, const Vec3& point, double separation) {
  const Polytope& own = of_a ? pair.a : pair.b;
  const Vec3 at = of_a ? point : pair.to_b(point);
  const double room = std::max(0.0, pair.radii() - separation) + kNearFaceGap * pair.size;
  return std::all_of(own.faces.begin(), own.faces.end(),
                     [&](const Face& face) { return dot(face.normal, at) - face.offset <= room; });
}

/// Where all points of the face are shallower than the meeting: the deepest corner, or, where that is far beside the solid, the
/// place of the meeting itself.
void add_deepest(const PlacedPair& pair, const Reference& reference, bool of_a, const Meeting& meeting, Maker& maker) {
  if (maker.has(meeting.gap)) return;
  const Vec3 deepest = deepest_of(pair, reference, of_a);
  if (is_at(pair, of_a, deepest, reference.separation)) {
    maker.add_over(reference, of_a, deepest, reference.separation, feature_of_corner(of_a ? 1 : 0, reference.deepest));
  } else {
    maker.add(meeting.on_a, meeting.on_b, meeting.gap, kNoFeature);
  }
}

/// Whether a second corner is nearly as high along n as the highest one.
bool may_have_level_edge(const Polytope& solid, const Vec3& n) {
  const double top = dot(n, solid.corner(farthest(solid, n)));
  return several_above(solid, n, top - 2.0 * kParallelEdges * solid.size);
}

/// The edge whose lower end along n is the highest; kNoFace for none.
std::uint32_t highest_edge(const Polytope& solid, const Vec3& n) {
  std::uint32_t best = kNoFace;
  double height = -std::numeric_limits<double>::infinity();
  for (std::uint32_t e = 0; e < solid.edges.size(); ++e) {
    const double lower = std::min(dot(n, solid.corner(solid.edges[e].from)), dot(n, solid.corner(solid.edges[e].to)));
    if (lower <= height) continue;
    height = lower;
    best = e;
  }
  return best;
}

/// The two ends of what two parallel edges share, where the solids meet along a line.
void line_points(const PlacedPair& pair, const Meeting& meeting, Maker& maker) {
  const Vec3 along_b = -(pair.turn_back * meeting.normal);
  if (!may_have_level_edge(pair.a, meeting.normal) || !may_have_level_edge(pair.b, along_b)) return;
  const std::uint32_t i = highest_edge(pair.a, meeting.normal);
  const std::uint32_t j = highest_edge(pair.b, along_b);
  if (i == kNoFace || j == kNoFace) return;
  const Vec3 p = pair.a.corner(pair.a.edges[i].from), q = pair.corner_b(pair.b.edges[j].from);
  const Vec3 u = pair.a.corner(pair.a.edges[i].to) - p, v = pair.corner_b(pair.b.edges[j].to) - q;
  const double uu = squared_norm(u), vv = squared_norm(v), uv = dot(u, v);
  if (uu * vv - uv * uv > kParallelEdges * kParallelEdges * uu * vv) return;
  // Both as intervals along u, from 0 to 1 for a's edge.
  const double begin = dot(q - p, u) / uu, end = begin + uv / uu;
  const double low = std::max(0.0, std::min(begin, end)), high = std::min(1.0, std::max(begin, end));
  if (!(high - low > kSamePoint)) return;
  const auto ends = [&](double s) { return std::pair{p + s * u, q + ((s - begin) * uu / uv) * v}; };
  // They lie over each other: what crosses within their length is no farther apart than their angle allows.
  const double aside = 2.0 * kParallelEdges * (high - low) * std::sqrt(uu) + kNearFaceGap * pair.size;
  for (const double s : {low, high}) {
    const auto [on_a, on_b] = ends(s);
    const Vec3 way = on_b - on_a;
    if (squared_norm(way - dot(meeting.normal, way) * meeting.normal) > aside * aside) return;
  }
  for (const double s : {low, high}) {
    const auto [on_a, on_b] = ends(s);
    maker.add(on_a, on_b, dot(meeting.normal, on_b - on_a), feature_of_edges(i, j, s == low ? 0 : 1));
  }
}

}  // namespace

void make_manifold(const PlacedPair& pair, const Meeting& meeting, double reach, Manifold& out) {
  const Reference a = reference_of_a(pair, meeting), b = reference_of_b(pair, meeting);
  const bool use_a = a.face != kNoFace && (b.face == kNoFace || a.separation >= b.separation - kSameGap * pair.size);
  if (!use_a && b.face == kNoFace) return make_edge_manifold(pair, meeting, reach, out);
  out.points.clear();
  out.of_face = true;
  const Reference& reference = use_a ? a : b;
  out.normal = use_a ? reference.out : -reference.out;
  Maker maker{pair, reach, out};
  face_points(pair, reference, use_a, out, maker);
  add_deepest(pair, reference, use_a, meeting, maker);
  if (out.points.size() > kDirections + 1) keep_support(out.normal, out.points);
  sort_by_feature(out.points);
}

void make_face_manifold(const PlacedPair& pair, std::uint32_t face, double reach, Manifold& out) {
  out.points.clear();
  out.of_face = true;
  out.normal = pair.a.faces[face].normal;
  Maker maker{pair, reach, out};
  Reference reference;
  reference.face = face;
  reference.out = out.normal;
  reference.deepest = pair.lowest_of_b(out.normal);
  face_points(pair, reference, true, out, maker);
  sort_by_feature(out.points);
}

void make_edge_manifold(const PlacedPair& pair, const Meeting& meeting, double reach, Manifold& out) {
  out.points.clear();
  out.of_face = false;
  out.normal = meeting.normal;
  Maker maker{pair, reach, out};
  line_points(pair, meeting, maker);
  if (!maker.has(meeting.gap)) maker.add(meeting.on_a, meeting.on_b, meeting.gap, kNoFeature);
  sort_by_feature(out.points);
}

void keep_support(const Vec3& normal, std::vector<ManifoldPoint>& points) {
  const ContactFrame frame = contact_frame(normal);
  std::array<std::size_t, kDirections + 1> kept{};
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].gap < points[deepest].gap) deepest = i;
  }
  double reach = 0.0;  // of the points about the first [m]
  double least = std::numeric_limits<double>::infinity();
  for (int d = 0; d < kDirections; ++d) {
    const double angle = 2.0 * std::numbers::pi * d / kDirections;
    const Vec3 along = std::cos(angle) * frame.tangent1 + std::sin(angle) * frame.tangent2;
    std::size_t best = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (dot(along, points[i].at) > dot(along, points[best].at)) best = i;
    }
    kept[static_cast<std::size_t>(d)] = best;
    reach = std::max(reach, dot(along, points[best].at - points[0].at));
    least = std::min(least, points[best].gap);
  }
  // On a level face every point is the deepest; there the extreme ones do.
  kept[kDirections] = points[deepest].gap < least - kSameGap * reach ? deepest : kept[0];
  std::sort(kept.begin(), kept.end());
  const auto last = std::unique(kept.begin(), kept.end());
  std::size_t count = 0;
  for (auto k = kept.begin(); k != last; ++k) points[count++] = points[*k];
  points.resize(count);
}

}  // namespace scree::polyhedron
