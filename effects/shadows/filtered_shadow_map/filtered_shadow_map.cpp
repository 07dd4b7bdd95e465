// SPDX-License-Identifier: MIT
#include "effects/shadows/filtered_shadow_map/filtered_shadow_map.h"

#include <shaders/filtered_shadow_map.h>

#include <algorithm>
#include <string>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/compute_pass.h"
#include "effects/engine/texel.h"
#include "effects/shadows/shadow_map/map_draws.h"

namespace kaamos::effects {
namespace {

using rtapi::Format;
using rtapi::ResourceStates;

// Registers of filtered_shadow_map.hlsl.
constexpr std::uint32_t kStored = 5, kHalfFiltered = 6, kHalfFilteredOut = 1, kLevels = 2;

// The format of the maps' texels and the shader that looks them up, by method.
struct MethodRow {
  Format format;
  const char* look_up;
};
constexpr MethodRow kMethods[kFilteredShadowMapMethodCount] = {
    {Format::kR32G32Float, "LookUpVariance"},
    {Format::kR32Float, "LookUpExponential"},
    {Format::kR32G32B32A32Float, "LookUpExponentialVariance"},
    {Format::kR8G8B8A8Unorm, "LookUpConvolution"},
    {Format::kR32G32Float, "LookUpPcssVariance"},
    {Format::kR16G16B16A16Float, "LookUpPcssConvolution"},
};

bool is_pcss(const FilteredShadowMapConstants& constants) {
  return constants.map.method == kFilteredPcssVariance ||
         constants.map.method == kFilteredPcssConvolution;
}

// Returns how many slices a map has. [SliceCount in filtered_shadow_map.hlsl]
std::uint32_t slice_count(const FilteredShadowMapConstants& constants) {
  const std::uint32_t series = (constants.terms + 1) / 2;
  if (constants.map.method == kFilteredPcssConvolution) return 2 * series + 1;
  return constants.map.method == kFilteredConvolution ? series : 1;
}

rtapi::Status wrong(const std::string& what, const std::string& value, const std::string& cure) {
  return make_error(ErrorId::kFilteredShadowMap,
                    "FilteredShadowMapConstants::" + what + " is " + value + "; choose " + cure);
}

rtapi::Status in_range(const char* what, float value, float least, float most) {
  if (value >= least && value <= most) return {};
  return wrong(what, std::to_string(value), std::to_string(least) + " to " + std::to_string(most));
}

rtapi::Status check_filter(const FilteredShadowMapConstants& c) {
  if (c.map.method >= kFilteredShadowMapMethodCount) {
    return wrong("map.method", std::to_string(c.map.method),
                 "0 to " + std::to_string(kFilteredShadowMapMethodCount - 1));
  }
  if (c.terms < 1 || c.terms > 16) return wrong("terms", std::to_string(c.terms), "1 to 16");
  if (is_pcss(c) && (c.map.size & (c.map.size - 1)) != 0) {
    return wrong("map.size", std::to_string(c.map.size), "a power of two for PCSS");
  }
  // exp(87) and exp(2 * 42) are the largest that leave room for sums, and 1 over them is no
  // denormal.
  const bool twice = c.map.method == kFilteredExponentialVariance;
  for (const rtapi::Status& status :
       {check_shadow_map(c.map), in_range("exponent", c.exponent, 1e-3f, twice ? 42.0f : 87.0f),
        in_range("back_exponent", c.back_exponent, 1e-3f, 42.0f),
        in_range("damping", c.damping, 0.0f, 20.0f),
        in_range("reduce_bleeding", c.reduce_bleeding, 0.0f, 0.99f),
        in_range("least_variance", c.least_variance, 0.0f, 1.0f),
        in_range("offset", c.offset, 0.0f, 1.0f)}) {
    if (!status) return status;
  }
  return {};
}

class FilteredShadowMapPass : public EffectPass {
 public:
  explicit FilteredShadowMapPass(const EffectScope& scope)
      : frame_(scope.frame),
        scene_(scope.scene),
        views_(scope.views),
        made_(scope.settings.get_constants<FilteredShadowMapConstants>()) {}

  rtapi::Status create(const EffectScope& scope) {
    if (const auto s = check_filter(made_); !s) return s;
    const auto& draws = scope.library("shadows/shadow_map/shadow_draws");
    if (const auto s = draws_.create(scope, draws, made_.map.size, map_count()); !s) return s;
    if (const auto s = create_maps(scope.device); !s) return s;
    if (const auto s = create_pass(scope, "StoreMap", store_); !s) return s;
    if (const auto s = create_pass(scope, kMethods[made_.map.method].look_up, look_up_); !s) {
      return s;
    }
    if (is_pcss(made_)) return create_pass(scope, "HalveLevel", halve_);
    if (const auto s = create_pass(scope, "FilterRows", rows_); !s) return s;
    return create_pass(scope, "FilterColumns", columns_);
  }

