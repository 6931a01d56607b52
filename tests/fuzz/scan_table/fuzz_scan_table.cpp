// Tables of scanned particles, byte by byte: every row becomes a particle or is refused, and a particle makes a solid.
#include <cstdlib>
#include <sstream>

#include "fuzz/fuzz.hpp"
#include "scree/base/error.hpp"
#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/scan_table.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in{std::string{reinterpret_cast<const char*>(data), size}};
  for (const scree::ScannedParticle& particle : scree::read_scan_table(in).particles) {
    const bool sound = particle.mass > 0.0 && particle.volume() > 0.0 && particle.outline.size() >= 3;
    if (!sound) std::abort();
    try {
      (void)scree::convex_hull(particle.corners());
    } catch (const scree::Error& error) {  // a plate as thin as its rounding
      if (error.kind() != scree::ErrorKind::usage) throw;
    }
  }
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  std::ofstream{folder / "plain.txt"} << "1 1 0.5 12.0 4 9 12 4 -1 1 1 -1 -2 -2 2 2\n";
  std::ofstream{folder / "filled.txt"} << "# material particle\n1 1 0.5 12.0 4 9 12 3 -1 1 0 nan -2 -2 2 nan\n"
                                          "1,2,0.5,12.0,4,9,12,4,-1,1,0,NaN,-2,-2,2,NaN\n"
                                          "2;3;0.5;12.0;4;9;12;3;-1;1;0;-2;-2;2;NaN;NaN\n";
  std::ofstream{folder / "bad.txt"} << "id x y\n1 2 3\n1 1 -0.5 12 4 9 12 3 0 1 2 0 1 2\nx\n";
}
