// SPDX-License-Identifier: MIT
#include "effects/engine/pass_views.h"

#include <numeric>

#include "effects/engine/picture.h"

namespace kaamos::effects {

rtapi::Status PassViews::set_shader_resource(std::uint32_t t, const rtapi::Texture& texture,
                                             rtapi::Format format) {
  bytes_[t] = picture_bytes(texture);
  const auto handle = heap_.GetCPUDescriptorHandle(first_ + t);
  if (format == rtapi::Format::kUnknown) return device_.CreateShaderResourceView(texture, handle);
  rtapi::ShaderResourceViewDesc view;
  view.Format = format;
  view.ViewDimension = rtapi::SrvDimension::kTexture2D;
  return device_.CreateShaderResourceView(texture, view, handle);
}

rtapi::Status PassViews::set_shader_resource(std::uint32_t t, const rtapi::Buffer& buffer,
                                             std::uint32_t stride) {
  bytes_[t] = buffer.size();
  rtapi::ShaderResourceViewDesc view;
  view.ViewDimension = rtapi::SrvDimension::kBuffer;
  view.Buffer.StructureByteStride = stride;
  view.Buffer.NumElements = static_cast<std::uint32_t>(buffer.size() / stride);
  return device_.CreateShaderResourceView(buffer, view, heap_.GetCPUDescriptorHandle(first_ + t));
}

rtapi::Status PassViews::set_shader_resource(std::uint32_t t, const rtapi::Texture& texture,
                                             const rtapi::ShaderResourceViewDesc& view) {
  bytes_[t] = picture_bytes(texture);
  return device_.CreateShaderResourceView(texture, view, heap_.GetCPUDescriptorHandle(first_ + t));
}

rtapi::Status PassViews::set_unordered_access(std::uint32_t u, const rtapi::Texture& texture,
                                              const rtapi::UnorderedAccessViewDesc& view) {
  bytes_[kPassShaderResources + u] = picture_bytes(texture);
  return device_.CreateUnorderedAccessView(
      texture, view, heap_.GetCPUDescriptorHandle(first_ + kPassShaderResources + u));
}

rtapi::Status PassViews::set_unordered_access(std::uint32_t u, const rtapi::Texture& texture) {
  bytes_[kPassShaderResources + u] = picture_bytes(texture);
  return device_.CreateUnorderedAccessView(
      texture, heap_.GetCPUDescriptorHandle(first_ + kPassShaderResources + u));
}

rtapi::Status PassViews::set_unordered_access(std::uint32_t u, const rtapi::Buffer& buffer,
                                              std::uint32_t stride) {
  bytes_[kPassShaderResources + u] = buffer.size();
  rtapi::UnorderedAccessViewDesc view;
  view.ViewDimension = rtapi::UavDimension::kBuffer;
  view.Buffer.StructureByteStride = stride;
  view.Buffer.NumElements = static_cast<std::uint32_t>(buffer.size() / stride);
  return device_.CreateUnorderedAccessView(
      buffer, view, heap_.GetCPUDescriptorHandle(first_ + kPassShaderResources + u));
}

void PassViews::clear(rtapi::CommandList& list, std::uint32_t u,
                      const rtapi::Texture& texture) const {
  const float zero[4] = {0, 0, 0, 0};
  const std::uint32_t index = first_ + kPassShaderResources + u;
  list.SetDescriptorHeaps({heap_});
  list.ClearUnorderedAccessViewFloat(heap_.GetGPUDescriptorHandle(index),
                                     heap_.GetCPUDescriptorHandle(index), texture, zero);
}

std::uint64_t PassViews::bytes() const {
  return std::accumulate(bytes_.begin(), bytes_.end(), std::uint64_t{0});
}

}  // namespace kaamos::effects
