// SPDX-License-Identifier: MIT
#include "effects/measure/run/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "effects/assets/common/file.h"
#include "effects/assets/common/parallel.h"
#include "effects/assets/image/png.h"

namespace kaamos::measure {

using namespace kaamos::effects;
namespace fs = std::filesystem;

std::string prepare_folder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) {
    return fmt::format("cannot make the folder {}: {}; choose another one with --out", folder,
                       failed.message());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return fmt::format("cannot write into {}: {}; choose another folder with --out", folder,
                       std::strerror(errno));
  }
  return {};
}

namespace {

constexpr const char* kStaging = ".northlight-new-";

// Removes what runs left behind that were killed: each holds a lock on its folder while it lives. A
// folder of this minute may be one that is not locked yet.
void remove_abandoned(const std::string& folder) {
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    if (!entry.path().filename().string().starts_with(kStaging)) continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(failed);
    if (failed || age < std::chrono::minutes(1)) continue;
    const int lock = open(entry.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock < 0) continue;
    if (flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), failed);
    close(lock);
  }
}

}  // namespace

StagedFiles::StagedFiles(const std::string& folder) : folder_(folder) {}

StagedFiles::~StagedFiles() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  if (lock_ >= 0) close(lock_);
}

std::string StagedFiles::create() {
  if (auto error = prepare_folder(folder_); !error.empty()) return error;
  remove_abandoned(folder_);
  std::string staging = (fs::path(folder_) / kStaging).string() + "XXXXXX";
  if (mkdtemp(staging.data()) != nullptr) {
    staging_ = staging;
    lock_ = open(staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0) return {};
  }
  return fmt::format("cannot write into {}: {}; choose another folder with --out", folder_,
                     std::strerror(errno));
}

std::string StagedFiles::add_path(const std::string& name) {
  names_.push_back(name);
  return (fs::path(staging_) / name).string();
}

std::string StagedFiles::add(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  const auto written = write_file(add_path(name), bytes);
  return written.ok() ? "" : written.error().message;
}

std::string StagedFiles::add(const std::string& name, const ByteImage& image) {
  const auto bytes = encode_png(image);
  return bytes.ok() ? add(name, bytes.value()) : bytes.error().message;
}

std::string StagedFiles::add(const std::vector<EncodedFile>& files, std::uint32_t threads) {
  std::vector<std::string> paths, errors(files.size());
  for (const EncodedFile& file : files) paths.push_back(add_path(file.name));
  run_parallel(threads, files.size(), [&](std::size_t i) {
    const auto bytes = files[i].encode();
    const auto written = bytes.ok() ? write_file(paths[i], bytes.value()) : bytes.error();
    if (!written.ok()) errors[i] = written.error().message;
  });
  for (const std::string& error : errors) {
    if (!error.empty()) return error;
  }
  return {};
}

std::string StagedFiles::publish() {
  for (const std::string& name : names_) {
    const auto placed = place_file(staging_ + "/" + name, folder_ + "/" + name);
    if (!placed.ok()) return placed.error().message;
  }
  return {};
}

}  // namespace kaamos::measure
