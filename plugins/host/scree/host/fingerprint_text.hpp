// Compares build fingerprints and says in words where they differ.
#pragma once

#include <string>

#include "scree/interfaces/build_fingerprint.hpp"

namespace scree {

/// Every difference with both sides, "compiler 'gcc 9' in the plugin, 'gcc 12' here"; empty when all agree.
[[nodiscard]] std::string fingerprint_differences(const BuildFingerprint& plugin, const BuildFingerprint& here);

}  // namespace scree
