// SPDX-License-Identifier: MIT
/// @file
/// Command signatures: what the bytes of ExecuteIndirect's argument buffer mean.
///
/// @code
/// // A command: one root constant of parameter 2, then a DispatchRaysDesc. 4 + 104 bytes.
/// auto signature = device.CreateCommandSignature(
///     {.ByteStride = 108,
///      .ArgumentDescs = {{.Type = IndirectArgumentType::kConstant, .Constant = {2, 0, 1}},
///                        {.Type = IndirectArgumentType::kDispatchRays}}},
///     root_signature).value();
/// list.ExecuteIndirect(signature, max_commands, arguments, 0, count, 0);
/// @endcode
///
/// Arguments follow each other without the padding that a C++ structure would have here: write them
/// one by one, or let a shader write them before the command executes.
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

/// The type of an argument. [D3D12: D3D12_INDIRECT_ARGUMENT_TYPE]
enum class IndirectArgumentType : uint32_t {
  kDraw = 0,                 ///< DrawArguments, 16 bytes
  kDrawIndexed = 1,          ///< DrawIndexedArguments, 20 bytes
  kDispatch = 2,             ///< DispatchArguments, 12 bytes
  kVertexBufferView = 3,     ///< VertexBufferView, 16 bytes; for draws
  kIndexBufferView = 4,      ///< IndexBufferView, 16 bytes; for draws
  kConstant = 5,             ///< 4 bytes each
  kConstantBufferView = 6,   ///< an address, 8 bytes
  kShaderResourceView = 7,   ///< an address, 8 bytes
  kUnorderedAccessView = 8,  ///< an address, 8 bytes
  kDispatchRays = 9,         ///< DispatchRaysDesc, 104 bytes; needs tier 1.1 (KA0541)
  kDispatchMesh = 10,        ///< refused (KA0540)
};

/// A vertex buffer that the argument buffer sets: a VertexBufferView.
struct IndirectVertexBuffer {
  uint32_t Slot;  ///< 0 to 31
};
/// Root constants that the argument buffer sets: 4 * Num32BitValuesToSet bytes.
struct IndirectConstant {
  uint32_t RootParameterIndex;       ///< of type k32BitConstants
  uint32_t DestOffsetIn32BitValues;  ///< the first constant that is set
  uint32_t Num32BitValuesToSet;      ///< at least 1, all of them inside the parameter
};
/// A root view that the argument buffer sets: an address, 8 bytes.
struct IndirectRootView {
  uint32_t RootParameterIndex;  ///< of the type that goes with the argument's
};

/// One argument of a command. [D3D12: D3D12_INDIRECT_ARGUMENT_DESC]
struct IndirectArgumentDesc {
  /// Selects the member of the union that counts; draws, dispatches and the index buffer have none.
  IndirectArgumentType Type = IndirectArgumentType::kDispatchRays;
  union {
    IndirectConstant Constant = {0, 0, 0};  ///< kConstant
    IndirectVertexBuffer VertexBuffer;      ///< kVertexBufferView
    IndirectRootView ConstantBufferView;    ///< kConstantBufferView
    IndirectRootView ShaderResourceView;    ///< kShaderResourceView
    IndirectRootView UnorderedAccessView;   ///< kUnorderedAccessView
  };
};

/// The arguments that kDispatch reads from the argument buffer. [D3D12: D3D12_DISPATCH_ARGUMENTS]
struct DispatchArguments {
  /// Thread groups along an axis: up to 65535; nothing runs where one of the three is 0.
  ///@{
  uint32_t ThreadGroupCountX = 0;
  uint32_t ThreadGroupCountY = 0;
  uint32_t ThreadGroupCountZ = 0;
  ///@}
};

/// Describes a command signature for Device::CreateCommandSignature. The arguments of a command
/// follow each other without padding, in this order; the next command starts ByteStride later.
/// [D3D12: D3D12_COMMAND_SIGNATURE_DESC]
struct CommandSignatureDesc {
  uint32_t ByteStride = 0;  ///< bytes: a multiple of 4, at least what the arguments take
  /// Root arguments in ascending order of parameter (constants: and of offset), and for draws
  /// vertex and index buffers, none set twice; then one draw or dispatch, the last. [DXR:
  /// D3D12_COMMAND_SIGNATURE_DESC]
  std::vector<IndirectArgumentDesc> ArgumentDescs = {};
  uint32_t NodeMask = 0;  ///< ignored: there is one node
  std::string Name = {};  ///< for messages
};

/// Describes what the bytes of an argument buffer mean. A copyable handle; a recorded
/// ExecuteIndirect keeps what it needs. [D3D12: ID3D12CommandSignature]
class CommandSignature {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same object.
  ///@{
  CommandSignature() = default;
  explicit CommandSignature(std::shared_ptr<detail::CommandSignatureImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandSignature&) const = default;
  ///@}

  /// Returns the desc that the signature was created with; a default desc for an empty handle.
  const CommandSignatureDesc& GetDesc() const;
  /// For the library itself.
  const std::shared_ptr<detail::CommandSignatureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandSignatureImpl> impl_;
};

}  // namespace rtapi
