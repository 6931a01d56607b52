#include "analysis/stem.hpp"

#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

Stem::Stem(std::string_view type, SceneServices& services, const std::filesystem::path& results,
           const std::vector<std::string>& endings) {
  const std::string stem = result_stem(type, type, services.part_name());
  claim_results(services, stem, endings);
  if (!results.empty()) stem_ = results / stem;
}

std::filesystem::path Stem::table(std::string_view part) const {
  return writes() ? std::filesystem::path{figure(part).string() + ".csv"} : stem_;
}

std::filesystem::path Stem::figure(std::string_view part) const {
  return part.empty() ? stem_ : std::filesystem::path{stem_.string() + "_" + std::string{part}};
}

}  // namespace scree
