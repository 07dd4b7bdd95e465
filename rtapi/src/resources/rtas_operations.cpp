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

}  // namespace

Status check_operation_data(const DeviceImpl& device, const RtasOperation& operation) {
  const RtasPartitionedTlasOperationData& data = operation.data;
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

Result<RtasOperation> describe_operation(const DeviceImpl& device,
                                         const RtasOperationInputs& inputs) {
  if (!device.desc.IndirectRtasOperations) {
    return make_error(Id::kNoRtasOperations, "an operation of type ",
                      static_cast<uint32_t>(inputs.Type),
                      " needs a device that was created with IndirectRtasOperations");
  }
  RtasOperation operation;
  if (inputs.Type != RtasOperationType::kPartitionedTlas) {
    return bad_inputs("Type is ", static_cast<uint32_t>(inputs.Type),
                      "; only kPartitionedTlas (8) is offered so far");
  }
  if (inputs.pPartitionedTLASInputsDesc == nullptr) {
    return bad_inputs("pPartitionedTLASInputsDesc is null");
  }
  if (Status s = check_partitioned(*inputs.pPartitionedTLASInputsDesc); !s.ok()) return s.error();
  operation.inputs = *inputs.pPartitionedTLASInputsDesc;
  return operation;
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
