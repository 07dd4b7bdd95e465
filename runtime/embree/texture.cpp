// SPDX-License-Identifier: MIT
#include "runtime/embree/texture.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/backend/clear_view.h"
#include "runtime/embree/memory.h"
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::embree {
namespace {

constexpr size_t kKeptAfterEnd = 4096;  // views, of about 650 bytes each

// Long rows are an odd number of cache lines apart; otherwise texels above each other would share a
// few cache sets, all of them the same one if a row is a power of two long.
uint64_t row_pitch_of(uint64_t row_bytes) {
  constexpr uint64_t kLine = 64, kLong = 1024;
  if (row_bytes < kLong) return row_bytes;
  return ((row_bytes + kLine - 1) / kLine | 1) * kLine;
}

void clear_texture(const shader::TextureView& view, const shader::Texel& value) {
  const shader::FormatCodec& codec = shader::format_codec(view.format);
  if (codec.encode == nullptr || !view.unordered_access) return;
  // Every other row is a prefix of the widest one.
  std::vector<uint8_t> row(size_t{view.mips[0].width} * codec.bytes);
  for (size_t at = 0; at < row.size(); at += codec.bytes) codec.encode(&row[at], value);
  for (uint32_t mip = 0; mip < view.mip_count; ++mip) {
    const shader::TextureMip& m = view.mips[mip];
    if (m.texels == nullptr) continue;
    const uint32_t slices =
        view.dimension == shader::TextureDimension::k3D ? m.depth : view.slice_count;
    for (uint32_t z = 0; z < slices; ++z) {
      for (uint32_t y = 0; y < m.height; ++y) {
        std::memcpy(m.texels + z * m.slice_pitch + uint64_t{y} * m.row_pitch, row.data(),
                    size_t{m.width} * codec.bytes);
      }
    }
  }
}

}  // namespace

shader::TextureView* ViewPool::create() {
  const std::lock_guard lock(mutex_);
  if (ended_.size() <= kKeptAfterEnd) return &views_.emplace_back();
  shader::TextureView* view = ended_.front();
  ended_.pop_front();
  return view;
}

void ViewPool::end(shader::TextureView* view) {
  const std::lock_guard lock(mutex_);
  *view = {};
  ended_.push_back(view);
}

const shader::SamplerState* ViewPool::sampler(const shader::SamplerState& state) {
  const std::lock_guard lock(mutex_);
  for (const shader::SamplerState& known : samplers_) {
    if (std::memcmp(&known, &state, sizeof(state)) == 0) return &known;
  }
  return &samplers_.emplace_back(state);
}

Texture::Texture(const rtapi::TextureDesc& desc, std::shared_ptr<ViewPool> pool)
    : desc_(desc), pool_(std::move(pool)), texel_bytes_(rtapi::GetFormatInfo(desc.Format).bytes) {
  array_size_ = is_volume() ? 1 : desc.DepthOrArraySize;
  for (uint32_t mip = 0; mip < desc.MipLevels; ++mip) {
    mip_offsets_.push_back(element_bytes_);
    const uint64_t width = std::max(desc.Width >> mip, 1u);
    const uint64_t height = std::max(desc.Height >> mip, 1u);
    const uint64_t depth = is_volume() ? std::max(desc.DepthOrArraySize >> mip, 1) : 1;
    element_bytes_ += (row_pitch_of(width * texel_bytes_) * height * depth + 63) / 64 * 64;
  }
}

std::shared_ptr<Texture> Texture::create(const rtapi::TextureDesc& desc,
                                         std::shared_ptr<ViewPool> pool) {
  std::shared_ptr<Texture> texture(new Texture(desc, std::move(pool)));
  texture->memory_ = Memory::allocate(texture->element_bytes_ * texture->array_size_);
  return texture->memory_ != nullptr ? texture : nullptr;
}

Texture::~Texture() {
  for (const auto& [desc, view] : views_) pool_->end(view);
  if (memory_ != nullptr) Memory::release(memory_, element_bytes_ * array_size_);
}

Texture::Subresource Texture::subresource(uint32_t mip, uint32_t array_element) const {
  Subresource result;
  result.texels = memory_ + array_element * element_bytes_ + mip_offsets_[mip];
  result.extent[0] = std::max(desc_.Width >> mip, 1u);
  result.extent[1] = std::max(desc_.Height >> mip, 1u);
  result.extent[2] = is_volume() ? std::max<uint32_t>(desc_.DepthOrArraySize >> mip, 1u) : 1;
  result.row_pitch = row_pitch_of(uint64_t{result.extent[0]} * texel_bytes_);
  result.slice_pitch = result.row_pitch * result.extent[1];
  return result;
}

const shader::TextureView* Texture::view(const runtime::TextureViewDesc& desc) {
  const std::lock_guard lock(mutex_);
  for (const auto& [known, view] : views_) {
    if (known == desc) return view;
  }
  shader::TextureView* view = pool_->create();
  fill(desc, *view);
  views_.emplace_back(desc, view);
  return view;
}

void Texture::fill(const runtime::TextureViewDesc& desc, shader::TextureView& view) const {
  view = {};
  view.format = static_cast<uint32_t>(desc.format);
  view.dimension = static_cast<shader::TextureDimension>(desc.dimension);
  view.unordered_access = desc.unordered_access;
  std::memcpy(view.swizzle, desc.swizzle, sizeof(view.swizzle));
  view.min_lod = desc.min_lod;
  view.slice_count = is_volume() ? 1 : desc.slice_count;
  const uint32_t mips = std::min(
      {desc.mip_count, uint32_t{desc_.MipLevels} - desc.first_mip, shader::kMaxTextureMips});
  for (uint32_t mip = 0; mip < mips; ++mip) {
    const Subresource s = subresource(desc.first_mip + mip, is_volume() ? 0 : desc.first_slice);
    shader::TextureMip& m = view.mips[mip];
    m.texels = s.texels;
    m.width = s.extent[0];
    m.height = s.extent[1];
    m.depth = s.extent[2];
    m.row_pitch = static_cast<uint32_t>(s.row_pitch);
    m.slice_pitch = is_volume() ? s.slice_pitch : element_bytes_;
    if (is_volume() && desc.unordered_access) {
      m.texels += desc.first_slice * s.slice_pitch;
      m.depth = std::min(desc.slice_count, m.depth - std::min(desc.first_slice, m.depth));
    }
  }
  view.mip_count = mips;
  const bool is_plain =
      view.swizzle[0] == 0 && view.swizzle[1] == 1 && view.swizzle[2] == 2 && view.swizzle[3] == 3;
  if (is_plain && view.dimension == shader::TextureDimension::k2D && mips != 0 &&
      view.mips[0].texels != nullptr) {
    view.direct_format = view.format;
  }
}

shader::SamplerState sampler_state_of(const rtapi::SamplerDesc& desc) {
  shader::SamplerState state;
  state.filter = static_cast<uint32_t>(desc.Filter);
  state.address[0] = static_cast<uint32_t>(desc.AddressU);
  state.address[1] = static_cast<uint32_t>(desc.AddressV);
  state.address[2] = static_cast<uint32_t>(desc.AddressW);
  state.mip_lod_bias = desc.MipLODBias;
  state.max_anisotropy = desc.MaxAnisotropy;
  state.comparison = static_cast<uint32_t>(desc.ComparisonFunc);
  std::copy(std::begin(desc.BorderColor), std::end(desc.BorderColor), state.border_color);
  state.min_lod = desc.MinLOD;
  state.max_lod = desc.MaxLOD;
  return state;
}

void clear_view(const shader::Descriptor& descriptor, bool is_float, const uint32_t values[4]) {
  const shader::TextureView* view = shader::texture_view(descriptor);
  if (view == nullptr) return runtime::clear_buffer_view(descriptor, is_float, values);
  const auto format = static_cast<rtapi::Format>(view->format);
  clear_texture(*view, runtime::clear_texel(format, is_float, values));
}

}  // namespace kaamos::embree
