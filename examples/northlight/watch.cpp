// SPDX-License-Identifier: MIT
#include "watch.h"

#include <rtapi/shader_compiler.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace northlight {

using namespace kaamos::effects;
namespace fs = std::filesystem;

namespace {

fs::file_time_type time_of(const std::string& path) {
  std::error_code missing;  // if an editor is just replacing the file, its time is the earliest
  const auto time = fs::last_write_time(path, missing);
  return missing ? fs::file_time_type::min() : time;
}

}  // namespace

rtapi::Result<ShaderLibraries> ShaderWatcher::compile() {
  ShaderLibraries out;
  const bool again = !files_.empty();
  files_.clear();
  rtapi::Status status;
  for (const EffectLibrary& library : libraries_) {
    rtapi::ShaderCompileOptions options;
    options.File = (folder_ / (library.file + ".hlsl")).string();
    options.IncludeDirectories = {(folder_ / "shaders").string()};
    options.Spirv = spirv_;
    options.Quick = again;
    const auto compiled = rtapi::CompileShaderLibrary(options);
    for (const std::string& file : compiled.Dependencies) {
      files_[file] = time_of(file);
    }
    files_.try_emplace(options.File, time_of(options.File));
    if (!compiled.Status && status) status = compiled.Status;
    out[library.file] = compiled.Library;
  }
  if (!status) return status.error();
  return out;
}

bool ShaderWatcher::wait(const std::atomic<bool>& stop) const {
  while (!stop) {
    for (const auto& [file, time] : files_) {
      const auto now = time_of(file);
      if (now != time && now != fs::file_time_type::min()) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

fs::path find_effects_folder() {
  std::error_code ignored;
  const fs::path programs = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  fs::path folder = (programs / KAAMOS_INSTALLED_EFFECTS).lexically_normal();
  if (const char* wanted = std::getenv("KAAMOS_EFFECTS")) {
    folder = wanted;
  } else if (fs::equivalent(programs, KAAMOS_BUILD_PROGRAMS, ignored)) {
    folder = KAAMOS_SOURCE_EFFECTS;
  }
  return fs::exists(folder / "shaders" / "frame.hlsli", ignored) ? folder : fs::path();
}

}  // namespace northlight
