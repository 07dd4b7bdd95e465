// SPDX-License-Identifier: MIT
#include "runtime/backend/debugger.h"

#include <atomic>
#include <chrono>
#include <fstream>
#include <string>

namespace kaamos::runtime {
namespace {

constexpr int64_t kMostAgeNanoseconds = 20'000'000;

bool has_tracer() {
  std::ifstream status("/proc/self/status");
  constexpr std::string_view kName = "TracerPid:";
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(kName)) continue;
    return line.find_first_not_of(" \t0", kName.size()) != std::string::npos;
  }
  return false;
}

}  // namespace

bool is_debugger_attached() {
  static std::atomic<int64_t> asked_at{0};
  static std::atomic<bool> answer{false};
  const int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
  int64_t last = asked_at.load(std::memory_order_acquire);
  const bool is_old = last == 0 || now - last > kMostAgeNanoseconds;
  if (is_old) {
    answer.store(has_tracer(), std::memory_order_relaxed);
    asked_at.store(now, std::memory_order_release);
  }
  return answer.load(std::memory_order_relaxed);
}

}  // namespace kaamos::runtime
