// SPDX-License-Identifier: MIT
#include "runtime/embree/texture.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/backend/clear_view.h"
#include "runtime/embree/parallel.h"
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::embree {
namespace {

constexpr size_t kKeptAfterEnd = 4096;   // views, of about 650 bytes each
constexpr uint64_t kBlocksAtOnce = 256;  // fewer blocks are not worth a second thread

void clear_texture(const shader::TextureView& view, const runtime::ClearUavCommand& command) {
  const shader::FormatCodec& codec = shader::format_codec(view.format);
  if (codec.encode == nullptr || !view.unordered_access) return;
  const auto format = static_cast<rtapi::Format>(view.format);
  const shader::Texel value = runtime::clear_texel(format, command.is_float, command.values);
  // Every other row is a prefix of the widest one.
  std::vector<uint8_t> row(size_t{view.mips[0].width} * codec.bytes);
  for (size_t at = 0; at < row.size(); at += codec.bytes) codec.encode(&row[at], value);
  for (uint32_t mip = 0; mip < view.mip_count; ++mip) {
    const shader::TextureMip& m = view.mips[mip];
    if (m.texels == nullptr) continue;
    const uint32_t slices =
        view.dimension == shader::TextureDimension::k3D ? m.depth : view.slice_count;
    for (const rtapi::Rect& part : runtime::cleared_parts(command, m.width, m.height)) {
      const size_t offset = static_cast<size_t>(part.left) * codec.bytes;
      const size_t bytes = static_cast<size_t>(part.right - part.left) * codec.bytes;
      for (uint32_t z = 0; z < slices; ++z) {
        for (auto y = static_cast<uint64_t>(part.top); y < static_cast<uint64_t>(part.bottom);
             ++y) {
          std::memcpy(m.texels + z * m.slice_pitch + y * m.row_pitch + offset, row.data(), bytes);
        }
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
    : desc_(desc),
      pool_(std::move(pool)),
      stored_(desc, rtapi::GetFormatInfo(desc.Format).bytes,
              rtapi::GetFormatInfo(desc.Format).block_side) {}

std::shared_ptr<Texture> Texture::create(const rtapi::TextureDesc& desc,
                                         std::shared_ptr<ViewPool> pool,
                                         const runtime::HeapPlace* place) {
  std::shared_ptr<Texture> texture(new Texture(desc, std::move(pool)));
  const bool shares = place != nullptr && rtapi::GetFormatInfo(desc.Format).block_side == 1;
  const bool made = shares ? texture->stored_.map(*place) : texture->stored_.allocate();
  return made ? texture : nullptr;
}

Texture::~Texture() {
  for (const auto& [desc, view] : views_) pool_->end(view);
}

const shader::TextureView* Texture::view(const runtime::TextureViewDesc& desc,
                                         tbb::task_arena& arena) {
  const std::lock_guard lock(mutex_);
  for (const auto& [known, view] : views_) {
    if (known == desc) return view;
  }
  const shader::BlockFormat blocks = shader::block_format(static_cast<uint32_t>(desc.format));
  const TextureMemory* memory = blocks.codec != nullptr ? decoded(*blocks.codec, arena) : &stored_;
  if (memory == nullptr) return nullptr;
  shader::TextureView* view = pool_->create();
  fill(desc, *memory, *view);
  views_.emplace_back(desc, view);
  return view;
}

void Texture::written(uint32_t mip, uint32_t array_element, const uint32_t origin[3],
                      const uint32_t extent[3], tbb::task_arena& arena) {
  for (const Decoded& copy : decoded_) decode(copy, mip, array_element, origin, extent, arena);
}

const TextureMemory* Texture::decoded(const shader::BlockCodec& codec, tbb::task_arena& arena) {
  for (const Decoded& known : decoded_) {
    if (known.codec == &codec) return known.texels.get();
  }
  Decoded made{&codec, std::make_unique<TextureMemory>(desc_, codec.texel_bytes, 1)};
  if (!made.texels->allocate()) return nullptr;
  const uint32_t array_size = is_volume() ? 1u : desc_.DepthOrArraySize;
  for (uint32_t element = 0; element < array_size; ++element) {
    for (uint32_t mip = 0; mip < desc_.MipLevels; ++mip) {
      const uint32_t first[3] = {0, 0, 0};
      decode(made, mip, element, first, stored_.subresource(mip, element).extent, arena);
    }
  }
  return decoded_.emplace_back(std::move(made)).texels.get();
}

void Texture::decode(const Decoded& copy, uint32_t mip, uint32_t array_element,
                     const uint32_t origin[3], const uint32_t extent[3],
                     tbb::task_arena& arena) const {
  const TextureMemory::Subresource from = stored_.subresource(mip, array_element);
  const TextureMemory::Subresource to = copy.texels->subresource(mip, array_element);
  const auto rows = [&](uint64_t begin, uint64_t end) {
    for (uint64_t row = begin; row < end; ++row) {
      const uint64_t z = origin[2] + row / extent[1];
      const uint32_t first[2] = {origin[0], origin[1] + static_cast<uint32_t>(row % extent[1])};
      const uint32_t count[2] = {extent[0], 1};
      shader::decode_blocks(*copy.codec, {from.first + z * from.slice_pitch, from.row_pitch},
                            {to.first + z * to.slice_pitch, to.row_pitch}, to.extent, first, count);
    }
  };
  const uint64_t row_count = uint64_t{extent[1]} * extent[2];
  if (row_count * extent[0] < kBlocksAtOnce) return rows(0, row_count);
  parallel_ranges(arena, row_count, rows);
}

void Texture::fill(const runtime::TextureViewDesc& desc, const TextureMemory& memory,
                   shader::TextureView& view) const {
  view = {};
  view.format = static_cast<uint32_t>(desc.format);
  view.dimension = static_cast<shader::TextureDimension>(desc.dimension);
  view.unordered_access = desc.unordered_access;
  std::memcpy(view.swizzle, desc.swizzle, sizeof(view.swizzle));
  shader::show_decoded(view);
  view.min_lod = desc.min_lod;
  view.slice_count = is_volume() ? 1 : desc.slice_count;
  uint32_t mips = std::min(
      {desc.mip_count, uint32_t{desc_.MipLevels} - desc.first_mip, shader::kMaxTextureMips});
  // Shaders see samples as mips, all of one size.
  if (memory.samples() > 1) {
    mips = memory.samples();
    view.dimension = desc.dimension == rtapi::SrvDimension::kTexture2DMSArray
                         ? shader::TextureDimension::k2DArray
                         : shader::TextureDimension::k2D;
  }
  // Mips below the clamp are out of bounds for every access.
  const auto first_there = static_cast<uint32_t>(desc.min_lod);
  for (uint32_t mip = 0; mip < mips; ++mip) {
    const TextureMemory::Subresource s =
        memory.subresource(desc.first_mip + mip, is_volume() ? 0 : desc.first_slice);
    shader::TextureMip& m = view.mips[mip];
    m.texels = mip < first_there ? nullptr : s.first;
    m.width = s.extent[0];
    m.height = s.extent[1];
    m.depth = s.extent[2];
    m.row_pitch = static_cast<uint32_t>(s.row_pitch);
    m.slice_pitch = is_volume() ? s.slice_pitch : memory.array_pitch();
    if (is_volume() && desc.unordered_access) {  // which have no clamp
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

void clear_view(const runtime::ClearUavCommand& command) {
  const shader::TextureView* view = shader::texture_view(command.view);
  if (view == nullptr) return runtime::clear_buffer_view(command.view, command);
  clear_texture(*view, command);
}

}  // namespace kaamos::embree
