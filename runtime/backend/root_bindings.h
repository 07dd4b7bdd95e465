// SPDX-License-Identifier: MIT
//
// Root arguments and heaps as a dispatch or draw finds them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <rtapi/root_signature.h>

namespace kaamos::runtime {

class BackendBuffer;

// 64 DWORDs of arguments take at most 64 * 8 bytes here, because tables are 8-byte handles. Always
// full size, with zeros where nothing was set, so that a shader with a different root signature
// reads no wild memory.
inline constexpr uint32_t kRootArgumentBytes = 512;
struct alignas(16) RootArguments {
  std::array<uint8_t, kRootArgumentBytes> bytes = {};
};

// The bindings that DispatchRays, Dispatch and draws have in common. They share a snapshot if
// nothing was set between them.
struct RootBindings {
  std::shared_ptr<const RootArguments> root_arguments;  // never null
  // The heaps set on the list; [begin, end) of shader::DispatchConstants. Null: none set.
  std::shared_ptr<BackendBuffer> view_heap;
  std::shared_ptr<BackendBuffer> sampler_heap;
  std::shared_ptr<BackendBuffer> prints;  // the device's print buffer (printing.h), if it has one
  rtapi::RootSignature root_signature;    // the one that was set; may be empty
  // The places of its parameters' arguments in `root_arguments`; null without a signature.
  std::shared_ptr<const std::vector<uint32_t>> argument_offsets;
  // Bits of root parameters that were set since; and of those that were set before, under another
  // signature. For checked mode.
  uint64_t set_parameters = 0;
  uint64_t forgotten_parameters = 0;
};

}  // namespace kaamos::runtime
