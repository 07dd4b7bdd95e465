// SPDX-License-Identifier: MIT
//
// Textures in host memory, and the views that descriptors name.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/backend.h"

namespace kaamos::embree {

class Texture final : public runtime::BackendTexture {
 public:
  // Null without memory.
  static std::shared_ptr<Texture> create(const rtapi::TextureDesc& desc);
  ~Texture() override;

  struct Subresource {
    uint8_t* texels = nullptr;
    uint32_t extent[3] = {0, 0, 0};  // width, height, depth
    uint64_t row_pitch = 0;          // bytes
    uint64_t slice_pitch = 0;
    uint8_t* at(const uint32_t position[3], uint32_t texel_bytes) const {
      return texels + position[2] * slice_pitch + position[1] * row_pitch +
             uint64_t{position[0]} * texel_bytes;
    }
  };

  const rtapi::TextureDesc& desc() const { return desc_; }
  uint32_t texel_bytes() const { return texel_bytes_; }
  Subresource subresource(uint32_t mip, uint32_t array_element) const;
  uint32_t array_size() const { return array_size_; }

 private:
  explicit Texture(const rtapi::TextureDesc& desc);

  rtapi::TextureDesc desc_;
  uint32_t texel_bytes_ = 0;
  uint32_t array_size_ = 1;
  uint64_t element_bytes_ = 0;  // one array element with all its mips
  uint8_t* memory_ = nullptr;
  std::vector<uint64_t> mip_offsets_;
};

}  // namespace kaamos::embree
