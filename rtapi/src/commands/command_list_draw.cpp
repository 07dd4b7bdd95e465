// SPDX-License-Identifier: MIT
//
// Draws, what they need to be set, and clears of targets.
#include <algorithm>
#include <array>
#include <cmath>

#include <rtapi/command_list.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/pipelines/pipeline_state_impl.h"
#include "rtapi/src/resources/target_view.h"
#include "runtime/backend/linked_graphics.h"

namespace rtapi {

namespace detail {

runtime::DrawState& CommandListImpl::writable_draw_state() {
  if (draw_state.use_count() > 1) {
    draw_state = std::make_shared<runtime::DrawState>(*draw_state);
  }
  return *draw_state;
}

void CommandListImpl::set_stencil_references(uint32_t front, uint32_t back) {
  runtime::DrawState& state = writable_draw_state();
  state.front_stencil = static_cast<uint8_t>(front);
  state.back_stencil = static_cast<uint8_t>(back);
}

namespace {

constexpr uint32_t kMaxVertexStride = 2048;
// D3D12_VIEWPORT_BOUNDS_MIN and _MAX.
constexpr float kViewportMin = -32768;
constexpr float kViewportMax = 32767;

// Remembers what the next draw with this buffer uses.
void note_input(CommandListImpl& list, uint32_t slot, GpuVirtualAddress address, std::string role) {
  list.input_uses.erase(slot);
  if (address != 0) list.input_uses[slot] = use_of(*list.device, address, std::move(role));
}

bool is_finite(const Viewport& v) {
  return std::isfinite(v.TopLeftX) && std::isfinite(v.TopLeftY) && std::isfinite(v.Width) &&
         std::isfinite(v.Height) && std::isfinite(v.MinDepth) && std::isfinite(v.MaxDepth);
}

Status check_viewport(const Viewport& v, size_t index) {
  const bool inside = v.TopLeftX >= kViewportMin && v.TopLeftX + v.Width <= kViewportMax &&
                      std::min(v.TopLeftY, v.TopLeftY + v.Height) >= kViewportMin &&
                      std::max(v.TopLeftY, v.TopLeftY + v.Height) <= kViewportMax;
  const bool depth = v.MinDepth >= 0 && v.MinDepth <= 1 && v.MaxDepth >= 0 && v.MaxDepth <= 1;
  if (is_finite(v) && inside && depth) return {};
  return make_error(Id::kDrawRectangles, "RSSetViewports: viewport ", index, " is (", v.TopLeftX,
                    ", ", v.TopLeftY, ") + (", v.Width, ", ", v.Height, "), depth ", v.MinDepth,
                    " to ", v.MaxDepth,
                    "; it must be finite, within -32768 to 32767, with depths from 0 to 1");
}

// Cuts rectangles to a view, and drops those that are empty then. [RAS-134]
std::vector<Rect> cut_to(const runtime::TargetView& view, std::span<const Rect> rects) {
  std::vector<Rect> out;
  for (Rect r : rects) {
    r.left = std::max(r.left, 0);
    r.top = std::max(r.top, 0);
    r.right = std::min(r.right, static_cast<int32_t>(view.width));
    r.bottom = std::min(r.bottom, static_cast<int32_t>(view.height));
    if (r.left < r.right && r.top < r.bottom) out.push_back(r);
  }
  return out;
}

// The target will be used by the next command.
void use_target(CommandListImpl& list, const char* call, const ReadTarget& target,
                std::string role) {
  if (target.view.texture == nullptr) return;
  MemoryUse use;
  use.owner = target.owner;
  use.role = std::move(role);
  use.name = target.texture_name;
  use.call = call;
  use.command = list.commands->size();
  list.uses->push_back(std::move(use));
}

// Records a clear of a view whose values are set. The pointers were checked.
void record_clear(CommandListImpl& list, const char* call, CpuDescriptorHandle handle,
                  std::span<const Rect> rects, runtime::ClearTargetCommand command) {
  auto target = read_target_slot(*list.device, handle, command.depth_stencil, call);
  if (!target.ok()) return list.fail(target.error());
  if (target->view.texture == nullptr) return;
  use_target(list, call, *target, "the view");
  command.view = target->view;
  command.whole = rects.empty();
  command.rects = cut_to(target->view, rects);
  if (command.whole || !command.rects.empty()) list.record(std::move(command));
}

// [D3D12: DXGI_SAMPLE_DESC of D3D12_GRAPHICS_PIPELINE_STATE_DESC]
Status check_samples(const char* call, const runtime::DrawTargets& targets,
                     const runtime::LinkedGraphics& pipeline) {
  const auto check = [&](const runtime::TargetView& view, const std::string& what) -> Status {
    if (view.texture == nullptr || view.samples == pipeline.samples) return {};
    return make_error(Id::kSampleMismatch, call, ": ", what, " has ", view.samples,
                      " samples, but ", named("graphics pipeline", pipeline.name),
                      " was made for SampleDesc.Count ", pipeline.samples);
  };
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    if (Status s = check(targets.color[i], concat("render target ", i)); !s.ok()) return s;
  }
  return check(targets.depth, "the depth-stencil view");
}

PrimitiveTopologyType type_of(PrimitiveTopology topology) {
  switch (topology) {
    case PrimitiveTopology::kPointList:
      return PrimitiveTopologyType::kPoint;
    case PrimitiveTopology::kLineList:
    case PrimitiveTopology::kLineStrip:
      return PrimitiveTopologyType::kLine;
    default:
      return PrimitiveTopologyType::kTriangle;
  }
}

// [RAS-01]
Status check_topology(const char* call, PrimitiveTopology topology,
                      const runtime::LinkedGraphics& pipeline) {
  if (type_of(topology) == pipeline.topology) return {};
  constexpr const char* kNames[] = {"", "kPoint", "kLine", "kTriangle"};
  return make_error(Id::kDrawState, call, ": topology ", static_cast<uint32_t>(topology),
                    " was set, but ", named("graphics pipeline", pipeline.name),
                    " was made for PrimitiveTopologyType ",
                    kNames[static_cast<uint32_t>(pipeline.topology)]);
}

void record_draw(CommandListImpl& list, const char* call, bool indexed,
                 const DrawIndexedArguments& arguments) {
  if (!list.check_open(call)) return;
  if (arguments.IndexCountPerInstance == 0 || arguments.InstanceCount == 0) return;
  const PipelineStateImpl* pipeline = list.draw_pipeline(call, indexed);
  if (!pipeline) return;
  runtime::DrawCommand command;
  command.pipeline = pipeline->pipeline;
  command.linked = pipeline->graphics;
  command.bindings = list.snapshot(call, list.graphics);
  command.state = list.draw_state;
  command.indexed = indexed;
  command.arguments = arguments;
  list.record(std::move(command));
}

}  // namespace

const PipelineStateImpl* CommandListImpl::draw_pipeline(const char* call, bool indexed) {
  const PipelineStateImpl* set = graphics_pipeline(call);
  if (!set) return nullptr;
  if (draw_state->topology == PrimitiveTopology::kUndefined) {
    fail(
        make_error(Id::kDrawState, call, " without a topology; call IASetPrimitiveTopology first"));
    return nullptr;
  }
  if (Status s = check_topology(call, draw_state->topology, *set->graphics); !s.ok()) {
    fail(s.error());
    return nullptr;
  }
  if (Status s = check_samples(call, draw_state->targets, *set->graphics); !s.ok()) {
    fail(s.error());
    return nullptr;
  }
  const auto note = [&](MemoryUse use) {
    use.call = call;
    use.command = commands->size();
    uses->push_back(std::move(use));
  };
  const auto note_input = [&](uint32_t slot) {
    if (auto node = input_uses.extract(slot)) note(std::move(node.mapped()));
  };
  for (const runtime::LinkedElement& element : set->graphics->elements) note_input(element.slot);
  if (indexed) note_input(kIndexBufferSlot);
  for (MemoryUse& use : std::exchange(target_uses, {})) note(std::move(use));
  return set;
}

}  // namespace detail

