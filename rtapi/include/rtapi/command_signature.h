// SPDX-License-Identifier: MIT
//
// Command signatures: what the bytes of ExecuteIndirect's argument buffer mean.
//
//   // A command: one root constant of parameter 2, then a DispatchRaysDesc. 4 + 104 bytes.
//   auto signature = device.CreateCommandSignature(
//       {.ByteStride = 108,
//        .ArgumentDescs = {{.Type = IndirectArgumentType::kConstant, .Constant = {2, 0, 1}},
//                          {.Type = IndirectArgumentType::kDispatchRays}}},
//       root_signature).value();
//   list.ExecuteIndirect(signature, max_commands, arguments, 0, count, 0);
//
// Arguments follow each other without the padding that a C++ structure would have here: write them
// one by one, or let a shader write them before the command executes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/root_signature.h>

namespace rtapi {

namespace detail {
struct CommandSignatureImpl;
}

// Those of drawing have their numbers here and are refused.
enum class IndirectArgumentType : uint32_t {
  kDraw = 0,
  kDrawIndexed = 1,
  kDispatch = 2,  // DispatchArguments, 12 bytes
  kVertexBufferView = 3,
  kIndexBufferView = 4,
  kConstant = 5,             // 4 bytes each
  kConstantBufferView = 6,   // an address, 8 bytes
  kShaderResourceView = 7,   // an address, 8 bytes
  kUnorderedAccessView = 8,  // an address, 8 bytes
  kDispatchRays = 9,         // DispatchRaysDesc, 104 bytes; needs tier 1.1
  kDispatchMesh = 10,
};

struct IndirectVertexBuffer {
  uint32_t Slot;
};
struct IndirectConstant {
  uint32_t RootParameterIndex;
  uint32_t DestOffsetIn32BitValues;
  uint32_t Num32BitValuesToSet;
};
struct IndirectRootView {
  uint32_t RootParameterIndex;
};

// The member of the union that counts is that of Type; the dispatches have none.
struct IndirectArgumentDesc {
  IndirectArgumentType Type = IndirectArgumentType::kDispatchRays;
  union {
    IndirectConstant Constant = {0, 0, 0};
    IndirectVertexBuffer VertexBuffer;
    IndirectRootView ConstantBufferView;
    IndirectRootView ShaderResourceView;
    IndirectRootView UnorderedAccessView;
  };
};

struct DispatchArguments {
  uint32_t ThreadGroupCountX = 0;
  uint32_t ThreadGroupCountY = 0;
  uint32_t ThreadGroupCountZ = 0;
};

// The arguments of a command follow each other without padding, in this order; the next command
// starts ByteStride later. [D3D12: Indirect drawing]
struct CommandSignatureDesc {
  uint32_t ByteStride = 0;  // bytes, a multiple of 4, at least what the arguments take
  // Root arguments in ascending order of parameter (constants: and of offset), none set twice; then
  // one dispatch, the last. [DXR: D3D12_COMMAND_SIGNATURE_DESC]
  std::vector<IndirectArgumentDesc> ArgumentDescs = {};
  uint32_t NodeMask = 0;  // accepted; there is one node
  std::string Name = {};
};

class CommandSignature {
 public:
  CommandSignature() = default;
  explicit CommandSignature(std::shared_ptr<detail::CommandSignatureImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandSignature&) const = default;

  const CommandSignatureDesc& GetDesc() const;
  const std::shared_ptr<detail::CommandSignatureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandSignatureImpl> impl_;
};

}  // namespace rtapi
