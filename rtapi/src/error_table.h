// SPDX-License-Identifier: MIT
//
// Every error that rtapi reports: one id, one row. The ids are stable; messages begin with them.
#pragma once

#include <cstdint>
#include <span>
#include <sstream>
#include <string>

#include <rtapi/result.h>

namespace rtapi::detail {

// The number in KAnnnn.
enum class Id : uint16_t {
  // State objects and pipelines
  kStateObjectInvalidSubobject = 500,
  kCollectionNested = 501,
  kLibraryTarget = 502,
  kExportNotFound = 503,
  kExportDuplicate = 504,
  kExportAmbiguous = 505,
  kExportUnnamed = 506,
  kAssociationUnknownExport = 507,
  kAssociationBadSubobject = 508,
  kAssociationConflict = 509,
  kHitGroupAssociationMismatch = 510,
  kShaderConfigMissing = 511,
  kPipelineConfigMissing = 512,
  kShaderConfigsDiffer = 513,
  kPipelineConfigsDiffer = 514,
  kDefaultAmbiguous = 515,
  kHitGroupShape = 516,
  kHitGroupStage = 517,
  kHitGroupUnresolved = 518,
  kRecursionDepth = 519,
  kPipelineConfig1Tier = 520,
  kAttributeSizeLimit = 521,
  kPayloadTooLarge = 522,
  kAttributesTooLarge = 523,
  kAttributesDisagree = 524,
  kCollectionNotReferable = 525,
  kCollectionWithoutAdditions = 526,
  kRootSignaturesOverlap = 527,
  kBindingMissing = 528,
  kBindingMismatch = 529,
  kStaticSamplerConflict = 530,
  kStaticSamplerCount = 531,
  kPipelineStackSize = 532,
  kAdditionNotAllowed = 533,
  kAdditionConfigsDiffer = 534,
  kAdditionDuplicate = 535,
  kRootSignatureKind = 536,
  kComputeEntryPoint = 537,
  kLibrarySubobject = 538,
  kConfigFlags = 539,
  kCommandSignature = 540,
  kCommandSignatureTier = 541,
  kShaderTier = 542,
  kCallGraphSignatures = 543,
  // Root signatures and descriptors
  kRootSignatureTooLarge = 600,
  kLocalRootSignatureTooLarge = 601,
  kLocalRootSignatureFlags = 602,
  kRootSignatureVisibility = 603,
  kRootSignatureOverlap = 604,
  kRootParameterInvalid = 605,
  kTableMixesSamplers = 606,
  kRangeInvalid = 607,
  kRootSignatureSyntax = 608,
  kRootConstantsCount = 609,
  kStaticSamplerInvalid = 610,
  kHeapSize = 620,
  kHeapType = 621,
  kDescriptorHandle = 622,
  kViewResource = 623,
  kViewRange = 624,
  kViewStride = 625,
  kViewFormat = 626,
  kViewAccess = 627,
  kConstantBufferView = 628,
  kAccelerationStructureView = 629,
  kViewSubresources = 630,
  kSamplerInvalid = 631,
  kDescriptorCopy = 632,
  // Acceleration structures
  kBuildInputs = 700,
  kBuildFlagsExclusive = 701,
  kGeometryMixed = 702,
  kVertexFormat = 703,
  kIndexBuffer = 704,
  kVertexBufferAlignment = 705,
  kTransformAlignment = 707,
  kAabbAlignment = 708,
  kGeometryLimits = 709,
  kGeometryDescsNull = 710,
  kAccelerationStructureAlignment = 711,
  kBuildAddress = 712,
  kAccelerationStructureMemory = 713,
  kBuildUpdate = 714,
  kPostbuildInfo = 715,
  kAccelerationStructureCopy = 716,
  kInstanceDescs = 717,
  kBuildMemoryTooSmall = 719,
  // Command lists and dispatch
  kListNotOpen = 800,
  kBarrier = 802,
  kAccelerationStructureTransition = 803,
  kSetHeaps = 804,
  kRootSignatureNotSet = 805,
  kFenceWait = 806,
  kRootParameterMismatch = 807,
  kRootConstantsRange = 808,
  kRootDescriptorAddress = 809,
  kDescriptorTableHandle = 810,
  kPipelineNotSet = 811,
  kPipelineRootSignature = 812,
  kShaderTableLayout = 813,
  kDispatchTooLarge = 814,
  kShaderTableMemory = 815,
  kIndirectArguments = 816,
  kCopyRange = 817,
  kCopyOverlap = 818,
  kCopyFormat = 819,
  kCopyFootprint = 820,
  kCopyHeap = 821,
  kClearView = 822,
  kListNotExecutable = 823,
  kEvents = 824,
  kTableUnknownExport = 840,
  kTableArgumentCount = 841,
  kTableArgumentKind = 842,
  kTableArgumentSize = 843,
  // Devices and resources
  kNoBackend = 900,
  kUnknownBackend = 901,
  kForeignObject = 903,
  kNullHandle = 904,
  kBufferSize = 905,
  kBufferHeap = 906,
  kAccelerationStructureBuffer = 907,
  kTextureSize = 908,
  kTextureFormat = 909,
  kShaderLibrary = 910,
  kMapDefaultHeap = 911,
  kDeviceDesc = 914,
  kTableDescription = 915,
  kExplain = 916,
};

struct ErrorEntry {
  Id id;
  ErrorCode code;
  const char* title;   // what a message says after the id
  const char* source;  // the rule: a conformance item or a D3D12 topic
};

// Sorted by id.
std::span<const ErrorEntry> ErrorTable();

template <class... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

std::string Quoted(std::string_view name);  // "\"name\""
std::string Hex(uint64_t value);            // "0x1f"

// "KA0504 <title>: <detail>"
Error MakeError(Id id, const std::string& detail);

template <class... Parts>
Error MakeError(Id id, const Parts&... parts) {
  return MakeError(id, Text(parts...));
}

}  // namespace rtapi::detail
