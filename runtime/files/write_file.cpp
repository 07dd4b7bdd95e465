// SPDX-License-Identifier: MIT
#include "runtime/files/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace kaamos::files {
namespace {

constexpr mode_t kPermissions = 07777;
constexpr int kMostLinks = 40;  // as the kernel follows

// The place where a file goes: the target of all links of its path.
struct Target {
  std::string path;
  bool in_place = false;  // no regular file, or one that somebody has open under this name
  bool exists = false;
  struct stat info = {};
};

// A link's text counts from the link's folder.
std::string follow(const std::string& link, const std::string& text) {
  const size_t folder = link.rfind('/');
  if (text.starts_with('/') || folder == std::string::npos) return text;
  return link.substr(0, folder + 1) + text;
}

int find_target(const std::string& path, Target& out) {
  out.path = path;
  struct stat link = {};
  for (int links = 0; lstat(out.path.c_str(), &link) == 0 && S_ISLNK(link.st_mode); ++links) {
    // The links of /proc name open files, some of which have no path.
    if (out.path.starts_with("/proc/") || links == kMostLinks) break;
    char text[4096];
    const ssize_t length = readlink(out.path.c_str(), text, sizeof text);
    if (length < 0) return errno;
    out.path = follow(out.path, std::string(text, static_cast<size_t>(length)));
  }
  out.exists = stat(out.path.c_str(), &out.info) == 0;
  if (!out.exists) return errno == ENOENT ? 0 : errno;
  if (S_ISDIR(out.info.st_mode)) return EISDIR;
  out.in_place = !S_ISREG(out.info.st_mode) || out.path.starts_with("/proc/");
  // A folder that may be written to would let anyone replace a file that may not.
  return access(out.path.c_str(), W_OK) == 0 ? 0 : errno;
}

// Writes everything, to the disk where there is one, and closes. Returns 0 or errno.
int write_and_close(int file, std::string_view bytes) {
  int error = 0;
  while (error == 0 && !bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), std::min<size_t>(bytes.size(), 1 << 24));
    if (written >= 0) bytes.remove_prefix(static_cast<size_t>(written));
    if (written < 0 && errno != EINTR) error = errno;
  }
  // A network's file system may tell of a full disk only here. Pipes and devices cannot do this.
  if (error == 0 && fsync(file) != 0 && errno != EINVAL && errno != EROFS) error = errno;
  if (close(file) != 0 && error == 0) error = errno;
  return error;
}

int write_in_place(const std::string& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  return file < 0 ? errno : write_and_close(file, bytes);
}

// The errors of a folder that takes no new files, or of a file that cannot be renamed over.
bool is_of_folder(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == EBUSY || error == EXDEV;
}

// Gives a new file the permissions and, where that is allowed, the owner of the one that it
// replaces.
int take_permissions(int file, const Target& target) {
  if (!target.exists) return 0;
  if (fchown(file, target.info.st_uid, target.info.st_gid) != 0 && errno != EPERM) return errno;
  return fchmod(file, target.info.st_mode & kPermissions) == 0 ? 0 : errno;
}

// A name that nobody else uses, beside the target, so that renaming stays on one disk. Returns the
// open file, or minus errno.
int open_beside(const Target& target, std::string& name) {
  static std::atomic<unsigned> counter{0};
  const std::string folder = target.path.substr(0, target.path.rfind('/') + 1);
  for (;;) {
    name = folder + ".kaamos-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
    const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) return file;
    if (errno != EEXIST) return -errno;
  }
}

int replace(const Target& target, std::string_view bytes) {
  std::string fresh;
  const int file = open_beside(target, fresh);
  if (file < 0) return -file;
  int error = take_permissions(file, target);
  const int failed = write_and_close(file, bytes);
  if (error == 0) error = failed;
  if (error == 0 && std::rename(fresh.c_str(), target.path.c_str()) != 0) error = errno;
  if (error != 0) unlink(fresh.c_str());
  return error;
}

int write_target(const Target& target, std::string_view bytes) {
  if (target.in_place) return write_in_place(target.path, bytes);
  const int error = replace(target, bytes);
  return target.exists && is_of_folder(error) ? write_in_place(target.path, bytes) : error;
}

}  // namespace

int write_file(const std::string& path, std::string_view bytes) {
  Target target;
  const int error = find_target(path, target);
  return error != 0 ? error : write_target(target, bytes);
}

int place_file(const std::string& from, const std::string& path) {
  Target target;
  if (const int error = find_target(path, target)) return error;
  if (!target.in_place &&
      (!target.exists || chmod(from.c_str(), target.info.st_mode & kPermissions) == 0) &&
      std::rename(from.c_str(), target.path.c_str()) == 0) {
    return 0;
  }
  if (!target.in_place && !is_of_folder(errno)) return errno;
  errno = EIO;
  std::ifstream in(from, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in.is_open() || in.bad()) return errno;
  if (const int error = write_target(target, bytes)) return error;
  unlink(from.c_str());
  return 0;
}

}  // namespace kaamos::files
