// SPDX-License-Identifier: MIT
#include "effects/shadows/shadow_map/shadow_map.h"

#include <shaders/shadow_draws.h>
#include <shaders/shadow_map.h>

#include <algorithm>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/shadows/shadow_map/disk_points.h"
#include "effects/shadows/shadow_map/map_draws.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kDiskPoints = 64;  // of shadow_map.hlsli
constexpr std::uint32_t kMostTexels = 16384, kMostCascades = 4;

constexpr const char* kEntryPoints[kShadowMapMethodCount] = {
    "ShadowMapHard", "ShadowMapPcf", "ShadowMapPcss", "ShadowMapBackprojection"};

rtapi::Status check(const char* what, std::uint32_t value, std::uint32_t least,
                    std::uint32_t most) {
  if (value >= least && value <= most) return {};
  return make_error(ErrorId::kShadowMap, std::string(what) + " is " + std::to_string(value) +
                                             "; choose " + std::to_string(least) + " to " +
                                             std::to_string(most));
}

rtapi::Status check(const char* what, float value, float least, float most) {
  if (value >= least && value <= most) return {};
  return make_error(ErrorId::kShadowMap, std::string(what) + " is " + std::to_string(value) +
                                             "; choose " + std::to_string(least) + " to " +
                                             std::to_string(most));
}

class ShadowMapPass : public EffectPass {
 public:
  explicit ShadowMapPass(const EffectScope& scope)
      : frame_(scope.frame),
        scene_(scope.scene),
        views_(scope.views),
        made_(scope.settings.get_constants<ShadowMapConstants>()) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto method =
        check("ShadowMapConstants::method", made_.method, 0, kShadowMapMethodCount - 1);
    if (!method) return method;
    if (const auto s = check_shadow_map(made_); !s) return s;
    const auto& draws = scope.library("shadows/shadow_map/shadow_draws");
    if (const auto s = draws_.create(scope, draws, made_.size, map_count()); !s) return s;
    const auto disk = bind_disk(scope);
    if (!disk) return disk.error();
    disk_ = *disk;
    auto look_up =
        ComputePass::create(scope.device, frame_, scope.library("shadows/shadow_map/shadow_map"),
                            kEntryPoints[made_.method]);
    if (!look_up) return look_up.error();
    look_up_ = std::move(*look_up);
    return {};
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    draws_.see_instances(camera.position());
    auto desc = describe_sun_maps(made_, scene_, draws_.bounds(), frame_);
    if (is_per_object()) find_objects(desc);
    draws_.set_maps(sun_maps(desc, camera));
    return {};
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto own = settings.get_constants<ShadowMapConstants>();
    own.size = made_.size;
    own.cascades = map_count();
    draws_.record(list, own);
    look_up_.dispatch(list, frame_, constants, PassArguments(views_, own), frame_.width(),
                      frame_.height());
  }

  std::uint64_t bytes() const override { return draws_.bytes() + disk_.size(); }

 private:
  bool is_per_object() const { return (made_.flags & kShadowMapPerObject) != 0; }
  std::uint32_t map_count() const {
    return is_per_object() ? made_.cascades + 1 : std::max(made_.cascades, 1u);
  }

  // Replaces the cascades of `desc` by as many objects.
  void find_objects(SunMapsDesc& desc) const {
    const std::uint32_t count = std::exchange(desc.cascades, 0u);
    const auto& instances = scene_.instances;
    for (std::uint32_t i = 0; i < instances.size() && desc.objects.size() < count; ++i) {
      if (instances[i].build_class == BuildClass::kHero)
        desc.objects.push_back(draws_.bounds_of(i));
    }
    desc.objects.resize(count);
    desc.border = made_.method == kShadowMapHard ? 0.0 : made_.radius;
  }

  const Frame& frame_;
  const Scene& scene_;
  PassViews& views_;
  const ShadowMapConstants made_;
  ShadowMapDraws draws_;
  rtapi::Buffer disk_;
  ComputePass look_up_;
};

}  // namespace

rtapi::Status check_shadow_map(const ShadowMapConstants& c) {
  constexpr float kAny = 1e9f;
  for (const rtapi::Status& status :
       {check("ShadowMapConstants::size", c.size, 4, kMostTexels),
        check("ShadowMapConstants::cascades", c.cascades, 0, kMostCascades),
        check("ShadowMapConstants::taps", c.taps, 1, kDiskPoints),
        check("ShadowMapConstants::blocker_taps", c.blocker_taps, 1, kDiskPoints),
        check("ShadowMapConstants::constant_bias", c.constant_bias, -kAny, kAny),
        check("ShadowMapConstants::slope_bias", c.slope_bias, -kAny, kAny),
        check("ShadowMapConstants::normal_offset", c.normal_offset, -kAny, kAny),
        check("ShadowMapConstants::most_bias", c.most_bias, 0.0f, kAny),
        check("ShadowMapConstants::radius", c.radius, 0.0f, kAny),
        check("ShadowMapConstants::blend", c.blend, 0.0f, 1.0f),
        check("ShadowMapConstants::split_share", c.split_share, 0.0f, 1.0f),
        check("ShadowMapConstants::reach", c.reach, 0.0f, kAny)}) {
    if (!status) return status;
  }
  return {};
}

rtapi::Result<rtapi::Buffer> bind_disk(const EffectScope& scope) {
  auto disk = rtapi::CreateUploadBuffer(scope.device, disk_points(kDiskPoints), "disk");
  if (!disk) return disk.error();
  if (const auto s = scope.views.set_shader_resource(3, *disk, sizeof(glm::vec2)); !s) {
    return s.error();
  }
  return disk;
}

SunMapsDesc describe_sun_maps(const ShadowMapConstants& constants, const Scene& scene,
                              const Bounds& bounds, const Frame& frame) {
  SunMapsDesc desc;
  if (scene.sun) desc.direction_to_sun = glm::normalize(glm::dvec3(scene.sun->direction_to_sun));
  desc.bounds = bounds;
  desc.size = constants.size;
  desc.cascades = constants.cascades;
  desc.aspect = static_cast<double>(frame.width()) / frame.height();
  desc.split_share = constants.split_share;
  desc.reach = constants.reach;
  desc.stable = (constants.flags & kShadowMapTight) == 0;
  return desc;
}

rtapi::Result<rtapi::ShaderLibrary> shadow_draws_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_shadow_draws());
}

rtapi::Result<rtapi::ShaderLibrary> shadow_map_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_shadow_map());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_shadow_map(const EffectScope& scope) {
  return make_pass<ShadowMapPass>(scope);
}

}  // namespace kaamos::effects
