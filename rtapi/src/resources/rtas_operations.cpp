// SPDX-License-Identifier: MIT
#include "rtapi/src/resources/rtas_operations.h"

#include "runtime/operations/operation_sizes.h"

namespace rtapi {

namespace detail {

namespace {

using runtime::RtasOperation;

template <class... Parts>
Error bad_inputs(const Parts&... parts) {
  return make_error(Id::kRtasInputs, parts...);
}

Status check_partitioned(const RtasPartitionedTlasInputsDesc& desc) {
  using Flags = RtasPartitionedTlasFlags;
  if (static_cast<uint32_t>(desc.Flags) > 7) {
    return bad_inputs("Flags are ", hex(static_cast<uint32_t>(desc.Flags)),
                      "; only the bits of 0x7 are defined");
  }
  if (HasAny(desc.Flags, Flags::kFastTrace) && HasAny(desc.Flags, Flags::kFastBuild)) {
    return bad_inputs("kFastTrace and kFastBuild are both set");
  }
  if (desc.InstanceCount > kRaytracingMaxInstancesPerTopLevelAccelerationStructure) {
    return bad_inputs("InstanceCount is ", desc.InstanceCount, "; at most 2^24 are allowed");
  }
  if (desc.PartitionCount > kRaytracingMaxInstancesPerTopLevelAccelerationStructure) {
    return bad_inputs("PartitionCount is ", desc.PartitionCount, "; at most 2^24 are allowed");
  }
  return {};
}

// Checks that `bytes` bytes from an aligned address are in a live buffer.
Status check_range(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                   uint32_t alignment, const char* what) {
  if (address % alignment != 0) {
    return make_error(Id::kRtasData, what, " is at ", device.describe_address(address),
                      "; its address must be a multiple of ", alignment);
  }
  const uint64_t available = device.addresses.bytes_from(address);
  if (available >= bytes && available != 0) return {};
  return make_error(Id::kRtasData, what, " needs ", bytes, " bytes at ",
                    device.describe_address(address), ", but there are ", available);
}

Status check_structure(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                       uint32_t alignment, const char* what) {
  if (Status s = check_range(device, address, bytes, alignment, what); !s.ok()) return s;
  const auto allocation = device.addresses.find(address);
  if (allocation->acceleration_structure) return {};
  return make_error(Id::kRtasData, what, " is in ", named("buffer", allocation->name),
                    "; create it with InitialState kRaytracingAccelerationStructure");
}

Status check_scratch(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes) {
  if (Status s = check_range(device, address, bytes, kRaytracingAccelerationStructureByteAlignment,
                             "scratch");
      !s.ok()) {
    return s;
  }
  const auto allocation = device.addresses.find(address);
  if (HasAny(allocation->flags, ResourceFlags::kAllowUnorderedAccess)) return {};
  return make_error(Id::kRtasData, "scratch is in ", named("buffer", allocation->name),
                    ", which was created without kAllowUnorderedAccess");
}

constexpr uint32_t kKnownFormats = static_cast<uint32_t>(RtasVertexFormat::kCompressed1);

Status check_mode(RtasOperationMode mode) {
  if (mode <= RtasOperationMode::kGetSizes) return {};
  return bad_inputs("Mode is ", static_cast<uint32_t>(mode), "; it must be 0, 1 or 2");
}

Status check_flags(RtasOperationFlags flags, uint32_t known) {
  const auto bits = static_cast<uint32_t>(flags);
  if ((bits & ~known) != 0) {
    return bad_inputs("Flags are ", hex(bits), "; only the bits of ", hex(known),
                      " are defined for this type");
  }
  if (HasAny(flags, RtasOperationFlags::kFastTrace) &&
      HasAny(flags, RtasOperationFlags::kFastOperation)) {
    return bad_inputs("kFastTrace and kFastOperation are both set");
  }
  return {};
}

Status check_limits(const RtasClusterLimits& limits) {
  if (limits.MaxGeometryIndexValue > kRtasMaximumGeometryIndex) {
    return bad_inputs("MaxGeometryIndexValue is ", limits.MaxGeometryIndexValue, "; at most ",
                      kRtasMaximumGeometryIndex, " is allowed");
  }
  if (limits.MaxTriangleCountPerCluster > kRtasMaxClusterElements) {
    return bad_inputs("MaxTriangleCountPerCluster is ", limits.MaxTriangleCountPerCluster,
                      "; at most 256 are allowed");
  }
  if (limits.MaxVertexCountPerCluster > kRtasMaxClusterElements) {
    return bad_inputs("MaxVertexCountPerCluster is ", limits.MaxVertexCountPerCluster,
                      "; at most 256 are allowed");
  }
  return {};
}

Status check_index_format(const char* what, RtasIndexFormat format, bool may_be_none) {
  const auto bytes = static_cast<uint32_t>(format);
  if (bytes == 1 || bytes == 2 || bytes == 4 || (bytes == 0 && may_be_none)) return {};
  return bad_inputs(what, " is ", bytes, "; it must be ", may_be_none ? "0, " : "", "1, 2 or 4");
}

Status check_vertex_format(const char* what, RtasVertexFormat format, bool may_be_none) {
  const auto number = static_cast<uint32_t>(format);
  if (number <= kKnownFormats && (number != 0 || may_be_none)) return {};
  return bad_inputs(what, " is ", number, "; it must be ", may_be_none ? 0 : 1, " to 14");
}

constexpr uint32_t kClusterFlags = 0x50C;  // all of RtasOperationFlags

// Checks the formats of indices of clusters and of templates.
template <class Desc>
Status check_index_formats(const Desc& desc) {
  Status s = check_index_format("IndexFormat", desc.IndexFormat, false);
  if (s.ok()) {
    s = check_index_format("GeometryIndexAndFlagsIndexFormat",
                           desc.GeometryIndexAndFlagsIndexFormat, true);
  }
  if (s.ok()) {
    s = check_index_format("OpacityMicromapIndexFormat", desc.OpacityMicromapIndexFormat, true);
  }
  return s;
}

Status check_inputs(const RtasClusterTrianglesInputsDesc& desc) {
  Status s = check_mode(desc.Mode);
  if (s.ok()) s = check_flags(desc.Flags, kClusterFlags);
  if (s.ok()) s = check_limits(desc.Limits);
  if (s.ok()) s = check_vertex_format("VertexFormat", desc.VertexFormat, false);
  if (s.ok()) s = check_index_formats(desc);
  return s;
}

Status check_inputs(const RtasClusterTemplateTrianglesInputsDesc& desc) {
  Status s = check_mode(desc.Mode);
  if (s.ok()) s = check_flags(desc.Flags, kClusterFlags);
  if (s.ok()) s = check_limits(desc.Limits);
  if (s.ok()) s = check_vertex_format("VertexHintFormat", desc.VertexHintFormat, true);
  if (s.ok()) {
    s = check_vertex_format("VertexInstantiationFormat", desc.VertexInstantiationFormat, false);
  }
  if (s.ok()) s = check_index_formats(desc);
  return s;
}

Status check_inputs(const RtasInstantiateClusterTemplateInputsDesc& desc) {
  Status s = check_mode(desc.Mode);
  if (s.ok()) s = check_flags(desc.Flags, kClusterFlags);
  if (s.ok()) s = check_limits(desc.Limits);
  if (s.ok()) s = check_vertex_format("VertexSourceFormat", desc.VertexSourceFormat, false);
  return s;
}

Status check_inputs(const RtasClusterMovesDesc& desc) {
  if (Status s = check_mode(desc.Mode); !s.ok()) return s;
  const auto flags = static_cast<uint32_t>(desc.Flags);
  if ((flags & ~0x600u) != 0) {
    return bad_inputs("Flags are ", hex(flags), "; only the bits of 0x600 are defined for moves");
  }
  if (desc.Type <= RtasMoveOperationType::kClusterTemplate) return {};
  return bad_inputs("the moves' Type is ", static_cast<uint32_t>(desc.Type),
                    "; it must be 0, 1 or 2");
}

Status check_inputs(const RtasClasInputsDesc& desc) {
  if (Status s = check_mode(desc.Mode); !s.ok()) return s;
  return check_flags(desc.Flags, kClusterFlags & ~0x100u);
}

Status check_inputs(const RtasPartitionedTlasInputsDesc& desc) {
  return check_partitioned(desc);
}

// Checks the desc of one type and copies it.
template <class Desc>
Result<RtasOperation> copy_inputs(const Desc* desc, const char* name) {
  if (desc == nullptr) return bad_inputs(name, " is null");
  if (Status s = check_inputs(*desc); !s.ok()) return s.error();
  RtasOperation operation;
  operation.inputs = *desc;
  return operation;
}

using Resolution = RtasOperationAddressResolutionFlags;

// The memory of an operation with many arguments, as far as it is known before the operation runs.
class BatchChecks {
 public:
  BatchChecks(const DeviceImpl& device, const RtasOperation& operation)
      : device_(device),
        data_(operation.batch),
        facts_(runtime::facts_of(operation.inputs)),
        sizes_(runtime::operation_sizes(operation.inputs)) {}

