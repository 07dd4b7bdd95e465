// SPDX-License-Identifier: MIT
#include "frame_run.h"

#include <algorithm>
#include <stdexcept>

#include "effects/assets/built_in/lounge.h"
#include "listening_library.h"

namespace kaamos::bench {
namespace {

effects::ShaderLibraries listening_libraries(const effects::FrameSettings& settings) {
  effects::ShaderLibraries libraries;
  effects::load_libraries(effects::frame_libraries(settings), libraries).value();
  for (auto& [file, library] : libraries) library = listening_library(library);
  return libraries;
}

}  // namespace

FrameRun::FrameRun(uint32_t width, uint32_t height, uint32_t threads)
    : scene_(effects::make_lounge()) {
  rtapi::DeviceDesc desc;
  desc.Threads = threads;
  desc.CollectStatistics = true;
  effects::FrameSettings settings;
  settings.width = width;
  settings.height = height;
  settings.effects = effects::choose_effects({"all", "ao"});
  for (auto& [name, effect] : settings.effects) effect.samples = 1;
  settings.volume.samples = 4;  // the time does not depend on what the volume holds
  renderer_ =
      effects::FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene_, settings).value();
  renderer_->set_libraries(listening_libraries(renderer_->context().settings));
  renderer_->prepare().value();
  const std::vector<std::string> parts = renderer_->parts();
  if (!std::equal(parts.begin(), parts.end(), kFrameParts.begin(), kFrameParts.end())) {
    throw std::runtime_error("the lounge's frame has other parts than kFrameParts names");
  }
}

void FrameRun::trace_and_shade(const std::string& part) {
  rtapi::CommandList list = device().CreateCommandList().value();
  // Each frame uses other samples, as in a sequence: to the filters, noise that stands still would
  // not be noise.
  const effects::PartOptions options = {.first_sample = frames_++};
  for (const char* each : kFrameParts) {
    if (part.empty() || part == each) renderer_->record(list, each, options);
  }
  queue().ExecuteAndWait(list).value();
}

void FrameRun::denoise_and_compose() {
  rtapi::CommandList list = device().CreateCommandList().value();
  renderer_->filters().record_rest(list);
  renderer_->composition().record(list);
  queue().ExecuteAndWait(list).value();
}

std::vector<FrameRay> FrameRun::record(uint64_t& hits, const std::string& part) {
  rtapi::Device device = renderer_->device();
  device.ResetStatistics();
  const RayRecording recording;
  trace_and_shade(part);
  std::vector<FrameRay> rays = recording.rays();
  const rtapi::RaytracingStatistics statistics = device.GetStatistics();
  if (statistics.TraceRayCalls != rays.size()) {
    throw std::runtime_error("the frame traced " + std::to_string(statistics.TraceRayCalls) +
                             " rays, of which " + std::to_string(rays.size()) + " were recorded");
  }
  hits = statistics.Hits;
  return rays;
}

SceneData FrameRun::scene_at_camera() const {
  SceneData data = make_scene_data();
  const glm::dvec3 camera = scene_.cameras.front().position();
  for (InstanceData& instance : data.instances) {
    for (int axis = 0; axis < 3; ++axis) {
      float& offset = instance.transform[4 * axis + 3];
      offset = static_cast<float>(offset - camera[axis]);
    }
  }
  return data;
}

}  // namespace kaamos::bench
