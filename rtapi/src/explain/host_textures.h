// SPDX-License-Identifier: MIT
//
// Copies of textures in host memory, for shaders that are replayed on the CPU. A texture is copied
// when it is first read; writes go to the copy.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "kaamos/shader/texture_view.h"
#include "rtapi/src/device/device_impl.h"
#include "runtime/shader/texture/block_format.h"

namespace rtapi::detail {

class HostTextures {
 public:
  explicit HostTextures(DeviceImpl& device) : device_(device) {}

  // Returns null if there is no texture behind the descriptor, or if it cannot be read.
  const shader::TextureView* View(const shader::Descriptor& descriptor);
  const shader::SamplerState* Sampler(const shader::Descriptor& descriptor);

 private:
  struct Subresource {
    uint64_t offset = 0;
    uint64_t row_pitch = 0;
    uint64_t slice_pitch = 0;
  };
  // Texels, or blocks, in memory.
  struct Layout {
    uint64_t element_bytes = 0;     // one array element with all its mips
    std::vector<Subresource> mips;  // of one array element
  };
  struct Decoded {
    Layout layout;
    std::vector<uint8_t> memory;
  };
  struct Copy {
    TextureDesc desc;
    Layout layout;
    std::shared_ptr<runtime::BackendBuffer> memory;
    std::map<const shader::BlockCodec*, Decoded> decoded;  // of a block-compressed texture
  };
  static Layout lay_out(const TextureDesc& desc, uint32_t bytes, bool blocks);
  Copy* find(const std::shared_ptr<runtime::BackendTexture>& texture, const TextureDesc& desc);
  static Decoded& decode(Copy& copy, const shader::BlockCodec& codec);
  static void fill(Copy& copy, const runtime::TextureViewDesc& desc, shader::TextureView& view);

  DeviceImpl& device_;
  std::map<std::pair<uint64_t, bool>, std::unique_ptr<shader::TextureView>> views_;
  std::map<uint64_t, std::unique_ptr<shader::SamplerState>> samplers_;
  std::map<const runtime::BackendTexture*, std::unique_ptr<Copy>> copies_;
};

}  // namespace rtapi::detail
