// SPDX-License-Identifier: MIT
//
// Enhanced barriers. [D3D12: Enhanced Barriers]
#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

using namespace detail;

namespace {

using Sync = BarrierSync;
using Access = BarrierAccess;
using Layout = BarrierLayout;

constexpr Sync kShading = Sync::kAll | Sync::kDraw | Sync::kVertexShading | Sync::kPixelShading |
                          Sync::kComputeShading | Sync::kRaytracing | Sync::kAllShading |
                          Sync::kNonPixelShading;

// What an access needs one of. [D3D12: Access Bits Barrier Sync Compatibility] kNonPixelShading is
// every shader but pixel shaders, and kAllShading every shader.
struct AccessRule {
  Access access;
  const char* name;
  Sync sync;
  ResourceStates states;  // in which a resource allows the access
};
constexpr AccessRule kAccesses[] = {
    {Access::kVertexBuffer, "kVertexBuffer",
     Sync::kAll | Sync::kVertexShading | Sync::kDraw | Sync::kAllShading | Sync::kNonPixelShading,
     ResourceStates::kVertexAndConstantBuffer},
    {Access::kConstantBuffer, "kConstantBuffer", kShading,
     ResourceStates::kVertexAndConstantBuffer},
    {Access::kIndexBuffer, "kIndexBuffer", Sync::kAll | Sync::kIndexInput | Sync::kDraw,
     ResourceStates::kIndexBuffer},
    {Access::kRenderTarget, "kRenderTarget", Sync::kAll | Sync::kDraw | Sync::kRenderTarget,
     ResourceStates::kRenderTarget},
    {Access::kUnorderedAccess, "kUnorderedAccess",
     kShading | Sync::kClearUnorderedAccessView | Sync::kEmitPostbuildInfo |
         Sync::kBuildAccelerationStructure,
     ResourceStates::kUnorderedAccess},
    {Access::kDepthStencilWrite, "kDepthStencilWrite",
     Sync::kAll | Sync::kDraw | Sync::kDepthStencil, ResourceStates::kDepthWrite},
    {Access::kDepthStencilRead, "kDepthStencilRead", Sync::kAll | Sync::kDraw | Sync::kDepthStencil,
     ResourceStates::kDepthRead},
    {Access::kShaderResource, "kShaderResource", kShading | Sync::kBuildAccelerationStructure,
     ResourceStates::kAllShaderResource},
    {Access::kStreamOutput, "kStreamOutput",
     Sync::kAll | Sync::kVertexShading | Sync::kDraw | Sync::kAllShading | Sync::kNonPixelShading,
     static_cast<ResourceStates>(0x100)},
    {Access::kIndirectArgument, "kIndirectArgument", Sync::kAll | Sync::kExecuteIndirect,
     ResourceStates::kIndirectArgument},
    {Access::kCopyDest, "kCopyDest", Sync::kAll | Sync::kCopy, ResourceStates::kCopyDest},
    {Access::kCopySource, "kCopySource", Sync::kAll | Sync::kCopy, ResourceStates::kCopySource},
    {Access::kResolveDest, "kResolveDest", Sync::kAll | Sync::kResolve,
     ResourceStates::kResolveDest},
    {Access::kResolveSource, "kResolveSource", Sync::kAll | Sync::kResolve,
     ResourceStates::kResolveSource},
    {Access::kAccelerationStructureRead, "kAccelerationStructureRead",
     kShading | Sync::kBuildAccelerationStructure | Sync::kCopyAccelerationStructure |
         Sync::kEmitPostbuildInfo,
     ResourceStates::kRaytracingAccelerationStructure},
    {Access::kAccelerationStructureWrite, "kAccelerationStructureWrite",
     kShading | Sync::kBuildAccelerationStructure | Sync::kCopyAccelerationStructure,
     ResourceStates::kRaytracingAccelerationStructure},
};

constexpr Access kStructureAccess =
    Access::kAccelerationStructureRead | Access::kAccelerationStructureWrite;
constexpr Access kBufferOnly = Access::kVertexBuffer | Access::kConstantBuffer |
                               Access::kIndexBuffer | Access::kStreamOutput |
                               Access::kIndirectArgument | kStructureAccess;
constexpr Access kTextureOnly =
    Access::kRenderTarget | Access::kDepthStencilWrite | Access::kDepthStencilRead;

constexpr uint32_t kSyncBits = 0x8180FFFF;
constexpr uint32_t kAccessBits = 0x8000FFFF;

// A layout and the accesses that it allows. [D3D12: Layout Access Compatibility]
struct LayoutRule {
  Layout layout;
  Access access;
  ResourceFlags needs;
};
constexpr Access kCommonAccess = Access::kShaderResource | Access::kCopySource | Access::kCopyDest;
constexpr LayoutRule kLayouts[] = {
    {Layout::kCommon, kCommonAccess, ResourceFlags::kNone},
    {Layout::kGenericRead, Access::kShaderResource | Access::kCopySource, ResourceFlags::kNone},
    {Layout::kRenderTarget, Access::kRenderTarget, ResourceFlags::kAllowRenderTarget},
    {Layout::kUnorderedAccess, Access::kUnorderedAccess, ResourceFlags::kAllowUnorderedAccess},
    {Layout::kDepthStencilWrite, Access::kDepthStencilWrite | Access::kDepthStencilRead,
     ResourceFlags::kAllowDepthStencil},
    {Layout::kDepthStencilRead, Access::kDepthStencilRead, ResourceFlags::kAllowDepthStencil},
    {Layout::kShaderResource, Access::kShaderResource, ResourceFlags::kNone},
    {Layout::kCopySource, Access::kCopySource, ResourceFlags::kNone},
    {Layout::kCopyDest, Access::kCopyDest, ResourceFlags::kNone},
    {Layout::kResolveSource, Access::kResolveSource, ResourceFlags::kNone},
    {Layout::kResolveDest, Access::kResolveDest, ResourceFlags::kNone},
    {Layout::kDirectQueueCommon, kCommonAccess | Access::kUnorderedAccess, ResourceFlags::kNone},
    {Layout::kDirectQueueGenericRead,
     Access::kShaderResource | Access::kCopySource | Access::kDepthStencilRead |
         Access::kResolveSource,
     ResourceFlags::kNone},
    {Layout::kDirectQueueUnorderedAccess, Access::kUnorderedAccess,
     ResourceFlags::kAllowUnorderedAccess},
    {Layout::kDirectQueueShaderResource, Access::kShaderResource, ResourceFlags::kNone},
    {Layout::kDirectQueueCopySource, Access::kCopySource, ResourceFlags::kNone},
    {Layout::kDirectQueueCopyDest, Access::kCopyDest, ResourceFlags::kNone},
    {Layout::kComputeQueueCommon, kCommonAccess | Access::kUnorderedAccess, ResourceFlags::kNone},
    {Layout::kComputeQueueGenericRead, Access::kShaderResource | Access::kCopySource,
     ResourceFlags::kNone},
    {Layout::kComputeQueueUnorderedAccess, Access::kUnorderedAccess,
     ResourceFlags::kAllowUnorderedAccess},
    {Layout::kComputeQueueShaderResource, Access::kShaderResource, ResourceFlags::kNone},
    {Layout::kComputeQueueCopySource, Access::kCopySource, ResourceFlags::kNone},
    {Layout::kComputeQueueCopyDest, Access::kCopyDest, ResourceFlags::kNone},
};

const LayoutRule* rule_of(Layout layout) {
  for (const LayoutRule& rule : kLayouts) {
    if (rule.layout == layout) return &rule;
  }
  return nullptr;
}

ResourceStates states_of(Access access) {
  ResourceStates states = ResourceStates::kCommon;
  for (const AccessRule& rule : kAccesses) {
    if (HasAny(access, rule.access)) states = states | rule.states;
  }
  return states;
}

// "SyncBefore 0x80"
std::string bits(const char* what, const char* side, uint32_t value) {
  return std::string(what) + side + " " + hex(value);
}

// One side of a barrier; `allowed`: what the resource, or its layout, lets be accessed.
Status check_side(const std::string& name, const char* side, Sync sync, Access access,
                  bool can_split, Access allowed, const std::string& allowed_by) {
  const auto sync_bits = static_cast<uint32_t>(sync);
  const auto access_bits = static_cast<uint32_t>(access);
  const std::string sync_text = bits("Sync", side, sync_bits);
  const std::string access_text = bits("Access", side, access_bits);
  if ((sync_bits & ~kSyncBits) != 0) {
    return make_error(Id::kEnhancedBarrier, name, ": ", sync_text,
                      " has bits that are undefined, or of video");
  }
  if ((access_bits & ~kAccessBits) != 0) {
    return make_error(Id::kEnhancedBarrier, name, ": ", access_text,
                      " has bits that are undefined, or of video and shading rates");
  }
  const bool is_split = HasAny(sync, Sync::kSplit);
  if (is_split && (sync != Sync::kSplit || !can_split)) {
    return make_error(Id::kEnhancedBarrier, name, ": ", sync_text,
                      can_split ? "; kSplit stands alone" : "; a global barrier cannot be split");
  }
  if (HasAny(access, Access::kNoAccess)) {
    if (access == Access::kNoAccess) return {};
    return make_error(Id::kEnhancedBarrier, name, ": ", access_text, "; kNoAccess stands alone");
  }
  if (sync == Sync::kNone) {
    return make_error(Id::kEnhancedBarrier, name, ": ", sync_text, " goes with kNoAccess, not ",
                      access_text);
  }
  for (const AccessRule& rule : kAccesses) {
    if (!HasAny(access, rule.access)) continue;
    if (!HasAny(allowed, rule.access)) {
      return make_error(Id::kEnhancedBarrier, name, ": ", access_text, " has ", rule.name,
                        ", which ", allowed_by, " does not allow");
    }
    if (!is_split && !HasAny(sync, rule.sync)) {
      return make_error(Id::kEnhancedBarrier, name, ": ", access_text, " has ", rule.name, ", and ",
                        sync_text, " no work that accesses so; it needs one of ",
                        hex(static_cast<uint32_t>(rule.sync)));
    }
  }
  return {};
}

Status check_sides(const std::string& name, const GlobalBarrier& barrier, bool can_split,
                   Access allowed, const std::string& allowed_by) {
  if (Status s = check_side(name, "Before", barrier.SyncBefore, barrier.AccessBefore, can_split,
                            allowed, allowed_by);
      !s.ok()) {
    return s;
  }
  return check_side(name, "After", barrier.SyncAfter, barrier.AccessAfter, can_split, allowed,
                    allowed_by);
}

Access allowed_of(const BufferDesc& desc) {
  if (desc.InitialState == ResourceStates::kRaytracingAccelerationStructure) {
    return kStructureAccess | Access::kUnorderedAccess;
  }
  switch (desc.Heap) {
    case HeapType::kUpload:
      return Access::kVertexBuffer | Access::kConstantBuffer | Access::kIndexBuffer |
             Access::kShaderResource | Access::kIndirectArgument | Access::kCopySource |
             Access::kResolveSource;
    case HeapType::kReadback:
      return Access::kCopyDest | Access::kResolveDest;
    case HeapType::kDefault:
    case HeapType::kCustom:
      break;
  }
  const auto all = static_cast<Access>(kAccessBits);
  Access allowed = all & ~kTextureOnly & ~kStructureAccess;
  if (!HasAny(desc.Flags, ResourceFlags::kAllowUnorderedAccess)) {
    allowed = allowed & ~Access::kUnorderedAccess;
  }
  return allowed;
}

Status check_buffer(const BufferBarrier& barrier) {
  const std::string name = named("buffer", barrier.Resource.name());
  const BufferDesc& desc = barrier.Resource.GetDesc();
  if (barrier.Offset != 0 || (barrier.Size != UINT64_MAX && barrier.Size != desc.SizeInBytes)) {
    return make_error(Id::kEnhancedBarrier, name, ": Offset ", barrier.Offset, ", Size ",
                      barrier.Size, "; a barrier is for the whole buffer: 0, and ",
                      desc.SizeInBytes, " or UINT64_MAX");
  }
  return check_sides(name, barrier, true, allowed_of(desc), "the buffer");
}

struct Range {
  uint32_t first_mip = kResourceBarrierAllSubresources;
  uint32_t mips = 0;  // 0: one subresource, or all
  uint32_t first_layer = 0;
  uint32_t layers = 1;
  uint32_t first_plane = 0;
  uint32_t planes = 1;
};

Result<Range> range_of(const std::string& name, const TextureBarrier& barrier) {
  const BarrierSubresourceRange& range = barrier.Subresources;
  const uint32_t count = barrier.Resource.subresource_count();
  if (range.NumMipLevels == 0) {
    const uint32_t index = range.IndexOrFirstMipLevel;
    if (index != kResourceBarrierAllSubresources && index >= count) {
      return make_error(Id::kEnhancedBarrier, name, ": subresource ", index,
                        " does not exist; there are ", count);
    }
    return Range{index};
  }
  const TextureDesc& desc = barrier.Resource.GetDesc();
  const uint32_t mips = desc.MipLevels;
  const uint32_t layers = array_size(desc);
  const uint32_t planes = runtime::plane_count(desc.Format);
  const uint32_t wanted_planes =
      range.NumPlanes != 0 ? range.NumPlanes : planes - std::min(range.FirstPlane, planes);
  const uint32_t wanted_layers = std::max(range.NumArraySlices, 1u);
  const auto outside = [](uint32_t first, uint32_t some, uint32_t all) {
    return some == 0 || first >= all || some > all - first;
  };
  if (outside(range.IndexOrFirstMipLevel, range.NumMipLevels, mips) ||
      outside(range.FirstArraySlice, wanted_layers, layers) ||
      outside(range.FirstPlane, wanted_planes, planes)) {
    return make_error(Id::kEnhancedBarrier, name, ": mips ", range.IndexOrFirstMipLevel, " + ",
                      range.NumMipLevels, ", array slices ", range.FirstArraySlice, " + ",
                      range.NumArraySlices, ", planes ", range.FirstPlane, " + ", range.NumPlanes,
                      "; there are ", mips, " mips, ", layers, " array slices and ", planes,
                      " planes");
  }
  return Range{range.IndexOrFirstMipLevel, range.NumMipLevels, range.FirstArraySlice, wanted_layers,
               range.FirstPlane,           wanted_planes};
}

// One side of a texture barrier. An undefined layout allows no access, unless both are undefined.
Status check_layout(const std::string& name, const char* side, const TextureBarrier& barrier,
                    Layout layout, Sync sync, Access access) {
  const std::string text = bits("Layout", side, static_cast<uint32_t>(layout));
  if (layout == Layout::kUndefined) {
    if (barrier.LayoutBefore == barrier.LayoutAfter) {
      return check_side(name, side, sync, access, true, static_cast<Access>(kAccessBits), text);
    }
    return check_side(name, side, sync, access, true, Access::kNoAccess, text);
  }
  const LayoutRule* rule = rule_of(layout);
  if (rule == nullptr) {
    return make_error(Id::kEnhancedBarrier, name, ": ", text,
                      " is not defined, or is one of video and shading rates");
  }
  const ResourceFlags flags = barrier.Resource.GetDesc().Flags;
  if ((flags & rule->needs) != rule->needs) {
    return make_error(Id::kEnhancedBarrier, name, ": ", text, " needs ResourceFlags ",
                      hex(static_cast<uint32_t>(rule->needs)), "; the texture has ",
                      hex(static_cast<uint32_t>(flags)));
  }
  Access allowed = rule->access;
  if (!HasAny(flags, ResourceFlags::kAllowUnorderedAccess)) {
    allowed = allowed & ~Access::kUnorderedAccess;
  }
  return check_side(name, side, sync, access, true, allowed, text);
}

Status check_texture(const TextureBarrier& barrier) {
  const std::string name = named("texture", barrier.Resource.name());
  if (barrier.LayoutAfter == Layout::kUndefined && barrier.LayoutBefore != Layout::kUndefined) {
    return make_error(Id::kEnhancedBarrier, name,
                      ": LayoutAfter is kUndefined, which only follows itself");
  }
  if ((static_cast<uint32_t>(barrier.Flags) & ~1u) != 0) {
    return make_error(Id::kEnhancedBarrier, name, ": Flags ",
                      hex(static_cast<uint32_t>(barrier.Flags)), " have undefined bits");
  }
  if (barrier.Flags == TextureBarrierFlags::kDiscard &&
      barrier.LayoutBefore != Layout::kUndefined) {
    return make_error(Id::kEnhancedBarrier, name, ": kDiscard goes with LayoutBefore kUndefined, ",
                      "not ", hex(static_cast<uint32_t>(barrier.LayoutBefore)));
  }
  if (Status s = check_layout(name, "Before", barrier, barrier.LayoutBefore, barrier.SyncBefore,
                              barrier.AccessBefore);
      !s.ok()) {
    return s;
  }
  return check_layout(name, "After", barrier, barrier.LayoutAfter, barrier.SyncAfter,
                      barrier.AccessAfter);
}

// The first half of a split barrier does nothing.
bool is_first_half(const GlobalBarrier& barrier) {
  return barrier.SyncAfter == Sync::kSplit;
}

}  // namespace

