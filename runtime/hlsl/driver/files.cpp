// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/files.h"

#include <xxhash.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace kaamos::hlsl {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string content_hash(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

}  // namespace kaamos::hlsl
