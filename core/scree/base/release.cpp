#include "scree/base/release.hpp"

#include <cstdlib>  // defines __GLIBC__
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace scree {

void map_large_blocks() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 8 * kMegabyte);  // else smaller blocks come and go through the system
#endif
}

}  // namespace scree