using namespace detail;

void CommandList::IASetPrimitiveTopology(PrimitiveTopology topology) {
  if (!impl_ || !impl_->check_open("IASetPrimitiveTopology")) return;
  const auto number = static_cast<uint32_t>(topology);
  const bool adjacency = number >= 10 && number <= 13;
  const bool patches = number >= 33 && number <= 64;
  if (adjacency || patches) {
    return impl_->fail(make_error(Id::kGraphicsUnsupported, "IASetPrimitiveTopology: topology ",
                                  number, adjacency ? " has adjacent vertices" : " is of patches",
                                  ", and there are no geometry and hull shaders to read them"));
  }
  if (topology > PrimitiveTopology::kTriangleStrip) {
    return impl_->fail(make_error(Id::kDrawState, "IASetPrimitiveTopology: ", number,
                                  " is no topology; use 1 to 5"));
  }
  impl_->writable_draw_state().topology = topology;
}

void CommandList::IASetVertexBuffers(uint32_t start_slot, std::span<const VertexBufferView> views) {
  if (!impl_ || !impl_->check_open("IASetVertexBuffers")) return;
  if (start_slot > kIAVertexInputResourceSlotCount ||
      views.size() > kIAVertexInputResourceSlotCount - start_slot) {
    return impl_->fail(make_error(Id::kDrawBuffers, "IASetVertexBuffers: slots ", start_slot, "..",
                                  start_slot + views.size(), "; there are 32"));
  }
  std::array<VertexBufferView, kIAVertexInputResourceSlotCount> taken;
  std::copy(views.begin(), views.end(), taken.begin());
  for (size_t i = 0; i < views.size(); ++i) {
    const VertexBufferView& view = views[i];
    if (view.StrideInBytes > kMaxVertexStride) {
      return impl_->fail(make_error(Id::kDrawBuffers, "IASetVertexBuffers: slot ", start_slot + i,
                                    " has a stride of ", view.StrideInBytes,
                                    " bytes; it may be 0 to 2048"));
    }
    if (view.BufferLocation == 0) continue;
    const uint64_t there = impl_->device->addresses.bytes_from(view.BufferLocation);
    if (there >= std::max<uint64_t>(view.SizeInBytes, 1)) continue;
    impl_->fail(make_error(Id::kDrawBuffers, "IASetVertexBuffers: slot ", start_slot + i, ": ",
                           view.SizeInBytes, " bytes at ",
                           impl_->device->describe_address(view.BufferLocation),
                           " are not inside one live buffer"));
    // Native runtimes take the view; what is beyond the buffer reads zeros here.
    if (there == 0 || impl_->device->desc.InvalidCalls != InvalidCalls::kDropCall) return;
    taken[i].SizeInBytes = static_cast<uint32_t>(there);
  }
  std::copy_n(taken.begin(), views.size(),
              impl_->writable_draw_state().vertex_buffers.begin() + start_slot);
  for (size_t i = 0; i < views.size(); ++i) {
    const auto slot = static_cast<uint32_t>(start_slot + i);
    note_input(*impl_, slot, views[i].BufferLocation, concat("vertex buffer ", slot));
  }
}

