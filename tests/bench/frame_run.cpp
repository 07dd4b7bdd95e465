// SPDX-License-Identifier: MIT
#include "frame_run.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>

#include "effects/scene/lounge.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/services.h"

namespace kaamos::bench {
namespace {

// What RayListener writes to: a list for each thread.
std::mutex heard_mutex;
std::vector<std::unique_ptr<std::vector<FrameRay>>> heard;
std::atomic<uint32_t> recording = 0;  // numbers the recordings

void hear(const shader::TraceRayArguments& arguments, shader::RayLanes origin,
          shader::RayLanes direction) {
  thread_local std::vector<FrameRay>* list = nullptr;
  thread_local uint32_t list_of = 0;
  if (list == nullptr || list_of != recording) {
    const std::lock_guard lock(heard_mutex);
    list = heard.emplace_back(std::make_unique<std::vector<FrameRay>>()).get();
    list_of = recording;
  }
  constexpr uint32_t kVisibility =
      embree::kRaySkipClosestHitShader | embree::kRayAcceptFirstHitAndEndSearch;
  const Ray ray = {{origin[0], origin[1], origin[2]},
                   origin[3],
                   {direction[0], direction[1], direction[2]},
                   direction[3]};
  list->push_back({ray, (arguments.ray_flags & kVisibility) == kVisibility});
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
  settings.effects = effects::choose_effects({"all"});
  for (auto& [name, effect] : settings.effects) effect.samples = 1;
  settings.volume.samples = 4;  // the time does not depend on what the volume holds
  renderer_ =
      effects::FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene_, settings).value();
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
  const effects::FrameRenderer::PartOptions options = {.first_sample = frames_++};
  for (const char* each : kFrameParts) {
    if (part.empty() || part == each) renderer_->record(list, each, options);
  }
  queue().ExecuteAndWait(list).value();
}

void FrameRun::denoise_and_compose() {
  rtapi::CommandList list = device().CreateCommandList().value();
  renderer_->record_filters(list);
  renderer_->record_compose(list);
  queue().ExecuteAndWait(list).value();
}

std::vector<FrameRay> FrameRun::record(uint64_t& hits, const std::string& part) {
  heard.clear();
  ++recording;
  rtapi::Device device = renderer_->device();
  device.ResetStatistics();
  embree::set_ray_listener(hear);
  trace_and_shade(part);
  embree::set_ray_listener(nullptr);
  std::vector<FrameRay> rays;
  for (const auto& list : heard) rays.insert(rays.end(), list->begin(), list->end());
  heard.clear();
  const rtapi::RaytracingStatistics statistics = device.GetStatistics();
  if (statistics.TraceRayCalls != rays.size()) {
    throw std::runtime_error("the frame traced " + std::to_string(statistics.TraceRayCalls) +
                             " rays, " + std::to_string(rays.size()) + " were heard of");
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
