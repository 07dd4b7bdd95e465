// SPDX-License-Identifier: MIT
#include "frame_run.h"

#include <atomic>
#include <stdexcept>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/scene/lounge.h"
#include "effects/sun_shadow/sun_shadow.h"
#include "listening_library.h"

namespace kaamos::bench {
namespace {

northlight::Options frame_options(uint32_t width, uint32_t height) {
  northlight::Options options;
  options.width = width;
  options.height = height;
  options.local = options.contact = options.gi = options.reflections = options.transparent = true;
  options.ao_samples = options.sun_samples = 1;
  options.gi_bake_samples = 4;  // the time does not depend on what the volume holds
  return options;
}

northlight::ShaderLibraries listening_libraries() {
  northlight::ShaderLibraries libraries = northlight::built_in_libraries().value();
  for (rtapi::ShaderLibrary* tracing :
       {&libraries.gbuffer, &libraries.lighting, &libraries.ambient_occlusion,
        &libraries.sun_shadow, &libraries.contact_shadow, &libraries.indirect_diffuse,
        &libraries.reflections}) {
    *tracing = listening_library(*tracing);
  }
  return libraries;
}

}  // namespace

FrameRun::FrameRun(uint32_t width, uint32_t height, uint32_t threads)
    : scene_(effects::make_lounge()) {
  const northlight::Options options = frame_options(width, height);
  rtapi::DeviceDesc desc;
  desc.Threads = threads;
  desc.CollectStatistics = true;
  device_ = rtapi::CreateDevice(desc).value();
  queue_ = device_.CreateCommandQueue().value();
  const effects::Camera& camera = scene_.cameras.front();
  gpu_ = effects::create_gpu_scene(device_, queue_, scene_, camera.position()).value();
  effects::FrameDesc frame_desc;
  frame_desc.width = width;
  frame_desc.height = height;
  frame_ = effects::Frame::create(device_, queue_, scene_, gpu_, camera, frame_desc).value();
  libraries_ = listening_libraries();
  const std::atomic<bool> never = false;
  effects_
      .create(
          device_, queue_, frame_, gpu_, scene_, options, libraries_, [](double) {}, never)
      .value();
  parts_.push_back(ray_pass(effects::gbuffer_pass(libraries_.gbuffer), {}));
  parts_.push_back([this](rtapi::CommandList& list, const effects::PassConstants&) {
    effects_.light(list, frame_);
  });
  parts_.push_back(ray_pass(effects::ambient_occlusion_pass(libraries_.ambient_occlusion), {}));
  parts_.push_back(ray_pass(effects::sun_shadow_pass(libraries_.sun_shadow), {}));
  for (const northlight::RayStep& step : effects_.steps()) {
    parts_.push_back(ray_pass(step.desc, step.arguments));
  }
  if (parts_.size() != kFrameParts.size()) {
    throw std::runtime_error("the lounge's frame has " + std::to_string(parts_.size()) +
                             " parts, kFrameParts names " + std::to_string(kFrameParts.size()));
  }
}

FrameRun::Record FrameRun::ray_pass(const effects::RayPassDesc& desc,
                                    const effects::PassArguments& arguments) {
  return [this, arguments, pass = effects::RayPass::create(device_, frame_, gpu_, desc).value()](
             rtapi::CommandList& list, const effects::PassConstants& constants) {
    pass.dispatch(list, frame_, constants, frame_.height(), arguments);
  };
}

void FrameRun::trace_and_shade(const std::string& part) {
  rtapi::CommandList list = device_.CreateCommandList().value();
  effects_.begin_frame(scene_.cameras.front().position(), false);
  effects::PassConstants constants;
  // Each frame uses other samples, as in a sequence: to the filters, noise that stands still would
  // not be noise.
  constants.first_sample = frames_++;
  constants.sample_count = 1;
  constants.radius = 4;
  constants.accumulate = 0;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (part.empty() || part == kFrameParts[i]) parts_[i](list, constants);
  }
  queue_.ExecuteAndWait(list).value();
}

void FrameRun::denoise_and_compose() {
  rtapi::CommandList list = device_.CreateCommandList().value();
  for (const auto& filter : effects_.filters(frame_)) filter.record(list);
  effects_.compose(list, frame_);
  queue_.ExecuteAndWait(list).value();
}

std::vector<FrameRay> FrameRun::record(uint64_t& hits, const std::string& part) {
  device_.ResetStatistics();
  const RayRecording recording;
  trace_and_shade(part);
  std::vector<FrameRay> rays = recording.rays();
  const rtapi::RaytracingStatistics statistics = device_.GetStatistics();
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