void CommandList::IASetIndexBuffer(const IndexBufferView* view) {
  if (!impl_ || !impl_->check_open("IASetIndexBuffer")) return;
  if (!view || view->BufferLocation == 0) {
    impl_->writable_draw_state().index_buffer = {};
    impl_->input_uses.erase(kIndexBufferSlot);
    return;
  }
  if (view->Format != Format::kR16Uint && view->Format != Format::kR32Uint) {
    return impl_->fail(make_error(Id::kDrawBuffers, "IASetIndexBuffer: format ",
                                  static_cast<uint32_t>(view->Format),
                                  "; it must be kR16Uint or kR32Uint"));
  }
  const uint32_t bytes = GetFormatInfo(view->Format).bytes;
  if (view->BufferLocation % bytes != 0 ||
      !impl_->device->addresses.contains(view->BufferLocation,
                                         std::max<uint64_t>(view->SizeInBytes, 1))) {
    return impl_->fail(
        make_error(Id::kDrawBuffers, "IASetIndexBuffer: ", view->SizeInBytes, " bytes at ",
                   impl_->device->describe_address(view->BufferLocation),
                   "; they must be inside one live buffer, at a multiple of ", bytes));
  }
  impl_->writable_draw_state().index_buffer = *view;
  note_input(*impl_, kIndexBufferSlot, view->BufferLocation, "index buffer");
}

