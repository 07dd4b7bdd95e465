// SPDX-License-Identifier: MIT
#include "effects/northlight/libraries.h"

#include <shaders/control.h>
#include <shaders/spatial.h>
#include <shaders/svgf.h>
#include <shaders/temporal_gradients.h>
#include <shaders/upscale.h>
#include <shaders/visibility_filter.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "effects/assets/common/parallel.h"
#include "effects/composition/composite/composite.h"
#include "effects/composition/enlarge/enlarge.h"
#include "effects/composition/taa/taa.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/direct/direct.h"
#include "effects/light/lights/lighting.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "effects/surfaces/gbuffer/raster_gbuffer.h"

namespace kaamos::effects {

namespace {

rtapi::Result<rtapi::ShaderLibrary> spatial_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_spatial());
}
rtapi::Result<rtapi::ShaderLibrary> svgf_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_svgf());
}
rtapi::Result<rtapi::ShaderLibrary> control_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_control());
}
rtapi::Result<rtapi::ShaderLibrary> upscale_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_upscale());
}
rtapi::Result<rtapi::ShaderLibrary> temporal_gradients_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_temporal_gradients());
}
rtapi::Result<rtapi::ShaderLibrary> visibility_filter_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_visibility_filter());
}

// A part that a frame has besides its effects, and the frames that have it.
struct PartRow {
  EffectLibrary library;
  bool (*is_needed)(const FrameSettings&);
};

const std::vector<PartRow>& parts() {
  constexpr auto kAlways = [](const FrameSettings&) { return true; };
  constexpr auto kWhole = [](const FrameSettings& s) { return s.whole_frame; };
  constexpr auto kDrawn = [](const FrameSettings& s) { return s.primary == Primary::kRaster; };
  static const std::vector<PartRow> rows = {
      {{"surfaces/gbuffer/gbuffer", gbuffer_library}, kAlways},
      {{"surfaces/gbuffer/raster", raster_library}, kDrawn},
      {{"surfaces/gbuffer/resolve", resolve_library}, kDrawn},
      {{"surfaces/gbuffer/curvature", curvature_library},
       [](const FrameSettings& s) { return s.curvature_to_roughness; }},
      {{"composition/composite/composite", composite_library}, kAlways},
      {{"light/lights/lighting", lighting_library}, kWhole},
      {{"light/lights/light_map_draws", light_map_draws_library},
       [](const FrameSettings& s) { return s.whole_frame && s.light_maps == LightMaps::kDrawn; }},
      {{"light/direct/direct", direct_library}, kWhole},
      {{"indirect/indirect_diffuse/volume_bake", volume_bake_library}, kWhole},
      {{"denoise/spatial", spatial_library}, kWhole},
      {{"denoise/svgf", svgf_library}, kWhole},
      {{"denoise/control", control_library}, kWhole},
      {{"denoise/upscale", upscale_library}, kWhole},
      {{"denoise/visibility_filter", visibility_filter_library}, kWhole},
      {{"denoise/temporal_gradients", temporal_gradients_library}, kWhole},
      {{"surfaces/ray_order/ray_order", ray_order_library},
       [](const FrameSettings& s) { return s.order != RayOrder::kPixels; }},
      {{"composition/taa/taa", taa_library}, [](const FrameSettings& s) { return s.taa; }},
      {{"composition/enlarge/enlarge", enlarge_library},
       [](const FrameSettings& s) { return s.enlarge > 1.0f; }}};
  return rows;
}

}  // namespace

std::vector<EffectLibrary> frame_libraries(const FrameSettings& settings,
                                           const std::vector<Effect>& effects) {
  std::vector<EffectLibrary> out;
  // Several effects may share one.
  const auto add = [&](const EffectLibrary& library) {
    const bool is_there = std::any_of(out.begin(), out.end(), [&](const EffectLibrary& each) {
      return each.file == library.file;
    });
    if (!is_there) out.push_back(library);
  };
  for (const PartRow& row : parts()) {
    if (row.is_needed(settings)) add(row.library);
  }
  for (const Effect& effect : effects) {
    if (settings.effects.count(effect.name) == 0) continue;
    if (!effect.library.file.empty()) add(effect.library);
    for (const EffectLibrary& library : effect.more_libraries) add(library);
  }
  return out;
}

rtapi::Result<Outcome> load_libraries(const std::vector<EffectLibrary>& libraries,
                                      ShaderLibraries& out, const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kUnnoticed(500);
  const Clock::time_point start = Clock::now();
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<std::optional<rtapi::Result<rtapi::ShaderLibrary>>> loaded(libraries.size());
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> stopped = false;
  run_parallel(0, libraries.size(), [&](std::size_t i) {
    if (stopped) return;
    loaded[i].emplace(libraries[i].built_in());
    const std::size_t count = ++done;
    // What follows says when it is complete.
    if (!progress || count == libraries.size() || std::this_thread::get_id() != caller) return;
    if (Clock::now() - start < kUnnoticed) return;
    stopped = !progress("shader libraries", double(count) / double(libraries.size()));
  });
  if (stopped) return Outcome::kStopped;
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    if (!*loaded[i]) return loaded[i]->error();
    out[libraries[i].file] = **loaded[i];
  }
  if (progress && Clock::now() - start >= kUnnoticed && !progress("shader libraries", 1.0)) {
    return Outcome::kStopped;
  }
  return Outcome::kDone;
}

DenoiseLibraries denoise_libraries(const ShaderLibraries& libraries) {
  return {libraries.at("denoise/spatial"),           libraries.at("denoise/svgf"),
          libraries.at("denoise/control"),           libraries.at("denoise/upscale"),
          libraries.at("denoise/visibility_filter"), libraries.at("denoise/temporal_gradients")};
}

}  // namespace kaamos::effects
