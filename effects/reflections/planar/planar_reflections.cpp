// SPDX-License-Identifier: MIT
#include "effects/reflections/planar/planar_reflections.h"

#include <shaders/planar_reflections.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"
#include "effects/engine/scene_draws.h"
#include "effects/reflections/environment_map/environment_map.h"
#include "effects/reflections/planar/mirrored_draws.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kPlanes = 4;               // register t, space3
constexpr std::uint32_t kMirrored = 1, kMips = 2;  // register u, space3
constexpr std::uint32_t kEnvironment = 2;
constexpr std::uint32_t kLevels = 6;  // as in planar_reflections.hlsl

// Mirrors MirrorPlane of planar_reflections.hlsl.
struct PlaneConstants {
  glm::vec4 plane{0.0f};
  std::uint32_t mask = 0;
  std::uint32_t padding[3] = {};
};

std::uint32_t level_size(std::uint32_t size, std::uint32_t level) {
  return std::max((size + (1u << level) - 1) >> level, 1u);
}

RayPassDesc mirrored_pass(const rtapi::ShaderLibrary& library, PlanarSource source) {
  return reflection_shading_pass("mirrored scene", library,
                                 source == PlanarSource::kDraws ? "ShadeDrawn" : "PlanarRayGen");
}

class PlanarReflections : public EffectPass {
 public:
  explicit PlanarReflections(const EffectScope& scope)
      : device_(scope.device),
        frame_(scope.frame),
        views_(scope.views),
        planes_(find_mirror_planes(scope.scene, scope.settings.get_constants<PlanarConstants>())) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<PlanarConstants>();
    width_ = constants.width == 0 ? frame_.width() : constants.width;
    height_ = constants.height == 0 ? frame_.height() : constants.height;
    if (width_ > frame_.width() || height_ > frame_.height()) {
      return make_error(ErrorId::kPlanarReflections,
                        "a plane's picture has " + std::to_string(width_) + " x " +
                            std::to_string(height_) + " texels and the frame " +
                            std::to_string(frame_.width()) + " x " +
                            std::to_string(frame_.height()) + "; choose no more, or 0");
    }
    const auto& library = scope.library("reflections/planar/planar_reflections");
    auto mirrored =
        RayPass::create(device_, frame_, scope.gpu, mirrored_pass(library, constants.source));
    if (!mirrored) return mirrored.error();
    mirrored_ = std::move(*mirrored);
    auto blur = ComputePass::create(device_, frame_, library, "BlurMirrored");
    if (!blur) return blur.error();
    blur_ = std::move(*blur);
    auto look_up = ComputePass::create(device_, frame_, library, "PlanarReflections");
    if (!look_up) return look_up.error();
    look_up_ = std::move(*look_up);
    if (const auto s = create_pictures(); !s) return s;
    if (constants.source == PlanarSource::kDraws && !planes_.empty()) {
      auto draws = MirroredDraws::create(scope, library, width_, height_);
      if (!draws) return draws.error();
      draws_ = std::move(*draws);
    }
    auto map = EnvironmentFallback::create(scope, constants.fallback == kEnvironment);
    if (!map) return map.error();
    environment_ = std::move(*map);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    std::vector<PlaneConstants> planes;
    for (const MirrorPlane& plane : planes_) {
      const double distance = glm::dot(plane.point - camera.position(), plane.normal);
      const double side = distance <= 0 ? 1 : -1;
      planes.push_back(
          {glm::vec4(glm::vec3(side * plane.normal), static_cast<float>(side * distance)),
           plane.is_mirror ? kMaskSolid : kMaskCasters});
    }
    if (planes.empty()) planes.emplace_back();
    const auto buffer = rtapi::CreateUploadBuffer(device_, planes, "mirror planes");
    if (!buffer) return buffer.error();
    plane_buffer_ = *buffer;
    if (const auto s = views_.set_shader_resource(kPlanes, plane_buffer_, sizeof(PlaneConstants));
        !s) {
      return s;
    }
    if (draws_) draws_->begin_frame(camera);
    return environment_.begin_frame(camera);
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto words = settings.get_constants<PlanarConstants>();
    words.plane_count = static_cast<std::uint32_t>(planes_.size());
    words.width = width_;
    words.height = height_;
    if (draws_) words.clip_scale = draws_->clip_scale();
    for (words.plane = 0; words.plane < words.plane_count; ++words.plane) {
      const PassArguments arguments(views_, words);
      if (draws_) draws_->record(list, frame_, arguments);
      mirrored_.dispatch_grid(list, frame_, constants, width_, height_, arguments);
      for (words.level = 1; words.level <= kLevels; ++words.level) {
        blur_.dispatch(list, frame_, constants, PassArguments(views_, words),
                       level_size(width_, words.level), level_size(height_, words.level));
      }
    }
    look_up_.dispatch(list, frame_, constants, PassArguments(views_, words), frame_.width(),
                      frame_.height());
  }

  std::uint64_t bytes() const override {
    return picture_bytes(picture_) + picture_bytes(mips_) + environment_.bytes() +
           (draws_ ? draws_->bytes() : 0);
  }

 private:
  rtapi::Status create_pictures() {
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(planes_.size(), 1));
    const auto picture = create_picture(device_, "mirrored scene",
                                        rtapi::Format::kR32G32B32A32Float, width_ * count, height_);
    if (!picture) return picture.error();
    picture_ = *picture;
    std::uint32_t width = 0;
    for (std::uint32_t level = 1; level <= kLevels; ++level) width += level_size(width_, level);
    const auto mips =
        create_picture(device_, "mirrored scene's mips", rtapi::Format::kR32G32B32A32Float,
                       width * count, level_size(height_, 1));
    if (!mips) return mips.error();
    mips_ = *mips;
    if (const auto s = views_.set_unordered_access(kMirrored, picture_); !s) return s;
    return views_.set_unordered_access(kMips, mips_);
  }

  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  std::vector<MirrorPlane> planes_;
  std::uint32_t width_ = 0, height_ = 0;
  RayPass mirrored_;
  ComputePass blur_, look_up_;
  rtapi::Texture picture_, mips_;
  std::optional<MirroredDraws> draws_;
  rtapi::Buffer plane_buffer_;
  EnvironmentFallback environment_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> planar_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_planar_reflections());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_planar_reflections(const EffectScope& scope) {
  return make_pass<PlanarReflections>(scope);
}

}  // namespace kaamos::effects
