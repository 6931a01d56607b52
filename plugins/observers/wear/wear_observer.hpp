// WearObserver: wear of named bodies by sliding and impacts, on each face of their surfaces.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "contact_study/contact_log.hpp"
#include "contact_study/followed_bodies.hpp"
#include "contact_study/series_table.hpp"
#include "face_map.hpp"
#include "scree/interfaces/observer.hpp"
#include "vtp/file_series.hpp"
#include "wear_account.hpp"
#include "wear_law.hpp"

namespace scree {

/// Writes wear.csv, wear.svg and .png, wear_*.vtp and wear.pvd; with a name, wear_NAME.
class WearObserver final : public Observer {
 public:
  explicit WearObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

  [[nodiscard]] const WearAccount& account(std::size_t slot) const { return accounts_[slot]; }
  [[nodiscard]] const FaceMap& faces(std::size_t slot) const { return *maps_[slot]; }

 private:
  void make_maps(SceneServices& services);
  [[nodiscard]] std::unique_ptr<FaceMap> map_of(const Shape& shape, const std::string& body) const;
  void wear_by(const Observation& now, const BodyContact& c);
  void remember_poses(const BodyView& bodies);
  void add_rows(double time);
  void write_field(double time, std::uint64_t step);
  void write_figure() const;
  [[nodiscard]] double deepest(std::size_t slot) const;
  [[nodiscard]] double density(std::size_t slot) const;  // of what is worn off [kg/m3]

  Options options_;
  FaceOptions face_options_;
  double min_impact_speed_;  // [m/s]
  bool moving_;              // faces are written where bodies are
  WearTable laws_;
  FollowedBodies followed_;
  const ShapeSet* shapes_ = nullptr;
  const Materials* materials_ = nullptr;

  std::filesystem::path results_;
  std::string stem_;
  std::uint64_t row_every_ = 1, field_every_ = 1;  // steps
  std::vector<std::unique_ptr<FaceMap>> maps_;     // by slot
  std::vector<WearAccount> accounts_;              // by slot
  std::vector<Pose> poses_;                        // seen last, by slot
  std::vector<std::uint32_t> body_materials_;      // by slot
  ContactLog log_;
  SeriesTable table_;
  FileSeries series_;
  double marked_ = 0.0, row_time_ = 0.0;          // times of the last field and row [s]
  std::vector<double> row_volume_;                // at the last row, by slot [m3]
  std::uint64_t last_field_ = ~std::uint64_t{0};  // step
};

}  // namespace scree
