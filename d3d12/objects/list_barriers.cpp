// SPDX-License-Identifier: MIT
// Enhanced barriers.
#include "d3d12/objects/graphics_command_list.h"
#include "d3d12/objects/resource.h"

namespace kaamos::d3d12 {

namespace {

// What barriers of all types begin with. rtapi has D3D12's numbers.
template <class Barrier>
rtapi::GlobalBarrier scopes_of(const Barrier& barrier) {
  return {static_cast<rtapi::BarrierSync>(barrier.SyncBefore),
          static_cast<rtapi::BarrierSync>(barrier.SyncAfter),
          static_cast<rtapi::BarrierAccess>(barrier.AccessBefore),
          static_cast<rtapi::BarrierAccess>(barrier.AccessAfter)};
}

rtapi::BufferBarrier buffer_barrier(const D3D12_BUFFER_BARRIER& barrier) {
  rtapi::BufferBarrier out = {scopes_of(barrier)};
  const rtapi::Resource resource = rtapi_resource(barrier.pResource);
  if (const auto* buffer = std::get_if<rtapi::Buffer>(&resource)) out.Resource = *buffer;
  out.Offset = barrier.Offset;
  out.Size = barrier.Size;
  return out;
}

rtapi::TextureBarrier texture_barrier(const D3D12_TEXTURE_BARRIER& barrier) {
  rtapi::TextureBarrier out = {scopes_of(barrier)};
  out.LayoutBefore = static_cast<rtapi::BarrierLayout>(barrier.LayoutBefore);
  out.LayoutAfter = static_cast<rtapi::BarrierLayout>(barrier.LayoutAfter);
  const rtapi::Resource resource = rtapi_resource(barrier.pResource);
  if (const auto* texture = std::get_if<rtapi::Texture>(&resource)) out.Resource = *texture;
  const D3D12_BARRIER_SUBRESOURCE_RANGE& range = barrier.Subresources;
  out.Subresources = {range.IndexOrFirstMipLevel, range.NumMipLevels, range.FirstArraySlice,
                      range.NumArraySlices,       range.FirstPlane,   range.NumPlanes};
  out.Flags = static_cast<rtapi::TextureBarrierFlags>(barrier.Flags);
  return out;
}

}  // namespace

void GraphicsCommandList::Barrier(UINT32 count, const D3D12_BARRIER_GROUP* groups) {
  if (count != 0 && groups == nullptr) {
    refuse(ErrorId::kNullPointer, "Barrier: pBarrierGroups.");
    return;
  }
  for (UINT32 i = 0; i < count; ++i) {
    const D3D12_BARRIER_GROUP& group = groups[i];
    if (group.NumBarriers != 0 && group.pGlobalBarriers == nullptr) {
      refuse(ErrorId::kNullPointer,
             "Barrier: the barriers of pBarrierGroups[" + std::to_string(i) + "].");
      continue;
    }
    for (UINT32 k = 0; k < group.NumBarriers; ++k) {
      switch (group.Type) {
        case D3D12_BARRIER_TYPE_GLOBAL:
          list_.Barrier(scopes_of(group.pGlobalBarriers[k]));
          break;
        case D3D12_BARRIER_TYPE_TEXTURE:
          list_.Barrier(texture_barrier(group.pTextureBarriers[k]));
          break;
        case D3D12_BARRIER_TYPE_BUFFER:
          list_.Barrier(buffer_barrier(group.pBufferBarriers[k]));
          break;
        default:
          refuse(ErrorId::kBarrier, "pBarrierGroups[" + std::to_string(i) + "].Type is " +
                                        std::to_string(group.Type) + "; it is 0, 1 or 2.");
          k = group.NumBarriers - 1;
      }
    }
  }
}

}  // namespace kaamos::d3d12
