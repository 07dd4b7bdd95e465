// SPDX-License-Identifier: MIT
// Compiles shaders at run time and waits until one of their files changes.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "effects/northlight/libraries.h"

namespace northlight {

class ShaderWatcher {
 public:
  // `folder` holds gbuffer/, ambient_occlusion/, ... and shaders/; `libraries` are compiled, with
  // what Vulkan needs if `spirv` is true.
  ShaderWatcher(std::filesystem::path folder, std::vector<kaamos::effects::EffectLibrary> libraries,
                bool spirv)
      : folder_(std::move(folder)), libraries_(std::move(libraries)), spirv_(spirv) {}

  // Compiles all shaders, those that have changed since the first call in a hurry; an error's
  // message is the compiler's.
  rtapi::Result<kaamos::effects::ShaderLibraries> compile();
  // Returns true when a file that the last compile() read has changed, false when `stop` is set.
  bool wait(const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path folder_;
  std::vector<kaamos::effects::EffectLibrary> libraries_;
  bool spirv_ = true;
  std::map<std::string, std::filesystem::file_time_type> files_;
};

// The folder of the effects' shaders: $KAAMOS_EFFECTS, else the one that was installed with the
// program; for the program of the build folder, that of the source tree. Empty if it is not there.
std::filesystem::path find_effects_folder();

}  // namespace northlight