ResourceStates StatesOfLayout(BarrierLayout layout) {
  const LayoutRule* rule = rule_of(layout);
  if (rule == nullptr || layout == BarrierLayout::kCommon) return ResourceStates::kCommon;
  return states_of(rule->access);
}

void CommandList::Barrier(std::span<const GlobalBarrier> barriers) {
  if (!impl_ || !impl_->check_open("Barrier")) return;
  for (const GlobalBarrier& barrier : barriers) {
    const auto all = static_cast<Access>(kAccessBits);
    if (Status s = check_sides("a global barrier", barrier, false, all, "it"); !s.ok()) {
      impl_->fail(s.error());
      continue;
    }
    runtime::BarrierCommand command;
    command.kind = runtime::BarrierCommand::Kind::kAccess;
    impl_->record(std::move(command));
  }
}

void CommandList::Barrier(std::span<const BufferBarrier> barriers) {
  if (!impl_ || !impl_->check_open("Barrier")) return;
  for (const BufferBarrier& barrier : barriers) {
    Status s = CheckHandle(impl_->device, barrier.Resource, "Barrier: the buffer");
    if (s.ok()) s = check_buffer(barrier);
    if (!s.ok()) {
      impl_->fail(s.error());
      continue;
    }
    if (is_first_half(barrier)) continue;
    runtime::BarrierCommand command;
    command.kind = runtime::BarrierCommand::Kind::kAccess;
    command.buffer = barrier.Resource.impl()->memory;
    // What no barrier follows may be used for nothing, which nobody can see.
    command.after = barrier.AccessAfter == Access::kNoAccess ? ResourceStates::kCommon
                                                             : states_of(barrier.AccessAfter);
    impl_->record(std::move(command));
  }
}

