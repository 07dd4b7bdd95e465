// SPDX-License-Identifier: MIT
#include "runtime/raster/draw_plan.h"

#include <algorithm>

#include "runtime/raster/sample_positions.h"

namespace kaamos::raster {
namespace {

using runtime::DrawState;
using runtime::kNoColumn;
using shader::Interpolation;

void plan_rows(const runtime::LinkedGraphics& linked, DrawPlan& plan) {
  const auto add = [&](Interpolation interpolation, std::vector<RowAttribute>& to) {
    for (const runtime::LinkedVarying& varying : linked.varyings) {
      if (varying.interpolation != interpolation) continue;
      for (uint32_t c = 0; c < varying.components; ++c) {
        const uint32_t vertex = interpolation == Interpolation::kSecondVertex  ? 1
                                : interpolation == Interpolation::kThirdVertex ? 2
                                                                               : 0;
        const auto word = static_cast<uint32_t>(plan.row_columns.size());
        to.push_back({varying.pixel_column + c, word, vertex});
        plan.row_columns.push_back(varying.vertex_column + c);
      }
    }
  };
  const auto add_places = [&](Interpolation center, Interpolation centroid, Interpolation sample,
                              std::vector<RowAttribute>& to, AttributePlaces& places) {
    add(center, to);
    places.centroid = to.size();
    add(centroid, to);
    places.sample = to.size();
    add(sample, to);
  };
  add_places(Interpolation::kLinear, Interpolation::kCentroid, Interpolation::kSample, plan.linear,
             plan.linear_places);
  add_places(Interpolation::kNoPerspective, Interpolation::kCentroidNoPerspective,
             Interpolation::kSampleNoPerspective, plan.screen_linear, plan.screen_places);
  add(Interpolation::kNoInterpolation, plan.flat);
  add(Interpolation::kSecondVertex, plan.flat);
  add(Interpolation::kThirdVertex, plan.flat);
}

void plan_depth_stencil(const DrawState& state, const runtime::LinkedGraphics& linked,
                        const Surface& surface, DrawPlan& plan) {
  const rtapi::DepthStencilDesc& desc = linked.depth_stencil;
  if (surface.texels == nullptr) return;
  if (desc.DepthEnable) plan.depth = depth_kind(surface.format);
  const bool has_stencil = desc.StencilEnable && rtapi::HasStencil(surface.format);
  if (plan.depth == DepthKind::kNone && !has_stencil) return;
  if (has_stencil) {
    plan.stencil =
        std::make_shared<StencilTables>(stencil_tables(desc, state, surface.read_only_stencil));
  }
  const bool tests_depth = plan.depth != DepthKind::kNone;
  if (tests_depth) plan.depth_func = static_cast<uint32_t>(desc.DepthFunc) - 1;
  const bool writes =
      tests_depth && desc.DepthWriteMask == rtapi::DepthWriteMask::kAll && !surface.read_only;
  const uint32_t flags = plan.has_pixel ? linked.pixel_desc().flags : 0;
  const bool forced = (flags & shader::kGraphicsEarlyDepthStencil) != 0;
  const bool has_depth = tests_depth && plan.has_pixel && linked.pixel_columns.depth != kNoColumn;
  const bool stores =
      (flags & (shader::kGraphicsWritesMemory | shader::kGraphicsOrdersPixels)) != 0;
  // Discarded pixels do nothing to stencil, not even if they fail a test.
  const bool keeps_stencil = plan.discards && has_stencil && plan.stencil->writes;
  if (!forced && (stores || has_depth || keeps_stencil)) {
    plan.late_test = true;
    plan.late_write = writes;
  } else {
    plan.early_test = true;
    plan.early_write = writes && (forced || !plan.discards);
    plan.late_write = writes && !plan.early_write;
  }
  plan.reads_depth_output = has_depth && !forced;
}

void plan_targets(const runtime::LinkedGraphics& linked, const Targets& targets, DrawPlan& plan) {
  for (uint32_t i = 0; i < rtapi::kSimultaneousRenderTargetCount; ++i) {
    const Surface& surface = targets.color[i];
    const auto& columns = linked.pixel_columns.targets[i];
    if (surface.texels == nullptr || columns.first_column == kNoColumn) continue;
    if (linked.blends_two_sources && i > 0) continue;
    PlannedTarget target;
    target.codec = &target_codec(surface.format);
    if (target.codec->bytes == 0) continue;
    target.slot = i;
    target.first_column = columns.first_column;
    target.components = columns.components;
    target.blend = linked.blend[i];
    const auto write_mask = static_cast<uint32_t>(target.blend.RenderTargetWriteMask);
    bool writes = false;
    for (uint32_t w = 0; w < target.codec->words; ++w) {
      uint32_t all = 0;
      for (uint32_t c = 0; c < 4; ++c) {
        all |= target.codec->component[c][w];
        if ((write_mask >> c & 1) != 0) target.mask[w] |= target.codec->component[c][w];
      }
      writes = writes || target.mask[w] != 0;
      target.whole_texels = target.whole_texels && target.mask[w] == all;
    }
    if (!writes) continue;
    target.blends = target.blend.BlendEnable && !target.codec->integer;
    if (target.blend.LogicOpEnable) target.whole_texels = false;
    plan.targets.push_back(target);
  }
}

}  // namespace

DepthKind depth_kind(rtapi::Format format) {
  switch (format) {
    case rtapi::Format::kD32Float:
    case rtapi::Format::kD32FloatS8X24Uint:
      return DepthKind::kFloat32;
    case rtapi::Format::kD16Unorm:
      return DepthKind::kUnorm16;
    case rtapi::Format::kD24UnormS8Uint:
      return DepthKind::kUnorm24;
    default:
      return DepthKind::kNone;
  }
}

DrawPlan plan_draw(const Draw& draw, const Targets& targets, uint32_t width, uint32_t height,
                   uint32_t slices) {
  const runtime::LinkedGraphics& linked = *draw.linked;
  DrawPlan plan;
  plan.linked = &linked;
  plan.state = draw.state;
  plan.has_pixel = linked.has_pixel();
  plan.samples = targets.samples;
  plan.sample_mask = linked.sample_mask & ((1u << plan.samples) - 1);
  for (const SamplePosition& position : sample_positions(plan.samples)) {
    plan.least_sample = std::min({plan.least_sample, position.x, position.y});
    plan.greatest_sample = std::max({plan.greatest_sample, position.x, position.y});
  }
  const shader::GraphicsDesc& vertex = linked.vertex_desc();
  plan.vertex_inputs = vertex.input_columns;
  plan.vertex_outputs = vertex.output_columns;
  plan.has_geometry = linked.has_geometry();
  plan.numbers_primitives = linked.vertex_columns.primitive_id != kNoColumn;
  plan.depth_clip = linked.rasterizer.DepthClipEnable;
  plan.clip_count = static_cast<uint32_t>(linked.vertex_columns.clip_distances.size());
  plan.cull_count = static_cast<uint32_t>(linked.vertex_columns.cull_distances.size());
  plan.picks_viewport = linked.vertex_columns.viewport_array_index != kNoColumn;
  plan.picks_slice = linked.vertex_columns.target_array_index != kNoColumn && slices > 1;
  plan.slices = slices;
  bool any_viewport = false;
  for (uint32_t i = 0; i < plan.viewports.size(); ++i) {
    plan.viewports[i] = viewport_state(*draw.state, i, width, height);
    any_viewport = any_viewport || !plan.viewports[i].rect.empty();
    if (!plan.picks_viewport) break;
  }

  const rtapi::RasterizerDesc& raster = linked.rasterizer;
  plan.wireframe = raster.FillMode == rtapi::FillMode::kWireframe;
  plan.lines_are_rectangles = raster.MultisampleEnable;
  plan.cull_front = raster.CullMode == rtapi::CullMode::kFront;
  plan.cull_back = raster.CullMode == rtapi::CullMode::kBack;
  plan.front_is_clockwise = !raster.FrontCounterClockwise;
  plan.biased = raster.DepthBias != 0 || raster.SlopeScaledDepthBias != 0;
  plan.depth_bias = static_cast<float>(raster.DepthBias);
  plan.bias_clamp = raster.DepthBiasClamp;
  plan.slope_bias = raster.SlopeScaledDepthBias;
  const DepthKind bound =
      targets.depth.texels != nullptr ? depth_kind(targets.depth.format) : DepthKind::kNone;
  if (bound != DepthKind::kNone) plan.bias_kind = bound;

  if (plan.has_pixel) {
    const shader::GraphicsDesc& pixel = linked.pixel_desc();
    plan.pixel_inputs = pixel.input_columns;
    plan.pixel_outputs = pixel.output_columns;
    plan.masks_output = linked.pixel_columns.coverage_out != kNoColumn || linked.alpha_to_coverage;
    plan.discards = plan.masks_output || (pixel.flags & shader::kGraphicsDiscards) != 0;
    plan.runs_per_sample = plan.samples > 1 && (pixel.flags & shader::kGraphicsRunsPerSample) != 0;
    plan_rows(linked, plan);
    plan_targets(linked, targets, plan);
    const runtime::PixelSystemColumns& columns = linked.pixel_columns;
    const bool barycentrics = columns.barycentrics != kNoColumn;
    const bool position = columns.position != kNoColumn;
    plan.needs_screen =
        !plan.screen_linear.empty() || (barycentrics && columns.barycentrics_no_perspective);
    plan.needs_perspective = !plan.linear.empty() ||
                             (barycentrics && !columns.barycentrics_no_perspective) ||
                             (position && columns.position_components > 3);
    plan.needs_z = position && columns.position_components > 2;
  }
  // A pixel shader of which nothing can be seen.
  if (plan.has_pixel && !draw.counted && plan.targets.empty() &&
      linked.pixel_columns.depth == kNoColumn && !plan.masks_output &&
      (linked.pixel_desc().flags & ~uint32_t{shader::kGraphicsRunsPerSample}) == 0) {
    plan.has_pixel = false;
    plan.needs_z = false;
  }
  plan_depth_stencil(*draw.state, linked, targets.depth, plan);
  plan.needs_z = plan.needs_z || plan.late_test || plan.late_write;
  for (int i = 0; i < 4; ++i) plan.blend_factor[i] = draw.state->blend_factor[i];
  plan.draws_nothing =
      plan.sample_mask == 0 ||
      (!draw.counted && (!any_viewport || (!plan.has_pixel && plan.depth == DepthKind::kNone &&
                                           plan.stencil == nullptr)));
  return plan;
}

}  // namespace kaamos::raster
