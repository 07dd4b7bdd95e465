// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/root_signature.h>

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

struct RootSignatureImpl {
  std::shared_ptr<DeviceImpl> device;
  RootSignatureDesc desc;         // append offsets are resolved
  std::vector<uint32_t> offsets;  // of each parameter's arguments
  uint32_t argument_bytes = 0;
  std::vector<shader::Descriptor> static_samplers;

  bool is_local() const { return HasAny(desc.Flags, RootSignatureFlags::kLocalRootSignature); }
};

// Compares parameters, samplers and flags.
bool same_definition(const RootSignature& a, const RootSignature& b);
// Compares the types and sizes of parameters: whether arguments for one lie right for the other.
bool same_arguments(const RootSignature& a, const RootSignature& b);
bool same_sampler(const StaticSamplerDesc& a, const StaticSamplerDesc& b);

// A range of registers that a signature defines, for overlap tests.
struct RegisterRange {
  shader::RegisterClass register_class = shader::RegisterClass::kShaderResource;
  uint32_t space = 0;
  uint32_t first = 0;
  uint64_t end = 0;        // one past the last; 2^32 if unbounded
  uint32_t parameter = 0;  // its index; for static samplers, the sampler's
  bool static_sampler = false;
  ShaderVisibility visibility = ShaderVisibility::kAll;
};
std::vector<RegisterRange> get_register_ranges(const RootSignatureDesc& desc);
// Returns whether some shader sees a register of both.
bool overlap(const RegisterRange& a, const RegisterRange& b);
std::string register_text(shader::RegisterClass register_class, uint32_t index, uint32_t space);

// Resolves and lays out the signature; the backend makes the static samplers.
Result<RootSignature> make_root_signature(const std::shared_ptr<DeviceImpl>& device,
                                          const RootSignatureDesc& desc);

}  // namespace rtapi::detail
