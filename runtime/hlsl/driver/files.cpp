// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/files.h"

#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace kaamos::hlsl {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

bool replace_file(const std::filesystem::path& path, std::string_view bytes) {
  std::string fresh = path.string() + "-XXXXXX";
  const int opened = mkstemp(fresh.data());
  if (opened < 0) return false;
  close(opened);
  std::ofstream out(fresh, std::ios::binary);
  out << bytes;
  out.close();
  if (out && std::rename(fresh.c_str(), path.c_str()) == 0) return true;
  const int reason = errno;
  std::remove(fresh.c_str());
  errno = reason;
  return false;
}

std::string content_hash(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

}  // namespace kaamos::hlsl
