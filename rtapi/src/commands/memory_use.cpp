// SPDX-License-Identifier: MIT
#include "rtapi/src/commands/memory_use.h"

#include <utility>

namespace rtapi::detail {

MemoryUse use_of(const DeviceImpl& device, GpuVirtualAddress address, std::string role) {
  MemoryUse use;
  const auto allocation = device.addresses.find(address);
  if (!allocation) return use;
  use.owner = allocation->owner;
  use.address = address;
  use.role = std::move(role);
  use.name = allocation->name;
  use.buffer_bytes = allocation->size_bytes;
  return use;
}

Result<std::vector<std::shared_ptr<const void>>> HoldAll(const MemoryUses& uses) {
  std::vector<std::shared_ptr<const void>> held;
  held.reserve(uses.size());
  for (const MemoryUse& use : uses) {
    held.push_back(use.owner.lock());
    if (held.back() != nullptr) continue;
    if (use.address == 0) {
      return make_error(Id::kMemoryFreed, use.call, ", command ", use.command, ": ", use.role,
                        " was a view of ", named("texture", use.name),
                        ", which was freed after the call was recorded; descriptors keep nothing "
                        "alive, so keep the texture until the list has executed");
    }
    return make_error(
        Id::kMemoryFreed, use.call, ", command ", use.command, ": ", use.role, " (",
        hex(use.address), ") was in ", named("buffer", use.name), " of ", use.buffer_bytes,
        " bytes, which was freed after the call was recorded; a list holds addresses, "
        "so keep the buffer until the list has executed");
  }
  return held;
}

}  // namespace rtapi::detail
