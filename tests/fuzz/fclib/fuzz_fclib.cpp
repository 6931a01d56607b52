// Files of FCLIB, byte by byte: read or refused, and what is read becomes a problem or is refused.
#include "fuzz/fuzz.hpp"
#include "scree/ccp/fclib/fclib_ccp.hpp"
#include "scree/ccp/fclib/testing_fclib.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path& file = scree::fuzz::file_of(data, size, ".hdf5");
  try {
    (void)scree::problem_kind(file);
    const scree::FclibCcp reduced{scree::read_fclib_file(file), "file"};
  } catch (const scree::Error& error) {
    if (error.kind() != scree::ErrorKind::io) throw;
  }
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  constexpr std::array kStorage{FclibStorage::triplets, FclibStorage::columns, FclibStorage::rows};
  for (const FclibStorage storage : kStorage) {
    const std::string name = std::to_string(static_cast<int>(storage)) + ".hdf5";
    FclibProblem problem = test::small_local(storage);
    problem.guesses = {{.v = {}, .u = {}, .r = std::vector<double>(6, 0.5), .lambda = {0.25}}};
    write_fclib_file(folder / ("local" + name), problem);
    problem = test::small_global(storage);
    const std::vector<double> six(6, 1.0);
    problem.solution = {.v = six, .u = six, .r = six, .lambda = {1.0}};
    write_fclib_file(folder / ("global" + name), problem);
  }
}
