// SPDX-License-Identifier: MIT
//
// Textures in host memory, and the view and sampler objects that descriptors point to.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "kaamos/shader/texture_view.h"
#include "runtime/backend/backend.h"
#include "runtime/embree/texture_memory.h"
#include "runtime/shader/texture/block_format.h"

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

// A block-compressed texture also keeps its decoded texels for each way to decode them that a view
// asks for.
class Texture final : public runtime::BackendTexture {
 public:
  // `place`: null, or where in a heap it lies; one with blocks lies nowhere, since what others
  // write there would not be decoded. Null if out of memory.
  static std::shared_ptr<Texture> create(const rtapi::TextureDesc& desc,
                                         std::shared_ptr<ViewPool> pool,
                                         const runtime::HeapPlace* place = nullptr);
  ~Texture() override;

  rtapi::Format format() const { return desc_.Format; }
  // The texels, or the blocks.
  const TextureMemory& stored() const { return stored_; }
  // Returns the view that goes into Descriptor::address; equal descs share one. The arena decodes
  // blocks. Null if out of memory.
  const shader::TextureView* view(const runtime::TextureViewDesc& desc, tbb::task_arena& arena);

  // Held while elements are written: no view is made meanwhile.
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  // Must be called under the lock after these elements were written.
  void written(uint32_t mip, uint32_t array_element, const uint32_t origin[3],
               const uint32_t extent[3], tbb::task_arena& arena);

 private:
  struct Decoded {
    const shader::BlockCodec* codec;
    std::unique_ptr<TextureMemory> texels;
  };
  Texture(const rtapi::TextureDesc& desc, std::shared_ptr<ViewPool> pool);
  bool is_volume() const { return desc_.Dimension == rtapi::ResourceDimension::kTexture3D; }
  void fill(const runtime::TextureViewDesc& desc, const TextureMemory& memory,
            shader::TextureView& view) const;
  const TextureMemory* decoded(const shader::BlockCodec& codec, tbb::task_arena& arena);
  void decode(const Decoded& decoded, uint32_t mip, uint32_t array_element,
              const uint32_t origin[3], const uint32_t extent[3], tbb::task_arena& arena) const;

  rtapi::TextureDesc desc_;
  std::shared_ptr<ViewPool> pool_;
  TextureMemory stored_;
  std::mutex mutex_;
  std::vector<Decoded> decoded_;
  std::vector<std::pair<runtime::TextureViewDesc, shader::TextureView*>> views_;
};

shader::SamplerState sampler_state_of(const rtapi::SamplerDesc& desc);
// Writes `values` to every element of a view. [D3D12: ClearUnorderedAccessViewUint, -Float]
void clear_view(const runtime::ClearUavCommand& command);

}  // namespace kaamos::embree
