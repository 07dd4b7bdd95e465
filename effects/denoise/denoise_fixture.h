// SPDX-License-Identifier: MIT
// A sphere over a plane, its G-buffer, and one signal that the test fills.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/upload.h>

#include <cmath>
#include <functional>
#include <span>
#include <string>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/denoise/denoise.h"
#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {

class DenoiseFixture : public testing::Test {
 protected:
  explicit DenoiseFixture(std::uint32_t width = 64, std::uint32_t height = 40,
                          const std::string& backend = "embree")
      : kWidth(width), kHeight(height), scene_(make_sphere_oracle(1.0, 1.5)) {
    rtapi::DeviceDesc device_desc;
    device_desc.Backend = backend;
    device_ = test::device_for(device_desc);
    queue_ = device_.CreateCommandQueue().value();
    const Camera& camera = scene_.cameras.front();
    gpu_ = create_gpu_scene(device_, queue_, scene_, camera.position()).value();
    FrameDesc desc;
    desc.width = kWidth;
    desc.height = kHeight;
    desc.max_pass_views = 4096;  // one test makes many denoisers
    frame_ = Frame::create(device_, scene_, gpu_, camera, desc).value();
    gbuffer_ =
        RayPass::create(device_, frame_, gpu_, gbuffer_pass(gbuffer_library().value())).value();
    signal_ = frame_.create_picture(device_, "signal", rtapi::Format::kR32G32B32A32Float).value();
    render_gbuffer();
  }

  void render_gbuffer() {
    rtapi::CommandList list = device_.CreateCommandList().value();
    gbuffer_.dispatch(list, frame_, {}, kHeight);
    queue_.ExecuteAndWait(list).value();
    view_z_ = frame_.read(device_, queue_, kViewZ).value();
    ids_ = frame_.read(device_, queue_, kIds).value();
    position_ = frame_.read(device_, queue_, kPosition).value();
  }

  Denoiser make(const DenoiseDesc& desc) {
    return Denoiser::create(device_, frame_, denoise_libraries().value(), "test", signal_, desc)
        .value();
  }

  using Value = std::function<float(std::uint32_t, std::uint32_t)>;

  void upload(const rtapi::Texture& texture, const FloatImage& image) {
    rtapi::UploadTexture(device_, queue_, texture, 0, std::as_bytes(std::span(image.values)))
        .value();
  }

  // Runs one frame of a grey signal; `hit` is its w.
  FloatImage run(Denoiser& denoiser, const Value& value, float hit = 0.0f) {
    FloatImage image(kWidth, kHeight, 4, hit);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const float v = value(x, y);
        for (std::uint32_t c = 0; c < 3; ++c) image.at(x, y, c) = v;
      }
    }
    upload(signal_, image);
    rtapi::CommandList list = device_.CreateCommandList().value();
    denoiser.dispatch(list, frame_);
    queue_.ExecuteAndWait(list).value();
    return read_picture(device_, queue_, denoiser.result()).value();
  }

  bool is_surface(std::uint32_t x, std::uint32_t y) const { return view_z_.at(x, y) > 0; }
  bool is_sphere(std::uint32_t x, std::uint32_t y) const { return ids_.at(x, y, 0) == 2.0f; }

  // Visits the surface pixels.
  template <class F>
  void for_surface(F visit) const {
    for (std::uint32_t y = 0; y < kHeight; ++y) {
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        if (is_surface(x, y)) visit(x, y);
      }
    }
  }

  const std::uint32_t kWidth, kHeight;
  Scene scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  RayPass gbuffer_;
  rtapi::Texture signal_;
  FloatImage view_z_, ids_, position_;
};

}  // namespace kaamos::effects