  Status run() const {
    if (static_cast<uint32_t>(data_.AddressResolutionFlags) > 0x3F) {
      return make_error(Id::kRtasData, "AddressResolutionFlags are ",
                        hex(static_cast<uint32_t>(data_.AddressResolutionFlags)),
                        "; only the bits of 0x3F are defined");
    }
    Status s = check_results();
    if (s.ok() && !indirected(data_.BatchScratchData, Resolution::kIndirectedBatchScratch,
                              "BatchScratchData", s)) {
      s = check_scratch(device_, data_.BatchScratchData, sizes_.ScratchDataSizeInBytes);
    }
    if (s.ok()) {
      s = check_array(data_.IndirectArgumentArray, Resolution::kIndirectedIndirectArgumentArray,
                      "IndirectArgumentArray", facts_.max_args != 0);
    }
    const uint64_t count = data_.IndirectArgumentArraySize;
    if (s.ok() && count != 0 &&
        !indirected(count, Resolution::kIndirectedIndirectArgumentCount,
                    "IndirectArgumentArraySize", s)) {
      s = check_range(device_, count, 4, 4, "IndirectArgumentArraySize");
    }
    return s;
  }

 private:
  // Whether the address is read from GPU memory; checks then where it stands.
  bool indirected(GpuVirtualAddress address, Resolution flag, const char* what, Status& s) const {
    if (!HasAny(data_.AddressResolutionFlags, flag)) return false;
    s = check_range(device_, address, 8, 8, what);
    return true;
  }

