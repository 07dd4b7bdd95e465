// SPDX-License-Identifier: MIT
#include "tests/parity/frames.h"

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/composite/composite.h"
#include "effects/frame/picture.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/indirect_diffuse/volume.h"
#include "effects/lights/lighting.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace kaamos::parity {

using namespace effects;

std::map<FrameTexture, FloatImage> render_frame(const Scene& scene, const FrameRun& run) {
  rtapi::DeviceDesc device_desc;
  device_desc.Backend = run.backend;
  const rtapi::Device device = rtapi::CreateDevice(device_desc).value();
  rtapi::CommandQueue queue = device.CreateCommandQueue().value();
  const Camera& camera = scene.cameras.front();
  const GpuScene gpu = create_gpu_scene(device, queue, scene, camera.position()).value();
  FrameDesc frame_desc;
  frame_desc.width = run.width;
  frame_desc.height = run.height;
  frame_desc.seed = run.seed;
  const Frame frame = Frame::create(device, queue, scene, gpu, camera, frame_desc).value();
  const auto pass = [&](const RayPassDesc& desc) {
    return RayPass::create(device, frame, gpu, desc).value();
  };
  const RayPass gbuffer = pass(gbuffer_pass(gbuffer_library().value()));
  const RayPass ao = pass(ambient_occlusion_pass(ambient_occlusion_library().value()));
  const RayPass sun = pass(sun_shadow_pass(sun_shadow_library().value()));
  const CompositePass composite =
      CompositePass::create(device, frame, composite_library().value()).value();

  rtapi::CommandList list = device.CreateCommandList().value();
  frame.clear(list, kAmbientOcclusionSum);
  frame.clear(list, kSunVisibilitySum);
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
  PassConstants constants;
  constants.sample_count = run.samples;
  constants.radius = 4.0f;
  gbuffer.dispatch(list, frame, {}, run.height);
  ao.dispatch(list, frame, constants, run.height);
  if (scene.sun) sun.dispatch(list, frame, constants, run.height);
  composite.dispatch(list, frame, {run.samples, scene.sun ? run.samples : 0});
  queue.ExecuteAndWait(list).value();

  std::map<FrameTexture, FloatImage> out;
  for (uint32_t i = 0; i < kFrameTextureCount; ++i) {
    const auto texture = static_cast<FrameTexture>(i);
    out[texture] = frame.read(device, queue, texture).value();
  }
  return out;
}

GlassRun render_glass(const Scene& scene, const FrameRun& run,
                      const TransparentConstants& constants) {
  rtapi::DeviceDesc device_desc;
  device_desc.Backend = run.backend;
  const rtapi::Device device = rtapi::CreateDevice(device_desc).value();
  rtapi::CommandQueue queue = device.CreateCommandQueue().value();
  const Camera& camera = scene.cameras.front();
  const GpuScene gpu = create_gpu_scene(device, queue, scene, camera.position()).value();
  FrameDesc frame_desc;
  frame_desc.width = run.width;
  frame_desc.height = run.height;
  frame_desc.seed = run.seed;
  const Frame frame = Frame::create(device, queue, scene, gpu, camera, frame_desc).value();
  const auto pass = [&](const RayPassDesc& desc) {
    return RayPass::create(device, frame, gpu, desc).value();
  };
  const rtapi::ShaderLibrary library = transparent_library().value();
  const RayPass gbuffer = pass(gbuffer_pass(gbuffer_library().value()));
  const RayPass sun = pass(sun_shadow_pass(sun_shadow_library().value()));
  const RayPass glass = pass(transparent_pass(library));
  const Lighting lighting = Lighting::create(device, frame, gpu, lighting_library().value(),
                                             static_cast<uint32_t>(scene.lights.size()))
                                .value();
  const CompositePass composite =
      CompositePass::create(device, frame, composite_library().value()).value();
  const ComputePass compose = transparent_compose_pass(device, frame, library).value();
  const auto picture = [&](const char* name) {
    return frame.create_picture(device, name, rtapi::Format::kR32G32B32A32Float).value();
  };
  const rtapi::Texture radiance = picture("glass"), transmittance = picture("transmittance");
  PassViews views = frame.create_pass_views(device).value();
  views.set_unordered_access(0, radiance).value();
  views.set_unordered_access(1, transmittance).value();
  lighting.bind(views).value();
  const GpuVolume no_volume = GpuVolume::create(device, {}, camera.position()).value();
  no_volume.bind(views).value();

  rtapi::CommandList list = device.CreateCommandList().value();
  frame.clear(list, kSunVisibilitySum);
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
  const PassArguments arguments(views, constants);
  PassConstants samples;
  samples.sample_count = run.samples;
  gbuffer.dispatch(list, frame, {}, run.height);
  lighting.update(list, frame);
  if (scene.sun) sun.dispatch(list, frame, samples, run.height);
  composite.dispatch(list, frame, {0, scene.sun ? run.samples : 0});
  glass.dispatch(list, frame, {}, run.height, arguments);
  compose.dispatch(list, frame, {}, arguments, run.width, run.height);
  queue.ExecuteAndWait(list).value();
  return {frame.read(device, queue, kIds).value(), frame.read(device, queue, kRadiance).value(),
          read_picture(device, queue, transmittance).value()};
}

}  // namespace kaamos::parity
