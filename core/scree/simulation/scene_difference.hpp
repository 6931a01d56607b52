// What differs between two resolved scenes, for a checkpoint that does not fit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree {

/// The settings that decide the motion and differ between two resolved scenes (JSON text), as --set addresses them:
/// "simulation.time_step", "source.0.rate"; of a part of another type its type alone, of a list of another length the list.
/// What Simulation::scene_hash() leaves out may differ. Empty when a text is no JSON.
[[nodiscard]] std::vector<std::string> differing_settings(const std::string& one, const std::string& other);

/// The resolved scene in the run.json of the folder of `checkpoint`; empty when there is none, or it is that of a scene with
/// another hash.
[[nodiscard]] std::string scene_beside(const std::filesystem::path& checkpoint, const std::string& scene_hash);

}  // namespace scree
