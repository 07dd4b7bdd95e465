// SPDX-License-Identifier: MIT
#include "python/draws.h"

#include <algorithm>
#include <utility>

namespace kaamos::python {
namespace {

// The value of a word. Throws py::value_error, which lists those that there are.
template <class T, size_t kCount>
T value_of(const std::string& word, const char* what,
           const std::pair<const char*, T> (&known)[kCount]) {
  std::string names;
  for (const auto& [name, value] : known) {
    if (word == name) return value;
    names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  throw py::value_error(std::string(what) + " is '" + word + "'; it is one of " + names);
}

// As the list and as the pipeline name it.
struct Topology {
  rtapi::PrimitiveTopology of_list;
  rtapi::PrimitiveTopologyType of_pipeline;
};

Topology topology_of(const std::string& word) {
  using T = rtapi::PrimitiveTopology;
  using Type = rtapi::PrimitiveTopologyType;
  return value_of<Topology>(word, "topology",
                            {{"triangles", {T::kTriangleList, Type::kTriangle}},
                             {"triangle strip", {T::kTriangleStrip, Type::kTriangle}},
                             {"lines", {T::kLineList, Type::kLine}},
                             {"line strip", {T::kLineStrip, Type::kLine}},
                             {"points", {T::kPointList, Type::kPoint}}});
}

enum class Blending { kNone, kAlpha, kAdd };

rtapi::RenderTargetBlendDesc blend_of(const std::string& word) {
  const auto kind = value_of<Blending>(
      word, "blend",
      {{"none", Blending::kNone}, {"alpha", Blending::kAlpha}, {"add", Blending::kAdd}});
  rtapi::RenderTargetBlendDesc desc;
  desc.BlendEnable = kind != Blending::kNone;
  const bool alpha = kind == Blending::kAlpha;
  desc.SrcBlend = alpha ? rtapi::Blend::kSrcAlpha : rtapi::Blend::kOne;
  desc.DestBlend = alpha ? rtapi::Blend::kInvSrcAlpha : rtapi::Blend::kOne;
  desc.DestBlendAlpha = alpha ? rtapi::Blend::kInvSrcAlpha : rtapi::Blend::kOne;
  return desc;
}

rtapi::PipelineState make_pipeline(const Session& session, const Library& library,
                                   const rtapi::RootSignature& signature, const Draw& what,
                                   const std::vector<ArrayTexture>& targets) {
  rtapi::GraphicsPipelineStateDesc desc;
  desc.pRootSignature = signature;
  desc.VS = {library.library, what.vertex};
  if (!what.pixel.empty()) desc.PS = {library.library, what.pixel};
  desc.RasterizerState.CullMode = value_of<rtapi::CullMode>(what.cull, "cull",
                                                            {{"none", rtapi::CullMode::kNone},
                                                             {"back", rtapi::CullMode::kBack},
                                                             {"front", rtapi::CullMode::kFront}});
  if (what.wireframe) desc.RasterizerState.FillMode = rtapi::FillMode::kWireframe;
  desc.BlendState.RenderTarget[0] = blend_of(what.blend);
  desc.DepthStencilState.DepthEnable = what.depth;
  if (what.depth) desc.DSVFormat = rtapi::Format::kD32Float;
  desc.PrimitiveTopologyType = topology_of(what.topology).of_pipeline;
  for (const ArrayTexture& target : targets) {
    desc.RTVFormats.push_back(target.texture.GetDesc().Format);
  }
  desc.Name = what.vertex;
  return session.device().CreateGraphicsPipelineState(desc).value();
}

// Views of the targets, and the depth buffer.
struct Targets {
  rtapi::DescriptorHeap views, depth_view;
  rtapi::Texture depth;
  std::vector<rtapi::CpuDescriptorHandle> handles;
};

Targets make_targets(const Session& session, const Draw& what,
                     const std::vector<ArrayTexture>& textures) {
  const rtapi::Device& device = session.device();
  Targets out;
  out.views = device
                  .CreateDescriptorHeap({.Type = rtapi::DescriptorHeapType::kRtv,
                                         .NumDescriptors = static_cast<uint32_t>(textures.size())})
                  .value();
  for (size_t i = 0; i < textures.size(); ++i) {
    out.handles.push_back(out.views.GetCPUDescriptorHandle(static_cast<uint32_t>(i)));
    device.CreateRenderTargetView(textures[i].texture, out.handles.back()).value();
  }
  if (!what.depth) return out;
  rtapi::TextureDesc desc = textures.front().texture.GetDesc();
  desc.Format = rtapi::Format::kD32Float;
  desc.Flags = rtapi::ResourceFlags::kAllowDepthStencil;
  desc.InitialState = rtapi::ResourceStates::kDepthWrite;
  desc.Name = "depth";
  out.depth = device.CreateTexture(desc).value();
  out.depth_view =
      device.CreateDescriptorHeap({.Type = rtapi::DescriptorHeapType::kDsv, .NumDescriptors = 1})
          .value();
  device
      .CreateDepthStencilView(out.depth, {.Format = rtapi::Format::kD32Float},
                              out.depth_view.GetCPUDescriptorHandle(0))
      .value();
  return out;
}

std::string name_of(const Draw& what, const std::vector<ArrayTexture>& targets) {
  std::string out = "draw " + what.vertex + "," + what.pixel + "," + what.topology + "," +
                    what.cull + "," + what.blend + "," + (what.wireframe ? "w" : "") +
                    (what.depth ? "d" : "");
  for (const ArrayTexture& target : targets) {
    out += "," + std::to_string(static_cast<uint32_t>(target.texture.GetDesc().Format));
  }
  return out;
}

}  // namespace

void draw(Session& session, const Library& library, const Draw& what,
          const std::vector<ArrayTexture>& targets, const Bindings& given) {
  if (targets.empty()) throw py::type_error("a draw needs a texture to draw to");
  if (!what.clear.empty() && what.clear.size() != 4) {
    throw py::value_error("clear has " + std::to_string(what.clear.size()) +
                          " numbers, and needs 4");
  }
  const rtapi::RootSignature signature = session.root_signature(library);
  rtapi::PipelineState& pipeline = session.made_of(library).pipelines[name_of(what, targets)];
  if (!pipeline) pipeline = make_pipeline(session, library, signature, what, targets);
  const Targets views = make_targets(session, what, targets);
  rtapi::CommandList list = session.device().CreateCommandList().value();
  BoundResources bound = session.bind(list, Root::kGraphics, library, signature, given);
  for (const ArrayTexture& target : targets) {
    list.ResourceBarrier(rtapi::ResourceBarrier::Transition(
        target.texture, rtapi::ResourceStates::kCommon, rtapi::ResourceStates::kRenderTarget));
    bound.undo.push_back(rtapi::ResourceBarrier::Transition(
        target.texture, rtapi::ResourceStates::kRenderTarget, rtapi::ResourceStates::kCommon));
  }
  if (!what.clear.empty()) {
    for (const rtapi::CpuDescriptorHandle& handle : views.handles) {
      list.ClearRenderTargetView(handle, what.clear.data());
    }
  }
  const rtapi::CpuDescriptorHandle depth =
      what.depth ? views.depth_view.GetCPUDescriptorHandle(0) : rtapi::CpuDescriptorHandle{};
  if (what.depth) list.ClearDepthStencilView(depth, rtapi::ClearFlags::kDepth, 1, 0);
  const rtapi::TextureDesc size = targets.front().texture.GetDesc();
  list.SetPipelineState(pipeline);
  list.IASetPrimitiveTopology(topology_of(what.topology).of_list);
  list.RSSetViewports(
      rtapi::Viewport{0, 0, static_cast<float>(size.Width), static_cast<float>(size.Height), 0, 1});
  list.RSSetScissorRects(
      rtapi::Rect{0, 0, static_cast<int32_t>(size.Width), static_cast<int32_t>(size.Height)});
  list.OMSetRenderTargets(static_cast<uint32_t>(views.handles.size()), views.handles.data(), false,
                          what.depth ? &depth : nullptr);
  list.DrawInstanced(what.vertices, what.instances, 0, 0);
  session.execute(list, bound);
}

}  // namespace kaamos::python
