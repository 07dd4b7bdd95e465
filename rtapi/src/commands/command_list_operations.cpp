// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Indirect acceleration structure operations.
#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/resources/rtas_operations.h"

namespace rtapi {

using namespace detail;

namespace {

void use_memory(CommandListImpl& list, const char* call, const runtime::RtasOperation& operation,
                size_t index) {
  const auto use = [&](GpuVirtualAddress address, const char* what) {
    if (address != 0) list.use(call, address, concat("operation ", index, " ", what));
  };
  if (!is_partitioned(operation)) {
    const RtasBatchedOperationData& data = operation.batch;
    const auto mode = mode_of(operation);
    if (mode == RtasOperationMode::kImplicitDestinations) use(data.BatchResultData, "results");
    if (mode != RtasOperationMode::kGetSizes) {
      use(data.ResultAddressArray.StartAddress, "result addresses");
    }
    use(data.BatchScratchData, "scratch");
    use(data.ResultSizeArray.StartAddress, "result sizes");
    use(data.IndirectArgumentArray.StartAddress, "arguments");
    use(data.IndirectArgumentArraySize, "count");
    use(data.ToolsInfo, "tools info");
    return;
  }
  const RtasPartitionedTlasOperationData& data = operation.partitioned;
  use(data.SourceAccelerationStructureData, "source");
  use(data.DestAccelerationStructureData, "dest");
  use(data.ScratchAccelerationStructureData, "scratch");
  use(data.IndirectPartitionedTlasOpCount, "count");
  use(data.IndirectPartitionedTlasOps, "operations");
}

}  // namespace

void CommandList::ExecuteIndirectRTASOperations(std::span<const RtasOperationDesc> descs,
                                                ExecuteIndirectRtasOperationsFlags flags) {
  static constexpr char kCall[] = "ExecuteIndirectRTASOperations";
  if (!impl_ || !impl_->check_open(kCall)) return;
  const DeviceImpl& device = *impl_->device;
  if (flags != ExecuteIndirectRtasOperationsFlags::kNone) {
    return impl_->fail(make_error(Id::kRtasInputs, "flags are ", hex(static_cast<uint32_t>(flags)),
                                  "; none are defined"));
  }
  runtime::RtasOperationsCommand command;
  for (size_t i = 0; i < descs.size(); ++i) {
    const RtasOperationDesc& desc = descs[i];
    if (desc.pInputs == nullptr || desc.pPartitionedTlasOperationData == nullptr) {
      return impl_->fail(make_error(Id::kRtasInputs, "operation ", i, ": ",
                                    desc.pInputs == nullptr ? "pInputs" : "its data", " is null"));
    }
    auto operation = describe_operation(device, *desc.pInputs);
    if (!operation) return impl_->fail(operation.error());
    if (is_partitioned(*operation)) {
      operation->partitioned = *desc.pPartitionedTlasOperationData;
    } else {
      operation->batch = *desc.pBatchedOperationData;
    }
    if (Status s = check_operation_data(device, *operation); !s.ok()) return impl_->fail(s.error());
    use_memory(*impl_, kCall, *operation, i);
    command.operations.push_back(*std::move(operation));
  }
  if (!command.operations.empty()) impl_->record(std::move(command));
}

}  // namespace rtapi
