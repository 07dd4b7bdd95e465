// SPDX-License-Identifier: MIT
#include "effect_run.h"

#include <algorithm>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace kaamos::test {

using namespace effects;

EffectResult run_effect(const Scene& scene, const EffectRun& run) {
  rtapi::DeviceDesc device_desc;
  device_desc.Threads = run.threads;
  const rtapi::Device device = rtapi::CreateDevice(device_desc).value();
  rtapi::CommandQueue queue = device.CreateCommandQueue().value();
  const Camera& camera = scene.cameras.front();
  const GpuScene gpu = create_gpu_scene(device, queue, scene, camera.position()).value();
  FrameDesc frame_desc;
  frame_desc.width = run.width;
  frame_desc.height = run.height;
  frame_desc.seed = run.seed;
  const Frame frame = Frame::create(device, queue, scene, gpu, camera, frame_desc).value();
  const bool ao = run.effect == Effect::kAmbientOcclusion;
  const RayPass gbuffer =
      RayPass::create(device, frame, gpu, gbuffer_pass(gbuffer_library().value())).value();
  const RayPass effect =
      RayPass::create(device, frame, gpu,
                      ao ? ambient_occlusion_pass(ambient_occlusion_library().value())
                         : sun_shadow_pass(sun_shadow_library().value()))
          .value();

  rtapi::CommandList list = device.CreateCommandList().value();
  gbuffer.dispatch(list, frame, {}, run.height);
  // Split over several dispatches, as northlight does.
  constexpr std::uint32_t kBatch = 1000;
  for (std::uint32_t first = 0; first < run.samples; first += kBatch) {
    PassConstants constants;
    constants.first_sample = first;
    constants.sample_count = std::min(kBatch, run.samples - first);
    constants.radius = run.radius;
    effect.dispatch(list, frame, constants, run.height);
  }
  queue.ExecuteAndWait(list).value();

  EffectResult result;
  result.visibility =
      frame.read(device, queue, ao ? kAmbientOcclusionSum : kSunVisibilitySum).value();
  for (float& value : result.visibility.values) {
    value /= static_cast<float>(run.samples);
  }
  result.position = frame.read(device, queue, kPosition).value();
  result.ids = frame.read(device, queue, kIds).value();
  return result;
}

}  // namespace kaamos::test