  Status check_array(const GpuVirtualAddressAndStride& array, Resolution flag, const char* what,
                     bool needed) const {
    if (array.StrideInBytes % 8 != 0) {
      return make_error(Id::kRtasData, what, " has stride ", array.StrideInBytes,
                        "; it must be a multiple of 8");
    }
    Status s;
    if (array.StartAddress == 0 && !needed) return s;
    if (indirected(array.StartAddress, flag, what, s)) return s;
    return check_range(device_, array.StartAddress, 8, 8, what);
  }

  Status check_results() const {
    const bool implicit = facts_.mode == RtasOperationMode::kImplicitDestinations;
    const bool sizes_only = facts_.mode == RtasOperationMode::kGetSizes;
    Status s;
    if (implicit && !indirected(data_.BatchResultData, Resolution::kIndirectedBatchResult,
                                "BatchResultData", s)) {
      s = check_structure(device_, data_.BatchResultData, facts_.all_bytes,
                          static_cast<uint32_t>(facts_.alignment), "BatchResultData");
    }
    if (s.ok() && !sizes_only) {
      s = check_array(data_.ResultAddressArray, Resolution::kIndirectedDestinationAddressArray,
                      "ResultAddressArray", !implicit);
    }
    if (!s.ok()) return s;
    return check_array(data_.ResultSizeArray, Resolution::kIndirectedResultSizeArray,
                       "ResultSizeArray", sizes_only);
  }