void CommandList::RSSetViewports(std::span<const Viewport> viewports) {
  if (!impl_ || !impl_->check_open("RSSetViewports")) return;
  if (viewports.size() > kViewportAndScissorRectCount) {
    return impl_->fail(make_error(Id::kDrawRectangles, "RSSetViewports: ", viewports.size(),
                                  " viewports; there are 16"));
  }
  for (size_t i = 0; i < viewports.size(); ++i) {
    if (Status s = check_viewport(viewports[i], i); !s.ok()) return impl_->fail(s.error());
  }
  runtime::DrawState& state = impl_->writable_draw_state();
  state.viewports = {};
  std::copy(viewports.begin(), viewports.end(), state.viewports.begin());
  state.viewport_count = static_cast<uint32_t>(viewports.size());
}

void CommandList::RSSetScissorRects(std::span<const Rect> rects) {
  if (!impl_ || !impl_->check_open("RSSetScissorRects")) return;
  if (rects.size() > kViewportAndScissorRectCount) {
    return impl_->fail(make_error(Id::kDrawRectangles, "RSSetScissorRects: ", rects.size(),
                                  " rectangles; there are 16"));
  }
  runtime::DrawState& state = impl_->writable_draw_state();
  state.scissors = {};
  std::copy(rects.begin(), rects.end(), state.scissors.begin());
  state.scissor_count = static_cast<uint32_t>(rects.size());
}

void CommandList::OMSetRenderTargets(uint32_t count, const CpuDescriptorHandle* render_targets,
                                     bool single_handle_to_descriptor_range,
                                     const CpuDescriptorHandle* depth_stencil) {
  if (!impl_ || !impl_->check_open("OMSetRenderTargets")) return;
  if (count > kSimultaneousRenderTargetCount || (count != 0 && !render_targets)) {
    return impl_->fail(make_error(Id::kDrawRectangles, "OMSetRenderTargets: ", count,
                                  count > kSimultaneousRenderTargetCount
                                      ? " render targets; there are 8"
                                      : " render targets at a null pointer"));
  }
  runtime::DrawTargets targets;
  std::vector<MemoryUse> uses;
  const auto read = [&](CpuDescriptorHandle handle, bool depth, std::string role,
                        runtime::TargetView& view) {
    auto target =
        read_target_slot(*impl_->device, handle, depth, concat("OMSetRenderTargets: ", role));
    if (!target.ok()) {
      impl_->fail(target.error());
      return false;
    }
    view = target->view;
    if (view.texture == nullptr) return true;
    MemoryUse& use = uses.emplace_back();
    use.owner = target->owner;
    use.role = std::move(role);
    use.name = target->texture_name;
    return true;
  };
  for (uint32_t i = 0; i < count; ++i) {
    const CpuDescriptorHandle handle =
        single_handle_to_descriptor_range ? render_targets[0].Offset(i) : render_targets[i];
    if (!read(handle, false, concat("render target ", i), targets.color[i])) return;
  }
  targets.color_count = count;
  if (depth_stencil && !read(*depth_stencil, true, "depth-stencil view", targets.depth)) return;
  const runtime::TargetView* first = nullptr;
  const auto same_samples = [&](const runtime::TargetView& view) {
    if (view.texture == nullptr) return true;
    if (first == nullptr) first = &view;
    if (view.samples == first->samples) return true;
    impl_->fail(make_error(Id::kSampleMismatch, "OMSetRenderTargets: targets of ", first->samples,
                           " and of ", view.samples, " samples; all must have as many"));
    return false;
  };
  for (uint32_t i = 0; i < count; ++i) {
    if (!same_samples(targets.color[i])) return;
  }
  if (!same_samples(targets.depth)) return;
  impl_->writable_draw_state().targets = std::move(targets);
  impl_->target_uses = std::move(uses);
}

