// SPDX-License-Identifier: MIT
//
// Compute pipelines.
#pragma once

#include <memory>
#include <string>

#include <rtapi/root_signature.h>
#include <rtapi/shader_library.h>

namespace rtapi {

namespace detail {
struct PipelineStateImpl;
}

struct ComputePipelineStateDesc {
  RootSignature pRootSignature = {};  // a global one
  ShaderLibrary CS = {};
  std::string EntryPoint = {};  // a compute export of CS; empty: its only one
  std::string Name = {};
};

class PipelineState {
 public:
  PipelineState() = default;
  explicit PipelineState(std::shared_ptr<detail::PipelineStateImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const PipelineState&) const = default;

  const std::string& name() const;
  const std::shared_ptr<detail::PipelineStateImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::PipelineStateImpl> impl_;
};

}  // namespace rtapi
