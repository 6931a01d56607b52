#include "analysis/stem.hpp"

#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

Stem::Stem(std::string_view type, const SceneServices& services, const std::filesystem::path& results) {
  if (!results.empty()) stem_ = results / result_stem(type, type, services.part_name());
}

std::filesystem::path Stem::table(std::string_view part) const {
  return writes() ? std::filesystem::path{figure(part).string() + ".csv"} : stem_;
}

std::filesystem::path Stem::figure(std::string_view part) const {
  return part.empty() ? stem_ : std::filesystem::path{stem_.string() + "_" + std::string{part}};
}

}  // namespace scree
