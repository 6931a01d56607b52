// BuildFingerprint: what must agree between the host and a plugin for C++ objects to pass between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scree/interfaces/boundary_layout.hpp"

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
  std::uint64_t layout;          ///< boundary_layout()
};

/// The fingerprint of the code being compiled.
constexpr BuildFingerprint build_fingerprint() {
#define SCREE_TEXT_OF(number) #number
#define SCREE_TEXT(number) SCREE_TEXT_OF(number)
#if defined(__clang__)
#define SCREE_COMPILER "clang " SCREE_TEXT(__clang_major__)
#else
#define SCREE_COMPILER "gcc " SCREE_TEXT(__GNUC__)
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
          sizeof(std::vector<double>),
          boundary_layout()};
#undef SCREE_COMPILER
#undef SCREE_TEXT
#undef SCREE_TEXT_OF
}

}  // namespace scree
