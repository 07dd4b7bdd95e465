// SPDX-License-Identifier: MIT
//
// Operations on partitioned top levels.
#include <bit>

#include "tests/fuzz/operations_fuzzer.h"

namespace kaamos::test {

using namespace rtapi;

RtasPartitionedTlasWriteInstanceArgs OperationsFuzzer::write(
    const RtasPartitionedTlasInputsDesc& inputs) {
  RtasPartitionedTlasWriteInstanceArgs args;
  const auto coordinate = [&] { return static_cast<float>(below(9)) / 4 - 1; };
  for (auto& row : args.Transform) {
    row[3] = coordinate();
    for (float& x : row) {
      if (below(64) == 0) x = std::bit_cast<float>(static_cast<uint32_t>(random_()));
    }
  }
  args.InstanceID = static_cast<uint32_t>(random_());
  args.InstanceMask = mostly(0xFFu);
  args.InstanceContributionToHitGroupIndex = mostly(0u);
  args.InstanceFlags =
      static_cast<RtasPartitionedTlasInstanceFlags>(mostly(static_cast<uint32_t>(below(128))));
  args.AccelerationStructure = structure();
  args.InstanceIndex = mostly(static_cast<uint32_t>(below(inputs.InstanceCount + 1)));
  args.PartitionIndex = below(4) == 0
                            ? kRtasPartitionIndexGlobalPartition
                            : mostly(static_cast<uint32_t>(below(inputs.PartitionCount + 1)));
  args.ExplicitAABB = {coordinate(), coordinate(), coordinate(),
                       coordinate(), coordinate(), coordinate()};
  return args;
}

RtasPartitionedTlasOperation OperationsFuzzer::partitioned_operation(
    const RtasPartitionedTlasInputsDesc& inputs) {
  using Kind = RtasPartitionedTlasOperationType;
  const size_t count = below(9);
  RtasPartitionedTlasOperation operation;
  operation.Type = static_cast<Kind>(mostly(static_cast<uint32_t>(below(3))));
  operation.ArgCount = mostly(static_cast<uint32_t>(count));
  operation.ArgData.StrideInBytes = rarely() ? 4 * below(40) : 0;
  if (operation.Type == Kind::kWriteInstance) {
    std::vector<RtasPartitionedTlasWriteInstanceArgs> all(count);
    for (auto& each : all) each = write(inputs);
    operation.ArgData.StartAddress = readable(put(all));
  } else if (operation.Type == Kind::kUpdateInstance) {
    std::vector<RtasPartitionedTlasUpdateInstanceArgs> all(count);
    for (auto& each : all) {
      each = {mostly(static_cast<uint32_t>(below(inputs.InstanceCount + 1))), mostly(0u),
              structure()};
    }
    operation.ArgData.StartAddress = readable(put(all));
  } else {
    std::vector<RtasPartitionedTlasTranslatePartitionArgs> all(count);
    for (auto& each : all) {
      each.PartitionIndex = below(4) == 0
                                ? kRtasPartitionIndexGlobalPartition
                                : mostly(static_cast<uint32_t>(below(inputs.PartitionCount + 1)));
      for (float& x : each.PartitionTranslation) {
        x = rarely() ? std::bit_cast<float>(static_cast<uint32_t>(random_()))
                     : static_cast<float>(below(3));
      }
    }
    operation.ArgData.StartAddress = readable(put(all));
  }
  return operation;
}

void OperationsFuzzer::make_partitioned(Operation& operation) {
  using Flags = RtasPartitionedTlasFlags;
  RtasPartitionedTlasInputsDesc& desc = operation.partitioned;
  desc.Flags = one_of({Flags::kNone, Flags::kFastTrace, Flags::kEnablePartitionTranslation,
                       Flags::kEnablePartitionTranslation | Flags::kFastBuild});
  desc.InstanceCount = static_cast<uint32_t>(rarely() ? below(200) : below(12));
  desc.MaxInstancePerPartitionCount = static_cast<uint32_t>(below(12));
  desc.PartitionCount = static_cast<uint32_t>(rarely() ? below(200) : below(5));
  desc.MaxInstanceInGlobalPartitionCount = static_cast<uint32_t>(below(12));
  operation.inputs.Type = RtasOperationType::kPartitionedTlas;
  operation.inputs.pPartitionedTLASInputsDesc = &desc;
  RtasPartitionedTlasOperationData& data = operation.partitioned_data;
  operation.desc.pPartitionedTlasOperationData = &data;
  data.DestAccelerationStructureData = rarely() ? place() : partitioned_place();
  switch (below(4)) {
    case 0:
      break;  // from nothing
    case 1:
      data.SourceAccelerationStructureData = rarely() ? structure() : partitioned_place();
      break;
    default:
      data.SourceAccelerationStructureData = data.DestAccelerationStructureData;
  }
  data.ScratchAccelerationStructureData = scratch_.GetGPUVirtualAddress();
  std::vector<RtasPartitionedTlasOperation> all(below(5));
  for (auto& each : all) each = partitioned_operation(desc);
  data.IndirectPartitionedTlasOpCount =
      put(std::vector<uint32_t>{mostly(static_cast<uint32_t>(all.size()))});
  data.IndirectPartitionedTlasOps = readable(put(all));
}

}  // namespace kaamos::test
