// SPDX-License-Identifier: MIT
#include "effects/measure/study/files.h"

#include <fstream>
#include <sstream>

namespace kaamos::measure {

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace kaamos::measure
