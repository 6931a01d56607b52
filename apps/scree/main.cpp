// scree: the command line.
#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "command_line.hpp"
#include "scree/base/error.hpp"
#include "scree/base/release.hpp"
#include "scree/geometry/decomposition_cache.hpp"

namespace {

/// A defect of scree or of a plugin, not of the input.
constexpr int kDefect = 1;

int report(const std::string& sentence, int exit_code) {
  std::fflush(stdout);
  std::fprintf(stderr, "scree: error: %s\n", sentence.c_str());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A full disk and a closed pipe become errors of the write, with a sentence, instead of the program's end.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  scree::map_large_blocks();
  scree::DecompositionCache::of_program().keep_in(scree::user_cache_folder());
  try {
    const int exit_code = scree::run_command_line(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw scree::Error{scree::ErrorKind::io, "standard output could not be written"};
    }
    return exit_code;
  } catch (const scree::Error& error) {
    return report(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return report("there is not enough memory for this scene", static_cast<int>(scree::ErrorKind::io));
  } catch (const std::exception& error) {
    return report(std::string{error.what()} + " (a defect of scree or of a plugin, please report it)", kDefect);
  } catch (...) {
    return report("something that is no std::exception was thrown (a defect of a plugin)", kDefect);
  }
}
