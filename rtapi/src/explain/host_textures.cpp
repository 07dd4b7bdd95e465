// SPDX-License-Identifier: MIT
#include "rtapi/src/explain/host_textures.h"

#include <algorithm>
#include <iterator>

#include "rtapi/src/resources/resource_impl.h"

namespace rtapi::detail {

HostTextures::Layout HostTextures::lay_out(const TextureDesc& desc, uint32_t bytes, bool blocks) {
  Layout layout;
  for (uint32_t mip = 0; mip < desc.MipLevels; ++mip) {
    const MipExtent extent = blocks ? get_mip_elements(desc, mip) : get_mip_extent(desc, mip);
    Subresource& at = layout.mips.emplace_back();
    at.offset = layout.element_bytes;
    at.row_pitch = align_up(uint64_t{extent.width} * bytes, 256);
    at.slice_pitch = at.row_pitch * extent.height;
    layout.element_bytes = align_up(at.offset + at.slice_pitch * extent.depth, 512);
  }
  return layout;
}

HostTextures::Copy* HostTextures::find(const std::shared_ptr<runtime::BackendTexture>& texture,
                                       const TextureDesc& desc) {
  // No buffer holds samples: explanations see nothing of multisampled textures.
  if (desc.SampleDesc.Count > 1) return nullptr;
  auto& found = copies_[texture.get()];
  if (found != nullptr) return found.get();
  auto copy = std::make_unique<Copy>();
  copy->desc = desc;
  copy->layout = lay_out(desc, GetFormatInfo(desc.Format).bytes, true);
  const uint32_t elements = array_size(desc);
  auto memory = device_.backend->create_buffer(
      {.SizeInBytes = copy->layout.element_bytes * elements, .Heap = HeapType::kReadback});
  if (!memory.ok() || (*memory)->host() == nullptr) return nullptr;
  copy->memory = *memory;
  std::vector<runtime::Command> commands;
  for (uint32_t element = 0; element < elements; ++element) {
    for (uint32_t mip = 0; mip < desc.MipLevels; ++mip) {
      const MipExtent extent = get_mip_elements(desc, mip);
      const Subresource& at = copy->layout.mips[mip];
      runtime::CopyTextureCommand command;
      command.source.texture = texture;
      command.source.mip = mip;
      command.source.array_element = element;
      command.source.plane = runtime::kAllPlanes;
      command.dest.buffer = *memory;
      command.dest.offset = copy->layout.element_bytes * element + at.offset;
      command.dest.row_pitch = static_cast<uint32_t>(at.row_pitch);
      command.dest.slice_pitch = at.slice_pitch;
      command.extent[0] = extent.width;
      command.extent[1] = extent.height;
      command.extent[2] = extent.depth;
      commands.emplace_back(std::in_place_type<runtime::CopyTextureCommand>, std::move(command));
    }
  }
  if (!device_.backend->execute(commands).ok()) return nullptr;
  found = std::move(copy);
  return found.get();
}

HostTextures::Decoded& HostTextures::decode(Copy& copy, const shader::BlockCodec& codec) {
  const auto [at, is_new] = copy.decoded.try_emplace(&codec);
  Decoded& decoded = at->second;
  if (!is_new) return decoded;
  decoded.layout = lay_out(copy.desc, codec.texel_bytes, false);
  const uint32_t elements = array_size(copy.desc);
  decoded.memory.resize(decoded.layout.element_bytes * elements);
  for (uint32_t element = 0; element < elements; ++element) {
    const uint8_t* blocks = copy.memory->host() + copy.layout.element_bytes * element;
    uint8_t* texels = decoded.memory.data() + decoded.layout.element_bytes * element;
    for (uint32_t mip = 0; mip < copy.desc.MipLevels; ++mip) {
      const Subresource& from = copy.layout.mips[mip];
      const Subresource& to = decoded.layout.mips[mip];
      const MipExtent size = get_mip_extent(copy.desc, mip);
      const MipExtent count = get_mip_elements(copy.desc, mip);
      const uint32_t texel_size[2] = {size.width, size.height}, first[2] = {0, 0};
      const uint32_t block_count[2] = {count.width, count.height};
      for (uint32_t z = 0; z < size.depth; ++z) {
        shader::decode_blocks(codec, {blocks + from.offset + z * from.slice_pitch, from.row_pitch},
                              {texels + to.offset + z * to.slice_pitch, to.row_pitch}, texel_size,
                              first, block_count);
      }
    }
  }
  return decoded;
}

void HostTextures::fill(Copy& copy, const runtime::TextureViewDesc& desc,
                        shader::TextureView& view) {
  const bool volume = copy.desc.Dimension == ResourceDimension::kTexture3D;
  view.format = static_cast<uint32_t>(desc.format);
  view.dimension = static_cast<shader::TextureDimension>(desc.dimension);
  view.unordered_access = desc.unordered_access;
  std::copy(std::begin(desc.swizzle), std::end(desc.swizzle), view.swizzle);
  view.slice_count = volume ? 1 : desc.slice_count;
  view.min_lod = desc.min_lod;
  const shader::BlockFormat blocks = shader::block_format(view.format);
  shader::show_decoded(view);
  Decoded* decoded = blocks.codec != nullptr ? &decode(copy, *blocks.codec) : nullptr;
  const Layout& layout_of_copy = decoded != nullptr ? decoded->layout : copy.layout;
  uint8_t* memory = decoded != nullptr ? decoded->memory.data() : copy.memory->host();
  const auto mips = static_cast<uint32_t>(layout_of_copy.mips.size());
  view.mip_count =
      std::min({desc.mip_count, mips - std::min(desc.first_mip, mips), shader::kMaxTextureMips});
  for (uint32_t i = 0; i < view.mip_count; ++i) {
    const uint32_t mip = desc.first_mip + i;
    const Subresource& layout = layout_of_copy.mips[mip];
    const MipExtent extent = get_mip_extent(copy.desc, mip);
    shader::TextureMip& to = view.mips[i];
    const bool is_there = i >= static_cast<uint32_t>(desc.min_lod);
    to.texels = is_there ? memory + layout.offset : nullptr;
    to.width = extent.width;
    to.height = extent.height;
    to.depth = extent.depth;
    to.row_pitch = static_cast<uint32_t>(layout.row_pitch);
    to.slice_pitch = volume ? layout.slice_pitch : layout_of_copy.element_bytes;
    if (!volume) {
      if (is_there) to.texels += desc.first_slice * layout_of_copy.element_bytes;
    } else if (desc.unordered_access) {
      to.texels += desc.first_slice * layout.slice_pitch;
      to.depth =
          std::min(desc.slice_count, extent.depth - std::min(desc.first_slice, extent.depth));
    }
  }
}

const shader::TextureView* HostTextures::View(const shader::Descriptor& descriptor) {
  const bool writable = descriptor.access == shader::DescriptorAccess::kUnorderedAccess;
  const auto key = std::pair(descriptor.address, writable);
  if (const auto it = views_.find(key); it != views_.end()) return it->second.get();
  auto& view = views_[key];
  const auto named = device_.views.find(descriptor.address, writable);
  const auto texture = named ? named->texture.lock() : nullptr;
  if (texture == nullptr) return nullptr;
  Copy* copy = find(texture, named->texture_desc);
  if (copy == nullptr) return nullptr;
  view = std::make_unique<shader::TextureView>();
  fill(*copy, named->desc, *view);
  return view.get();
}

const shader::SamplerState* HostTextures::Sampler(const shader::Descriptor& descriptor) {
  auto& state = samplers_[descriptor.address];
  if (state != nullptr) return state.get();
  const auto desc = device_.views.find_sampler(descriptor.address);
  if (!desc) return nullptr;
  state = std::make_unique<shader::SamplerState>();
  state->filter = static_cast<uint32_t>(desc->Filter);
  state->address[0] = static_cast<uint32_t>(desc->AddressU);
  state->address[1] = static_cast<uint32_t>(desc->AddressV);
  state->address[2] = static_cast<uint32_t>(desc->AddressW);
  state->mip_lod_bias = desc->MipLODBias;
  state->max_anisotropy = desc->MaxAnisotropy;
  state->comparison = static_cast<uint32_t>(desc->ComparisonFunc);
  std::copy(std::begin(desc->BorderColor), std::end(desc->BorderColor), state->border_color);
  state->min_lod = desc->MinLOD;
  state->max_lod = desc->MaxLOD;
  return state.get();
}

}  // namespace rtapi::detail
