// SPDX-License-Identifier: MIT
// Compiles shaders at run time and waits until one of their files changes.
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer.h"

namespace northlight {

class ShaderWatcher {
 public:
  // `folder` holds gbuffer/, ambient_occlusion/, ... and shaders/. `whole_frame`: all effects, not
  // only ambient occlusion and the sun. `sorts`: also the sorting of rays.
  ShaderWatcher(std::filesystem::path folder, bool whole_frame, bool sorts)
      : folder_(std::move(folder)), whole_frame_(whole_frame), sorts_(sorts) {}

  // Compiles all shaders; an error's message is the compiler's.
  rtapi::Result<ShaderLibraries> compile();
  // Returns true when a file that the last compile() read has changed, false when `stop` is set.
  bool wait(const std::atomic<bool>& stop) const;

 private:
  std::filesystem::path folder_;
  bool whole_frame_;
  bool sorts_;
  std::map<std::string, std::filesystem::file_time_type> files_;
};

// The folder of the effects' shaders: $KAAMOS_EFFECTS, else the source or the installed folder.
// Empty if there is none.
std::filesystem::path find_effects_folder();

}  // namespace northlight
