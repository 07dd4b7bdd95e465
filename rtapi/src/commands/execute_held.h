// SPDX-License-Identifier: MIT
// Runs the commands of a list, for queues and for calls that explain a list.
#pragma once

#include <mutex>
#include <span>

#include <rtapi/command_queue.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/commands/memory_use.h"
#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

// Hands commands to the backend; the device is removed where that fails.
inline Status execute_commands(DeviceImpl& device, std::span<const runtime::Command> commands) {
  if (commands.empty()) return {};
  Status s = device.backend->execute(commands);
  if (!s.ok()) device.Remove(s.error());
  return s;
}

// Calls run(), which executes the commands of one list by execute_commands: no other list runs
// meanwhile, the memory that the list uses stays, and checked mode sees one list.
// KA0856: some of that memory has been freed; run() is not called.
template <class Run>
Status execute_held(DeviceImpl& device, const MemoryUses& uses, Run&& run) {
  const auto held = HoldAll(uses);
  if (!held) return held.error();
  const std::lock_guard lock(device.execute_mutex);
  if (device.checks) device.checks->begin_list();
  const Status s = run();
  if (device.checks) device.checks->end_list();
  return s;
}

// Makes a list ready to be explained: closes it, and fails as ExecuteCommandLists would. `call`
// names the caller in messages.
Status prepare_explained(const CommandQueue& queue, const CommandList& list, const char* call);

}  // namespace rtapi::detail
