// SPDX-License-Identifier: MIT
// A frame whose depth picture is a height field that a test writes, and the techniques over it.
#pragma once

#include <rtapi/upload.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/engine/picture.h"
#include "effects/occlusion/screen_space_ao/line_sweep_ao.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {

/// Depth and normals that a camera at the origin would see; it looks along -z.
class HeightField {
 public:
  using Depth = std::function<float(std::uint32_t x, std::uint32_t y)>;
  using Normal = std::function<glm::vec3(std::uint32_t x, std::uint32_t y)>;

  HeightField(const std::string& backend, std::uint32_t width, std::uint32_t height, double fov)
      : width_(width), height_(height), scene_(make_wall_oracle(1)) {
    rtapi::DeviceDesc device;
    device.Backend = backend;
    device_ = test::device_for(device);
    queue_ = device_.CreateCommandQueue().value();
    Camera& camera = scene_.cameras.front();
    camera.camera_to_world = glm::dmat4(1.0);
    camera.vertical_fov = fov;
    gpu_ = create_gpu_scene(device_, queue_, scene_, camera.position()).value();
    FrameDesc desc;
    desc.width = width;
    desc.height = height;
    frame_ = Frame::create(device_, scene_, gpu_, camera, desc).value();
    result_ = frame_.create_picture(device_, "result", rtapi::Format::kR32G32B32A32Float).value();
    bent_ = frame_.create_picture(device_, "bent", rtapi::Format::kR32G32B32A32Float).value();
  }

  HeightField(const HeightField&) = delete;  // its passes point into it

  /// Normals in view space: z into the picture. Empty: towards the camera.
  void fill(const Depth& depth, const Normal& normal = {}) {
    std::vector<float> z;
    std::vector<std::int16_t> normals;
    for (std::uint32_t y = 0; y < height_; ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        z.push_back(depth(x, y));
        const glm::vec3 n = normal ? normal(x, y) : glm::vec3(0, 0, -1);
        const glm::vec3 world(n.x, n.y, -n.z);
        const float over = 1 / (std::abs(world.x) + std::abs(world.y) + std::abs(world.z));
        // Normals towards the camera have no folded part.
        normals.push_back(static_cast<std::int16_t>(std::lround(world.x * over * 32767)));
        normals.push_back(static_cast<std::int16_t>(std::lround(world.y * over * 32767)));
      }
    }
    const auto upload = [&](FrameTexture texture, std::span<const std::byte> bytes) {
      rtapi::UploadTexture(device_, queue_, frame_.texture(texture), 0, bytes).value();
    };
    upload(kViewZ, std::as_bytes(std::span(z)));
    upload(kNormal, std::as_bytes(std::span(normals)));
    upload(kShadingNormal, std::as_bytes(std::span(normals)));
  }

  /// Grey, no metal: the same for all pixels, as the picture of colours holds it.
  void paint(std::uint8_t encoded) {
    const std::vector<std::uint8_t> colors(std::size_t{4} * width_ * height_, encoded);
    rtapi::UploadTexture(device_, queue_, frame_.texture(kBaseColor), 0,
                         std::as_bytes(std::span(colors)))
        .value();
  }
  /// Goes on to a frame of the sequence; the camera is at rest.
  void set_frame(std::uint32_t index) {
    const Camera& camera = scene_.cameras.front();
    frame_.set_camera(device_, scene_, camera, {.index = index, .previous_camera = camera}).value();
  }
  /// The next run has no frames before.
  void forget(ScreenSpaceAoKind kind) { techniques_[static_cast<std::size_t>(kind)] = {}; }

  /// Visibility by one technique.
  template <class Constants>
  FloatImage run(ScreenSpaceAoKind kind, const Constants& constants, float radius) {
    return first_channel(run_colored(kind, constants, radius));
  }
  /// The bent normals of the run before; 4 channels, in world space.
  FloatImage bent() { return read_picture(device_, queue_, bent_).value(); }
  /// As run writes it, 4 channels.
  template <class Constants>
  FloatImage run_colored(ScreenSpaceAoKind kind, const Constants& constants, float radius) {
    Technique& technique = techniques_[static_cast<std::size_t>(kind)];
    std::uint32_t pictures = 0;
    if constexpr (requires { constants.fresh; }) pictures += constants.fresh < 1 ? 1 : 0;
    if constexpr (requires { constants.bent_normals; }) pictures += 2 * constants.bent_normals;
    if (!technique.passes || technique.pictures != pictures) {
      using Load = rtapi::Result<rtapi::ShaderLibrary> (*)();
      constexpr Load kLibraries[] = {crytek_ao_library, hemisphere_ao_library, hbao_library,
                                     gtao_library};
      technique.pictures = pictures;
      technique.views = make_views();
      technique.views.set_unordered_access(3, bent_).value();
      technique.passes = ScreenSpaceAo::create(device_, frame_, kind,
                                               kLibraries[static_cast<std::size_t>(kind)]().value(),
                                               occlusion_filter_library().value(), technique.views,
                                               PassArguments(technique.views, constants).words)
                             .value();
    }
    const auto words = PassArguments(technique.views, constants).words;
    technique.passes->begin_frame().value();
    return execute([&](rtapi::CommandList& list) {
      technique.passes->record(list, frame_, {.radius = radius}, words);
    });
  }
  FloatImage run(const LineSweepSettings& settings,
                 float radius = std::numeric_limits<float>::infinity()) {
    if (!lines_) {
      line_views_ = make_views();
      lines_ = LineSweepAo::create(device_, frame_, line_sweep_ao_library().value(), line_views_)
                   .value();
    }
    return first_channel(execute([&](rtapi::CommandList& list) {
      lines_->record(list, frame_, {.radius = radius}, settings);
    }));
  }

 private:
  PassViews make_views() {
    PassViews views = frame_.create_pass_views(device_).value();
    views.set_unordered_access(0, result_).value();
    return views;
  }
  FloatImage execute(const std::function<void(rtapi::CommandList&)>& record) {
    rtapi::CommandList list = device_.CreateCommandList().value();
    record(list);
    queue_.ExecuteAndWait(list).value();
    return read_picture(device_, queue_, result_).value();
  }
  FloatImage first_channel(const FloatImage& picture) const {
    FloatImage out(width_, height_, 1);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = picture.values[4 * i];
    return out;
  }

  std::uint32_t width_, height_;
  Scene scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  rtapi::Texture result_, bent_;
  struct Technique {
    PassViews views;
    std::optional<ScreenSpaceAo> passes;
    std::uint32_t pictures = 0;  // which of those that only some constants need
  };
  std::array<Technique, 4> techniques_;
  PassViews line_views_;
  std::optional<LineSweepAo> lines_;
};

}  // namespace kaamos::effects
