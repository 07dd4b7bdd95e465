// SPDX-License-Identifier: MIT
#include "rtapi/src/error_table.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace rtapi::detail {

namespace {

constexpr ErrorEntry kTable[] = {
    {Id::kStateObjectInvalidSubobject, ErrorCode::kInvalidArgument, "invalid subobject", "SO-02"},
    {Id::kCollectionNested, ErrorCode::kInvalidArgument, "collection inside a collection", "SO-01"},
    {Id::kLibraryTarget, ErrorCode::kInvalidArgument, "shader library target cannot be used", "SO-03"},
    {Id::kExportNotFound, ErrorCode::kInvalidArgument, "export not found", "SO-04"},
    {Id::kExportDuplicate, ErrorCode::kInvalidArgument, "duplicate export", "SO-06"},
    {Id::kExportAmbiguous, ErrorCode::kInvalidArgument, "ambiguous export name", "SO-07"},
    {Id::kExportUnnamed, ErrorCode::kInvalidArgument, "export without a name", "SO-05"},
    {Id::kAssociationUnknownExport, ErrorCode::kInvalidArgument, "association with an unknown export", "SO-12"},
    {Id::kAssociationBadSubobject, ErrorCode::kInvalidArgument, "association of an unsuitable subobject", "SO-12"},
    {Id::kAssociationConflict, ErrorCode::kInvalidArgument, "conflicting associations", "SO-14, SO-15"},
    {Id::kHitGroupAssociationMismatch, ErrorCode::kInvalidArgument, "hit group associations disagree", "SO-16"},
    {Id::kShaderConfigMissing, ErrorCode::kInvalidArgument, "no ray tracing shader config", "SO-17, SO-19"},
    {Id::kPipelineConfigMissing, ErrorCode::kInvalidArgument, "no ray tracing pipeline config", "SO-17, SO-19"},
    {Id::kShaderConfigsDiffer, ErrorCode::kInvalidArgument, "different shader configs", "SO-17, SO-24"},
    {Id::kPipelineConfigsDiffer, ErrorCode::kInvalidArgument, "different pipeline configs", "SO-17, SO-23"},
    {Id::kDefaultAmbiguous, ErrorCode::kInvalidArgument, "several default associations", "SO-18"},
    {Id::kHitGroupShape, ErrorCode::kInvalidArgument, "hit group has the wrong shaders", "SO-20"},
    {Id::kHitGroupStage, ErrorCode::kInvalidArgument, "hit group imports a shader of another stage", "SO-20"},
    {Id::kHitGroupUnresolved, ErrorCode::kInvalidArgument, "hit group import not found", "SO-25, SO-30"},
    {Id::kRecursionDepth, ErrorCode::kInvalidArgument, "MaxTraceRecursionDepth out of range", "SO-22"},
    {Id::kPipelineConfig1Tier, ErrorCode::kUnsupported, "pipeline config 1 needs tier 1.1", "SO-23"},
    {Id::kAttributeSizeLimit, ErrorCode::kInvalidArgument, "MaxAttributeSizeInBytes out of range", "PAY-03"},
    {Id::kPayloadTooLarge, ErrorCode::kInvalidArgument, "payload larger than the shader config allows", "PAY-02"},
    {Id::kAttributesTooLarge, ErrorCode::kInvalidArgument, "attributes larger than the shader config allows", "PAY-03"},
    {Id::kAttributesDisagree, ErrorCode::kInvalidArgument, "attribute sizes disagree", "PAY-04, SV-13"},
    {Id::kCollectionNotReferable, ErrorCode::kInvalidArgument, "collection does not allow outside dependencies", "SO-27"},
    {Id::kCollectionWithoutAdditions, ErrorCode::kInvalidArgument, "collection does not allow additions", "SO-28"},
    {Id::kRootSignaturesOverlap, ErrorCode::kInvalidArgument, "local and global root signature overlap", "ROOT-11"},
    {Id::kBindingMissing, ErrorCode::kInvalidArgument, "resource is in no root signature", "ROOT-11, SO-19"},
    {Id::kBindingMismatch, ErrorCode::kInvalidArgument, "root parameter cannot feed the resource", "ROOT-11"},
    {Id::kStaticSamplerConflict, ErrorCode::kInvalidArgument, "static samplers disagree", "ROOT-15"},
    {Id::kStaticSamplerCount, ErrorCode::kInvalidArgument, "too many static samplers", "ROOT-15"},
    {Id::kPipelineStackSize, ErrorCode::kInvalidArgument, "pipeline stack size refused", "SO-44"},
    {Id::kAdditionNotAllowed, ErrorCode::kInvalidArgument, "addition to a state object not allowed", "SO-60"},
    {Id::kAdditionConfigsDiffer, ErrorCode::kInvalidArgument, "configs of addition and parent differ", "SO-62"},
    {Id::kAdditionDuplicate, ErrorCode::kInvalidArgument, "addition exports a name of its parent", "SO-63"},
    {Id::kRootSignatureKind, ErrorCode::kInvalidArgument, "root signature of the wrong kind", "ROOT-08"},
    {Id::kComputeEntryPoint, ErrorCode::kInvalidArgument, "no such compute shader", "D3D12: CreateComputePipelineState"},
    {Id::kLibrarySubobject, ErrorCode::kInvalidArgument, "subobject written in HLSL is invalid", "SO-19, SO-21"},
    {Id::kConfigFlags, ErrorCode::kInvalidArgument, "undefined flags", "SO-28"},
    {Id::kRootSignatureTooLarge, ErrorCode::kInvalidArgument, "root signature too large", "D3D12: root signature limits"},
    {Id::kLocalRootSignatureTooLarge, ErrorCode::kInvalidArgument, "local root signature too large", "ROOT-07"},
    {Id::kLocalRootSignatureFlags, ErrorCode::kInvalidArgument, "root signature flags", "ROOT-08"},
    {Id::kRootSignatureVisibility, ErrorCode::kInvalidArgument, "root parameter visibility", "ROOT-09"},
    {Id::kRootSignatureOverlap, ErrorCode::kInvalidArgument, "register bound twice", "D3D12: root signatures"},
    {Id::kRootParameterInvalid, ErrorCode::kInvalidArgument, "root parameter invalid", "D3D12: root signatures"},
    {Id::kTableMixesSamplers, ErrorCode::kInvalidArgument, "descriptor table mixes samplers and views", "D3D12: root signatures"},
    {Id::kRangeInvalid, ErrorCode::kInvalidArgument, "descriptor range invalid", "D3D12: D3D12_DESCRIPTOR_RANGE1"},
    {Id::kRootSignatureSyntax, ErrorCode::kInvalidArgument, "root signature text", "HLSL: specifying root signatures"},
    {Id::kRootConstantsCount, ErrorCode::kInvalidArgument, "root constants without values", "D3D12: D3D12_ROOT_CONSTANTS"},
    {Id::kStaticSamplerInvalid, ErrorCode::kInvalidArgument, "static sampler invalid", "D3D12: D3D12_STATIC_SAMPLER_DESC"},
    {Id::kHeapSize, ErrorCode::kInvalidArgument, "descriptor heap size", "D3D12: hardware tiers"},
    {Id::kHeapType, ErrorCode::kInvalidArgument, "descriptor heap type or flags", "D3D12: D3D12_DESCRIPTOR_HEAP_DESC"},
    {Id::kDescriptorHandle, ErrorCode::kInvalidArgument, "descriptor handle names no slot", "ROOT-17"},
    {Id::kViewResource, ErrorCode::kInvalidArgument, "view does not fit the resource", "D3D12: views"},
    {Id::kViewRange, ErrorCode::kInvalidArgument, "view reaches outside the buffer", "D3D12: views"},
    {Id::kViewStride, ErrorCode::kInvalidArgument, "structure stride or offset", "D3D12: views"},
    {Id::kViewFormat, ErrorCode::kInvalidArgument, "view format", "D3D12: views"},
    {Id::kViewAccess, ErrorCode::kInvalidArgument, "resource does not allow unordered access", "D3D12: D3D12_RESOURCE_FLAGS"},
    {Id::kConstantBufferView, ErrorCode::kInvalidArgument, "constant buffer view", "D3D12: D3D12_CONSTANT_BUFFER_VIEW_DESC"},
    {Id::kAccelerationStructureView, ErrorCode::kInvalidArgument, "acceleration structure view", "ROOT-18, ERR-31"},
    {Id::kViewSubresources, ErrorCode::kInvalidArgument, "view reaches outside the texture", "D3D12: views"},
    {Id::kSamplerInvalid, ErrorCode::kInvalidArgument, "sampler invalid", "D3D12: D3D12_SAMPLER_DESC"},
    {Id::kDescriptorCopy, ErrorCode::kInvalidArgument, "descriptor copy", "D3D12: CopyDescriptorsSimple"},
    {Id::kBuildInputs, ErrorCode::kInvalidArgument, "build inputs", "AS-01"},
    {Id::kBuildFlagsExclusive, ErrorCode::kInvalidArgument, "build flags exclude each other", "AS-50"},
    {Id::kGeometryMixed, ErrorCode::kInvalidArgument, "bottom level mixes geometry types", "AS-01"},
    {Id::kVertexFormat, ErrorCode::kInvalidArgument, "vertex format", "AS-09"},
    {Id::kIndexBuffer, ErrorCode::kInvalidArgument, "index buffer", "AS-06"},
    {Id::kVertexBufferAlignment, ErrorCode::kInvalidArgument, "vertex buffer address or stride", "AS-11"},
    {Id::kTransformAlignment, ErrorCode::kInvalidArgument, "Transform3x4 address", "AS-12"},
    {Id::kAabbAlignment, ErrorCode::kInvalidArgument, "AABB address or stride", "AS-13"},
    {Id::kGeometryLimits, ErrorCode::kInvalidArgument, "acceleration structure limits exceeded", "AS-16"},
    {Id::kGeometryDescsNull, ErrorCode::kInvalidArgument, "geometry descs missing", "AS-02"},
    {Id::kAccelerationStructureAlignment, ErrorCode::kInvalidArgument, "acceleration structure address misaligned", "AS-20"},
    {Id::kBuildAddress, ErrorCode::kInvalidArgument, "address is in no live buffer", "AS-03"},
    {Id::kAccelerationStructureMemory, ErrorCode::kInvalidArgument, "memory cannot hold an acceleration structure", "AS-21, AS-24"},
    {Id::kBuildUpdate, ErrorCode::kInvalidArgument, "update arguments", "AS-52, AS-55"},
    {Id::kPostbuildInfo, ErrorCode::kInvalidArgument, "postbuild info", "AS-46"},
    {Id::kAccelerationStructureCopy, ErrorCode::kInvalidArgument, "acceleration structure copy", "AS-70"},
    {Id::kInstanceDescs, ErrorCode::kInvalidArgument, "instance descs", "AS-14"},
    {Id::kBuildMemoryTooSmall, ErrorCode::kInvalidArgument, "buffer too small", "AS-41, ERR-11"},
    {Id::kListNotOpen, ErrorCode::kInvalidCall, "command list is not open", "D3D12: ID3D12GraphicsCommandList::Close"},
    {Id::kBarrier, ErrorCode::kInvalidArgument, "resource barrier", "D3D12: D3D12_RESOURCE_BARRIER"},
    {Id::kAccelerationStructureTransition, ErrorCode::kInvalidArgument, "transition of an acceleration structure buffer", "AS-22"},
    {Id::kSetHeaps, ErrorCode::kInvalidArgument, "descriptor heaps", "ROOT-16"},
    {Id::kRootSignatureNotSet, ErrorCode::kInvalidCall, "no compute root signature", "ROOT-10"},
    {Id::kFenceWait, ErrorCode::kInvalidCall, "fence not reached", "D3D12: ID3D12Fence"},
    {Id::kRootParameterMismatch, ErrorCode::kInvalidArgument, "root parameter", "D3D12: SetComputeRoot*"},
    {Id::kRootConstantsRange, ErrorCode::kInvalidArgument, "root constants out of range", "D3D12: SetComputeRoot32BitConstants"},
    {Id::kRootDescriptorAddress, ErrorCode::kInvalidArgument, "root descriptor address", "D3D12: SetComputeRoot*View"},
    {Id::kDescriptorTableHandle, ErrorCode::kInvalidArgument, "descriptor table handle", "ROOT-17"},
    {Id::kPipelineNotSet, ErrorCode::kInvalidCall, "no pipeline of this kind", "DSP-06, SO-70"},
    {Id::kPipelineRootSignature, ErrorCode::kInvalidCall, "root signature set is not the pipeline's", "ROOT-14"},
    {Id::kShaderTableLayout, ErrorCode::kInvalidArgument, "shader table alignment or stride", "DSP-07, SBT-14, SBT-17"},
    {Id::kDispatchTooLarge, ErrorCode::kInvalidArgument, "dispatch too large", "DSP-01"},
    {Id::kShaderTableMemory, ErrorCode::kInvalidArgument, "shader table outside live memory", "SBT-23"},
    {Id::kCopyRange, ErrorCode::kInvalidArgument, "copy out of range", "D3D12: CopyBufferRegion"},
    {Id::kCopyOverlap, ErrorCode::kInvalidArgument, "copy overlaps itself", "D3D12: CopyBufferRegion"},
    {Id::kCopyFormat, ErrorCode::kInvalidArgument, "copy between unlike resources", "D3D12: CopyTextureRegion"},
    {Id::kCopyFootprint, ErrorCode::kInvalidArgument, "copy footprint", "D3D12: D3D12_PLACED_SUBRESOURCE_FOOTPRINT"},
    {Id::kCopyHeap, ErrorCode::kInvalidArgument, "copy with this heap type", "D3D12: D3D12_HEAP_TYPE"},
    {Id::kClearView, ErrorCode::kInvalidArgument, "clear of an unordered access view", "D3D12: ClearUnorderedAccessViewUint"},
    {Id::kListNotExecutable, ErrorCode::kInvalidCall, "command list cannot be executed", "D3D12: ExecuteCommandLists"},
    {Id::kEvents, ErrorCode::kInvalidCall, "events", "D3D12: EndEvent"},
    {Id::kTableUnknownExport, ErrorCode::kNotFound, "shader table: unknown export", "SO-40"},
    {Id::kTableArgumentCount, ErrorCode::kInvalidArgument, "shader table: number of local arguments", "ROOT-01"},
    {Id::kTableArgumentKind, ErrorCode::kInvalidArgument, "shader table: kind of a local argument", "ROOT-01"},
    {Id::kTableArgumentSize, ErrorCode::kInvalidArgument, "shader table: size of a local argument", "ROOT-04"},
    {Id::kNoBackend, ErrorCode::kUnsupported, "no backend", "CreateDevice"},
    {Id::kUnknownBackend, ErrorCode::kNotFound, "unknown backend", "CreateDevice"},
    {Id::kDeviceRemoved, ErrorCode::kDeviceRemoved, "device removed", "D3D12: GetDeviceRemovedReason"},
    {Id::kForeignObject, ErrorCode::kInvalidArgument, "object of another device", "D3D12: devices"},
    {Id::kNullHandle, ErrorCode::kInvalidArgument, "empty handle", "D3D12: E_INVALIDARG"},
    {Id::kBufferSize, ErrorCode::kInvalidArgument, "buffer size", "D3D12: CreateCommittedResource"},
    {Id::kBufferHeap, ErrorCode::kInvalidArgument, "buffer heap, flags or state", "D3D12: D3D12_HEAP_TYPE"},
    {Id::kAccelerationStructureBuffer, ErrorCode::kInvalidArgument, "acceleration structure buffer", "AS-21"},
    {Id::kTextureSize, ErrorCode::kInvalidArgument, "texture size", "D3D12: D3D12_RESOURCE_DESC"},
    {Id::kTextureFormat, ErrorCode::kInvalidArgument, "texture format", "D3D12: D3D12_RESOURCE_DESC"},
    {Id::kShaderLibrary, ErrorCode::kInvalidArgument, "shader library cannot be used", "kaamos/shader/abi.h"},
    {Id::kMapDefaultHeap, ErrorCode::kInvalidArgument, "default heap cannot be mapped", "D3D12: ID3D12Resource::Map"},
    {Id::kOutOfMemory, ErrorCode::kOutOfMemory, "out of memory", "D3D12: E_OUTOFMEMORY"},
    {Id::kDeviceDesc, ErrorCode::kInvalidArgument, "device description", "CreateDevice"},
};

}  // namespace

std::span<const ErrorEntry> ErrorTable() { return kTable; }

std::string Quoted(std::string_view name) { return "\"" + std::string(name) + "\""; }

std::string Hex(uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(value));
  return text;
}

Error MakeError(Id id, const std::string& detail) {
  const auto* entry = std::lower_bound(
      std::begin(kTable), std::end(kTable), id,
      [](const ErrorEntry& e, Id wanted) { return e.id < wanted; });
  const bool known = entry != std::end(kTable) && entry->id == id;
  char number[8];
  std::snprintf(number, sizeof number, "KA%04u", static_cast<unsigned>(id));
  Error error;
  error.id = number;
  error.code = known ? entry->code : ErrorCode::kFailed;
  error.message = Text(number, " ", known ? entry->title : "error", ": ", detail);
  return error;
}

}  // namespace rtapi::detail
