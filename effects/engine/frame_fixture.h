// SPDX-License-Identifier: MIT
// A scene on a device with a frame of it, for tests that record its passes themselves.
#pragma once

#include <string>
#include <utility>

#include "effects/assets/scene/scene.h"
#include "effects/engine/frame.h"
#include "effects/engine/gpu_scene.h"
#include "effects/engine/ray_pass.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {

struct FrameStage {
  // Seen by the scene's first camera.
  FrameStage(Scene given, std::uint32_t width, std::uint32_t height,
             const rtapi::DeviceDesc& device_desc = {})
      : scene(std::move(given)) {
    device = test::device_for(device_desc);
    queue = device.CreateCommandQueue().value();
    const Camera& camera = scene.cameras.front();
    gpu = create_gpu_scene(device, queue, scene, camera.position()).value();
    FrameDesc desc;
    desc.width = width;
    desc.height = height;
    frame = Frame::create(device, scene, gpu, camera, desc).value();
  }

  static rtapi::DeviceDesc on(const std::string& backend) {
    rtapi::DeviceDesc desc;
    desc.Backend = backend;
    return desc;
  }
  // Executes what `record` records.
  template <class Record>
  void run(const Record& record) {
    rtapi::CommandList list = device.CreateCommandList().value();
    record(list);
    queue.ExecuteAndWait(list).value();
  }
  RayPass make_pass(const RayPassDesc& desc) const {
    return RayPass::create(device, frame, gpu, desc).value();
  }

  Scene scene;
  rtapi::Device device;
  rtapi::CommandQueue queue;
  GpuScene gpu;
  Frame frame;
};

}  // namespace kaamos::effects
