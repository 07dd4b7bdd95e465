// SPDX-License-Identifier: MIT
#include "effects/measure/study/files.h"

#include <cstdint>
#include <fstream>
#include <sstream>

#include "effects/assets/common/file.h"

namespace kaamos::measure {

rtapi::Status write_text(const std::string& path, const std::string& text) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  if (const auto s = effects::write_file(path, {bytes, text.size()}); !s.ok()) return s.error();
  return {};
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace kaamos::measure
