// SPDX-License-Identifier: MIT
#include "effects/engine/scene_pipeline.h"

#include <algorithm>
#include <utility>

namespace kaamos::effects {

using namespace rtapi;

rtapi::Status SceneDrawList::create(const Device& device, const Scene& scene, const GpuScene& gpu,
                                    PassViews& views, const Registers& registers,
                                    const std::string& name) {
  gpu_ = &gpu;
  const std::vector<SceneDraw> draws(std::max(most_scene_draws(scene), 1u));
  const auto draw_buffer = CreateUploadBuffer(device, draws, name + " draws");
  if (!draw_buffer) return draw_buffer.error();
  draw_buffer_ = *draw_buffer;
  std::vector<HitConstants> geometries;
  for (const GpuGeometry& geometry : gpu.geometries) geometries.push_back(geometry.constants);
  if (geometries.empty()) geometries.emplace_back();
  const auto geometry_buffer = CreateUploadBuffer(device, geometries, name + " geometries");
  if (!geometry_buffer) return geometry_buffer.error();
  geometry_buffer_ = *geometry_buffer;
  const auto s = views.set_shader_resource(registers.draws, draw_buffer_, sizeof(SceneDraw));
  if (!s) return s;
  return views.set_shader_resource(registers.geometries, geometry_buffer_, sizeof(HitConstants));
}

void SceneDrawList::see_instances(std::uint32_t mask) {
  set(scene_draws(*gpu_, mask));
}

void SceneDrawList::set(std::vector<SceneDraw> draws) {
  draws_ = std::move(draws);
  std::copy(draws_.begin(), draws_.end(), draw_buffer_.data<SceneDraw>().begin());
}

void SceneDrawList::bind(CommandList& list, std::uint32_t draw, std::uint32_t word) const {
  const GpuGeometry& of = geometry(draw);
  const auto vertex_bytes = static_cast<std::uint32_t>(of.vertex_range().size_bytes);
  const auto index_bytes = static_cast<std::uint32_t>(of.index_range().size_bytes);
  list.IASetVertexBuffers(0,
                          VertexBufferView{of.vertices, vertex_bytes, of.constants.vertex_stride});
  const IndexBufferView indices = {
      of.indices, index_bytes,
      of.constants.index_size_bytes == 2 ? Format::kR16Uint : Format::kR32Uint};
  list.IASetIndexBuffer(&indices);
  list.SetGraphicsRoot32BitConstant(kRootPassWords, draw, word);
}

void SceneDrawList::record(CommandList& list, std::uint32_t draw, std::uint32_t word) const {
  bind(list, draw, word);
  list.DrawIndexedInstanced(geometry(draw).index_count, 1, 0, 0, 0);
}

rtapi::Result<ScenePipeline> ScenePipeline::create(const Device& device, const Frame& frame,
                                                   const Desc& wanted) {
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = frame.root_signature();
  desc.InputLayout = scene_input_layout();
  desc.RasterizerState.CullMode = CullMode::kNone;  // rays hit both sides, too
  desc.DepthStencilState.DepthFunc = wanted.depth_func;
  desc.RTVFormats = wanted.targets;
  desc.DSVFormat = Format::kD32Float;
  ScenePipeline out;
  for (const bool has_holes : {false, true}) {
    const std::string& shader = has_holes ? wanted.pixel_shader_of_holes : wanted.pixel_shader;
    desc.VS = {wanted.library, has_holes ? wanted.vertex_shader_of_holes : wanted.vertex_shader};
    if (!shader.empty()) desc.PS = {wanted.library, shader};
    desc.Name = wanted.name + (has_holes ? " with holes" : "");
    const auto created = device.CreateGraphicsPipelineState(desc);
    if (!created) return created.error();
    (has_holes ? out.with_holes_ : out.opaque_) = *created;
  }
  return out;
}

void ScenePipeline::record(CommandList& list, const SceneDrawList& draws,
                           std::uint32_t word) const {
  for (const bool with_holes : {false, true}) {
    list.SetPipelineState(with_holes ? with_holes_ : opaque_);
    for (std::uint32_t i = 0; i < draws.draws().size(); ++i) {
      if (draws.geometry(i).alpha_tested == with_holes) draws.record(list, i, word);
    }
  }
}

void set_draw_area(CommandList& list, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                   std::uint32_t height) {
  list.RSSetViewports(Viewport{static_cast<float>(x), static_cast<float>(y),
                               static_cast<float>(width), static_cast<float>(height), 0, 1});
  list.RSSetScissorRects(Rect{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                              static_cast<std::int32_t>(x + width),
                              static_cast<std::int32_t>(y + height)});
}

std::vector<InputElementDesc> scene_input_layout() {
  return {
      {.SemanticName = "POSITION",
       .Format = Format::kR32G32B32Float,
       .AlignedByteOffset = kPositionOffset},
      {.SemanticName = "TEXCOORD", .Format = Format::kR32G32Float, .AlignedByteOffset = kUvOffset}};
}

}  // namespace kaamos::effects
