#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/detail/fclib_group.hpp"

namespace scree {

namespace {

constexpr std::size_t kLongestNumber = 16;  // [byte]

std::string kind_of(H5T_class_t type) {
  switch (type) {
    case H5T_INTEGER:
      return "whole numbers";
    case H5T_FLOAT:
      return "numbers";
    case H5T_STRING:
      return "text";
    default:
      return "something else";
  }
}

}  // namespace

void FclibPlace::fail(const std::string& sentence) const {
  throw Error{ErrorKind::io, file + ": " + (path.empty() ? std::string{} : path + " ") + sentence};
}

void FclibPlace::require(bool good, const std::string& sentence) const {
  if (!good) fail(sentence);
}

bool FclibGroupReader::has(const std::string& name) const {
  return H5Lexists(group_.get(), name.c_str(), H5P_DEFAULT) > 0;
}

FclibGroupReader FclibGroupReader::group(const std::string& name) const {
  const FclibPlace at = place_.inside(name);
  at.require(has(name), "is missing; an FCLIB problem needs it");
  Handle child{H5Gopen2(group_.get(), name.c_str(), H5P_DEFAULT), H5Gclose};
  at.require(child.valid(), "cannot be opened as a group; the file is damaged");
  return {std::move(child), at};
}

std::vector<std::string> FclibGroupReader::names() const {
  std::vector<std::string> found;
  H5G_info_t info{};
  place_.require(H5Gget_info(group_.get(), &info) >= 0, "cannot be listed; the file is damaged");
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char name[256] = {};
    const ssize_t size =
        H5Lget_name_by_idx(group_.get(), ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
    place_.require(size >= 0, "cannot be listed; the file is damaged");
    found.emplace_back(name);
  }
  return found;
}

Handle FclibGroupReader::open(const std::string& name) const {
  const FclibPlace at = place_.inside(name);
  at.require(has(name), "is missing; an FCLIB problem needs it");
  Handle dataset{H5Dopen2(group_.get(), name.c_str(), H5P_DEFAULT), H5Dclose};
  at.require(dataset.valid(), "cannot be opened as a dataset; the file is damaged");
  return dataset;
}

template <class Value>
std::vector<Value> FclibGroupReader::read(const std::string& name, bool integer, hid_t memory_type) const {
  const FclibPlace at = place_.inside(name);
  const Handle dataset = open(name);
  const Handle type{H5Dget_type(dataset.get()), H5Tclose};
  const H5T_class_t kind = H5Tget_class(type.get());
  at.require(kind == H5T_INTEGER || (kind == H5T_FLOAT && !integer),
             fmt::format("holds {}; {} are needed", kind_of(kind), kind_of(integer ? H5T_INTEGER : H5T_FLOAT)));
  // HDF5 makes a buffer for numbers of as many bytes as a damaged file says.
  at.require(H5Tget_size(type.get()) <= kLongestNumber, "holds numbers of no known length; the file is damaged");
  const Handle space{H5Dget_space(dataset.get()), H5Sclose};
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  // A damaged file must not ask for memory that it cannot fill: compression saves at most a factor of about 1032.
  hsize_t file_size = 0;
  const Handle file{H5Iget_file_id(group_.get()), H5Fclose};
  at.require(count >= 0 && H5Fget_filesize(file.get(), &file_size) >= 0 &&
                 static_cast<hsize_t>(count) <= file_size * (1032 / sizeof(Value)),
             "cannot be read; the file is damaged");
  std::vector<Value> values(static_cast<std::size_t>(count));
  at.require(values.empty() || H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
             "cannot be read; the file is damaged or cut short");
  return values;
}

std::vector<double> FclibGroupReader::doubles(const std::string& name) const {
  std::vector<double> values = read<double>(name, false, H5T_NATIVE_DOUBLE);
  const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (bad != values.end())
    place_.inside(name).fail(fmt::format("has {} at entry {}; finite numbers are needed", *bad, bad - values.begin()));
  return values;
}

std::vector<double> FclibGroupReader::doubles(const std::string& name, std::size_t count,
                                              const std::string& what) const {
  std::vector<double> values = doubles(name);
  place_.inside(name).require(values.size() == count,
                              fmt::format("has {} numbers; {} are needed, one a {}", values.size(), count, what));
  return values;
}

std::vector<std::int64_t> FclibGroupReader::integers(const std::string& name) const {
  return read<std::int64_t>(name, true, H5T_NATIVE_INT64);
}

std::int64_t FclibGroupReader::integer(const std::string& name) const {
  const std::vector<std::int64_t> values = integers(name);
  place_.inside(name).require(values.size() == 1, fmt::format("has {} numbers; one is needed", values.size()));
  return values.front();
}

std::int64_t FclibGroupReader::integer(const std::string& name, std::int64_t least) const {
  const std::int64_t value = integer(name);
  constexpr std::int64_t kGreatest = std::numeric_limits<std::int32_t>::max();
  place_.inside(name).require(value >= least && value <= kGreatest,
                              fmt::format("is {}; a whole number from {} to {} is needed", value, least, kGreatest));
  return value;
}

std::string FclibGroupReader::text(const std::string& name) const {
  if (!has(name)) return {};
  const FclibPlace at = place_.inside(name);
  const Handle dataset = open(name);
  const Handle type{H5Dget_type(dataset.get()), H5Tclose};
  const Handle space{H5Dget_space(dataset.get()), H5Sclose};
  at.require(H5Tget_class(type.get()) == H5T_STRING && H5Sget_simple_extent_npoints(space.get()) == 1,
             "is not one text");
  if (H5Tis_variable_str(type.get()) > 0) {
    char* text = nullptr;
    at.require(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(&text)) >= 0,
               "cannot be read; the file is damaged");
    const std::string value = text != nullptr ? text : "";
    H5free_memory(text);
    return value;
  }
  constexpr std::size_t kLongest = 1 << 20;
  const std::size_t size = H5Tget_size(type.get());
  at.require(size <= kLongest, "is longer than any text of a problem; the file is damaged");
  std::string value(size, '\0');
  at.require(H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) >= 0,
             "cannot be read; the file is damaged");
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

FclibGroupWriter FclibGroupWriter::group(const std::string& name) const {
  Handle child{H5Gcreate2(group_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
  place_.inside(name).require(child.valid(), "cannot be made");
  return {std::move(child), place_.inside(name)};
}

void FclibGroupWriter::write(const std::string& name, hid_t file_type, hid_t memory_type, std::size_t count,
                             const void* data) const {
  const hsize_t size = count;
  const Handle space{H5Screate_simple(1, &size, nullptr), H5Sclose};
  const Handle dataset{
      H5Dcreate2(group_.get(), name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose};
  place_.inside(name).require(
      dataset.valid() && (count == 0 || H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0),
      "cannot be written");
}

void FclibGroupWriter::write(const std::string& name, std::span<const double> values) const {
  write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void FclibGroupWriter::write(const std::string& name, std::span<const int> values) const {
  write(name, H5T_STD_I32LE, H5T_NATIVE_INT, values.size(), values.data());
}

void FclibGroupWriter::write(const std::string& name, const std::string& text) const {
  const Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  const Handle space{H5Screate(H5S_SCALAR), H5Sclose};
  H5Tset_size(type.get(), text.size() + 1);  // with the zero at its end, as readers in C expect
  const Handle dataset{
      H5Dcreate2(group_.get(), name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose};
  place_.inside(name).require(
      dataset.valid() && H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0,
      "cannot be written");
}

}  // namespace scree
