// operator new of a program: large blocks lie in large pages.
//
// A page is mapped when it is first touched, which costs as much as writing to it several times, and more in a virtual machine.
// In large scenes the phases of a step give their memory back (release.hpp), so that every step maps its buffers anew, and reads
// them in random order. Pages of 2 MB instead of 4 kB make both cheap. To be linked into programs, not into libscree: how
// memory is allocated is for a program to say. The rest of malloc is as it was; free() serves all blocks.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <sys/mman.h>

namespace {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kLargePage = std::size_t{2} << 20;
/// Smaller blocks are not worth the ends that do not fill a large page.
constexpr std::size_t kLargeBlock = kLargePage;

void* allocate(std::size_t size, std::size_t alignment) {
  const bool large = size >= kLargeBlock;
  if (large && alignment < kLargePage) alignment = kLargePage;
  for (;;) {
    void* block = alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size)
                                                         : std::aligned_alloc(alignment, size);
    if (block != nullptr) {
      // Where the system has no large pages this changes nothing.
      if (large) static_cast<void>(madvise(block, size / kPage * kPage, MADV_HUGEPAGE));
      return block;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc{};
    handler();
  }
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t /*size*/) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept { std::free(block); }
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept { std::free(block); }

#endif
