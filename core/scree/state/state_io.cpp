#include "scree/state/state_io.hpp"

#include "scree/base/error.hpp"

namespace scree {

namespace {

// Vectors and quaternions are stored as their components, one after another.
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quat) == 4 * sizeof(double));

template <class Record>
std::span<const double> components(std::span<const Record> values) {
  return {reinterpret_cast<const double*>(values.data()), values.size() * (sizeof(Record) / sizeof(double))};
}

[[noreturn]] void wrong_count(std::string_view name, std::size_t count, const char* expected) {
  throw Error{ErrorKind::io, "the file holds " + std::to_string(count) + " numbers under \"" + std::string{name} +
                                 "\", but " + expected + " expected."};
}

template <class Value>
Value single(std::string_view name, const std::vector<Value>& values) {
  if (values.size() != 1) wrong_count(name, values.size(), "one is");
  return values.front();
}

}  // namespace

StateWriter::~StateWriter() = default;
StateReader::~StateReader() = default;

void StateWriter::write(std::string_view name, std::span<const Vec3> values) { write(name, components(values)); }
void StateWriter::write(std::string_view name, std::span<const Quat> values) { write(name, components(values)); }
void StateWriter::write(std::string_view name, double value) { write(name, std::span<const double>{&value, 1}); }
void StateWriter::write(std::string_view name, std::uint64_t value) {
  write(name, std::span<const std::uint64_t>{&value, 1});
}

std::vector<Vec3> StateReader::vectors(std::string_view name) const {
  const std::vector<double> flat = doubles(name);
  if (flat.size() % 3 != 0) wrong_count(name, flat.size(), "a multiple of three is");
  std::vector<Vec3> values(flat.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return values;
}

std::vector<Quat> StateReader::quaternions(std::string_view name) const {
  const std::vector<double> flat = doubles(name);
  if (flat.size() % 4 != 0) wrong_count(name, flat.size(), "a multiple of four is");
  std::vector<Quat> values(flat.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = {flat[4 * i], flat[4 * i + 1], flat[4 * i + 2], flat[4 * i + 3]};
  }
  return values;
}

double StateReader::number(std::string_view name) const { return single(name, doubles(name)); }
std::uint64_t StateReader::integer(std::string_view name) const { return single(name, integers(name)); }

}  // namespace scree
