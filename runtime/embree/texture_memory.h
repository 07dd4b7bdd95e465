// SPDX-License-Identifier: MIT
//
// The memory of a texture, or of the texels that its blocks decode to: array elements one after
// another, each with all its mips. A multisampled texture has its samples in the place of mips,
// each as large as the first.
#pragma once

#include <cstdint>
#include <vector>

#include <rtapi/resource.h>

#include "runtime/backend/heap_memory.h"

namespace kaamos::embree {

class TextureMemory {
 public:
  // For elements of block_side x block_side texels. Nothing is allocated yet.
  TextureMemory(const rtapi::TextureDesc& desc, uint32_t element_bytes, uint32_t block_side);
  ~TextureMemory();
  TextureMemory(const TextureMemory&) = delete;
  TextureMemory& operator=(const TextureMemory&) = delete;

  // Zeros. False if out of memory.
  bool allocate();
  // What lies in a heap, with rows that follow each other. False if out of memory.
  bool map(const runtime::HeapPlace& place);

  struct Subresource {
    uint8_t* first = nullptr;
    uint32_t extent[3] = {0, 0, 0};  // elements: width, height, depth
    uint64_t row_pitch = 0;          // bytes
    uint64_t slice_pitch = 0;
    uint8_t* at(const uint32_t position[3], uint32_t element_bytes) const {
      return first + position[2] * slice_pitch + position[1] * row_pitch +
             uint64_t{position[0]} * element_bytes;
    }
  };
  // `mip`: or the sample of a multisampled texture.
  Subresource subresource(uint32_t mip, uint32_t array_element) const;

  uint32_t samples() const { return samples_; }
  // Bytes from a sample to the next.
  uint64_t sample_pitch() const { return samples_ == 1 ? 0 : mip_offsets_[1]; }
  uint32_t element_bytes() const { return element_bytes_; }
  uint64_t array_pitch() const { return array_pitch_; }  // from an array element to the next
  uint64_t size_bytes() const { return array_pitch_ * array_size_; }

 private:
  void lay_out();
  Subresource mip_layout(uint32_t mip) const;

  uint32_t size_[3];
  bool is_volume_;
  uint32_t samples_;
  uint32_t array_size_;
  uint32_t element_bytes_;
  uint32_t block_side_;
  bool packed_ = false;  // rows follow each other
  uint64_t array_pitch_ = 0;
  std::vector<uint64_t> mip_offsets_;
  uint8_t* memory_ = nullptr;
  runtime::MappedPages mapping_;  // of memory_, if it is a heap's
};

}  // namespace kaamos::embree