void CommandList::Barrier(std::span<const TextureBarrier> barriers) {
  if (!impl_ || !impl_->check_open("Barrier")) return;
  for (const TextureBarrier& barrier : barriers) {
    Status s = CheckHandle(impl_->device, barrier.Resource, "Barrier: the texture");
    if (s.ok()) s = check_texture(barrier);
    Range range;
    if (s.ok()) {
      const auto found = range_of(named("texture", barrier.Resource.name()), barrier);
      if (found.ok()) {
        range = *found;
      } else {
        s = found.error();
      }
    }
    if (!s.ok()) {
      impl_->fail(s.error());
      continue;
    }
    if (is_first_half(barrier) || barrier.LayoutAfter == Layout::kUndefined) continue;
    runtime::BarrierCommand command;
    command.kind = runtime::BarrierCommand::Kind::kAccess;
    command.texture = barrier.Resource.impl()->memory;
    command.any_before = barrier.LayoutBefore == Layout::kUndefined;
    command.before = StatesOfLayout(barrier.LayoutBefore);
    command.after = StatesOfLayout(barrier.LayoutAfter);
    command.subresource = range.first_mip;
    command.mip_count = range.mips;
    command.first_layer = range.first_layer;
    command.layer_count = range.layers;
    command.first_plane = range.first_plane;
    command.plane_count = range.planes;
    impl_->record(std::move(command));
  }
}

}  // namespace rtapi
