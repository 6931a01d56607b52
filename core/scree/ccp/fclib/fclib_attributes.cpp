// Attributes of a group: what a program noted beside its problem.
#include <algorithm>
#include <limits>

#include "scree/ccp/fclib/detail/fclib_group.hpp"

namespace scree {

namespace {

/// A note, not a table.
constexpr hssize_t kMostNumbers = 1 << 16;
constexpr std::size_t kLongestText = 1 << 16, kLongestNumber = 16;  // [byte]

template <class Value>
bool read_numbers(hid_t attribute, hid_t memory_type, hssize_t count, FclibAttribute& out) {
  std::vector<Value> values(static_cast<std::size_t>(count));
  if (!values.empty() && H5Aread(attribute, memory_type, values.data()) < 0) return false;
  out.value = std::move(values);
  return true;
}

bool read_text(hid_t attribute, hid_t type, FclibAttribute& out) {
  if (H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute, type, static_cast<void*>(&text)) < 0) return false;
    out.value = std::string{text != nullptr ? text : ""};
    H5free_memory(text);
    return true;
  }
  std::string value(std::min(H5Tget_size(type), kLongestText + 1), '\0');
  if (value.size() > kLongestText || H5Aread(attribute, type, value.data()) < 0) return false;
  value.resize(std::min(value.find('\0'), value.size()));
  out.value = std::move(value);
  return true;
}

/// False for what is neither numbers nor one text.
bool read_value(hid_t attribute, FclibAttribute& out) {
  const Handle type{H5Aget_type(attribute), H5Tclose};
  const Handle space{H5Aget_space(attribute), H5Sclose};
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0 || count > kMostNumbers) return false;
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_STRING && H5Tget_size(type.get()) > kLongestNumber) return false;
  switch (kind) {
    case H5T_INTEGER:
      return read_numbers<std::int64_t>(attribute, H5T_NATIVE_INT64, count, out);
    case H5T_FLOAT:
      return read_numbers<double>(attribute, H5T_NATIVE_DOUBLE, count, out);
    case H5T_STRING:
      return count == 1 && read_text(attribute, type.get(), out);
    default:
      return false;
  }
}

}  // namespace

std::vector<FclibAttribute> FclibGroupReader::attributes() const {
  std::vector<FclibAttribute> found;
  const int count = H5Aget_num_attrs(group_.get());
  for (int k = 0; k < count; ++k) {
    const Handle attribute{H5Aopen_by_idx(group_.get(), ".", H5_INDEX_NAME, H5_ITER_INC, static_cast<hsize_t>(k),
                                          H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose};
    char name[256] = {};
    if (!attribute.valid() || H5Aget_name(attribute.get(), sizeof name, name) < 0) continue;
    FclibAttribute one{name, {}};
    if (read_value(attribute.get(), one)) found.push_back(std::move(one));
  }
  return found;
}

void FclibGroupWriter::write(const FclibAttribute& attribute) const {
  const auto put = [&](hid_t file_type, hid_t memory_type, const Handle& space, std::size_t count, const void* data) {
    const Handle made{
        H5Acreate2(group_.get(), attribute.name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
    place_.inside(attribute.name)
        .require(made.valid() && (count == 0 || H5Awrite(made.get(), memory_type, data) >= 0), "cannot be written");
  };
  if (const auto* text = std::get_if<std::string>(&attribute.value)) {
    const Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
    H5Tset_size(type.get(), text->size() + 1);
    return put(type.get(), type.get(), {H5Screate(H5S_SCALAR), H5Sclose}, 1, text->c_str());
  }
  const auto space = [](hsize_t count) { return Handle{H5Screate_simple(1, &count, nullptr), H5Sclose}; };
  if (const auto* numbers = std::get_if<std::vector<double>>(&attribute.value)) {
    return put(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space(numbers->size()), numbers->size(), numbers->data());
  }
  // FCLIB's own functions read whole numbers of 32 bits.
  const auto& numbers = std::get<std::vector<std::int64_t>>(attribute.value);
  const bool narrow = std::all_of(numbers.begin(), numbers.end(), [](std::int64_t x) {
    return x >= std::numeric_limits<std::int32_t>::min() && x <= std::numeric_limits<std::int32_t>::max();
  });
  put(narrow ? H5T_STD_I32LE : H5T_STD_I64LE, H5T_NATIVE_INT64, space(numbers.size()), numbers.size(), numbers.data());
}

}  // namespace scree