void CommandList::OMSetBlendFactor(const float factor[4]) {
  if (!impl_ || !impl_->check_open("OMSetBlendFactor")) return;
  float* const to = impl_->writable_draw_state().blend_factor;
  for (int i = 0; i < 4; ++i) to[i] = factor ? factor[i] : 1.0f;
}

void CommandList::OMSetStencilRef(uint32_t reference) {
  if (!impl_ || !impl_->check_open("OMSetStencilRef")) return;
  impl_->set_stencil_references(reference, reference);
}

void CommandList::OMSetFrontAndBackStencilRef(uint32_t front, uint32_t back) {
  if (!impl_ || !impl_->check_open("OMSetFrontAndBackStencilRef")) return;
  impl_->set_stencil_references(front, back);
}

void CommandList::ClearRenderTargetView(CpuDescriptorHandle view, const float color[4],
                                        std::span<const Rect> rects) {
  if (!impl_ || !impl_->check_open("ClearRenderTargetView")) return;
  if (!color) {
    return impl_->fail(
        make_error(Id::kClearTarget, "ClearRenderTargetView: the pointer to the colour is null"));
  }
  runtime::ClearTargetCommand command;
  std::copy(color, color + 4, command.color);
  record_clear(*impl_, "ClearRenderTargetView", view, rects, std::move(command));
}

void CommandList::ClearDepthStencilView(CpuDescriptorHandle view, ClearFlags flags, float depth,
                                        uint8_t stencil, std::span<const Rect> rects) {
  if (!impl_ || !impl_->check_open("ClearDepthStencilView")) return;
  const auto bits = static_cast<uint32_t>(flags);
  if (bits == 0 || bits > 3) {
    return impl_->fail(make_error(Id::kClearTarget, "ClearDepthStencilView: flags ", bits,
                                  "; they must be kDepth (1), kStencil (2) or both"));
  }
  runtime::ClearTargetCommand command;
  command.depth_stencil = true;
  command.clear_depth = HasAny(flags, ClearFlags::kDepth);
  command.clear_stencil = HasAny(flags, ClearFlags::kStencil);
  if (command.clear_depth && !(depth >= 0 && depth <= 1)) {
    return impl_->fail(make_error(Id::kClearTarget, "ClearDepthStencilView: depth ", depth,
                                  "; it must be 0 to 1"));
  }
  command.depth = depth;
  command.stencil = stencil;
  record_clear(*impl_, "ClearDepthStencilView", view, rects, std::move(command));
}

void CommandList::DrawInstanced(uint32_t vertices, uint32_t instances, uint32_t start_vertex,
                                uint32_t start_instance) {
  if (!impl_) return;
  record_draw(*impl_, "DrawInstanced", false,
              {vertices, instances, start_vertex, 0, start_instance});
}

void CommandList::DrawIndexedInstanced(uint32_t indices, uint32_t instances, uint32_t start_index,
                                       int32_t base_vertex, uint32_t start_instance) {
  if (!impl_) return;
  record_draw(*impl_, "DrawIndexedInstanced", true,
              {indices, instances, start_index, base_vertex, start_instance});
}

}  // namespace rtapi
