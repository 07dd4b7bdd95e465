// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/shader_cache.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "runtime/hlsl/driver/process.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOnlyOwner = S_IRWXU;
constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;

// lstat() follows a link whose name ends in a slash.
fs::path without_slash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

std::string refused(const fs::path& folder, const std::string& why, const std::string& cure) {
  return "the shader cache " + folder.string() + " is refused: " + why +
         ", so another user may have put code there; " + cure;
}

std::string mode_text(mode_t mode) {
  char text[16];
  std::snprintf(text, sizeof text, "%04o", static_cast<unsigned>(mode & 07777));
  return text;
}

}  // namespace

fs::path cache_folder() {
  if (const std::string folder = environment("KAAMOS_CACHE_DIR"); !folder.empty()) {
    return folder;
  }
  if (const std::string folder = environment("XDG_CACHE_HOME"); !folder.empty()) {
    return fs::path(folder) / "kaamos";
  }
  if (const std::string home = environment("HOME"); !home.empty()) {
    return fs::path(home) / ".cache" / "kaamos";
  }
  return fs::path("/tmp") / ("kaamos-cache-" + std::to_string(geteuid()));
}

std::string open_cache(const fs::path& wanted) {
  const fs::path folder = without_slash(wanted);
  std::error_code ignored;
  fs::create_directories(folder.parent_path(), ignored);
  struct stat found = {};
  if ((mkdir(folder.c_str(), kOnlyOwner) != 0 && errno != EEXIST) ||
      lstat(folder.c_str(), &found) != 0) {
    return cannot_write(folder);
  }
  const std::string other = "set $KAAMOS_CACHE_DIR to a folder of yours";
  if (S_ISLNK(found.st_mode)) {
    return refused(folder, "it is a symbolic link",
                   "name the folder itself in $KAAMOS_CACHE_DIR, or remove the link");
  }
  if (!S_ISDIR(found.st_mode)) {
    return "the shader cache " + folder.string() + " is not a folder; " + other;
  }
  if (found.st_uid != geteuid()) {
    return refused(folder,
                   "it belongs to user " + std::to_string(found.st_uid) +
                       " and this program runs as user " + std::to_string(geteuid()),
                   other);
  }
  if ((found.st_mode & kOthersWrite) != 0) {
    return refused(folder, "others can write to it (mode " + mode_text(found.st_mode) + ")",
                   "empty it and run chmod go-w on it, or " + other);
  }
  return {};
}

bool may_load(const fs::path& object) {
  struct stat found = {};
  return lstat(object.c_str(), &found) == 0 && S_ISREG(found.st_mode) &&
         found.st_uid == geteuid() && (found.st_mode & kOthersWrite) == 0;
}

std::string cannot_write(const fs::path& path) {
  return "cannot write " + path.string() + " of the shader cache: " + std::strerror(errno) +
         "; set $KAAMOS_CACHE_DIR to a folder that can be written";
}

}  // namespace kaamos::hlsl
