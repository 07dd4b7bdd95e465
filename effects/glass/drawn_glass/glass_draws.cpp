// SPDX-License-Identifier: MIT
#include "effects/glass/drawn_glass/glass_draws.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "effects/engine/picture.h"
#include "effects/glass/transparent/transparent.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

constexpr std::uint32_t kDrawWord = offsetof(DrawnGlassConstants, draw) / 4;
// Registers of space3.
constexpr std::uint32_t kMirrored = 2;                // u
constexpr std::uint32_t kDraws = 7, kGeometries = 8;  // t

}  // namespace

rtapi::Status GlassDraws::create(const EffectScope& scope, const DrawnGlassConstants& constants) {
  frame_ = &scope.frame;
  gpu_ = &scope.gpu;
  auto rays =
      RayPass::create(scope.device, scope.frame, scope.gpu,
                      glass_reflection_pass(scope.library("glass/transparent/transparent")));
  if (!rays) return rays.error();
  rays_ = std::move(*rays);
  const auto mirrored =
      scope.frame.create_picture(scope.device, "mirrored by glass", Format::kR32G32B32A32Float);
  if (!mirrored) return mirrored.error();
  mirrored_ = *mirrored;
  if (const auto s = scope.views.set_unordered_access(kMirrored, mirrored_); !s) return s;
  clip_depth_ = ClipDepth(scope.scene);
  for (const Instance& instance : scope.scene.instances) {
    const Bounds box = scope.scene.meshes[instance.mesh].bounds();
    centres_.push_back(box.empty() ? glm::dvec3(0.0) : (box.min + box.max) * 0.5);
  }
  const auto drawn = draws_.create(scope.device, scope.scene, scope.gpu, scope.views,
                                   {.draws = kDraws, .geometries = kGeometries}, "glass");
  if (!drawn) return drawn;
  auto map =
      EnvironmentFallback::create(scope, constants.fallback == DrawnGlassFallback::kEnvironment);
  if (!map) return map.error();
  environment_ = std::move(*map);
  return {};
}

rtapi::Status GlassDraws::begin_frame(const Camera& camera) {
  clip_scale_ = clip_depth_.scale_of(camera);
  std::vector<SceneDraw> draws = scene_draws(*gpu_, kMaskTransparent);
  const auto distance = [&](const SceneDraw& draw) {
    const glm::dmat3x4 rows(draw.object_to_world);
    const glm::dvec4 centre(centres_[draw.instance], 1.0);
    const glm::dvec3 at(glm::dot(rows[0], centre), glm::dot(rows[1], centre),
                        glm::dot(rows[2], centre));
    return camera.is_orthographic() ? glm::dot(at, camera.forward()) : glm::length(at);
  };
  std::stable_sort(draws.begin(), draws.end(), [&](const SceneDraw& a, const SceneDraw& b) {
    return distance(a) > distance(b);
  });
  draws_.set(std::move(draws));
  return environment_.begin_frame(camera);
}

void GlassDraws::set_words(DrawnGlassConstants& words) const {
  if (!environment_) words.fallback = DrawnGlassFallback::kNothing;
  words.clip_scale = clip_scale_;
  words.width = static_cast<float>(frame_->width());
  words.height = static_cast<float>(frame_->height());
}

void GlassDraws::record_rays(CommandList& list, const PassConstants& constants,
                             const PassArguments& arguments,
                             const DrawnGlassConstants& words) const {
  if (words.tolerance < 0) return;
  rays_.dispatch(list, *frame_, constants, frame_->height(), arguments);
}

void GlassDraws::record(CommandList& list, const std::vector<PipelineState>& pipelines) const {
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  for (std::uint32_t i = 0; i < draws_.draws().size(); ++i) {
    draws_.bind(list, i, kDrawWord);
    for (const PipelineState& pipeline : pipelines) {
      list.SetPipelineState(pipeline);
      list.DrawIndexedInstanced(draws_.geometry(i).index_count, 1, 0, 0, 0);
    }
  }
}

GraphicsPipelineStateDesc GlassDraws::describe(const ShaderLibrary& library,
                                               const char* pixel_shader) const {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame_->root_signature();
  desc.VS = {library, "DrawnGlassVertex"};
  desc.PS = {library, pixel_shader};
  desc.InputLayout = {{.SemanticName = "POSITION",
                       .Format = Format::kR32G32B32Float,
                       .AlignedByteOffset = kPositionOffset}};
  desc.RasterizerState.FrontCounterClockwise = true;  // as shapes are
  return desc;
}

std::uint64_t GlassDraws::bytes() const {
  return picture_bytes(mirrored_) + draws_.bytes() + environment_.bytes();
}

}  // namespace kaamos::effects
