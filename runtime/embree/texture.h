// SPDX-License-Identifier: MIT
//
// Textures in host memory, and the view and sampler objects that descriptors point to.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "kaamos/shader/texture_view.h"
#include "runtime/backend/backend.h"

namespace kaamos::embree {

// Memory of view objects. A view that has ended reads as null for as long as possible: its memory
// is not reused until many others have ended.
class ViewPool {
 public:
  shader::TextureView* create();
  void end(shader::TextureView* view);
  // Lives as long as the pool; equal states share one object.
  const shader::SamplerState* sampler(const shader::SamplerState& state);

 private:
  std::mutex mutex_;
  std::deque<shader::TextureView> views_;
  std::deque<shader::TextureView*> ended_;
  std::deque<shader::SamplerState> samplers_;
};

class Texture final : public runtime::BackendTexture {
 public:
  // Null if out of memory.
  static std::shared_ptr<Texture> create(const rtapi::TextureDesc& desc,
                                         std::shared_ptr<ViewPool> pool);
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

  uint32_t texel_bytes() const { return texel_bytes_; }
  Subresource subresource(uint32_t mip, uint32_t array_element) const;
  // What goes into Descriptor::address; equal descs share one view.
  const shader::TextureView* view(const runtime::TextureViewDesc& desc);

 private:
  Texture(const rtapi::TextureDesc& desc, std::shared_ptr<ViewPool> pool);
  bool is_volume() const { return desc_.Dimension == rtapi::ResourceDimension::kTexture3D; }
  void fill(const runtime::TextureViewDesc& desc, shader::TextureView& view) const;

  rtapi::TextureDesc desc_;
  std::shared_ptr<ViewPool> pool_;
  uint32_t texel_bytes_ = 0;
  uint32_t array_size_ = 1;
  uint64_t element_bytes_ = 0;  // one array element with all its mips
  uint8_t* memory_ = nullptr;
  std::vector<uint64_t> mip_offsets_;
  std::mutex mutex_;
  std::vector<std::pair<runtime::TextureViewDesc, shader::TextureView*>> views_;
};

shader::SamplerState sampler_state_of(const rtapi::SamplerDesc& desc);
// Writes `values` to every element of a view. [D3D12: ClearUnorderedAccessViewUint, -Float]
void clear_view(const shader::Descriptor& view, bool is_float, const uint32_t values[4]);

}  // namespace kaamos::embree
