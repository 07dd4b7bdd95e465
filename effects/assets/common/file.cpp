// SPDX-License-Identifier: MIT
#include "effects/assets/common/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "runtime/files/write_file.h"

namespace kaamos::effects {
namespace {

Error file_error(const char* doing, const std::string& path, int error) {
  const char* advice = "";
  if (error == ENOSPC || error == EDQUOT) advice = ": free some space or write to another disk";
  if (error == EACCES || error == EROFS) advice = ": choose a folder that you may write to";
  if (error == ENOENT) advice = ": check the spelling of the path and that its folder exists";
  return make_error(ErrorId::kFile, std::string("cannot ") + doing + " \"" + path +
                                        "\": " + std::strerror(error) + advice);
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

Result<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t max_bytes) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return file_error("open", path, errno);
  struct stat info = {};
  if (::fstat(file.get(), &info) != 0) return file_error("read", path, errno);
  if (S_ISDIR(info.st_mode)) return file_error("read", path, EISDIR);
  // Devices such as /dev/zero never end.
  if (!S_ISREG(info.st_mode))
    return make_error(ErrorId::kFile, "cannot read \"" + path + "\": it is not a regular file");
  std::vector<std::uint8_t> bytes;
  bytes.reserve(std::min(static_cast<std::size_t>(info.st_size), max_bytes));
  std::vector<std::uint8_t> block(1 << 20);
  for (;;) {
    const ssize_t got = ::read(file.get(), block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return file_error("read", path, errno);
    if (got == 0) return bytes;
    bytes.insert(bytes.end(), block.begin(), block.begin() + got);
    if (bytes.size() > max_bytes)
      return make_error(ErrorId::kFile, "cannot read \"" + path +
                                            "\": it is larger than the limit of " +
                                            std::to_string(max_bytes) + " bytes");
  }
}

Status write_file(const std::string& path, std::span<const std::uint8_t> bytes) {
  const int error =
      files::write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (error == 0) return {};
  return file_error("write", path, error);
}

Status write_text(const std::string& path, const std::string& text) {
  return write_file(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Status place_file(const std::string& from, const std::string& path) {
  const int error = files::place_file(from, path);
  if (error == 0) return {};
  return file_error("write", path, error);
}

}  // namespace kaamos::effects
