// SPDX-License-Identifier: MIT
// Helpers with which tests silence and collect messages.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// While it lives, nothing is printed.
class Quiet {
 public:
  Quiet() { setenv("KAAMOS_D3D12_MESSAGES", "none", 1); }
  ~Quiet() { unsetenv("KAAMOS_D3D12_MESSAGES"); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

/// The errors of a reporter, while it lives.
class Listener {
 public:
  explicit Listener(Reporter& reporter = process_reporter()) : reporter_(reporter) {
    sink_ = reporter_.add_sink([this](D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
      if (severity <= D3D12_MESSAGE_SEVERITY_ERROR) messages.push_back(error.message);
    });
  }
  ~Listener() { reporter_.remove_sink(sink_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::vector<std::string> messages;

 private:
  Reporter& reporter_;
  uint64_t sink_;
};

}  // namespace kaamos::d3d12
