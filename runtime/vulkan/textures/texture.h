// SPDX-License-Identifier: MIT
//
// Textures, their views and samplers in the bindless set.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/backend/backend.h"
#include "runtime/vulkan/memory/command_stream.h"
#include "runtime/vulkan/textures/descriptor_set.h"

namespace kaamos::vulkan {

class TextureStore {
 public:
  static rtapi::Result<std::unique_ptr<TextureStore>> create(
      std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors);
  virtual ~TextureStore() = default;

  // Like BackendDevice's functions of the same names.
  virtual rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_texture(
      const rtapi::TextureDesc& desc) = 0;
  virtual rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_placed_texture(
      const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) = 0;
  virtual uint64_t placed_bytes(const rtapi::TextureDesc& desc) const = 0;
  virtual rtapi::Result<uint64_t> create_view(runtime::BackendTexture& texture,
                                              const runtime::TextureViewDesc& desc) = 0;
  virtual rtapi::Result<uint64_t> create_sampler(const rtapi::SamplerDesc& desc) = 0;
  virtual bool supports_format(rtapi::Format format, bool unordered_access) const = 0;

  // Recorded after everything before it; images stay in layout GENERAL.
  virtual rtapi::Status copy(CommandStream& stream, const runtime::CopyTextureCommand& command) = 0;
  // For views of textures and of buffers.
  virtual rtapi::Status clear(CommandStream& stream, const runtime::ClearUavCommand& command) = 0;
};

}  // namespace kaamos::vulkan