  const DeviceImpl& device_;
  const RtasBatchedOperationData& data_;
  runtime::BatchFacts facts_;
  RtasOperationPrebuildInfo sizes_;
};

Status check_partitioned_data(const DeviceImpl& device, const RtasOperation& operation) {
  const RtasPartitionedTlasOperationData& data = operation.partitioned;
  const auto sizes = runtime::operation_sizes(operation.inputs);
  constexpr uint32_t kAlignment = kRaytracingAccelerationStructureByteAlignment;
  Status s = check_structure(device, data.DestAccelerationStructureData,
                             sizes.ResultDataMaxSizeInBytes, kAlignment, "dest");
  if (s.ok() && data.SourceAccelerationStructureData != 0) {
    s = check_structure(device, data.SourceAccelerationStructureData, 1, kAlignment, "source");
  }
  if (s.ok()) {
    s = check_scratch(device, data.ScratchAccelerationStructureData, sizes.ScratchDataSizeInBytes);
  }
  if (s.ok()) {
    s = check_range(device, data.IndirectPartitionedTlasOpCount, 4, 4,
                    "IndirectPartitionedTlasOpCount");
  }
  if (s.ok() && data.IndirectPartitionedTlasOps != 0) {
    s = check_range(device, data.IndirectPartitionedTlasOps, 1, 8, "IndirectPartitionedTlasOps");
  }
  return s;
}

}  // namespace

RtasOperationMode mode_of(const RtasOperation& operation) {
  return runtime::facts_of(operation.inputs).mode;
}

Status check_operation_data(const DeviceImpl& device, const RtasOperation& operation) {
  if (is_partitioned(operation)) return check_partitioned_data(device, operation);
  return BatchChecks(device, operation).run();
}

Result<RtasOperation> describe_operation(const DeviceImpl& device,
                                         const RtasOperationInputs& inputs) {
  if (!device.desc.IndirectRtasOperations) {
    return make_error(Id::kNoRtasOperations, "an operation of type ",
                      static_cast<uint32_t>(inputs.Type),
                      " needs a device that was created with IndirectRtasOperations");
  }
  switch (inputs.Type) {
    case RtasOperationType::kPartitionedTlas:
      return copy_inputs(inputs.pPartitionedTLASInputsDesc, "pPartitionedTLASInputsDesc");
    case RtasOperationType::kBuildClasFromTriangles:
      return copy_inputs(inputs.pClusterTrianglesDesc, "pClusterTrianglesDesc");
    case RtasOperationType::kBuildBlasFromClas:
      return copy_inputs(inputs.pClasDesc, "pClasDesc");
    case RtasOperationType::kBuildClusterTemplatesFromTriangles:
      return copy_inputs(inputs.pClusterTemplateTrianglesDesc, "pClusterTemplateTrianglesDesc");
    case RtasOperationType::kInstantiateClusterTemplates:
      return copy_inputs(inputs.pInstantiateClusterTemplateDesc, "pInstantiateClusterTemplateDesc");
    case RtasOperationType::kMoveClusterObjects:
      return copy_inputs(inputs.pClusterMovesDesc, "pClusterMovesDesc");
  }
  return bad_inputs("Type is ", static_cast<uint32_t>(inputs.Type), "; it must be 0 to 4, or 8");
}

}  // namespace detail

using namespace detail;

RtasOperationPrebuildInfo Device::GetRTASOperationPrebuildInfo(
    const RtasOperationInputs& inputs) const {
  if (!impl_) return {};
  const auto operation = describe_operation(*impl_, inputs);
  if (!operation) {
    impl_->report(MessageSeverity::kWarning, operation.error());
    return {};
  }
  return runtime::operation_sizes(operation->inputs);
}

}  // namespace rtapi
