// Checkpoints as HDF5 files: groups and plain one-dimensional datasets that any HDF5 tool can read.
//
// A file carries the attributes format_version, content, scene_hash and scree_version, and a check sum on every dataset.
// Other files of scree, such as recorded contact problems, have the same form with another content. It is composed in memory and appears on disk whole or not at all: a full disk never costs the last good checkpoint.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "scree/state/state_io.hpp"

namespace scree {

/// What a file holds, and how such files are called, for messages.
struct StateContent {
  std::string noun = "checkpoint";
  std::string example = "checkpoint.h5";
};

/// What a checkpoint says about itself.
struct CheckpointHeader {
  std::string scene_hash;     ///< of the resolved scene
  std::string scree_version;  ///< that wrote it
};

/// Composes a checkpoint and puts it on disk.
class CheckpointWriter {
 public:
  /// Touches no file yet.
  explicit CheckpointWriter(const CheckpointHeader& header, const StateContent& content = {});
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// The top group. Writers of sub-groups must not outlive this object.
  [[nodiscard]] StateWriter& root();
  /// Writes the file, replacing an older one at the very end. @throws Error (io) with the file and the reason; the
  /// older file is then still there.
  void save_as(const std::filesystem::path& file);

 private:
  struct Image;
  std::unique_ptr<Image> image_;
};

/// Reads a checkpoint.
class CheckpointReader {
 public:
  /// @throws Error (io) when `file` is missing, is no HDF5 file, is cut short, is no file of scree, holds something else
  /// than `content`, or has a newer format.
  explicit CheckpointReader(const std::filesystem::path& file, const StateContent& content = {});
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  [[nodiscard]] const CheckpointHeader& header() const;
  /// The top group. Readers of sub-groups must not outlive this object.
  [[nodiscard]] const StateReader& root() const;

 private:
  struct Source;
  std::unique_ptr<Source> source_;
};

}  // namespace scree
