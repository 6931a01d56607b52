// BuildFingerprint: what must agree between the host and a plugin for C++
// objects to pass between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scree {

/// Compiler, standard library and layout of the boundary, as constant data.
struct BuildFingerprint {
  const char* compiler;          ///< name and major version
  std::uint32_t cxx_abi;         ///< __GXX_ABI_VERSION
  std::uint32_t library;         ///< release of the standard library
  std::uint32_t new_string_abi;  ///< _GLIBCXX_USE_CXX11_ABI
  std::uint32_t debug_library;   ///< _GLIBCXX_DEBUG, which changes containers
  std::uint32_t pointer_size;    ///< [byte]
  std::uint32_t string_size;     ///< sizeof(std::string) [byte]
  std::uint32_t vector_size;     ///< sizeof(std::vector<double>) [byte]
};

/// The fingerprint of the code being compiled.
constexpr BuildFingerprint build_fingerprint() {
#if defined(__clang__)
#define SCREE_COMPILER "clang"
#else
#define SCREE_COMPILER "gcc"
#endif
  return {SCREE_COMPILER,
          __GXX_ABI_VERSION,
          _GLIBCXX_RELEASE,
          _GLIBCXX_USE_CXX11_ABI,
#ifdef _GLIBCXX_DEBUG
          1,
#else
          0,
#endif
          sizeof(void*),
          sizeof(std::string),
          sizeof(std::vector<double>)};
#undef SCREE_COMPILER
}

}  // namespace scree
