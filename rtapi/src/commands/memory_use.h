// SPDX-License-Identifier: MIT
//
// Memory that a command list names by its address only: shader tables, root views, vertex and index
// buffers, the inputs and results of builds; and textures that it names by descriptors of targets.
// A list does not keep it alive, so they are looked at again when the list executes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <rtapi/result.h>

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

struct MemoryUse {
  std::weak_ptr<const void> owner;  // of the memory
  GpuVirtualAddress address = 0;    // 0: a texture
  std::string role;                 // "HitGroupTable"
  std::string name;                 // of the buffer or texture, as it was then
  uint64_t buffer_bytes = 0;
  const char* call = "";  // "DispatchRays"
  size_t command = 0;     // its number in the list
};
using MemoryUses = std::vector<MemoryUse>;

// Empty if the address is in no live buffer.
MemoryUse use_of(const DeviceImpl& device, GpuVirtualAddress address, std::string role);

// Takes a reference to all of them, or returns KA0856 for the first one that was freed.
Result<std::vector<std::shared_ptr<const void>>> HoldAll(const MemoryUses& uses);

}  // namespace rtapi::detail
