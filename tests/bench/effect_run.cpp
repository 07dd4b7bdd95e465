// SPDX-License-Identifier: MIT
#include "effect_run.h"

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/reflections/reflections.h"
#include "effects/sun_shadow/sun_shadow.h"

namespace kaamos::bench {

using namespace effects;

const BenchEffect kAoEffect = {"ao", ambient_occlusion_pass, ambient_occlusion_library, false};
const BenchEffect kSunEffect = {"sun", sun_shadow_pass, sun_shadow_library, false};
const BenchEffect kReflectionsEffect = {"reflections", reflections_pass, reflections_library, true};

namespace {

PassConstants constants(bool sorted, uint32_t samples) {
  PassConstants out;
  out.sample_count = samples;
  out.radius = kDefaultAmbientOcclusionRadius;
  out.sorted = sorted ? 1 : 0;
  return out;
}

}  // namespace

EffectRun::EffectRun(const BenchEffect& effect, Fixtures& fixtures) {
  rtapi::DeviceDesc device_desc;
  device_desc.Threads = fixtures.threads();
  device_ = rtapi::CreateDevice(device_desc).value();
  queue_ = device_.CreateCommandQueue().value();
  const Scene& scene = fixtures.scene().scene;
  const Camera& camera = scene.cameras.front();
  gpu_ = create_gpu_scene(device_, queue_, scene, camera.position()).value();
  FrameDesc desc;
  desc.width = fixtures.options().width;
  desc.height = fixtures.options().height;
  frame_ = Frame::create(device_, queue_, scene, gpu_, camera, desc).value();
  lighting_ = Lighting::create(device_, frame_, gpu_, lighting_library().value(), 0).value();
  volume_ = GpuVolume::create(device_, {}, camera.position()).value();
  sorter_ = RaySorter::create(device_, frame_, ray_order_library().value()).value();
  const RayPassDesc pass = effect.pass(effect.library().value());
  pass_ = RayPass::create(device_, frame_, gpu_, pass).value();
  keys_ = RayPass::create(device_, frame_, gpu_, key_pass(pass)).value();
  if (effect.own_picture) bind_picture();
  const RayPass gbuffer =
      RayPass::create(device_, frame_, gpu_, gbuffer_pass(gbuffer_library().value())).value();
  list_ = device_.CreateCommandList().value();
  gbuffer.dispatch(list_, frame_, {}, frame_.height());
  lighting_->update(list_, frame_);
  keys_.dispatch(list_, frame_, constants(false, 1), frame_.height(), arguments_);
  sorter_.sort(list_, frame_, RayOrder::kDirection);
  queue_.ExecuteAndWait(list_).value();
}

void EffectRun::bind_picture() {
  picture_ = frame_.create_picture(device_, "sum", rtapi::Format::kR32G32B32A32Float).value();
  views_ = frame_.create_pass_views(device_).value();
  views_.set_unordered_access(0, picture_).value();
  lighting_->bind(views_).value();
  volume_.bind(views_).value();
  arguments_ = {views_, ReflectionConstants{}};
}

void EffectRun::sort() {
  list_.Reset().value();
  keys_.dispatch(list_, frame_, constants(false, 1), frame_.height(), arguments_);
  sorter_.sort(list_, frame_, RayOrder::kDirection);
  queue_.ExecuteAndWait(list_).value();
}

void EffectRun::trace(bool sorted, uint32_t samples) {
  list_.Reset().value();
  pass_.dispatch(list_, frame_, constants(sorted, samples), frame_.height(), arguments_);
  queue_.ExecuteAndWait(list_).value();
}

}  // namespace kaamos::bench
