// SPDX-License-Identifier: MIT
// Shaders compiled at run time, and waiting until one of their files changes.
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
  // `folder` holds gbuffer/, ambient_occlusion/, ... and shaders/; `libraries` are compiled.
  ShaderWatcher(std::filesystem::path folder, std::vector<kaamos::effects::EffectLibrary> libraries)
      : folder_(std::move(folder)), libraries_(std::move(libraries)) {}

  // Compiles all of them; the message of an error is what the compiler says.
  rtapi::Result<kaamos::effects::ShaderLibraries> compile();
  // Returns true when a file that the last compile() read has changed, false when `stop` is set.
  bool wait(const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path folder_;
  std::vector<kaamos::effects::EffectLibrary> libraries_;
  std::map<std::string, std::filesystem::file_time_type> files_;
};

// Where the effects' shaders are: $KAAMOS_EFFECTS, else the source or the installed folder. Empty
// if there is none.
std::filesystem::path find_effects_folder();

}  // namespace northlight
