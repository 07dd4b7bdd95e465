// SPDX-License-Identifier: MIT
//
// What kaamos-verify checks of an installed copy.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace kaamos::verify {

enum class Outcome {
  kPassed,
  kFailed,
  kAbsent,  // the machine does not have it, and nothing says that it should
};

struct Finding {
  Outcome outcome = Outcome::kFailed;
  std::string what;    // "vulkan: picture"
  std::string detail;  // what was found, or why it failed; may have several lines
  double seconds = 0;
};

struct Settings {
  bool require_vulkan = false;
  bool require_compiler = false;
};

// Both backends: a device, the picture, ten rules of DXR and of draws; then the picture with
// shaders that are interpreted, and with shaders that the machine's C++ compiler makes native code
// of. Each runs in a process of its own, so that a fault ends only that. `on_finding` gets each as
// it ends. Vulkan is absent where no driver is found, unless it is required or the environment
// names a driver; so is native code without a C++ compiler, unless $KAAMOS_CXX names one.
std::vector<Finding> run_checks(const Settings& settings,
                                const std::function<void(const Finding&)>& on_finding);

}  // namespace kaamos::verify
