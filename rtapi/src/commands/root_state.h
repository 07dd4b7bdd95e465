// SPDX-License-Identifier: MIT
//
// The root signature and root arguments of a command list: one state for dispatches, one for draws.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include <rtapi/root_signature.h>

#include "rtapi/src/commands/memory_use.h"
#include "runtime/backend/root_bindings.h"

namespace rtapi::detail {

struct CommandListImpl;

struct RootState {
  RootSignature signature;
  // Shared with recorded commands, which read no later changes.
  std::shared_ptr<runtime::RootArguments> arguments = std::make_shared<runtime::RootArguments>();
  std::map<uint32_t, MemoryUse> views;  // by root parameter: what they refer to
  // As in runtime::RootBindings.
  uint64_t set_parameters = 0;
  uint64_t forgotten_parameters = 0;

  void write(uint32_t offset_bytes, const void* value, size_t bytes);
  void clear(uint32_t offset_bytes, uint32_t size_bytes);
  // Takes over the arguments of parameters that are of the same index and type in `before`, as
  // drivers do. Of InvalidCalls::kDropCall. [D3D12: SetComputeRootSignature, undefined]
  void keep_arguments(const RootState& before);
  void note_set(uint32_t parameter) {
    if (parameter < 64) set_parameters |= uint64_t{1} << parameter;
  }
};

// The calls that set them. `call` is the name of the CommandList's member; errors are kept by the
// list.
struct RootSetter {
  CommandListImpl& list;
  RootState& root;
  const char* call;

  void set_signature(const RootSignature& signature);
  void set_constants(uint32_t parameter, uint32_t count, const void* values, uint32_t dest_offset);
  void set_view(uint32_t parameter, RootParameterType type, GpuVirtualAddress address);
  void set_table(uint32_t parameter, GpuDescriptorHandle base);

 private:
  // Returns the parameter if it exists and has the type that the call sets, else null.
  const RootParameter* find(uint32_t index, RootParameterType type);
};

}  // namespace rtapi::detail
