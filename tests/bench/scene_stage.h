// SPDX-License-Identifier: MIT
//
// A scene on the Embree device with its frame and its G-buffer, for cases that time passes one by
// one.
#pragma once

#include <functional>

#include "effects/engine/frame.h"
#include "effects/engine/gpu_scene.h"
#include "effects/engine/ray_pass.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "suite.h"

namespace kaamos::bench {

struct SceneStage {
  // Pictures of `width` x `height`, seen by the scene's first camera.
  SceneStage(effects::Scene given, uint32_t threads, uint32_t width, uint32_t height)
      : scene(std::move(given)) {
    rtapi::DeviceDesc device_desc;
    device_desc.Threads = threads;
    device = rtapi::CreateDevice(device_desc).value();
    queue = device.CreateCommandQueue().value();
    const effects::Camera& camera = scene.cameras.front();
    gpu = effects::create_gpu_scene(device, queue, scene, camera.position()).value();
    effects::FrameDesc desc;
    desc.width = width;
    desc.height = height;
    frame = effects::Frame::create(device, scene, gpu, camera, desc).value();
    const auto gbuffer =
        effects::RayPass::create(device, frame, gpu,
                                 effects::gbuffer_pass(effects::gbuffer_library().value()))
            .value();
    run([&](rtapi::CommandList& list) { gbuffer.dispatch(list, frame, {}, height); });
  }

  void run(const std::function<void(rtapi::CommandList&)>& record) {
    rtapi::CommandList list = device.CreateCommandList().value();
    record(list);
    queue.ExecuteAndWait(list).value();
  }

  effects::Scene scene;
  rtapi::Device device;
  rtapi::CommandQueue queue;
  effects::GpuScene gpu;
  effects::Frame frame;
};

}  // namespace kaamos::bench
