// Runs a fuzz target without libFuzzer.
//
//     NAME_replay [FILE or FOLDER]...   the seeds, these files, and variants of all of them
//     NAME_replay --seeds FOLDER        only writes the seeds
//
// Variants are drawn from fixed seeds: every run does the same. SCREE_TRIALS sets their number per input.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz/fuzz.hpp"
#include "support/trials.hpp"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const fs::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, std::istreambuf_iterator<char>{}};
}

std::vector<fs::path> files_in(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator{path}) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void run(const Bytes& bytes) { LLVMFuzzerTestOneInput(bytes.data(), bytes.size()); }

/// A few places changed, cut, or repeated.
Bytes variant(Bytes bytes, std::mt19937_64& random) {
  if (bytes.empty()) return bytes;
  if (random() % 8 == 0) bytes.resize(random() % bytes.size());
  for (std::size_t count = 1 + random() % 6; count > 0 && !bytes.empty(); --count) {
    const std::size_t at = random() % bytes.size(), length = std::min<std::size_t>(bytes.size() - at, random() % 9);
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random() % 5) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << (random() % 8)));
        break;
      case 2:
        std::fill_n(place, length, random() % 2 == 0 ? 0 : 255);
        break;
      case 3:
        bytes.erase(place, place + static_cast<std::ptrdiff_t>(length));
        break;
      default: {
        const Bytes part{place, place + static_cast<std::ptrdiff_t>(length)};
        bytes.insert(place, part.begin(), part.end());
      }
    }
  }
  return bytes;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3 && std::strcmp(arguments[1], "--seeds") == 0) {
    fs::create_directories(arguments[2]);
    scree::fuzz::write_seeds(arguments[2]);
    return 0;
  }
  const fs::path folder = fs::temp_directory_path() / ("scree_seeds_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  scree::fuzz::write_seeds(folder);
  std::vector<fs::path> files = files_in(folder);
  for (int k = 1; k < count; ++k) {
    const std::vector<fs::path> more = files_in(arguments[k]);
    files.insert(files.end(), more.begin(), more.end());
  }
  const int variants = scree::test::trials(200);
  for (const fs::path& file : files) {
    const Bytes bytes = bytes_of(file);
    std::printf("%s, %zu bytes\n", file.filename().c_str(), bytes.size());
    std::fflush(stdout);  // the last line names what broke the program
    run(bytes);
    std::mt19937_64 random{bytes.size()};
    for (int k = 0; k < variants; ++k) run(variant(bytes, random));
  }
  fs::remove_all(folder);
  return files.empty() ? 1 : 0;
}
