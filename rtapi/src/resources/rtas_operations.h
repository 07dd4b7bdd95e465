// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The checks of indirect acceleration structure operations that need no look at GPU
// memory.
#pragma once

#include <variant>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "rtapi/src/device/device_impl.h"
#include "runtime/backend/commands.h"

namespace rtapi::detail {

inline bool is_partitioned(const runtime::RtasOperation& operation) {
  return std::holds_alternative<RtasPartitionedTlasInputsDesc>(operation.inputs);
}

// Where the results go; not of partitioned top levels.
RtasOperationMode mode_of(const runtime::RtasOperation& operation);

// Checks inputs and copies the desc that they point to. KA0549, KA0748.
Result<runtime::RtasOperation> describe_operation(const DeviceImpl& device,
                                                  const RtasOperationInputs& inputs);

// Checks alignment, liveness and extent of every address that is known before the operation runs.
// KA0749.
Status check_operation_data(const DeviceImpl& device, const runtime::RtasOperation& operation);

}  // namespace rtapi::detail
