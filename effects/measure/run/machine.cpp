// SPDX-License-Identifier: MIT
#include "effects/measure/run/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace kaamos::measure {

std::string machine() {
  std::ifstream in("/proc/cpuinfo");
  std::string name = "an unknown processor";
  for (std::string text; std::getline(in, text);) {
    const std::size_t colon = text.find(": ");
    if (!text.starts_with("model name") || colon == std::string::npos) continue;
    name = text.substr(colon + 2);
    break;
  }
  return fmt::format("{} threads, {}", std::thread::hardware_concurrency(), name);
}

}  // namespace kaamos::measure
