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
#include "rtapi/src/device_impl.h"

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
  struct Copy {
    std::shared_ptr<runtime::BackendBuffer> memory;
    uint64_t element_bytes = 0;     // one array element with all its mips
    std::vector<Subresource> mips;  // of one array element
    TextureDesc desc;
  };
  const Copy* Find(const std::shared_ptr<runtime::BackendTexture>& texture,
                   const TextureDesc& desc);
  static void Fill(const Copy& copy, const runtime::TextureViewDesc& desc,
                   shader::TextureView& view);

  DeviceImpl& device_;
  std::map<std::pair<uint64_t, bool>, std::unique_ptr<shader::TextureView>> views_;
  std::map<uint64_t, std::unique_ptr<shader::SamplerState>> samplers_;
  std::map<const runtime::BackendTexture*, std::unique_ptr<Copy>> copies_;
};

}  // namespace rtapi::detail
