// SPDX-License-Identifier: MIT
#include "runtime/embree/texture_memory.h"

#include <algorithm>

#include "runtime/embree/memory.h"

namespace kaamos::embree {
namespace {

// Long rows are an odd number of cache lines apart; otherwise texels above each other would share a
// few cache sets, all of them the same one if a row is a power of two long.
uint64_t row_pitch_of(uint64_t row_bytes) {
  constexpr uint64_t kLine = 64, kLong = 1024;
  if (row_bytes < kLong) return row_bytes;
  return ((row_bytes + kLine - 1) / kLine | 1) * kLine;
}

}  // namespace

TextureMemory::TextureMemory(const rtapi::TextureDesc& desc, uint32_t element_bytes,
                             uint32_t block_side)
    : size_{desc.Width, desc.Height, 1},
      is_volume_(desc.Dimension == rtapi::ResourceDimension::kTexture3D),
      samples_(desc.SampleDesc.Count),
      array_size_(is_volume_ ? 1u : desc.DepthOrArraySize),
      element_bytes_(element_bytes),
      block_side_(block_side) {
  if (is_volume_) size_[2] = desc.DepthOrArraySize;
  mip_offsets_.resize(samples_ > 1 ? samples_ : desc.MipLevels);
  lay_out();
}

void TextureMemory::lay_out() {
  array_pitch_ = 0;
  for (uint32_t mip = 0; mip < mip_offsets_.size(); ++mip) {
    mip_offsets_[mip] = array_pitch_;
    const Subresource s = mip_layout(mip);
    array_pitch_ += (s.slice_pitch * s.extent[2] + 63) / 64 * 64;
  }
}

TextureMemory::~TextureMemory() {
  if (memory_ != nullptr && !mapping_) Memory::release(memory_, size_bytes());
}

bool TextureMemory::allocate() {
  memory_ = Memory::allocate(size_bytes());
  return memory_ != nullptr;
}

bool TextureMemory::map(const runtime::HeapPlace& place) {
  packed_ = true;
  lay_out();
  mapping_ = place.map();
  memory_ = mapping_.first();
  return memory_ != nullptr;
}

TextureMemory::Subresource TextureMemory::mip_layout(uint32_t mip) const {
  Subresource s;
  for (int i = 0; i < 3; ++i) {
    const uint32_t texels = std::max(size_[i] >> (samples_ > 1 ? 0 : mip), 1u);
    s.extent[i] = i < 2 ? (texels + block_side_ - 1) / block_side_ : texels;
  }
  const uint64_t row_bytes = uint64_t{s.extent[0]} * element_bytes_;
  s.row_pitch = packed_ ? row_bytes : row_pitch_of(row_bytes);
  s.slice_pitch = s.row_pitch * s.extent[1];
  return s;
}

TextureMemory::Subresource TextureMemory::subresource(uint32_t mip, uint32_t array_element) const {
  Subresource s = mip_layout(mip);
  s.first = memory_ + array_element * array_pitch_ + mip_offsets_[mip];
  return s;
}

}  // namespace kaamos::embree
