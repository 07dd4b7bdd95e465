// SPDX-License-Identifier: MIT
#include "effects/reflections/planar/planar_reflections.h"

#include <shaders/planar_reflections.h>

#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/picture.h"
#include "effects/engine/ray_pass.h"
#include "effects/reflections/environment_map/environment_map.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kPlanes = 4;    // register t, space3
constexpr std::uint32_t kMirrored = 1;  // register u, space3
constexpr std::uint32_t kEnvironment = 2;

RayPassDesc mirrored_pass(const rtapi::ShaderLibrary& library) {
  RayPassDesc desc;
  desc.name = "mirrored scene";
  desc.library = library;
  desc.ray_generation = "PlanarRayGen";
  desc.miss[kRayTypeSurface] = "ReflectionMiss";
  desc.miss[kRayTypeVisibility] = "VisibilityMiss";
  desc.hit[kRayTypeSurface] = {"ReflectionAnyHit", "ReflectionClosestHit"};
  desc.hit[kRayTypeVisibility].any_hit = "VisibilityAnyHit";
  desc.payload_bytes = 28;
  desc.max_recursion_depth = 2;
  return desc;
}

class PlanarReflections : public EffectPass {
 public:
  explicit PlanarReflections(const EffectScope& scope)
      : device_(scope.device),
        frame_(scope.frame),
        views_(scope.views),
        planes_(find_mirror_planes(scope.scene)) {}

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
    auto mirrored = RayPass::create(device_, frame_, scope.gpu, mirrored_pass(library));
    if (!mirrored) return mirrored.error();
    mirrored_ = std::move(*mirrored);
    auto look_up = ComputePass::create(device_, frame_, library, "PlanarReflections");
    if (!look_up) return look_up.error();
    look_up_ = std::move(*look_up);
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(planes_.size(), 1));
    const auto picture = create_picture(device_, "mirrored scene",
                                        rtapi::Format::kR32G32B32A32Float, width_ * count, height_);
    if (!picture) return picture.error();
    picture_ = *picture;
    if (const auto s = views_.set_unordered_access(kMirrored, picture_); !s) return s;
    auto map = EnvironmentFallback::create(scope, constants.fallback == kEnvironment);
    if (!map) return map.error();
    environment_ = std::move(*map);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    std::vector<glm::vec4> planes;
    for (const MirrorPlane& plane : planes_) {
      const double distance = glm::dot(plane.point - camera.position(), plane.normal);
      const double side = distance <= 0 ? 1 : -1;
      planes.emplace_back(glm::vec3(side * plane.normal), static_cast<float>(side * distance));
    }
    if (planes.empty()) planes.emplace_back(0.0f);
    const auto buffer = rtapi::CreateUploadBuffer(device_, planes, "mirror planes");
    if (!buffer) return buffer.error();
    plane_buffer_ = *buffer;
    if (const auto s = views_.set_shader_resource(kPlanes, plane_buffer_, sizeof(glm::vec4)); !s) {
      return s;
    }
    return environment_.begin_frame(camera);
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto words = settings.get_constants<PlanarConstants>();
    words.plane_count = static_cast<std::uint32_t>(planes_.size());
    words.width = width_;
    words.height = height_;
    for (words.plane = 0; words.plane < words.plane_count; ++words.plane) {
      mirrored_.dispatch_grid(list, frame_, constants, width_, height_,
                              PassArguments(views_, words));
    }
    look_up_.dispatch(list, frame_, constants, PassArguments(views_, words), frame_.width(),
                      frame_.height());
  }

  std::uint64_t bytes() const override { return picture_bytes(picture_) + environment_.bytes(); }

 private:
  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  std::vector<MirrorPlane> planes_;
  std::uint32_t width_ = 0, height_ = 0;
  RayPass mirrored_;
  ComputePass look_up_;
  rtapi::Texture picture_;
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
