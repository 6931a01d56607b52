// OutputFile: a file of results in which no failed write goes unnoticed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace scree {

/// A file opened for writing, buffered. Every failure is an Error (io) that names the file and the system's reason.
///
/// In a folder of results a new file is listed as one of the run's (scree/results/result_folder.hpp).
/// The program has to ignore SIGXFSZ for a file size limit to arrive here as an error.
class OutputFile {
 public:
  /// Creates or empties `file`. @throws Error (io).
  explicit OutputFile(std::filesystem::path file);
  /// Closes without checks: what was not written by close() or flush() may be lost.
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  /// @throws Error (io).
  void write(std::string_view text);
  void write(std::span<const std::byte> bytes);
  /// Hands everything to the system. @throws Error (io).
  void flush();
  /// Writes what is left and closes; with `to_disk` it waits until the disk has it. @throws Error (io).
  void close(bool to_disk = false);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void fail(const char* what) const;
  void write_through(const char* data, std::size_t size);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string buffer_;
};

/// Writes `bytes` to `file` as a whole or not at all: to a temporary name beside it, which is then renamed. An older
/// `file` stays untouched when that fails. @throws Error (io).
void replace_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
void replace_file(const std::filesystem::path& file, std::string_view text);

/// Finds out before long work whether replace_file() could create `file`: there is a folder, it may be written to, and no folder
/// has that name. Leaves nothing behind. @throws Error (io).
void check_replaceable(const std::filesystem::path& file);

/// What replace_file() puts behind the name while it writes.
inline constexpr const char* kPartOfFile = ".part";

/// A sentence for a failed system call: "cannot write FILE: No space left on device".
[[nodiscard]] std::string system_failure(std::string_view what, const std::filesystem::path& file, int error_number);

}  // namespace scree
