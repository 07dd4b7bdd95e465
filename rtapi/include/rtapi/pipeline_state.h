// SPDX-License-Identifier: MIT
/// @file
/// Compute pipelines, and the handle of compute and graphics pipelines.
#pragma once

#include <memory>
#include <string>

#include <rtapi/root_signature.h>
#include <rtapi/shader_library.h>

namespace rtapi {

namespace detail {
struct PipelineStateImpl;
}

/// Describes a compute pipeline for Device::CreateComputePipelineState.
/// [D3D12: D3D12_COMPUTE_PIPELINE_STATE_DESC]
struct ComputePipelineStateDesc {
  RootSignature pRootSignature = {};  ///< a global one that feeds every resource of the shader
  ShaderLibrary CS = {};              ///< where the shader is
  std::string EntryPoint = {};        ///< a compute export of CS; empty: its only one
  std::string Name = {};              ///< for messages; empty: the shader's name
};

/// A compute or graphics pipeline, for CommandList::SetPipelineState. A copyable handle;
/// lists keep it alive until they are reset, and it keeps its libraries and root signature alive.
/// [D3D12: ID3D12PipelineState]
class PipelineState {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same object.
  ///@{
  PipelineState() = default;
  explicit PipelineState(std::shared_ptr<detail::PipelineStateImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const PipelineState&) const = default;
  ///@}

  /// The name in messages; empty for an empty handle.
  const std::string& name() const;
  /// For the library itself.
  const std::shared_ptr<detail::PipelineStateImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::PipelineStateImpl> impl_;
};

}  // namespace rtapi