  rtapi::Status begin_frame(const Camera& camera) override {
    draws_.see_instances(camera.position());
    draws_.set_maps(
        sun_maps(describe_sun_maps(made_.map, scene_, draws_.bounds(), frame_), camera));
    return {};
  }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    auto own = settings.get_constants<FilteredShadowMapConstants>();
    own.map.method = made_.map.method;
    own.map.size = made_.map.size;
    own.map.cascades = map_count();
    own.terms = made_.terms;
    draws_.record(list, own.map);
    own.level = 0;
    record_maps(list, store_, own, constants);
    if (is_pcss(made_)) {
      for (own.level = 1; own.level < level_count_; ++own.level) {
        record_maps(list, halve_, own, constants);
      }
      own.level = 0;
      transition(list, stored_, true);
    } else {
      transition(list, stored_, true);
      record_maps(list, rows_, own, constants);
      transition(list, half_filtered_, true);
      transition(list, stored_, false);
      record_maps(list, columns_, own, constants);
      transition(list, half_filtered_, false);
      transition(list, stored_, true);
    }
    look_up_.dispatch(list, frame_, constants, PassArguments(views_, own), frame_.width(),
                      frame_.height());
    transition(list, stored_, false);
  }

  std::uint64_t bytes() const override {
    return draws_.bytes() + bytes_of(stored_) + bytes_of(half_filtered_);
  }

 private:
  std::uint32_t map_count() const { return std::max(made_.map.cascades, 1u); }

  rtapi::Status create_pass(const EffectScope& scope, const char* name, ComputePass& pass) {
    const auto& library = scope.library("shadows/filtered_shadow_map/filtered_shadow_map");
    auto made = ComputePass::create(scope.device, frame_, library, name);
    if (!made) return made.error();
    pass = std::move(*made);
    return {};
  }

  rtapi::Status create_maps(const rtapi::Device& device) {
    const bool has_levels = is_pcss(made_);
    while (has_levels && (made_.map.size >> level_count_) > 0) ++level_count_;
    rtapi::TextureDesc desc;
    desc.Width = desc.Height = made_.map.size;
    desc.DepthOrArraySize = static_cast<std::uint16_t>(map_count() * slice_count(made_));
    desc.MipLevels = static_cast<std::uint16_t>(level_count_);
    desc.Format = kMethods[made_.map.method].format;
    desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = ResourceStates::kUnorderedAccess;
    desc.Name = "filtered shadow maps";
    if (const auto s = create_map(device, desc, stored_, kStored); !s) return s;
    for (std::uint32_t level = 0; level < level_count_; ++level) {
      if (const auto s = set_output(stored_, kLevels + level, level); !s) return s;
    }
    if (has_levels) return {};
    desc.Name = "half filtered shadow maps";
    if (const auto s = create_map(device, desc, half_filtered_, kHalfFiltered); !s) return s;
    return set_output(half_filtered_, kHalfFilteredOut, 0);
  }

  rtapi::Status create_map(const rtapi::Device& device, const rtapi::TextureDesc& desc,
                           rtapi::Texture& map, std::uint32_t t) {
    const auto made = device.CreateTexture(desc);
    if (!made) return made.error();
    map = *made;
    rtapi::ShaderResourceViewDesc view;
    view.Format = desc.Format;
    view.ViewDimension = rtapi::SrvDimension::kTexture2DArray;
    return views_.set_shader_resource(t, map, view);
  }

  rtapi::Status set_output(const rtapi::Texture& map, std::uint32_t u, std::uint32_t level) {
    rtapi::UnorderedAccessViewDesc view;
    view.Format = map.GetDesc().Format;
    view.ViewDimension = rtapi::UavDimension::kTexture2DArray;
    view.Texture2DArray.MipSlice = level;
    return views_.set_unordered_access(u, map, view);
  }

  // A dispatch for each map, over the texels of the level that `own` names.
  void record_maps(rtapi::CommandList& list, const ComputePass& pass,
                   FilteredShadowMapConstants own, const PassConstants& constants) const {
    const std::uint32_t side = made_.map.size >> own.level;
    for (own.map.map = 0; own.map.map < map_count(); ++own.map.map) {
      pass.dispatch(list, frame_, constants, PassArguments(views_, own), side, side);
    }
  }

  static void transition(rtapi::CommandList& list, const rtapi::Texture& map, bool to_read) {
    const ResourceStates states[] = {ResourceStates::kUnorderedAccess,
                                     ResourceStates::kNonPixelShaderResource};
    list.ResourceBarrier(
        rtapi::ResourceBarrier::Transition(map, states[to_read ? 0 : 1], states[to_read ? 1 : 0]));
  }

  static std::uint64_t bytes_of(const rtapi::Texture& map) {
    if (!map) return 0;
    const rtapi::TextureDesc desc = map.GetDesc();
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < desc.MipLevels; ++level) {
      const std::uint64_t side = std::max<std::uint64_t>(desc.Width >> level, 1);
      texels += side * side;
    }
    return texels * desc.DepthOrArraySize * texel_bytes(desc.Format);
  }

  const Frame& frame_;
  const Scene& scene_;
  PassViews& views_;
  const FilteredShadowMapConstants made_;
  ShadowMapDraws draws_;
  std::uint32_t level_count_ = 1;
  rtapi::Texture stored_, half_filtered_;
  ComputePass store_, rows_, columns_, halve_, look_up_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> filtered_shadow_map_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_filtered_shadow_map());
}

rtapi::Result<std::unique_ptr<EffectPass>> make_filtered_shadow_map(const EffectScope& scope) {
  return make_pass<FilteredShadowMapPass>(scope);
}

}  // namespace kaamos::effects
