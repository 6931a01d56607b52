#include "scree/results/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

namespace {

constexpr std::size_t kBufferSize = 1 << 16;  // [byte]

std::string_view advice(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "; free some space or choose another folder";
    case EFBIG:
      return "; raise the file size limit (ulimit -f) or choose a coarser output interval";
    case EACCES:
    case EROFS:
      return "; choose a folder that you may write to";
    case ENOENT:
      return "; make its folder first, or choose another one";
    default:
      return "";
  }
}

}  // namespace

std::string system_failure(std::string_view what, const std::filesystem::path& file, int error_number) {
  return "cannot " + std::string{what} + " " + file.string() + ": " +
         std::error_code{error_number, std::generic_category()}.message() + std::string{advice(error_number)} + ".";
}

OutputFile::OutputFile(std::filesystem::path file) : path_{std::move(file)} {
  list_result(path_);
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("create");
  buffer_.reserve(kBufferSize);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_{std::move(other.path_)},
      descriptor_{std::exchange(other.descriptor_, -1)},
      buffer_{std::move(other.buffer_)} {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  try {
    flush();
  } catch (const Error&) {
    // A destructor cannot report; whoever needs to know calls close().
  }
  ::close(descriptor_);
}

void OutputFile::fail(const char* what) const { throw Error{ErrorKind::io, system_failure(what, path_, errno)}; }

void OutputFile::write_through(const char* data, std::size_t size) {
  while (size > 0) {
    const ::ssize_t written = ::write(descriptor_, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("write");
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void OutputFile::write(std::string_view text) {
  if (buffer_.size() + text.size() > kBufferSize) flush();
  if (text.size() > kBufferSize) {
    write_through(text.data(), text.size());
  } else {
    buffer_.append(text);
  }
}

void OutputFile::write(std::span<const std::byte> bytes) {
  write(std::string_view{reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void OutputFile::flush() {
  const std::string pending = std::exchange(buffer_, {});
  write_through(pending.data(), pending.size());
}

void OutputFile::close(bool to_disk) {
  if (descriptor_ < 0) return;
  flush();
  // EINVAL: the file is a pipe or a device, which has no disk.
  if (to_disk && ::fsync(descriptor_) != 0 && errno != EINVAL) fail("write");
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("close");
}

void replace_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::filesystem::path temporary = file;
  temporary += kPartOfFile;
  try {
    OutputFile out{temporary};
    out.write(bytes);
    out.close(true);
    std::error_code failure;
    std::filesystem::rename(temporary, file, failure);
    if (failure) throw Error{ErrorKind::io, system_failure("write", file, failure.value())};
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void check_replaceable(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw Error{ErrorKind::io, system_failure("write", file, EISDIR)};
  std::filesystem::path temporary = file;
  temporary += kPartOfFile;
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throw Error{ErrorKind::io, system_failure("create", file, errno)};
  ::close(descriptor);
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
}

void replace_file(const std::filesystem::path& file, std::string_view text) {
  replace_file(file, std::as_bytes(std::span{text}));
}

}  // namespace scree
