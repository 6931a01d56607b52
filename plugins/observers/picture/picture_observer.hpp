// PictureObserver: orthographic pictures of the scene as PNG and SVG files, drawn without any graphics driver.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene_picture.hpp"
#include "scree/config/options.hpp"

namespace scree {

/// Writes picture_NAME.png at the end and picture_NAME_STEP.png at an interval, and the same as SVG when wanted.
class PictureObserver final : public Observer {
 public:
  explicit PictureObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;

 private:
  void write(const Observation& now, const std::string& stem) const;

  Options options_;
  View view_;
  int width_;                       // [px]
  std::optional<double> interval_;  // [s]
  bool at_end_, svg_, labels_;
  std::string title_;
  std::vector<Mark> marks_;

  std::string name_, stem_;  // from here on made by setup()
  std::filesystem::path results_;
  std::optional<SceneWords> words_;
  std::uint64_t steps_between_ = 0;  // 0: never
};

}  // namespace scree
