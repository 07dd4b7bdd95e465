// SPDX-License-Identifier: MIT
// Results that appear in their folder together or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"

namespace kaamos::measure {

// A file by the work that makes its bytes, which any thread may do.
struct EncodedFile {
  std::string name;
  std::function<effects::Result<std::vector<std::uint8_t>>()> encode;
};

// Files that wait beside the results until all of them are complete: a full disk or Ctrl-C must not
// leave half of a new run over the old one. The destructor deletes what was not published.
class StagedFiles {
 public:
  explicit StagedFiles(const std::string& folder);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  // These return an error text, empty on success.
  std::string create();
  std::string add(const std::string& name, const std::vector<std::uint8_t>& bytes);
  std::string add(const std::string& name, const effects::ByteImage& image);
  // Encodes files on so many threads [thread_count] and adds them in their order.
  std::string add(const std::vector<EncodedFile>& files, std::uint32_t threads);
  // For code that writes its own file: the path to use before publishing.
  std::string add_path(const std::string& name);
  // Renames all files into the folder.
  std::string publish();

 private:
  std::string folder_, staging_;  // staging_ is of this run alone
  int lock_ = -1;                 // held while it is
  std::vector<std::string> names_;
};

// Makes the folder and checks that files can be written there, before hours of rendering. Returns
// an error text, empty on success.
std::string prepare_folder(const std::string& folder);

}  // namespace kaamos::measure
