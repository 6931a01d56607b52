// What a fuzz target consists of: see scree_add_fuzz() in cmake/ScreeFuzz.cmake.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

/// Gives `size` bytes to what is tested. Returns 0; whatever goes wrong ends the program.
// NOLINTNEXTLINE(readability-identifier-naming): what libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace scree::fuzz {

/// Writes good inputs into `folder`, one a file: where a search begins.
void write_seeds(const std::filesystem::path& folder);

/// Path of a file with these bytes, for what reads files; there is one for each suffix and process. In memory, where the
/// system has /dev/shm.
inline const std::filesystem::path& file_of(const std::uint8_t* data, std::size_t size, const std::string& suffix) {
  struct Scratch {
    explicit Scratch(const std::string& end) {
      const std::filesystem::path memory = "/dev/shm";
      const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
      path = folder / ("scree_fuzz_" + std::to_string(::getpid()) + end);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
    }
    std::filesystem::path path;
  };
  static const Scratch scratch{suffix};
  std::ofstream{scratch.path, std::ios::binary}.write(reinterpret_cast<const char*>(data),
                                                      static_cast<std::streamsize>(size));
  return scratch.path;
}

}  // namespace scree::fuzz
