// SPDX-License-Identifier: MIT
#include "effects/reflections/tiled/tiled_reflections.h"

#include <shaders/tiled_reflections.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/ray_pass.h"
#include "effects/reflections/hybrid/hybrid_reflections.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kTile = 8;                      // pixels along a side
constexpr std::uint32_t kTiles = 3, kDispatchRays = 4;  // u, space3
constexpr const char* kLibrary = "reflections/tiled/tiled_reflections";
static_assert(offsetof(rtapi::DispatchRaysDesc, Height) == 4 * 23);  // kHeightWord

class TiledReflections : public EffectPass {
 public:
  explicit TiledReflections(const EffectScope& scope)
      : device_(scope.device), frame_(scope.frame), views_(scope.views) {}

  rtapi::Status create(const EffectScope& scope) {
    const auto constants = scope.settings.get_constants<TiledConstants>();
    auto inputs = ScreenInputs::create(scope, constants.screen);
    if (!inputs) return inputs.error();
    inputs_ = std::move(*inputs);
    auto classify = ComputePass::create(device_, frame_, scope.library(kLibrary), "ClassifyTiles");
    if (!classify) return classify.error();
    classify_ = std::move(*classify);
    auto rays = RayPass::create(
        device_, frame_, scope.gpu,
        reflection_shading_pass("tiled reflections", scope.library(kLibrary), "TiledRayGen"));
    if (!rays) return rays.error();
    rays_ = std::move(*rays);
    auto signature = device_.CreateCommandSignature(
        {.ByteStride = sizeof(rtapi::DispatchRaysDesc),
         .ArgumentDescs = {{.Type = rtapi::IndirectArgumentType::kDispatchRays}}},
        {});
    if (!signature) return signature.error();
    signature_ = std::move(*signature);
    return create_buffers();
  }

  rtapi::Status begin_frame(const Camera& camera) override { return inputs_.begin_frame(camera); }

  void record(rtapi::CommandList& list, const EffectSettings& settings,
              const PassConstants& constants) override {
    using States = rtapi::ResourceStates;
    const auto transition = [&](States from, States to) {
      list.ResourceBarrier(rtapi::ResourceBarrier::Transition(dispatch_rays_, from, to));
    };
    transition(States::kUnorderedAccess, States::kCopyDest);
    list.CopyBufferRegion(dispatch_rays_, 0, no_tiles_, 0, sizeof(rtapi::DispatchRaysDesc));
    transition(States::kCopyDest, States::kUnorderedAccess);
    const PassArguments arguments(views_, settings.constants);
    classify_.dispatch(list, frame_, constants, arguments, frame_.width(), frame_.height());
    transition(States::kUnorderedAccess, States::kIndirectArgument);
    frame_.bind(list, constants, arguments);
    list.SetPipelineState1(rays_.pipeline());
    list.ExecuteIndirect(signature_, 1, dispatch_rays_, 0);
    list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
    transition(States::kIndirectArgument, States::kUnorderedAccess);
  }

  std::uint64_t bytes() const override {
    return inputs_.bytes() + tiles_.size() + dispatch_rays_.size() + no_tiles_.size();
  }

 private:
  rtapi::Status create_buffers() {
    const std::uint64_t tiles = std::uint64_t{(frame_.width() + kTile - 1) / kTile} *
                                ((frame_.height() + kTile - 1) / kTile);
    rtapi::BufferDesc desc;
    desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
    desc.SizeInBytes = tiles * sizeof(std::uint32_t);
    desc.Name = "tiles with rays";
    auto list = device_.CreateBuffer(desc);
    if (!list) return list.error();
    tiles_ = std::move(*list);
    desc.SizeInBytes = sizeof(rtapi::DispatchRaysDesc);
    desc.Name = "rays of tiles";
    auto rays = device_.CreateBuffer(desc);
    if (!rays) return rays.error();
    dispatch_rays_ = std::move(*rays);
    rtapi::DispatchRaysDesc none = rays_.tables();
    none.Width = kTile * kTile;
    none.Height = 0;  // the shader counts
    none.Depth = 1;
    auto upload = rtapi::CreateUploadBuffer(device_, std::vector{none}, "rays of no tiles");
    if (!upload) return upload.error();
    no_tiles_ = std::move(*upload);
    if (const auto s = views_.set_unordered_access(kTiles, tiles_, 4); !s) return s;
    return views_.set_unordered_access(kDispatchRays, dispatch_rays_, 4);
  }

  const rtapi::Device& device_;
  const Frame& frame_;
  PassViews& views_;
  ComputePass classify_;
  RayPass rays_;
  rtapi::CommandSignature signature_;
  rtapi::Buffer tiles_, dispatch_rays_, no_tiles_;
  ScreenInputs inputs_;
};

}  // namespace

rtapi::Result<rtapi::ShaderLibrary> tiled_reflections_library() {
  return rtapi::LoadShaderLibrary(kaamos_shaders_tiled_reflections());
}

TiledConstants default_tiled_constants() {
  return {.screen = default_hybrid_constants().screen};
}

rtapi::Result<std::unique_ptr<EffectPass>> make_tiled_reflections(const EffectScope& scope) {
  return make_pass<TiledReflections>(scope);
}

}  // namespace kaamos::effects
