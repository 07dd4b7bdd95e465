// SPDX-License-Identifier: MIT
// Draws, what they read and write, and clears of targets.
#include <utility>

#include "d3d12/com/report.h"
#include "d3d12/objects/graphics_command_list.h"
#include "d3d12/objects/resource.h"
#include "d3d12/objects/same_bytes.h"

namespace kaamos::d3d12 {

void GraphicsCommandList::DrawInstanced(UINT vertices, UINT instances, UINT start_vertex,
                                        UINT start_instance) {
  list_.DrawInstanced(vertices, instances, start_vertex, start_instance);
}

void GraphicsCommandList::DrawIndexedInstanced(UINT indices, UINT instances, UINT start_index,
                                               INT base_vertex, UINT start_instance) {
  list_.DrawIndexedInstanced(indices, instances, start_index, base_vertex, start_instance);
}

void GraphicsCommandList::IASetPrimitiveTopology(D3D12_PRIMITIVE_TOPOLOGY topology) {
  list_.IASetPrimitiveTopology(static_cast<rtapi::PrimitiveTopology>(topology));
}

void GraphicsCommandList::IASetIndexBuffer(const D3D12_INDEX_BUFFER_VIEW* view) {
  const auto same = same_bytes<rtapi::IndexBufferView>(view, 1);
  list_.IASetIndexBuffer(same.empty() ? nullptr : same.data());
}

void GraphicsCommandList::IASetVertexBuffers(UINT start_slot, UINT count,
                                             const D3D12_VERTEX_BUFFER_VIEW* views) {
  if (views == nullptr) return;  // like Microsoft's, which leaves the slots as they are
  list_.IASetVertexBuffers(start_slot, same_bytes<rtapi::VertexBufferView>(views, count));
}

void GraphicsCommandList::RSSetViewports(UINT count, const D3D12_VIEWPORT* viewports) {
  list_.RSSetViewports(same_bytes<rtapi::Viewport>(viewports, count));
}

void GraphicsCommandList::RSSetScissorRects(UINT count, const D3D12_RECT* rects) {
  list_.RSSetScissorRects(same_bytes<rtapi::Rect>(rects, count));
}

void GraphicsCommandList::OMSetRenderTargets(UINT count, const D3D12_CPU_DESCRIPTOR_HANDLE* targets,
                                             BOOL single_handle,
                                             const D3D12_CPU_DESCRIPTOR_HANDLE* depth) {
  list_.OMSetRenderTargets(count, same_bytes<rtapi::CpuDescriptorHandle>(targets),
                           single_handle != FALSE, same_bytes<rtapi::CpuDescriptorHandle>(depth));
}

void GraphicsCommandList::OMSetBlendFactor(const FLOAT factor[4]) {
  list_.OMSetBlendFactor(factor);
}

void GraphicsCommandList::OMSetStencilRef(UINT reference) {
  list_.OMSetStencilRef(reference);
}

void GraphicsCommandList::OMSetFrontAndBackStencilRef(UINT front, UINT back) {
  list_.OMSetFrontAndBackStencilRef(front, back);
}

void GraphicsCommandList::ClearRenderTargetView(D3D12_CPU_DESCRIPTOR_HANDLE view,
                                                const FLOAT color[4], UINT rect_count,
                                                const D3D12_RECT* rects) {
  list_.ClearRenderTargetView({view.ptr}, color, same_bytes<rtapi::Rect>(rects, rect_count));
}

void GraphicsCommandList::ClearDepthStencilView(D3D12_CPU_DESCRIPTOR_HANDLE view,
                                                D3D12_CLEAR_FLAGS flags, FLOAT depth, UINT8 stencil,
                                                UINT rect_count, const D3D12_RECT* rects) {
  list_.ClearDepthStencilView({view.ptr}, static_cast<rtapi::ClearFlags>(flags), depth, stencil,
                              same_bytes<rtapi::Rect>(rects, rect_count));
}

// A render pass is its targets, and clears where it begins with one.
void GraphicsCommandList::BeginRenderPass(UINT count,
                                          const D3D12_RENDER_PASS_RENDER_TARGET_DESC* targets,
                                          const D3D12_RENDER_PASS_DEPTH_STENCIL_DESC* depth,
                                          D3D12_RENDER_PASS_FLAGS) {
  if (count != 0 && targets == nullptr) {
    refuse(ErrorId::kNullPointer, "BeginRenderPass: pRenderTargets.");
    return;
  }
  pass_resolves_.clear();
  std::vector<D3D12_CPU_DESCRIPTOR_HANDLE> handles;
  for (UINT i = 0; i < count; ++i) {
    handles.push_back(targets[i].cpuDescriptor);
    note_resolve(targets[i].EndingAccess, D3D12_RESOURCE_STATE_RENDER_TARGET);
  }
  if (depth != nullptr) note_resolve(depth->DepthEndingAccess, D3D12_RESOURCE_STATE_DEPTH_WRITE);
  OMSetRenderTargets(count, handles.data(), FALSE,
                     depth != nullptr ? &depth->cpuDescriptor : nullptr);
  for (UINT i = 0; i < count; ++i) {
    const D3D12_RENDER_PASS_BEGINNING_ACCESS& access = targets[i].BeginningAccess;
    if (access.Type == D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_CLEAR) {
      ClearRenderTargetView(targets[i].cpuDescriptor, access.Clear.ClearValue.Color, 0, nullptr);
    }
  }
  if (depth == nullptr) return;
  const auto clear = [&](const D3D12_RENDER_PASS_BEGINNING_ACCESS& access, D3D12_CLEAR_FLAGS part) {
    if (access.Type != D3D12_RENDER_PASS_BEGINNING_ACCESS_TYPE_CLEAR) return;
    const D3D12_DEPTH_STENCIL_VALUE& value = access.Clear.ClearValue.DepthStencil;
    ClearDepthStencilView(depth->cpuDescriptor, part, value.Depth, value.Stencil, 0, nullptr);
  };
  clear(depth->DepthBeginningAccess, D3D12_CLEAR_FLAG_DEPTH);
  clear(depth->StencilBeginningAccess, D3D12_CLEAR_FLAG_STENCIL);
}

void GraphicsCommandList::note_resolve(const D3D12_RENDER_PASS_ENDING_ACCESS& access,
                                       D3D12_RESOURCE_STATES state) {
  if (access.Type != D3D12_RENDER_PASS_ENDING_ACCESS_TYPE_RESOLVE) return;
  const auto* first = access.Resolve.pSubresourceParameters;
  PassResolve resolve = {access.Resolve, {}, state};
  if (first != nullptr) {
    resolve.subresources.assign(first, first + access.Resolve.SubresourceCount);
  }
  pass_resolves_.push_back(std::move(resolve));
}

// Sources stay in their states of targets for the program. [D3D12: Render passes]
void GraphicsCommandList::EndRenderPass() {
  for (PassResolve& resolve : std::exchange(pass_resolves_, {})) {
    const rtapi::Resource source = rtapi_resource(resolve.desc.pSrcResource);
    const auto drawn = static_cast<rtapi::ResourceStates>(resolve.source_state);
    constexpr auto kResolved = rtapi::ResourceStates::kResolveSource;
    list_.ResourceBarrier(rtapi::ResourceBarrier::Transition(source, drawn, kResolved));
    for (auto& part : resolve.subresources) {
      const bool whole = part.SrcRect.right == 0 && part.SrcRect.bottom == 0;
      ResolveSubresourceRegion(resolve.desc.pDstResource, part.DstSubresource, part.DstX, part.DstY,
                               resolve.desc.pSrcResource, part.SrcSubresource,
                               whole ? nullptr : &part.SrcRect, resolve.desc.Format,
                               resolve.desc.ResolveMode);
    }
    list_.ResourceBarrier(rtapi::ResourceBarrier::Transition(source, kResolved, drawn));
  }
}

}  // namespace kaamos::d3d12
