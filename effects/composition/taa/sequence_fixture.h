// SPDX-License-Identifier: MIT
// For tests: renders a moving scene frame by frame, as a program would.
#pragma once

#include <rtapi/upload.h>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "effects/composition/composite/composite.h"
#include "effects/composition/taa/taa.h"
#include "effects/engine/picture.h"
#include "effects/engine/sums_fixture.h"
#include "effects/geometry/structures/structures.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/shadows/sun_shadow/sun_shadow.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {

class SequenceStage {
 public:
  SequenceStage(Scene given, std::uint32_t width, std::uint32_t height, std::uint32_t threads = 0,
                const std::string& backend = "embree")
      : scene(std::move(given)), camera(scene.cameras.front()) {
    rtapi::DeviceDesc device_desc;
    device_desc.Backend = backend;
    device_desc.Threads = threads;
    device = test::device_for(device_desc);
    queue = device.CreateCommandQueue().value();
    manager = StructureManager::create(device, queue, scene).value();
    FrameDesc desc;
    desc.width = width;
    desc.height = height;
    frame = Frame::create(device, scene, manager.scene(), camera, desc).value();
    const auto pass = [&](RayPassDesc d) {
      return RayPass::create(device, frame, manager.scene(), d).value();
    };
    gbuffer = pass(gbuffer_pass(gbuffer_library().value()));
    ambient = pass(ambient_occlusion_pass(ambient_occlusion_library().value()));
    sun = pass(sun_shadow_pass(sun_shadow_library().value()));
    ambient_sums = AmbientSums(device, frame);
    sun_sums = SunSums(device, frame);
    const FrameParts sums = {.sun_visibility = &sun_sums.visible, .ambient = &ambient_sums.open};
    composite = CompositePass::create(device, frame, composite_library().value(), sums).value();
  }

  // Starts the frame at `seconds`, seen from `camera` through `jitter`.
  void begin(double seconds, const glm::vec2& jitter = glm::vec2(0.0f)) {
    rtapi::CommandList list = device.CreateCommandList().value();
    manager.record(list, evaluate_instances(scene, seconds), camera.position()).value();
    FrameTime time;
    time.index = index;
    time.previous_camera = previous_camera.value_or(camera);
    time.jitter = jitter;
    time.previous_jitter = previous_jitter;
    frame.set_camera(device, scene, camera, time).value();
    gbuffer.dispatch(list, frame, {}, frame.height());
    queue.ExecuteAndWait(list).value();
    previous_camera = camera;
    previous_jitter = jitter;
  }
  // Ambient occlusion, sun and radiance; `samples` continue the previous frame's sequence.
  void light(std::uint32_t samples) {
    rtapi::CommandList list = device.CreateCommandList().value();
    PassConstants constants;
    constants.first_sample = index * samples;
    constants.sample_count = samples;
    constants.radius = 1.0f;
    constants.accumulate = 0;
    ambient.dispatch(list, frame, constants, frame.height(), ambient_sums.arguments());
    sun.dispatch(list, frame, constants, frame.height(), sun_sums.arguments());
    composite.dispatch(list, frame, {samples, samples});
    queue.ExecuteAndWait(list).value();
    ++index;
  }
  // Radiance without noise: the sky lights everything, and only the G-buffer needs rays.
  void light_by_the_sky() {
    run([&](rtapi::CommandList& list) { composite.dispatch(list, frame, {}); });
    ++index;
  }

  template <class F>
  void run(const F& record) {
    rtapi::CommandList list = device.CreateCommandList().value();
    record(list);
    queue.ExecuteAndWait(list).value();
  }
  FloatImage read(FrameTexture texture) { return frame.read(device, queue, texture).value(); }
  FloatImage read(const rtapi::Texture& texture) {
    return read_picture(device, queue, texture).value();
  }
  void write(FrameTexture texture, const FloatImage& image) {
    rtapi::UploadTexture(device, queue, frame.texture(texture), 0,
                         std::as_bytes(std::span(image.values)))
        .value();
  }

  Scene scene;
  Camera camera;
  rtapi::Device device;
  rtapi::CommandQueue queue;
  StructureManager manager;
  Frame frame;
  RayPass gbuffer, ambient, sun;
  AmbientSums ambient_sums;
  SunSums sun_sums;
  CompositePass composite;
  std::optional<Camera> previous_camera;
  glm::vec2 previous_jitter{0.0f};
  std::uint32_t index = 0;
};

}  // namespace kaamos::effects
