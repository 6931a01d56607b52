#include "scree/state/state_io.hpp"

#include <cstddef>

#include "scree/base/error.hpp"

namespace scree {
namespace {

/// Vec3 and Quat are plain aggregates of doubles, so a span of them is a span of doubles.
template <class T>
std::span<const double> as_doubles(std::span<const T> values) {
  static_assert(sizeof(T) % sizeof(double) == 0 && alignof(T) == alignof(double));
  return {reinterpret_cast<const double*>(values.data()), values.size() * (sizeof(T) / sizeof(double))};
}

template <class T>
T only_value(const std::vector<T>& values, std::string_view name) {
  if (values.size() == 1) return values.front();
  throw Error{ErrorKind::io, "the checkpoint holds " + std::to_string(values.size()) + " values of '" +
                                 std::string{name} + "' where one belongs; it is damaged or of another scree"};
}

}  // namespace

StateWriter::~StateWriter() = default;
StateReader::~StateReader() = default;

void StateWriter::write(std::string_view name, std::span<const Vec3> values) { write(name, as_doubles(values)); }
void StateWriter::write(std::string_view name, std::span<const Quat> values) { write(name, as_doubles(values)); }
void StateWriter::write(std::string_view name, double value) { write(name, std::span<const double>{&value, 1}); }
void StateWriter::write(std::string_view name, std::uint64_t value) {
  write(name, std::span<const std::uint64_t>{&value, 1});
}

std::vector<Vec3> StateReader::vectors(std::string_view name) const {
  const std::vector<double> flat = doubles(name);
  std::vector<Vec3> values(flat.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return values;
}

std::vector<Quat> StateReader::quaternions(std::string_view name) const {
  const std::vector<double> flat = doubles(name);
  std::vector<Quat> values(flat.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = {flat[4 * i], flat[4 * i + 1], flat[4 * i + 2], flat[4 * i + 3]};
  }
  return values;
}

double StateReader::number(std::string_view name) const { return only_value(doubles(name), name); }
std::uint64_t StateReader::integer(std::string_view name) const { return only_value(integers(name), name); }

}  // namespace scree
