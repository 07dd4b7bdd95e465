// SPDX-License-Identifier: MIT
#include "rtapi/src/commands/execute_held.h"

#include "rtapi/src/commands/command_queue_impl.h"

namespace rtapi::detail {

Status prepare_explained(const CommandQueue& queue, const CommandList& list, const char* call) {
  if (!queue) return make_error(Id::kNullHandle, call, ": the queue is an empty handle");
  const std::shared_ptr<DeviceImpl>& device = queue.impl()->device;
  if (Status s = CheckHandle(device, list, concat(call, ": the list")); !s.ok()) return s;
  if (list.is_open()) {
    if (Status s = CommandList(list).Close(); !s.ok()) return s;
  }
  if (!list.GetErrors().empty()) return list.GetErrors().front();
  return device->removed();
}

}  // namespace rtapi::detail
