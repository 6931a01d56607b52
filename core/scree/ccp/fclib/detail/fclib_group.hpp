// Groups of an FCLIB file: datasets with their place in every message. For the sources of this folder; not installed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scree/ccp/fclib/fclib_problem.hpp"
#include "scree/state/detail/hdf5_handle.hpp"

namespace scree {

/// Where something stands, for messages: "FILE: /fclib_local/W/p".
struct FclibPlace {
  std::string file;
  std::string path;  ///< "" at the top

  [[nodiscard]] FclibPlace inside(const std::string& name) const { return {file, path + "/" + name}; }
  /// @throws Error (io) "FILE: PATH SENTENCE" unless `good`.
  void require(bool good, const std::string& sentence) const;
  /// @throws Error (io).
  [[noreturn]] void fail(const std::string& sentence) const;
};

/// Reads a group.
class FclibGroupReader {
 public:
  FclibGroupReader(Handle group, FclibPlace place) : group_{std::move(group)}, place_{std::move(place)} {}

  [[nodiscard]] const FclibPlace& place() const { return place_; }
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] FclibGroupReader group(const std::string& name) const;
  /// Names of everything in it, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;
  /// All numbers of a dataset, finite.
  [[nodiscard]] std::vector<double> doubles(const std::string& name) const;
  /// The same, of which there have to be `count`: one for every `what`.
  [[nodiscard]] std::vector<double> doubles(const std::string& name, std::size_t count, const std::string& what) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& name) const;
  /// An integer from `least` on, at most 2^31 - 1.
  [[nodiscard]] std::int64_t integer(const std::string& name, std::int64_t least) const;
  /// "" when there is no such text.
  [[nodiscard]] std::string text(const std::string& name) const;
  /// The attributes of the group, by name; those that are neither numbers nor one text are left out.
  [[nodiscard]] std::vector<FclibAttribute> attributes() const;

 private:
  [[nodiscard]] Handle open(const std::string& name) const;
  template <class Value>
  [[nodiscard]] std::vector<Value> read(const std::string& name, bool integer, hid_t memory_type) const;

  Handle group_;
  FclibPlace place_;
};

/// Writes a group.
class FclibGroupWriter {
 public:
  FclibGroupWriter(Handle group, FclibPlace place) : group_{std::move(group)}, place_{std::move(place)} {}

  [[nodiscard]] const FclibPlace& place() const { return place_; }
  [[nodiscard]] FclibGroupWriter group(const std::string& name) const;
  void write(const std::string& name, std::span<const double> values) const;
  void write(const std::string& name, std::span<const int> values) const;
  void write(const std::string& name, int value) const { write(name, std::span{&value, 1}); }
  void write(const std::string& name, double value) const { write(name, std::span{&value, 1}); }
  void write(const std::string& name, const std::string& text) const;
  /// Attaches an attribute to the group.
  void write(const FclibAttribute& attribute) const;

 private:
  void write(const std::string& name, hid_t file_type, hid_t memory_type, std::size_t count, const void* data) const;

  Handle group_;
  FclibPlace place_;
};

}  // namespace scree
