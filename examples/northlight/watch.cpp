// SPDX-License-Identifier: MIT
#include "watch.h"

#include <rtapi/shader_compiler.h>

#include <chrono>
#include <cstdlib>
#include <iterator>
#include <thread>
#include <utility>
#include <vector>

namespace northlight {

namespace fs = std::filesystem;

namespace {

fs::file_time_type time_of(const std::string& path) {
  std::error_code missing;  // if an editor is just replacing the file, its time is the earliest
  const auto time = fs::last_write_time(path, missing);
  return missing ? fs::file_time_type::min() : time;
}

}  // namespace

rtapi::Result<ShaderLibraries> ShaderWatcher::compile() {
  ShaderLibraries libraries;
  std::vector<std::pair<const char*, rtapi::ShaderLibrary*>> parts = {
      {"gbuffer/gbuffer", &libraries.gbuffer},
      {"ambient_occlusion/ambient_occlusion", &libraries.ambient_occlusion},
      {"sun_shadow/sun_shadow", &libraries.sun_shadow},
      {"composite/composite", &libraries.composite}};
  const std::pair<const char*, rtapi::ShaderLibrary*> more[] = {
      {"lights/lighting", &libraries.lighting},
      {"direct/direct", &libraries.direct},
      {"contact_shadow/contact_shadow", &libraries.contact_shadow},
      {"indirect_diffuse/volume_bake", &libraries.volume_bake},
      {"indirect_diffuse/indirect_diffuse", &libraries.indirect_diffuse},
      {"reflections/reflections", &libraries.reflections},
      {"transparent/transparent", &libraries.transparent},
      {"denoise/spatial", &libraries.denoise.spatial},
      {"denoise/svgf", &libraries.denoise.svgf},
      {"denoise/control", &libraries.denoise.control},
      {"denoise/upscale", &libraries.denoise.upscale}};
  if (whole_frame_) parts.insert(parts.end(), std::begin(more), std::end(more));
  if (sorts_) parts.emplace_back("ray_order/ray_order", &libraries.ray_order);
  files_.clear();
  rtapi::Status status;
  for (const auto& [name, library] : parts) {
    rtapi::ShaderCompileOptions options;
    options.File = (folder_ / (std::string(name) + ".hlsl")).string();
    options.IncludeDirectories = {(folder_ / "shaders").string()};
    const auto compiled = rtapi::CompileShaderLibrary(options);
    for (const std::string& file : compiled.Dependencies) {
      files_[file] = time_of(file);
    }
    files_.try_emplace(options.File, time_of(options.File));
    if (!compiled.Status && status) status = compiled.Status;
    *library = compiled.Library;
  }
  if (!status) return status.error();
  return libraries;
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
  const char* wanted = std::getenv("KAAMOS_EFFECTS");
  std::error_code ignored;
  for (const char* folder : {wanted, KAAMOS_EFFECTS_SOURCE, KAAMOS_EFFECTS_INSTALLED}) {
    if (folder != nullptr && fs::exists(fs::path(folder) / "shaders" / "frame.hlsli", ignored)) {
      return folder;
    }
  }
  return {};
}

}  // namespace northlight
