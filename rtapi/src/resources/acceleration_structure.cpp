// SPDX-License-Identifier: MIT
#include "rtapi/src/resources/acceleration_structure.h"

#include <algorithm>
#include <optional>

#include <rtapi/device.h>

#include "rtapi/src/device/device_level.h"
#include "runtime/structures/opacity_micromap.h"
#include "runtime/structures/serialized_identifier.h"

namespace rtapi {

namespace detail {

namespace {

using BuildFlags = RaytracingAccelerationStructureBuildFlags;
using StructureType = RaytracingAccelerationStructureType;

struct VertexFormatInfo {
  Format format;
  uint32_t component_bytes;  // alignment of the address and of the stride
  uint32_t read_bytes;       // what a build reads per vertex, without the A component
  uint32_t stride;           // 0: any multiple of component_bytes
  bool tier_1_1;
};

// [DXR: D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC]
constexpr VertexFormatInfo kVertexFormats[] = {
    {Format::kR32G32Float, 4, 8, 0, false},     {Format::kR32G32B32Float, 4, 12, 0, false},
    {Format::kR16G16Float, 2, 4, 0, false},     {Format::kR16G16B16A16Float, 2, 6, 0, false},
    {Format::kR16G16Snorm, 2, 4, 0, false},     {Format::kR16G16B16A16Snorm, 2, 6, 0, false},
    {Format::kR16G16Unorm, 2, 4, 0, true},      {Format::kR16G16B16A16Unorm, 2, 6, 0, true},
    {Format::kR10G10B10A2Unorm, 4, 4, 4, true}, {Format::kR8G8Unorm, 1, 2, 0, true},
    {Format::kR8G8B8A8Unorm, 1, 3, 0, true},    {Format::kR8G8Snorm, 1, 2, 0, true},
    {Format::kR8G8B8A8Snorm, 1, 3, 0, true},
};

const VertexFormatInfo* find_vertex_format(Format format) {
  for (const auto& f : kVertexFormats) {
    if (f.format == format) return &f;
  }
  return nullptr;
}

std::string geometry_text(size_t index) {
  return concat("geometry ", index);
}

// The purpose that a description is checked for. Sizes depend on no address; at most on whether one
// is null. [DXR: GetRaytracingAccelerationStructurePrebuildInfo]
enum class Purpose { kSize, kBuild };

Status check_addresses(const RaytracingGeometryTrianglesDesc& t, uint32_t vertex_unit,
                       const std::string& where) {
  if (t.VertexBuffer.StartAddress % vertex_unit != 0) {
    return make_error(Id::kVertexBufferAlignment, where, ": vertices are at ",
                      hex(t.VertexBuffer.StartAddress),
                      "; this format needs an address that is a multiple of ", vertex_unit);
  }
  const bool none = t.IndexFormat == Format::kUnknown;
  if (!none && t.IndexBuffer == 0) {
    return make_error(Id::kIndexBuffer, where, ": IndexCount is ", t.IndexCount, " and the format ",
                      static_cast<uint32_t>(t.IndexFormat),
                      ", but there is no index buffer; without one the format must be kUnknown and "
                      "the count 0");
  }
  const uint32_t index_bytes = t.IndexFormat == Format::kR16Uint ? 2 : 4;
  if (!none && t.IndexBuffer % index_bytes != 0) {
    return make_error(Id::kIndexBuffer, where, ": indices at ", hex(t.IndexBuffer),
                      "; the address must be a multiple of ", index_bytes);
  }
  if (t.Transform3x4 % kRaytracingTransform3x4ByteAlignment != 0) {
    return make_error(Id::kTransformAlignment, where, ": Transform3x4 is at ", hex(t.Transform3x4),
                      "; its address must be a multiple of 16");
  }
  return {};
}

Status check_triangles(const DeviceImpl& device, const RaytracingGeometryTrianglesDesc& t,
                       size_t index, Purpose purpose) {
  const std::string where = geometry_text(index);
  const VertexFormatInfo* format = find_vertex_format(t.VertexFormat);
  if (!format || (format->tier_1_1 && device.desc.Tier < RaytracingTier::kTier1_1)) {
    return make_error(
        Id::kVertexFormat, where, ": vertex format ", static_cast<uint32_t>(t.VertexFormat),
        format ? " needs tier 1.1, " + but_tier(device) : " is not one of DXR's vertex formats");
  }
  // Only the low 32 bits of the stride count. [DXR: D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE]
  const uint64_t stride = t.VertexBuffer.StrideInBytes & 0xFFFFFFFFu;
  const uint32_t unit = format->component_bytes;
  if (stride % unit != 0 || (format->stride && t.VertexCount > 1 && stride != format->stride)) {
    return make_error(Id::kVertexBufferAlignment, where, ": vertices have stride ", stride,
                      "; this format needs ",
                      format->stride ? std::string("a stride of 4")
                                     : concat("a stride that is a multiple of ", unit));
  }
  const bool none = t.IndexFormat == Format::kUnknown;
  if (!none && t.IndexFormat != Format::kR16Uint && t.IndexFormat != Format::kR32Uint) {
    return make_error(Id::kIndexBuffer, where, ": index format ",
                      static_cast<uint32_t>(t.IndexFormat),
                      "; it must be kR16Uint, kR32Uint, or kUnknown without an index buffer");
  }
  if (none && (t.IndexBuffer != 0 || t.IndexCount != 0)) {
    return make_error(Id::kIndexBuffer, where, ": index format is kUnknown, but ",
                      t.IndexBuffer ? std::string("an index buffer is given")
                                    : concat("IndexCount is ", t.IndexCount));
  }
  return purpose == Purpose::kBuild ? check_addresses(t, unit, where) : Status();
}

Status check_aabbs(const RaytracingGeometryAabbsDesc& a, size_t index, Purpose purpose) {
  const uint64_t address = purpose == Purpose::kBuild ? a.AABBs.StartAddress : 0;
  if (address % kRaytracingAabbByteAlignment == 0 &&
      a.AABBs.StrideInBytes % kRaytracingAabbByteAlignment == 0) {
    return {};
  }
  return make_error(Id::kAabbAlignment, geometry_text(index), ": AABBs at ",
                    hex(a.AABBs.StartAddress), " with stride ", a.AABBs.StrideInBytes,
                    "; both must be multiples of 8");
}

bool is_procedural(const RaytracingGeometryDesc& g) {
  return g.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs;
}

// The triangles of a geometry that is not procedural.
const RaytracingGeometryTrianglesDesc& triangles_of(const RaytracingGeometryDesc& g) {
  return g.Type == RaytracingGeometryType::kOmmTriangles ? *g.OmmTriangles.pTriangles : g.Triangles;
}

uint64_t primitive_count(const RaytracingGeometryDesc& g) {
  if (is_procedural(g)) return g.AABBs.AABBCount;
  const auto& t = triangles_of(g);
  return (t.IndexFormat == Format::kUnknown ? t.VertexCount : t.IndexCount) / 3;
}

// Bytes of a micromap index; 0: the format is none.
uint32_t micromap_index_bytes(Format format) {
  switch (format) {
    case Format::kR8Uint:
      return 1;
    case Format::kR16Uint:
      return 2;
    case Format::kR32Uint:
      return 4;
    default:
      return 0;
  }
}

// Micromaps need tier 1.2, and a backend that has them; `what` names what was asked for.
Status check_has_micromaps(const DeviceImpl& device, const std::string& what) {
  if (device.desc.Tier < RaytracingTier::kTier1_2) {
    return make_error(Id::kMicromapTier, what, " needs tier 1.2, ", but_tier(device));
  }
  if (device.backend->has_micromaps()) return {};
  return make_error(Id::kNoMicromaps, what, " needs opacity micromaps, but backend ",
                    in_quotes(device.desc.Backend), " has none");
}

Status check_linkage(const DeviceImpl& device, const RaytracingGeometryOmmTrianglesDesc& g,
                     size_t index, Purpose purpose) {
  const std::string where = geometry_text(index);
  if (Status s = check_has_micromaps(device, where + " of type 2"); !s.ok()) return s;
  if (g.pTriangles == nullptr || g.pOmmLinkage == nullptr) {
    return make_error(Id::kMicromapLinkage, where, ": ",
                      g.pTriangles == nullptr ? "pTriangles" : "pOmmLinkage", " is null");
  }
  const RaytracingGeometryOmmLinkageDesc& link = *g.pOmmLinkage;
  const Format format = link.OpacityMicromapIndexFormat;
  const uint32_t bytes = micromap_index_bytes(format);
  if (bytes == 0 && format != Format::kUnknown) {
    return make_error(Id::kMicromapLinkage, where, ": micromap index format ",
                      static_cast<uint32_t>(format),
                      "; it must be kR8Uint, kR16Uint, kR32Uint, or kUnknown without a buffer");
  }
  const auto& buffer = link.OpacityMicromapIndexBuffer;
  if (bytes != 0 && buffer.StrideInBytes % bytes != 0) {
    return make_error(Id::kMicromapLinkage, where, ": micromap indices have stride ",
                      buffer.StrideInBytes, "; it must be a multiple of ", bytes);
  }
  if (purpose == Purpose::kSize) return {};
  if (bytes != 0 && buffer.StartAddress % bytes != 0) {
    return make_error(Id::kMicromapLinkage, where, ": micromap indices are at ",
                      hex(buffer.StartAddress), "; the address must be a multiple of ", bytes);
  }
  if (link.OpacityMicromapArray % kRaytracingOpacityMicromapArrayByteAlignment != 0) {
    return make_error(Id::kMicromapLinkage, where, ": the micromap array is at ",
                      hex(link.OpacityMicromapArray), "; its address must be a multiple of 128");
  }
  if (bytes == 0 && link.OpacityMicromapArray == 0) {
    return make_error(Id::kMicromapLinkage, where,
                      ": without micromap indices there must be a micromap array");
  }
  return {};
}

const RaytracingGeometryDesc* geometry_at(const BuildRaytracingAccelerationStructureInputs& inputs,
                                          uint32_t i) {
  return inputs.DescsLayout == ElementsLayout::kArray ? inputs.pGeometryDescs + i
                                                      : inputs.ppGeometryDescs[i];
}

Status check_geometries(const DeviceImpl& device,
                        const BuildRaytracingAccelerationStructureInputs& inputs, Purpose purpose) {
  if (inputs.NumDescs > kRaytracingMaxGeometriesPerBottomLevelAccelerationStructure) {
    return make_error(Id::kGeometryLimits, inputs.NumDescs,
                      " geometries; at most 2^24 are allowed");
  }
  if (inputs.NumDescs != 0 && inputs.pGeometryDescs == nullptr) {
    return make_error(Id::kGeometryDescsNull, "NumDescs is ", inputs.NumDescs,
                      ", but the pointer to the geometry descs is null");
  }
  uint64_t primitives = 0;
  bool procedural = false;
  for (uint32_t i = 0; i < inputs.NumDescs; ++i) {
    const RaytracingGeometryDesc* g = geometry_at(inputs, i);
    if (!g) return make_error(Id::kGeometryDescsNull, geometry_text(i), " is a null pointer");
    if (g->Type > RaytracingGeometryType::kOmmTriangles) {
      return make_error(Id::kBuildInputs, geometry_text(i), " has type ",
                        static_cast<uint32_t>(g->Type), "; it must be 0 to 2");
    }
    if (i == 0) procedural = is_procedural(*g);
    if (is_procedural(*g) != procedural) {
      return make_error(Id::kGeometryMixed, geometry_text(i), " holds ",
                        procedural ? "triangles but geometry 0 holds AABBs"
                                   : "AABBs but geometry 0 holds triangles",
                        "; all geometries of a bottom level must be of one kind");
    }
    const auto known =
        RaytracingGeometryFlags::kOpaque | RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
    if ((g->Flags & ~known) != RaytracingGeometryFlags::kNone) {
      return make_error(Id::kBuildInputs, geometry_text(i), " has undefined flags ",
                        hex(static_cast<uint32_t>(g->Flags)));
    }
    if (g->Type == RaytracingGeometryType::kOmmTriangles) {
      if (Status s = check_linkage(device, g->OmmTriangles, i, purpose); !s.ok()) return s;
    }
    Status s = procedural ? check_aabbs(g->AABBs, i, purpose)
                          : check_triangles(device, triangles_of(*g), i, purpose);
    if (!s.ok()) return s;
    const uint64_t count = primitive_count(*g);
    primitives = std::min(primitives, UINT64_MAX - count) + count;
  }
  if (primitives > kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure) {
    return make_error(Id::kGeometryLimits, primitives, " primitives; at most 2^29 are allowed");
  }
  return {};
}

// Checks that every byte of [address, address + bytes) lies in one live buffer.
Status check_live(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                  const std::string& what) {
  if (bytes == 0) return {};
  const uint64_t available = device.addresses.bytes_from(address);
  if (available == 0) {
    return make_error(Id::kBuildAddress, what, ": needs ", bytes, " bytes at ",
                      device.describe_address(address));
  }
  if (available < bytes) {
    return make_error(Id::kBuildMemoryTooSmall, what, ": needs ", bytes, " bytes from ",
                      device.describe_address(address), ", but the buffer has only ", available,
                      " left there");
  }
  return {};
}

// Bytes from the start of the first element to the end of the last; UINT64_MAX on overflow.
uint64_t extent_bytes(uint64_t count, uint64_t stride, uint64_t element) {
  if (count == 0) return 0;
  if (stride != 0 && count - 1 > (UINT64_MAX - element) / stride) return UINT64_MAX;
  return (count - 1) * stride + element;
}

Status check_geometry_memory(const DeviceImpl& device, const RaytracingGeometryDesc& g,
                             size_t index) {
  const std::string where = geometry_text(index);
  if (g.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    return check_live(
        device, g.AABBs.AABBs.StartAddress,
        extent_bytes(g.AABBs.AABBCount, g.AABBs.AABBs.StrideInBytes, sizeof(RaytracingAabb)),
        where + " AABBs");
  }
  const auto& t = g.Triangles;
  const uint64_t stride = t.VertexBuffer.StrideInBytes & 0xFFFFFFFFu;
  Status s = check_live(
      device, t.VertexBuffer.StartAddress,
      extent_bytes(t.VertexCount, stride, find_vertex_format(t.VertexFormat)->read_bytes),
      where + " vertices");
  if (!s.ok()) return s;
  const uint64_t index_bytes = t.IndexFormat == Format::kR16Uint ? 2 : 4;
  s = check_live(device, t.IndexBuffer, t.IndexCount * index_bytes, where + " indices");
  if (!s.ok() || t.Transform3x4 == 0) return s;
  return check_live(device, t.Transform3x4, 48, where + " Transform3x4");
}

Status check_linkage_memory(const DeviceImpl& device, const runtime::BuildCommand& command,
                            size_t index) {
  if (command.linkages.empty() || !command.linkages[index]) return {};
  const auto& link = *command.linkages[index];
  const uint32_t bytes = micromap_index_bytes(link.OpacityMicromapIndexFormat);
  const auto& buffer = link.OpacityMicromapIndexBuffer;
  const uint64_t count = bytes == 0 ? 0 : primitive_count(command.geometries[index]);
  Status s =
      check_live(device, buffer.StartAddress, extent_bytes(count, buffer.StrideInBytes, bytes),
                 geometry_text(index) + " micromap indices");
  if (!s.ok() || link.OpacityMicromapArray == 0) return s;
  return check_structure_address(device, link.OpacityMicromapArray,
                                 geometry_text(index) + " micromap array",
                                 kRaytracingOpacityMicromapArrayByteAlignment);
}

Status check_micromap_memory(const DeviceImpl& device, const runtime::MicromapInputs& inputs) {
  uint64_t count = 0;
  uint64_t smallest = 0;
  for (const auto& entry : inputs.histogram) {
    if (entry.Count == 0) continue;
    count += entry.Count;
    const auto format = static_cast<runtime::MicromapFormat>(entry.Format);
    smallest = std::max(smallest, runtime::micromap_bytes(entry.SubdivisionLevel, format));
  }
  Status s = check_live(device, inputs.input_buffer, smallest, "micromap input buffer");
  if (!s.ok()) return s;
  return check_live(
      device, inputs.descs.StartAddress,
      extent_bytes(count, inputs.descs.StrideInBytes, sizeof(RaytracingOpacityMicromapDesc)),
      "micromap descs");
}

Status check_instance_memory(const DeviceImpl& device,
                             const BuildRaytracingAccelerationStructureInputs& inputs) {
  const bool array = inputs.DescsLayout == ElementsLayout::kArray;
  const uint32_t alignment = array ? kRaytracingInstanceDescsByteAlignment : 8;
  if (inputs.NumDescs != 0 && inputs.InstanceDescs % alignment != 0) {
    return make_error(Id::kInstanceDescs, array ? "instance descs" : "instance desc pointers",
                      " at ", device.describe_address(inputs.InstanceDescs),
                      "; the address must be a multiple of ", alignment);
  }
  return check_live(device, inputs.InstanceDescs,
                    uint64_t{inputs.NumDescs} * (array ? sizeof(RaytracingInstanceDesc) : 8),
                    "instance descs");
}

Status check_scratch(const DeviceImpl& device, const BuildRaytracingAccelerationStructureDesc& desc,
                     uint64_t bytes) {
  if (bytes == 0) return {};
  const GpuVirtualAddress scratch = desc.ScratchAccelerationStructureData;
  if (scratch % kRaytracingAccelerationStructureByteAlignment != 0) {
    return make_error(Id::kAccelerationStructureAlignment, "scratch is at ",
                      device.describe_address(scratch), "; its address must be a multiple of 256");
  }
  const auto allocation = device.addresses.find(scratch);
  if (allocation && !HasAny(allocation->flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kAccelerationStructureMemory, "scratch is in ",
                      named("buffer", allocation->name),
                      ", which was created without kAllowUnorderedAccess");
  }
  return check_live(device, scratch, bytes, "scratch");
}

Status check_micromap_array(const DeviceImpl& device,
                            const BuildRaytracingAccelerationStructureInputs& inputs,
                            Purpose purpose) {
  if (Status s = check_has_micromaps(device, "a micromap array"); !s.ok()) return s;
  if (inputs.NumDescs != 1 || inputs.DescsLayout != ElementsLayout::kArray) {
    return make_error(Id::kMicromapArray, "NumDescs is ", inputs.NumDescs, " and DescsLayout ",
                      static_cast<uint32_t>(inputs.DescsLayout),
                      "; a micromap array has one desc, and layout kArray");
  }
  constexpr BuildFlags kAllowed =
      BuildFlags::kAllowCompaction | BuildFlags::kPreferFastTrace | BuildFlags::kPreferFastBuild;
  if ((inputs.Flags & ~kAllowed) != BuildFlags::kNone) {
    return make_error(Id::kMicromapArray, "Flags are ", hex(static_cast<uint32_t>(inputs.Flags)),
                      "; micromap arrays take kAllowCompaction, kPreferFastTrace and "
                      "kPreferFastBuild only");
  }
  const RaytracingOpacityMicromapArrayDesc* desc = inputs.pOpacityMicromapArrayDesc;
  if (desc == nullptr || (desc->NumOmmHistogramEntries != 0 && desc->pOmmHistogram == nullptr)) {
    return make_error(Id::kMicromapArray,
                      desc == nullptr ? "pOpacityMicromapArrayDesc" : "pOmmHistogram", " is null");
  }
  uint64_t count = 0;
  for (uint32_t i = 0; i < desc->NumOmmHistogramEntries; ++i) {
    const RaytracingOpacityMicromapHistogramEntry& entry = desc->pOmmHistogram[i];
    if (entry.SubdivisionLevel > kRaytracingOpacityMicromapMaxSubdivisionLevel ||
        (entry.Format != RaytracingOpacityMicromapFormat::kOc1_2State &&
         entry.Format != RaytracingOpacityMicromapFormat::kOc1_4State)) {
      return make_error(Id::kMicromapArray, "histogram entry ", i, " has subdivision level ",
                        entry.SubdivisionLevel, " and format ", static_cast<uint32_t>(entry.Format),
                        "; levels are 0 to 12, formats 1 and 2");
    }
    count += entry.Count;
  }
  if (count > kRaytracingMaxPrimitivesPerBottomLevelAccelerationStructure) {
    return make_error(Id::kGeometryLimits, count, " micromaps; at most 2^29 are allowed");
  }
  if (purpose == Purpose::kSize) return {};
  if (desc->InputBuffer % kRaytracingOpacityMicromapArrayByteAlignment != 0) {
    return make_error(Id::kMicromapArray, "InputBuffer is at ",
                      device.describe_address(desc->InputBuffer),
                      "; its address must be a multiple of 128");
  }
  if (desc->PerOmmDescs.StartAddress % 4 != 0 || desc->PerOmmDescs.StrideInBytes % 4 != 0) {
    return make_error(Id::kMicromapArray, "PerOmmDescs are at ",
                      device.describe_address(desc->PerOmmDescs.StartAddress), " with stride ",
                      desc->PerOmmDescs.StrideInBytes, "; both must be multiples of 4");
  }
  return {};
}

Status check_data_access(const DeviceImpl& device, StructureType type) {
  if (type != StructureType::kBottomLevel) {
    return make_error(Id::kDataAccess, "kAllowDataAccess (0x100) is for bottom levels only");
  }
  if (device.desc.ShaderModel < ShaderModel::k6_10) {
    return make_error(Id::kDataAccess,
                      "kAllowDataAccess (0x100) needs shader model 6.10, but this ",
                      "device was created with shader model ", GetName(device.desc.ShaderModel));
  }
  return {};
}

Status check_build_flags(const DeviceImpl& device, StructureType type, BuildFlags flags) {
  if (HasAny(flags, BuildFlags::kAllowDataAccess)) {
    if (Status s = check_data_access(device, type); !s.ok()) return s;
  }
  constexpr BuildFlags kMicromapFlags =
      BuildFlags::kAllowOmmLinkageUpdate | BuildFlags::kAllowDisableOmms;
  if (HasAny(flags, kMicromapFlags)) {
    const std::string what =
        concat("build flag ", hex(static_cast<uint32_t>(flags & kMicromapFlags)));
    if (Status s = check_has_micromaps(device, what); !s.ok()) return s;
  }
  if (HasAny(flags, BuildFlags::kAllowOmmLinkageUpdate) &&
      !HasAny(flags, BuildFlags::kAllowUpdate)) {
    return make_error(Id::kMicromapLinkage, "kAllowOmmLinkageUpdate needs kAllowUpdate");
  }
  return {};
}

Status check_inputs(const DeviceImpl& device,
                    const BuildRaytracingAccelerationStructureInputs& inputs, Purpose purpose) {
  if (Status s = check_has_raytracing(device, "an acceleration structure"); !s.ok()) return s;
  if (inputs.Type > StructureType::kOpacityMicromapArray) {
    return make_error(Id::kBuildInputs, "Type is ", static_cast<uint32_t>(inputs.Type),
                      "; it must be kTopLevel (0), kBottomLevel (1) or kOpacityMicromapArray (2)");
  }
  if (inputs.DescsLayout > ElementsLayout::kArrayOfPointers) {
    return make_error(Id::kBuildInputs, "DescsLayout is ",
                      static_cast<uint32_t>(inputs.DescsLayout), "; it must be 0 or 1");
  }
  if (static_cast<uint32_t>(inputs.Flags) & ~0x1FFu) {
    return make_error(Id::kBuildInputs, "Flags are ", hex(static_cast<uint32_t>(inputs.Flags)),
                      "; only the bits of 0x1ff are defined");
  }
  if (HasAny(inputs.Flags, BuildFlags::kPreferFastTrace) &&
      HasAny(inputs.Flags, BuildFlags::kPreferFastBuild)) {
    return make_error(Id::kBuildFlagsExclusive,
                      "kPreferFastTrace and kPreferFastBuild are both set");
  }
  if (inputs.Type == StructureType::kOpacityMicromapArray) {
    return check_micromap_array(device, inputs, purpose);
  }
  if (Status s = check_build_flags(device, inputs.Type, inputs.Flags); !s.ok()) return s;
  if (inputs.Type == StructureType::kBottomLevel) return check_geometries(device, inputs, purpose);
  if (inputs.NumDescs > kRaytracingMaxInstancesPerTopLevelAccelerationStructure) {
    return make_error(Id::kGeometryLimits, inputs.NumDescs, " instances; at most 2^24 are allowed");
  }
  return {};
}

}  // namespace

Status check_build_inputs(const DeviceImpl& device,
                          const BuildRaytracingAccelerationStructureInputs& inputs) {
  return check_inputs(device, inputs, Purpose::kBuild);
}

runtime::BuildCommand describe_build(const BuildRaytracingAccelerationStructureInputs& inputs) {
  runtime::BuildCommand command;
  command.type = inputs.Type;
  command.flags = inputs.Flags;
  if (inputs.Type == StructureType::kTopLevel) {
    command.instance_count = inputs.NumDescs;
    command.instance_layout = inputs.DescsLayout;
    command.instance_descs = inputs.InstanceDescs;
    return command;
  }
  if (inputs.Type == StructureType::kOpacityMicromapArray) {
    const RaytracingOpacityMicromapArrayDesc& desc = *inputs.pOpacityMicromapArrayDesc;
    command.micromaps.histogram.assign(desc.pOmmHistogram,
                                       desc.pOmmHistogram + desc.NumOmmHistogramEntries);
    command.micromaps.input_buffer = desc.InputBuffer;
    command.micromaps.descs = desc.PerOmmDescs;
    return command;
  }
  command.geometries.reserve(inputs.NumDescs);
  for (uint32_t i = 0; i < inputs.NumDescs; ++i) {
    RaytracingGeometryDesc geometry = *geometry_at(inputs, i);
    if (geometry.Type == RaytracingGeometryType::kOmmTriangles) {
      const RaytracingGeometryOmmTrianglesDesc linked = geometry.OmmTriangles;
      command.linkages.resize(inputs.NumDescs);
      command.linkages[i] = *linked.pOmmLinkage;
      geometry.Type = RaytracingGeometryType::kTriangles;
      geometry.Triangles = *linked.pTriangles;
    }
    command.geometries.push_back(geometry);
  }
  return command;
}

Status check_structure_address(const DeviceImpl& device, GpuVirtualAddress address,
                               std::string_view what, uint32_t alignment) {
  if (address == 0 || address % alignment != 0) {
    return make_error(Id::kAccelerationStructureAlignment, what, " is at ",
                      device.describe_address(address), "; its address must be a multiple of ",
                      alignment, " and not 0");
  }
  const auto allocation = device.addresses.find(address);
  if (!allocation) {
    return make_error(Id::kBuildAddress, what, " is at ", device.describe_address(address));
  }
  if (!allocation->acceleration_structure) {
    return make_error(Id::kAccelerationStructureMemory, what, " is in ",
                      named("buffer", allocation->name),
                      "; create it with InitialState kRaytracingAccelerationStructure");
  }
  return {};
}

Status check_build_addresses(const DeviceImpl& device,
                             const BuildRaytracingAccelerationStructureDesc& desc,
                             const runtime::BuildCommand& command) {
  const auto& inputs = desc.Inputs;
  const bool update = HasAny(inputs.Flags, BuildFlags::kPerformUpdate);
  const bool micromaps = inputs.Type == StructureType::kOpacityMicromapArray;
  Status s = check_structure_address(device, desc.DestAccelerationStructureData, "dest",
                                     micromaps ? kRaytracingOpacityMicromapArrayByteAlignment
                                               : kRaytracingAccelerationStructureByteAlignment);
  if (!s.ok()) return s;
  if (!update && desc.SourceAccelerationStructureData != 0) {
    return make_error(Id::kBuildUpdate, "source is ",
                      device.describe_address(desc.SourceAccelerationStructureData),
                      ", but it must be 0 without kPerformUpdate");
  }
  if (update) {
    s = check_structure_address(device, desc.SourceAccelerationStructureData, "source",
                                kRaytracingAccelerationStructureByteAlignment);
    if (!s.ok()) return s;
  }
  const auto sizes = device.backend->prebuild_info(command);
  // An update writes as much memory as its source holds. The source may have been compacted, so
  // only the backend knows how much that is.
  if (!update) {
    s = check_live(device, desc.DestAccelerationStructureData, sizes.ResultDataMaxSizeInBytes,
                   "dest");
    if (!s.ok()) return s;
  }
  s = check_scratch(device, desc,
                    update ? sizes.UpdateScratchDataSizeInBytes : sizes.ScratchDataSizeInBytes);
  if (!s.ok()) return s;
  for (size_t i = 0; i < command.geometries.size(); ++i) {
    if (s = check_geometry_memory(device, command.geometries[i], i); !s.ok()) return s;
    if (s = check_linkage_memory(device, command, i); !s.ok()) return s;
  }
  if (micromaps) return check_micromap_memory(device, command.micromaps);
  return inputs.Type == StructureType::kTopLevel ? check_instance_memory(device, inputs) : Status();
}

Status check_structure_bytes(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                             bool written, std::string_view what) {
  if (address % kRaytracingAccelerationStructureByteAlignment != 0) {
    return make_error(Id::kAccelerationStructureAlignment, what, " is at ",
                      device.describe_address(address), "; its address must be a multiple of 256");
  }
  const auto allocation = device.addresses.find(address);
  if (allocation && allocation->acceleration_structure) {
    return make_error(Id::kAccelerationStructureMemory, what, " is in ",
                      named("buffer", allocation->name),
                      ", which holds acceleration structures; serialized and decoded data need a "
                      "plain buffer");
  }
  if (allocation && written && !HasAny(allocation->flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kAccelerationStructureMemory, what, " is in ",
                      named("buffer", allocation->name),
                      ", which was created without kAllowUnorderedAccess");
  }
  return check_live(device, address, bytes, std::string(what));
}

Status check_postbuild_info(const DeviceImpl& device,
                            const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
                            size_t count) {
  using Type = RaytracingAccelerationStructurePostbuildInfoType;
  if (desc.InfoType > Type::kCurrentSize) {
    return make_error(Id::kPostbuildInfo, "InfoType is ", static_cast<uint32_t>(desc.InfoType),
                      "; it must be 0 to 3");
  }
  if (desc.DestBuffer % 8 != 0) {
    return make_error(Id::kPostbuildInfo, "DestBuffer is at ",
                      device.describe_address(desc.DestBuffer),
                      "; its address must be a multiple of 8");
  }
  const auto allocation = device.addresses.find(desc.DestBuffer);
  if (allocation && !HasAny(allocation->flags, ResourceFlags::kAllowUnorderedAccess)) {
    return make_error(Id::kPostbuildInfo, "DestBuffer is in ", named("buffer", allocation->name),
                      ", which was created without kAllowUnorderedAccess");
  }
  return check_live(device, desc.DestBuffer,
                    count * (desc.InfoType == Type::kSerialization ? 16 : 8), "postbuild info");
}

}  // namespace detail

using namespace detail;

DriverMatchingIdentifierStatus Device::CheckDriverMatchingIdentifier(
    SerializedDataType type, const SerializedDataDriverMatchingIdentifier& identifier) const {
  if (!impl_) return DriverMatchingIdentifierStatus::kUnrecognized;
  return runtime::check_identifier(type, identifier);
}

Result<RaytracingAccelerationStructurePrebuildInfo>
Device::GetRaytracingAccelerationStructurePrebuildInfo(
    const BuildRaytracingAccelerationStructureInputs& inputs) const {
  if (!impl_)
    return make_error(Id::kNullHandle,
                      "GetRaytracingAccelerationStructurePrebuildInfo "
                      "on an empty device handle");
  if (Status s = check_inputs(*impl_, inputs, Purpose::kSize); !s.ok()) return s.error();
  return impl_->backend->prebuild_info(describe_build(inputs));
}

}  // namespace rtapi
