// The field, the figure and the table of a wear observer.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "plot/figure.hpp"
#include "vtp/poly_data.hpp"
#include "wear_observer.hpp"

namespace scree {

namespace {

// Columns of the table.
constexpr std::size_t kTime = 0, kBody = 1, kSliding = 2, kImpact = 3;

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// Columns of the field, face by face.
struct Columns {
  std::vector<std::int32_t> body, primitive;
  std::vector<double> area, sliding, impact, depth, rate, sliding_energy, impact_energy;

  void add(const FaceMap& map, const WearAccount& account, std::size_t slot, double seconds) {
    for (std::size_t f = 0; f < map.size(); ++f) {
      const WearAmount& wear = account.faces()[f];
      const double per_area = map.areas()[f] > 0.0 ? 1.0 / map.areas()[f] : 0.0;
      body.push_back(static_cast<std::int32_t>(slot));
      primitive.push_back(static_cast<std::int32_t>(map.primitive(f)));
      area.push_back(map.areas()[f]);
      sliding.push_back(per_area * wear.sliding_volume);
      impact.push_back(per_area * wear.impact_volume);
      depth.push_back(per_area * wear.volume());
      rate.push_back(seconds > 0.0 ? per_area * account.since_mark(f) / seconds : 0.0);
      sliding_energy.push_back(per_area * wear.sliding_energy);
      impact_energy.push_back(per_area * wear.impact_energy);
    }
  }

  [[nodiscard]] std::vector<DataArray> arrays() const {
    const auto real = [](const char* name, const std::vector<double>& values) {
      return to_array(name, values, Precision::double_precision);
    };
    return {to_array("body", body),
            to_array("primitive", primitive),
            real("area", area),
            real("depth_sliding", sliding),
            real("depth_impact", impact),
            real("depth", depth),
            real("depth_rate", rate),
            real("sliding_energy_density", sliding_energy),
            real("impact_energy_density", impact_energy)};
  }
};

/// A unit in which a volume is a number that one reads.
struct VolumeUnit {
  const char* name;
  double per_m3;
};

VolumeUnit unit_for(double volume) {
  constexpr std::array kUnits{VolumeUnit{"m3", 1.0},        VolumeUnit{"cm3", 1e6},       VolumeUnit{"mm3", 1e9},
                              VolumeUnit{"1e-3 mm3", 1e12}, VolumeUnit{"1e-6 mm3", 1e15}, VolumeUnit{"um3", 1e18}};
  for (const VolumeUnit& unit : kUnits) {
    if (volume * unit.per_m3 >= 0.1) return unit;
  }
  return kUnits.back();
}

}  // namespace

void WearObserver::write_field(double time, std::uint64_t step) {
  last_field_ = step;
  Columns columns;
  PolyData data;
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const auto base = static_cast<std::uint32_t>(points.size());
    for (const Vec3& p : maps_[k]->points()) points.push_back(moving_ ? transform(poses_[k], p) : p);
    for (const Triangle& t : maps_[k]->triangles()) data.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    columns.add(*maps_[k], accounts_[k], k, time - marked_);
    accounts_[k].mark();
  }
  marked_ = time;
  if (results_.empty()) return;
  data.time = time;
  data.point_count = points.size();
  data.points = to_array("Points", std::span<const Vec3>{points}, Precision::double_precision);
  data.cell_data = columns.arrays();
  data.texts = {{"body_names", followed_.names()}};
  const std::string file = numbered_file(stem_, step);
  write_vtp(data, results_ / file);
  series_.add(time, 0, file);
  series_.write(results_ / (stem_ + ".pvd"));
}

void WearObserver::write_figure() const {
  plot::Figure figure;
  figure.title = "Wear";
  figure.x = {"time [s]"};
  double most = 0.0;
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const WearAmount& all = accounts_[k].total();
    most = std::max({most, all.sliding_volume, all.impact_volume});
  }
  const VolumeUnit unit = unit_for(most);
  figure.y = {std::string{"volume ["} + unit.name + "]"};
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const auto key = static_cast<double>(k);
    const std::vector<double> time = table_.column(kTime, kBody, key);
    for (const auto& [column, word] : {std::pair{kSliding, " (sliding)"}, std::pair{kImpact, " (impacts)"}}) {
      std::vector<double> volume = table_.column(column, kBody, key);
      if (volume.empty() || volume.back() == 0.0) continue;
      for (double& v : volume) v *= unit.per_m3;
      figure.series.push_back({followed_.name(k) + word, plot::SeriesStyle::line, time, std::move(volume)});
    }
  }
  if (!figure.series.empty()) plot::write_figure(figure, results_ / stem_);
}

std::vector<ReportTable> WearObserver::report() const {
  ReportTable table;
  table.title = stem_ + ": wear";
  table.header = {"body",        "sliding [m3]",       "impacts [m3]",      "mass [kg]", "density [kg/m3]",
                  "deepest [m]", "sliding energy [J]", "impact energy [J]", "impacts",   "faces",
                  "worn faces"};
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const WearAmount& all = accounts_[k].total();
    const std::vector<WearAmount>& faces = accounts_[k].faces();
    const auto worn = std::count_if(faces.begin(), faces.end(), [](const WearAmount& f) { return f.volume() > 0.0; });
    table.rows.push_back({followed_.name(k), number(all.sliding_volume), number(all.impact_volume),
                          number(density(k) * all.volume()), number(density(k)), number(deepest(k)),
                          number(all.sliding_energy), number(all.impact_energy), number(accounts_[k].impacts()),
                          std::to_string(faces.size()), std::to_string(worn)});
  }
  return {table};
}

}  // namespace scree
