// SPDX-License-Identifier: MIT
#include "d3d12/objects/message_ids.h"

#include <algorithm>
#include <iterator>

#include <rtapi/error_ids.h>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

namespace {

namespace ids = rtapi::error_ids;

struct Row {
  rtapi::ErrorId error;
  D3D12_MESSAGE_ID id;
};

// Sorted by number.
constexpr Row kRows[] = {
    {ids::checked::kRootAccessOutOfBounds,
     D3D12_MESSAGE_ID_GPU_BASED_VALIDATION_ROOT_DESCRIPTOR_ACCESS_OUT_OF_BOUNDS},
    {ids::checked::kOutsideBinding, D3D12_MESSAGE_ID_GPU_BASED_VALIDATION_DESCRIPTOR_TYPE_MISMATCH},
    {ids::checked::kOutsideHeap,
     D3D12_MESSAGE_ID_GPU_BASED_VALIDATION_DESCRIPTOR_HEAP_INDEX_OUT_OF_BOUNDS},
    {ids::checked::kWrongDescriptor,
     D3D12_MESSAGE_ID_GPU_BASED_VALIDATION_DESCRIPTOR_UNINITIALIZED},
    {ids::checked::kResourceState, D3D12_MESSAGE_ID_INVALID_SUBRESOURCE_STATE},
    {ids::checked::kTransitionBefore, D3D12_MESSAGE_ID_RESOURCE_BARRIER_BEFORE_AFTER_MISMATCH},
    {ids::api::kAdditionNotAllowed, D3D12_MESSAGE_ID_ADD_TO_STATE_OBJECT_ERROR},
    {ids::api::kAdditionConfigsDiffer, D3D12_MESSAGE_ID_ADD_TO_STATE_OBJECT_ERROR},
    {ids::api::kAdditionDuplicate, D3D12_MESSAGE_ID_ADD_TO_STATE_OBJECT_ERROR},
    {ids::api::kDescriptorHandle, D3D12_MESSAGE_ID_INVALID_DESCRIPTOR_HANDLE},
    {ids::api::kViewResource, D3D12_MESSAGE_ID_CREATESHADERRESOURCEVIEW_INVALIDRESOURCE},
    {ids::api::kViewFormat, D3D12_MESSAGE_ID_CREATESHADERRESOURCEVIEW_INVALIDFORMAT},
    {ids::api::kViewAccess, D3D12_MESSAGE_ID_CREATEUNORDEREDACCESSVIEW_INVALIDRESOURCE},
    {ids::api::kConstantBufferView, D3D12_MESSAGE_ID_CREATE_CONSTANT_BUFFER_VIEW_INVALID_DESC},
    {ids::api::kDescriptorCopy, D3D12_MESSAGE_ID_COPY_DESCRIPTORS_INVALID_RANGES},
    {ids::api::kLibraryRootSignature,
     D3D12_MESSAGE_ID_CREATE_ROOT_SIGNATURE_NOT_UNIQUE_IN_DXIL_LIBRARY},
    {ids::api::kListNotOpen, D3D12_MESSAGE_ID_COMMAND_LIST_CLOSED},
    {ids::api::kBarrier, D3D12_MESSAGE_ID_RESOURCE_BARRIER_INVALID_COMBINATION},
    {ids::api::kSetHeaps, D3D12_MESSAGE_ID_SET_DESCRIPTOR_HEAP_INVALID},
    {ids::api::kRootSignatureNotSet, D3D12_MESSAGE_ID_COMMAND_LIST_DISPATCH_ROOT_SIGNATURE_NOT_SET},
    {ids::api::kRootConstantsRange, D3D12_MESSAGE_ID_SET_ROOT_CONSTANT_INVALID},
    {ids::api::kDescriptorTableHandle, D3D12_MESSAGE_ID_SET_DESCRIPTOR_TABLE_INVALID},
    {ids::api::kPipelineNotSet, D3D12_MESSAGE_ID_COMMAND_LIST_PIPELINE_STATE_NOT_SET},
    {ids::api::kPipelineRootSignature,
     D3D12_MESSAGE_ID_COMMAND_LIST_DISPATCH_ROOT_SIGNATURE_MISMATCH},
    {ids::api::kIndirectArguments, D3D12_MESSAGE_ID_EXECUTE_INDIRECT_INVALID_PARAMETERS},
    {ids::api::kCopyOverlap, D3D12_MESSAGE_ID_COPY_ON_SAME_SUBRESOURCE},
    {ids::api::kCopyFormat, D3D12_MESSAGE_ID_COPYTEXTUREREGION_FORMATMISMATCH},
    {ids::api::kClearView, D3D12_MESSAGE_ID_CLEAR_UNORDERED_ACCESS_VIEW_INVALID_DESCRIPTOR_HANDLE},
    {ids::api::kListNotExecutable, D3D12_MESSAGE_ID_EXECUTECOMMANDLISTS_FAILEDCOMMANDLIST},
    {ids::api::kMemoryFreed, D3D12_MESSAGE_ID_OBJECT_DELETED_WHILE_STILL_IN_USE},
    {ids::api::kMapDefaultHeap, D3D12_MESSAGE_ID_MAP_INVALIDHEAP},
    {public_id(ErrorId::kMap), D3D12_MESSAGE_ID_MAP_INVALIDRESOURCE},
    {public_id(ErrorId::kRootSignatureBlob),
     D3D12_MESSAGE_ID_CREATE_ROOT_SIGNATURE_DESERIALIZE_FAILED},
    {public_id(ErrorId::kStateObject), D3D12_MESSAGE_ID_CREATE_STATE_OBJECT_ERROR},
};

struct Range {
  uint16_t first;
  uint16_t last;
  D3D12_MESSAGE_CATEGORY category;
  D3D12_MESSAGE_ID id;  // of all that have no row
};

constexpr Range kRanges[] = {
    {400, 499, D3D12_MESSAGE_CATEGORY_EXECUTION, D3D12_MESSAGE_ID_UNKNOWN},
    {500, 569, D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_ID_CREATE_STATE_OBJECT_ERROR},
    {600, 610, D3D12_MESSAGE_CATEGORY_STATE_CREATION,
     D3D12_MESSAGE_ID_CREATE_ROOT_SIGNATURE_INVALID_CONFIGURATION},
    {620, 621, D3D12_MESSAGE_CATEGORY_STATE_CREATION,
     D3D12_MESSAGE_ID_CREATE_DESCRIPTOR_HEAP_INVALID_DESC},
    {622, 634, D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_ID_UNKNOWN},
    {700, 719, D3D12_MESSAGE_CATEGORY_EXECUTION,
     D3D12_MESSAGE_ID_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INVALID},
    {720, 731, D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_ID_UNKNOWN},
    {740, 899, D3D12_MESSAGE_CATEGORY_EXECUTION, D3D12_MESSAGE_ID_UNKNOWN},
    {900, 999, D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_ID_UNKNOWN},
    {2000, 2799, D3D12_MESSAGE_CATEGORY_SHADER, D3D12_MESSAGE_ID_UNKNOWN},
    {4010, 4029, D3D12_MESSAGE_CATEGORY_STATE_CREATION, D3D12_MESSAGE_ID_UNKNOWN},
    {4030, 4039, D3D12_MESSAGE_CATEGORY_EXECUTION, D3D12_MESSAGE_ID_UNKNOWN},
};

}  // namespace

MessageKind message_kind(rtapi::ErrorId error) {
  MessageKind kind = {D3D12_MESSAGE_CATEGORY_MISCELLANEOUS, D3D12_MESSAGE_ID_UNKNOWN};
  for (const Range& range : kRanges) {
    if (error.number >= range.first && error.number <= range.last)
      kind = {range.category, range.id};
  }
  const Row* row = std::ranges::lower_bound(kRows, error.number, {},
                                            [](const Row& r) { return r.error.number; });
  if (row != std::end(kRows) && row->error == error) kind.id = row->id;
  return kind;
}

}  // namespace kaamos::d3d12
