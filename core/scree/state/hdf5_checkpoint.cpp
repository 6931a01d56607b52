#include "scree/state/hdf5_checkpoint.hpp"

#include <hdf5.h>

#include <algorithm>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/results/output_file.hpp"
#include "scree/state/detail/hdf5_handle.hpp"

namespace scree {

namespace {

constexpr std::uint64_t kFormatVersion = 1;
constexpr hsize_t kChunk = 1 << 16;                // numbers in one check-summed piece of a dataset
constexpr std::size_t kMemoryIncrement = 1 << 20;  // [byte] by which the image of a file grows

void check(bool good, const std::string& sentence) {
  if (!good) throw Error{ErrorKind::io, sentence};
}

void write_scalar(hid_t place, const char* name, hid_t type, const void* value) {
  const Handle space{H5Screate(H5S_SCALAR), H5Sclose};
  const Handle attribute{H5Acreate2(place, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
  check(attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0,
        "cannot write the attribute \"" + std::string{name} + "\" of a checkpoint.");
}

// A text type of fixed size; HDF5 has no empty one, so that an empty text is one zero byte.
Handle text_type(std::size_t size) {
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type.get(), std::max<std::size_t>(size, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

void write_text_attribute(hid_t place, const char* name, const std::string& text) {
  write_scalar(place, name, text_type(text.size()).get(), text.c_str());
}

std::string without_padding(std::string text) {
  const std::size_t end = text.find('\0');
  if (end != std::string::npos) text.resize(end);
  return text;
}

class GroupWriter final : public StateWriter {
 public:
  explicit GroupWriter(Handle group) : group_{std::move(group)} {}
  using StateWriter::write;

  void write(std::string_view name, std::span<const double> values) override {
    write_array(name, values.size(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
  }
  void write(std::string_view name, std::span<const std::uint64_t> values) override {
    write_array(name, values.size(), H5T_STD_U64LE, H5T_NATIVE_UINT64, values.data());
  }
  void write(std::string_view name, std::string_view text) override {
    const Handle type = text_type(text.size());
    const Handle space{H5Screate(H5S_SCALAR), H5Sclose};
    const std::string value{text};
    write_dataset(name, type.get(), type.get(), space, H5P_DEFAULT, value.c_str());
  }
  std::unique_ptr<StateWriter> group(std::string_view name) override {
    Handle child{H5Gcreate2(group_.get(), std::string{name}.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
    check(child.valid(), "cannot make the group \"" + std::string{name} + "\" in a checkpoint; is it made twice?");
    return std::make_unique<GroupWriter>(std::move(child));
  }

 private:
  void write_array(std::string_view name, std::size_t count, hid_t file_type, hid_t memory_type, const void* data) {
    const hsize_t size = count;
    const Handle space{H5Screate_simple(1, &size, nullptr), H5Sclose};
    const Handle layout{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
    if (size > 0) {
      const hsize_t chunk = std::min(size, kChunk);
      H5Pset_chunk(layout.get(), 1, &chunk);
      H5Pset_fletcher32(layout.get());
    }
    write_dataset(name, file_type, memory_type, space, layout.get(), data);
  }
  void write_dataset(std::string_view name, hid_t file_type, hid_t memory_type, const Handle& space, hid_t layout,
                     const void* data) {
    const Handle dataset{
        H5Dcreate2(group_.get(), std::string{name}.c_str(), file_type, space.get(), H5P_DEFAULT, layout, H5P_DEFAULT),
        H5Dclose};
    check(dataset.valid(), "cannot make \"" + std::string{name} + "\" in a checkpoint; is it written twice?");
    const bool empty = H5Sget_simple_extent_npoints(space.get()) == 0;
    check(empty || H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0,
          "cannot write \"" + std::string{name} + "\" into a checkpoint.");
  }
  Handle group_;
};

class GroupReader final : public StateReader {
 public:
  /// `place` names the file in messages: "the checkpoint FILE".
  GroupReader(Handle group, std::string place) : group_{std::move(group)}, place_{std::move(place)} {}

  bool has(std::string_view name) const override {
    return H5Lexists(group_.get(), std::string{name}.c_str(), H5P_DEFAULT) > 0;
  }
  std::vector<double> doubles(std::string_view name) const override {
    return read<double>(name, H5T_FLOAT, H5T_NATIVE_DOUBLE);
  }
  std::vector<std::uint64_t> integers(std::string_view name) const override {
    return read<std::uint64_t>(name, H5T_INTEGER, H5T_NATIVE_UINT64);
  }
  std::string text(std::string_view name) const override {
    const Handle dataset = open(name, H5T_STRING);
    const Handle type{H5Dget_type(dataset.get()), H5Tclose};
    std::string value(H5Tget_size(type.get()), '\0');
    check(H5Tis_variable_str(type.get()) == 0 &&
              H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) >= 0,
          damaged(name));
    return without_padding(std::move(value));
  }
  std::unique_ptr<StateReader> group(std::string_view name) const override {
    Handle child{H5Gopen2(group_.get(), std::string{name}.c_str(), H5P_DEFAULT), H5Gclose};
    check(child.valid(), missing(name));
    return std::make_unique<GroupReader>(std::move(child), place_);
  }

 private:
  [[nodiscard]] std::string missing(std::string_view name) const {
    return place_ + " holds no \"" + std::string{name} + "\"; was it written by another scene?";
  }
  [[nodiscard]] std::string damaged(std::string_view name) const {
    return "\"" + std::string{name} + "\" in " + place_ + " cannot be read; the file is damaged.";
  }
  [[nodiscard]] Handle open(std::string_view name, H5T_class_t expected) const {
    Handle dataset{H5Dopen2(group_.get(), std::string{name}.c_str(), H5P_DEFAULT), H5Dclose};
    check(dataset.valid(), missing(name));
    const Handle type{H5Dget_type(dataset.get()), H5Tclose};
    check(H5Tget_class(type.get()) == expected,
          "\"" + std::string{name} + "\" in " + place_ + " is of another kind than expected.");
    return dataset;
  }
  template <class Value>
  std::vector<Value> read(std::string_view name, H5T_class_t expected, hid_t memory_type) const {
    const Handle dataset = open(name, expected);
    const Handle space{H5Dget_space(dataset.get()), H5Sclose};
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    check(count >= 0, damaged(name));
    // A damaged file must not ask for memory that it cannot fill: compression saves at most a factor of about 1032.
    hsize_t file_size = 0;
    const Handle file{H5Iget_file_id(group_.get()), H5Fclose};
    check(H5Fget_filesize(file.get(), &file_size) >= 0 &&
              static_cast<hsize_t>(count) <= file_size * (1032 / sizeof(Value)),
          damaged(name));
    std::vector<Value> values(static_cast<std::size_t>(count));
    check(values.empty() || H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
          damaged(name));
    return values;
  }
  Handle group_;
  std::string place_;
};

// A file that lives in memory only.
Handle make_image() {
  silence_hdf5();
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_fapl_core(access.get(), kMemoryIncrement, false);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // The newer file format has check sums on everything that is not a dataset.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V110);
  Handle file{H5Fcreate("checkpoint", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
  check(file.valid(), "cannot make a checkpoint in memory.");
  return file;
}

std::string place_of(const std::string& file, const StateContent& content) {
  return "the " + content.noun + " " + file;
}

Handle open_file(const std::string& file, const StateContent& content) {
  silence_hdf5();
  check(std::filesystem::exists(file), "there is no " + content.noun + " " + file + ".");
  check(std::filesystem::is_regular_file(file),
        file + " is not a file; a " + content.noun + " such as " + content.example + " is needed.");
  check(H5Fis_hdf5(file.c_str()) > 0, file + " is not a " + content.noun +
                                          ": it is not an HDF5 file, or cannot be read. Give a " + content.example +
                                          " of scree.");
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  Handle opened{H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  check(opened.valid(), place_of(file, content) + " is damaged or cut short; use an older one.");
  return opened;
}

// An HDF5 file, opened, whose attributes say what it is.
struct OpenFile {
  hid_t id;
  const std::string& name;
  const StateContent& content;

  [[nodiscard]] std::string foreign(const char* attribute) const {
    return name + " is an HDF5 file, but not a " + content.noun + " of scree: it has no attribute \"" +
           std::string{attribute} + "\".";
  }
  // The text attribute `attribute`, or an Error that this is none of scree's files.
  [[nodiscard]] std::string text(const char* attribute) const {
    const Handle place{H5Aopen(id, attribute, H5P_DEFAULT), H5Aclose};
    check(place.valid(), foreign(attribute));
    const Handle type{H5Aget_type(place.get()), H5Tclose};
    check(H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0, foreign(attribute));
    std::string value(H5Tget_size(type.get()), '\0');
    check(H5Aread(place.get(), type.get(), value.data()) >= 0, foreign(attribute));
    return without_padding(std::move(value));
  }
  void check_format() const {
    const Handle place{H5Aopen(id, "format_version", H5P_DEFAULT), H5Aclose};
    std::uint64_t version = 0;
    check(place.valid() && H5Aread(place.get(), H5T_NATIVE_UINT64, &version) >= 0, foreign("format_version"));
    check(version == kFormatVersion, place_of(name, content) + " has format " + std::to_string(version) +
                                         "; this scree reads format " + std::to_string(kFormatVersion) + ".");
    // The first checkpoints did not say what they are.
    const std::string held = H5Aexists(id, "content") > 0 ? text("content") : StateContent{}.noun;
    check(held == content.noun,
          name + " holds a " + held + " of scree; a " + content.noun + " such as " + content.example + " is needed.");
  }
};

Handle top_group(const Handle& file) { return {H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose}; }

}  // namespace

struct CheckpointWriter::Image {
  std::string noun;
  Handle file = make_image();
  GroupWriter root{top_group(file)};
};

CheckpointWriter::CheckpointWriter(const CheckpointHeader& header, const StateContent& content)
    : image_{new Image{content.noun}} {
  const hid_t file = image_->file.get();
  write_scalar(file, "format_version", H5T_NATIVE_UINT64, &kFormatVersion);
  write_text_attribute(file, "content", content.noun);
  write_text_attribute(file, "scene_hash", header.scene_hash);
  write_text_attribute(file, "scree_version", header.scree_version);
}
CheckpointWriter::~CheckpointWriter() = default;

StateWriter& CheckpointWriter::root() { return image_->root; }

void CheckpointWriter::save_as(const std::filesystem::path& file) {
  const hid_t id = image_->file.get();
  void* memory = nullptr;
  // The handle of a file in memory is the address of the pointer to its bytes: they are written without a copy.
  check(H5Fflush(id, H5F_SCOPE_LOCAL) >= 0 && H5Fget_vfd_handle(id, H5P_DEFAULT, &memory) >= 0 && memory != nullptr,
        "cannot compose the " + image_->noun + " " + file.string() + " in memory.");
  // An image without a place to go to is only measured.
  const ssize_t size = H5Fget_file_image(id, nullptr, 0);
  check(size > 0, "cannot measure the " + image_->noun + " " + file.string() + " in memory.");
  replace_file(file, std::span{*static_cast<const std::byte* const*>(memory), static_cast<std::size_t>(size)});
}

struct CheckpointReader::Source {
  Source(const std::string& path, const StateContent& content)
      : file{open_file(path, content)}, root{top_group(file), place_of(path, content)} {
    const OpenFile opened{file.get(), path, content};
    opened.check_format();
    header = {opened.text("scene_hash"), opened.text("scree_version")};
  }
  Handle file;
  GroupReader root;
  CheckpointHeader header;
};

CheckpointReader::CheckpointReader(const std::filesystem::path& file, const StateContent& content)
    : source_{std::make_unique<Source>(file.string(), content)} {}
CheckpointReader::~CheckpointReader() = default;

const CheckpointHeader& CheckpointReader::header() const { return source_->header; }
const StateReader& CheckpointReader::root() const { return source_->root; }

}  // namespace scree
