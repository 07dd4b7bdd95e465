// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/texture.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "runtime/backend/clear_view.h"
#include "runtime/shader/texture/format_codec.h"
#include "runtime/vulkan/memory/memory.h"
#include "runtime/vulkan/textures/image.h"
#include "runtime/vulkan/textures/sampler.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

using runtime::CopyTextureCommand;
using runtime::TextureCopyPlace;

constexpr uint64_t kClearPatternBytes = 1 << 20;

const Image& image_of(const TextureCopyPlace& place) {
  return static_cast<const Image&>(*place.texture);
}

bool has_both(const Image& image) {
  return (image.aspects() & VK_IMAGE_ASPECT_STENCIL_BIT) != 0;
}

VkImageSubresourceLayers layers(const TextureCopyPlace& place) {
  VkImageAspectFlags aspects = image_of(place).aspects();
  if (has_both(image_of(place))) {
    aspects = place.plane == runtime::kStencilPlane ? VK_IMAGE_ASPECT_STENCIL_BIT
                                                    : VK_IMAGE_ASPECT_DEPTH_BIT;
  }
  return {aspects, place.mip, place.array_element, 1};
}

uint32_t element_bytes(const TextureCopyPlace& place) {
  return rtapi::GetFormatInfo(runtime::plane_format(image_of(place).desc().Format, place.plane))
      .bytes;
}

VkOffset3D offset_of(const TextureCopyPlace& place) {
  const auto side = static_cast<int32_t>(image_of(place).block_side());
  return {static_cast<int32_t>(place.origin[0]) * side,
          static_cast<int32_t>(place.origin[1]) * side, static_cast<int32_t>(place.origin[2])};
}

// In texels of that texture: blocks at its edges may reach out of it.
VkExtent3D extent_of(const CopyTextureCommand& command, const TextureCopyPlace& place) {
  const Image& image = image_of(place);
  const VkExtent3D size = image.extent(place.mip);
  const VkOffset3D offset = offset_of(place);
  const auto texels = [&](uint32_t elements, uint32_t total, int32_t first) {
    return std::min(elements * image.block_side(), total - static_cast<uint32_t>(first));
  };
  return {texels(command.extent[0], size.width, offset.x),
          texels(command.extent[1], size.height, offset.y), command.extent[2]};
}

// The byte of its buffer at which a copy begins.
uint64_t first_byte(const TextureCopyPlace& place, uint32_t bytes) {
  return place.offset + place.origin[2] * place.slice_pitch +
         uint64_t{place.origin[1]} * place.row_pitch + uint64_t{place.origin[0]} * bytes;
}

// The same, in its VkBuffer.
uint64_t buffer_offset(const TextureCopyPlace& place, uint32_t bytes) {
  return gpu_buffer_of(*place.buffer).offset() + first_byte(place, bytes);
}

// What copies of these elements begin at a multiple of: also 4, as those of depth and stencil must.
uint32_t alignment_of(uint32_t bytes) {
  return bytes % 4 == 0 ? bytes : 4;
}

// Returns whether Vulkan can describe these rows and slices: everything must be a whole number of
// elements and rows.
bool expressible(const TextureCopyPlace& place, uint32_t bytes) {
  return place.row_pitch % bytes == 0 && buffer_offset(place, bytes) % alignment_of(bytes) == 0 &&
         place.slice_pitch % place.row_pitch == 0;
}

// Memory for elements in rows and slices without gaps.
struct Staging {
  std::shared_ptr<GpuBuffer> buffer;
  uint64_t offset = 0;  // in the VkBuffer; a multiple of alignment_of()
  uint8_t* host = nullptr;
};

rtapi::Result<Staging> stage(Gpu& gpu, uint64_t elements, uint32_t bytes) {
  const uint32_t alignment = alignment_of(bytes);
  auto made = gpu.create_buffer(elements * bytes + alignment, "staging memory of a texture",
                                InitialContents::kAny);
  if (!made) return made.error();
  Staging result;
  result.buffer = std::move(*made);
  const uint64_t start = result.buffer->offset();
  result.offset = (start + alignment - 1) / alignment * alignment;
  result.host = result.buffer->host() + (result.offset - start);
  return result;
}

uint64_t element_count(const CopyTextureCommand& command) {
  return uint64_t{command.extent[0]} * command.extent[1] * command.extent[2];
}

// The region for a copy between a texture and a buffer, where it begins at `buffer_offset` and has
// no gaps.
VkBufferImageCopy region_of(const CopyTextureCommand& command, const TextureCopyPlace& texture,
                            uint64_t buffer_offset) {
  const uint32_t side = image_of(texture).block_side();
  VkBufferImageCopy region = {};
  region.bufferOffset = buffer_offset;
  region.bufferRowLength = command.extent[0] * side;
  region.bufferImageHeight = command.extent[1] * side;
  region.imageSubresource = layers(texture);
  region.imageOffset = offset_of(texture);
  region.imageExtent = extent_of(command, texture);
  return region;
}

// The same, with the buffer's own rows and slices.
VkBufferImageCopy region_of(const CopyTextureCommand& command, const TextureCopyPlace& texture,
                            const TextureCopyPlace& buffer) {
  const Image& image = image_of(texture);
  const uint32_t bytes = element_bytes(texture);
  VkBufferImageCopy region = region_of(command, texture, buffer_offset(buffer, bytes));
  region.bufferRowLength = buffer.row_pitch / bytes * image.block_side();
  region.bufferImageHeight =
      static_cast<uint32_t>(buffer.slice_pitch / buffer.row_pitch) * image.block_side();
  return region;
}

// Depth and stencil of the copied texels, each without gaps.
struct DepthAndStencil {
  Staging depth;    // 4 bytes each
  Staging stencil;  // 1 byte each
};

rtapi::Result<DepthAndStencil> stage_both(Gpu& gpu, const CopyTextureCommand& command) {
  auto depth = stage(gpu, element_count(command), 4);
  if (!depth) return depth.error();
  auto stencil = stage(gpu, element_count(command), 1);
  if (!stencil) return stencil.error();
  return DepthAndStencil{*depth, *stencil};
}

std::array<VkBufferImageCopy, 2> regions_of_both(const CopyTextureCommand& command,
                                                 const TextureCopyPlace& texture,
                                                 const DepthAndStencil& staged) {
  std::array<VkBufferImageCopy, 2> regions = {region_of(command, texture, staged.depth.offset),
                                              region_of(command, texture, staged.stencil.offset)};
  regions[0].imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  regions[1].imageSubresource.aspectMask = VK_IMAGE_ASPECT_STENCIL_BIT;
  return regions;
}

// Calls visit(element, depth, stencil) with pointers to the bytes of every texel. An element has 24
// bits of depth and 8 of stencil, or a float, 8 bits of stencil and 24 that are not used.
template <class Visit>
void each_of_both(const CopyTextureCommand& command, const TextureCopyPlace& buffer, uint32_t bytes,
                  const DepthAndStencil& staged, const Visit& visit) {
  uint8_t* depth = staged.depth.host;
  uint8_t* stencil = staged.stencil.host;
  uint8_t* const first = buffer.buffer->host() + first_byte(buffer, bytes);
  for (uint32_t z = 0; z < command.extent[2]; ++z) {
    for (uint32_t y = 0; y < command.extent[1]; ++y) {
      uint8_t* element = first + z * buffer.slice_pitch + uint64_t{y} * buffer.row_pitch;
      for (uint32_t x = 0; x < command.extent[0]; ++x, element += bytes) {
        visit(element, depth, stencil);
        depth += 4;
        stencil += 1;
      }
    }
  }
}

class Textures final : public TextureStore {
 public:
  Textures(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors)
      : gpu_(gpu), descriptors_(descriptors), samplers_(gpu, descriptors) {}

  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_texture(
      const rtapi::TextureDesc& desc) override {
    return stored(Image::create(gpu_, descriptors_, desc, nullptr));
  }
  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_placed_texture(
      const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) override {
    return stored(Image::create(gpu_, descriptors_, desc, &place));
  }
  uint64_t placed_bytes(const rtapi::TextureDesc& desc) const override {
    return Image::placed_bytes(gpu_, descriptors_, desc);
  }
  rtapi::Result<uint64_t> create_view(runtime::BackendTexture& texture,
                                      const runtime::TextureViewDesc& desc) override {
    return static_cast<Image&>(texture).view(desc);
  }
  rtapi::Result<uint64_t> create_sampler(const rtapi::SamplerDesc& desc) override {
    return samplers_.sampler(desc);
  }
  // For typed buffers, which shaders convert themselves. What textures of this device do not
  // support is reported by KA0960 and KA0961.
  bool supports_format(rtapi::Format format, bool unordered_access) const override {
    const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
    if (rtapi::GetFormatInfo(format).block_side != 1) return !unordered_access;
    const bool of_depth = (texture_format(format).aspects & VK_IMAGE_ASPECT_COLOR_BIT) == 0;
    if (of_depth) return !unordered_access;
    return codec.bytes != 0 && (!unordered_access || codec.encode != nullptr);
  }
  rtapi::Status copy(CommandStream& stream, const CopyTextureCommand& command) override;
  rtapi::Status clear(CommandStream& stream, const runtime::ClearUavCommand& command) override;

 private:
  static rtapi::Result<std::shared_ptr<runtime::BackendTexture>> stored(
      rtapi::Result<std::shared_ptr<Image>> image) {
    if (!image) return image.error();
    return std::shared_ptr<runtime::BackendTexture>(std::move(*image));
  }
  rtapi::Status copy_between(CommandStream& stream, const CopyTextureCommand& command);
  rtapi::Status copy_through(CommandStream& stream, const CopyTextureCommand& command);
  rtapi::Status upload(CommandStream& stream, const CopyTextureCommand& command);
  rtapi::Status download(CommandStream& stream, const CopyTextureCommand& command);
  rtapi::Status download_both(CommandStream& stream, const CopyTextureCommand& command);
  rtapi::Status clear_buffer(CommandStream& stream, const runtime::ClearUavCommand& command);
  rtapi::Status clear_texture(CommandStream& stream, const Image& image,
                              const runtime::TextureViewDesc& view,
                              const runtime::ClearUavCommand& command);
  std::shared_ptr<Gpu> gpu_;
  std::shared_ptr<DescriptorSet> descriptors_;
  SamplerPool samplers_;
};

rtapi::Status Textures::copy(CommandStream& stream, const CopyTextureCommand& command) {
  if (command.extent[0] == 0 || command.extent[1] == 0 || command.extent[2] == 0) return {};
  if (command.dest.texture != nullptr && command.source.texture != nullptr) {
    return copy_between(stream, command);
  }
  return command.dest.texture != nullptr ? upload(stream, command) : download(stream, command);
}

rtapi::Status Textures::copy_between(CommandStream& stream, const CopyTextureCommand& command) {
  const Image& dest = image_of(command.dest);
  const Image& source = image_of(command.source);
  const VkExtent3D extent = extent_of(command, command.source);
  const VkExtent3D at_dest = extent_of(command, command.dest);
  if (dest.type() != source.type() || dest.block_side() != source.block_side() ||
      dest.aspects() != source.aspects() ||
      layers(command.dest).aspectMask != layers(command.source).aspectMask ||
      extent.width != at_dest.width || extent.height != at_dest.height) {
    return copy_through(stream, command);
  }
  stream.everything();
  auto commands = stream.record("CopyTextureRegion");
  if (!commands) return commands.error();
  VkImageCopy region = {};
  region.srcSubresource = layers(command.source);
  region.srcOffset = offset_of(command.source);
  region.dstSubresource = layers(command.dest);
  region.dstOffset = offset_of(command.dest);
  region.extent = extent;
  gpu_->vk().vkCmdCopyImage(*commands, source.handle(), VK_IMAGE_LAYOUT_GENERAL, dest.handle(),
                            VK_IMAGE_LAYOUT_GENERAL, 1, &region);
  stream.keep(command.source.texture);
  stream.keep(command.dest.texture);
  return {};
}

// Copies through a buffer, because Vulkan allows copies between images of different dimensions, and
// of blocks that reach out of an image, only in some cases.
rtapi::Status Textures::copy_through(CommandStream& stream, const CopyTextureCommand& command) {
  const Image& dest = image_of(command.dest);
  auto between = stage(*gpu_, element_count(command), element_bytes(command.dest));
  if (!between) return between.error();
  stream.everything();
  auto commands = stream.record("CopyTextureRegion");
  if (!commands) return commands.error();
  const VkBufferImageCopy from = region_of(command, command.source, between->offset);
  gpu_->vk().vkCmdCopyImageToBuffer(*commands, image_of(command.source).handle(),
                                    VK_IMAGE_LAYOUT_GENERAL, between->buffer->handle(), 1, &from);
  stream.everything();
  const VkBufferImageCopy to = region_of(command, command.dest, between->offset);
  gpu_->vk().vkCmdCopyBufferToImage(*commands, between->buffer->handle(), dest.handle(),
                                    VK_IMAGE_LAYOUT_GENERAL, 1, &to);
  stream.keep(command.source.texture);
  stream.keep(command.dest.texture);
  stream.keep(between->buffer);
  return {};
}

rtapi::Status Textures::upload(CommandStream& stream, const CopyTextureCommand& command) {
  const Image& image = image_of(command.dest);
  const TextureCopyPlace& source = command.source;
  const uint32_t element = element_bytes(command.dest);
  VkBufferImageCopy region = {};
  VkBuffer buffer = VK_NULL_HANDLE;
  if (expressible(source, element)) {
    buffer = gpu_buffer_of(*source.buffer).handle();
    region = region_of(command, command.dest, source);
    stream.keep(source.buffer);
  } else {
    if (auto s = stream.flush(); !s) return s;
    auto rows = stage(*gpu_, element_count(command), element);
    if (!rows) return rows.error();
    const uint64_t row_bytes = uint64_t{command.extent[0]} * element;
    uint8_t* out = rows->host;
    const uint8_t* in = source.buffer->host() + first_byte(source, element);
    for (uint32_t z = 0; z < command.extent[2]; ++z) {
      for (uint32_t y = 0; y < command.extent[1]; ++y, out += row_bytes) {
        std::memcpy(out, in + z * source.slice_pitch + uint64_t{y} * source.row_pitch, row_bytes);
      }
    }
    buffer = rows->buffer->handle();
    region = region_of(command, command.dest, rows->offset);
    stream.keep(rows->buffer);
  }
  stream.everything();
  auto commands = stream.record("CopyTextureRegion to a texture");
  if (!commands) return commands.error();
  gpu_->vk().vkCmdCopyBufferToImage(*commands, buffer, image.handle(), VK_IMAGE_LAYOUT_GENERAL, 1,
                                    &region);
  stream.keep(command.dest.texture);
  return {};
}

rtapi::Status Textures::download(CommandStream& stream, const CopyTextureCommand& command) {
  const Image& image = image_of(command.source);
  if (has_both(image) && command.source.plane == runtime::kAllPlanes) {
    return download_both(stream, command);
  }
  const TextureCopyPlace& dest = command.dest;
  const uint32_t element = element_bytes(command.source);
  VkBufferImageCopy region = {};
  const bool direct = expressible(dest, element);
  Staging rows;
  VkBuffer buffer = VK_NULL_HANDLE;
  if (direct) {
    buffer = gpu_buffer_of(*dest.buffer).handle();
    region = region_of(command, command.source, dest);
    stream.keep(dest.buffer);
  } else {
    auto made = stage(*gpu_, element_count(command), element);
    if (!made) return made.error();
    rows = std::move(*made);
    buffer = rows.buffer->handle();
    region = region_of(command, command.source, rows.offset);
  }
  stream.everything();
  auto commands = stream.record("CopyTextureRegion to a buffer");
  if (!commands) return commands.error();
  gpu_->vk().vkCmdCopyImageToBuffer(*commands, image.handle(), VK_IMAGE_LAYOUT_GENERAL, buffer, 1,
                                    &region);
  stream.keep(command.source.texture);
  if (direct) return {};
  if (auto s = stream.flush(); !s) return s;
  const uint64_t row_bytes = uint64_t{command.extent[0]} * element;
  const uint8_t* in = rows.host;
  uint8_t* out = dest.buffer->host() + first_byte(dest, element);
  for (uint32_t z = 0; z < command.extent[2]; ++z) {
    for (uint32_t y = 0; y < command.extent[1]; ++y, in += row_bytes) {
      std::memcpy(out + z * dest.slice_pitch + uint64_t{y} * dest.row_pitch, in, row_bytes);
    }
  }
  return {};
}

rtapi::Status Textures::download_both(CommandStream& stream, const CopyTextureCommand& command) {
  const Image& image = image_of(command.source);
  auto staged = stage_both(*gpu_, command);
  if (!staged) return staged.error();
  stream.everything();
  auto commands = stream.record("CopyTextureRegion to a buffer");
  if (!commands) return commands.error();
  const auto regions = regions_of_both(command, command.source, *staged);
  const VkBuffer buffers[] = {staged->depth.buffer->handle(), staged->stencil.buffer->handle()};
  for (size_t i = 0; i < regions.size(); ++i) {
    gpu_->vk().vkCmdCopyImageToBuffer(*commands, image.handle(), VK_IMAGE_LAYOUT_GENERAL,
                                      buffers[i], 1, &regions[i]);
  }
  stream.keep(command.source.texture);
  if (auto s = stream.flush(); !s) return s;
  const uint32_t bytes = image.element_bytes();
  const uint32_t stencil_at = bytes == 4 ? 3 : 4;
  each_of_both(command, command.dest, bytes, *staged,
               [&](uint8_t* element, const uint8_t* depth, const uint8_t* stencil) {
                 std::memset(element, 0, bytes);
                 std::memcpy(element, depth, stencil_at);
                 element[stencil_at] = *stencil;
               });
  return {};
}

rtapi::Status Textures::clear(CommandStream& stream, const runtime::ClearUavCommand& command) {
  if (command.view.kind == shader::DescriptorKind::kNull || command.resource == nullptr) return {};
  if (command.view.kind != shader::DescriptorKind::kTexture) return clear_buffer(stream, command);
  const auto* texture = static_cast<const runtime::BackendTexture*>(command.resource.get());
  const auto& image = static_cast<const Image&>(*texture);
  // A descriptor left over from another texture counts as a null one.
  const auto view = image.storage_view(command.view.address);
  return view ? clear_texture(stream, image, *view, command) : rtapi::Status{};
}

// On the host, whose conversions are those of typed stores.
rtapi::Status Textures::clear_buffer(CommandStream& stream,
                                     const runtime::ClearUavCommand& command) {
  if (auto s = stream.flush(); !s) return s;
  const auto& buffer = *static_cast<const runtime::BackendBuffer*>(command.resource.get());
  shader::Descriptor view = command.view;
  view.address = reinterpret_cast<uint64_t>(buffer.host() + (view.address - buffer.address()));
  runtime::clear_buffer_view(view, command);
  return {};
}

// Fills a few rows with the texel and copies them wherever they must go: exact for every format,
// and for views of some slices of a volume.
rtapi::Status Textures::clear_texture(CommandStream& stream, const Image& image,
                                      const runtime::TextureViewDesc& view,
                                      const runtime::ClearUavCommand& command) {
  const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(view.format));
  const VkExtent3D extent = image.extent(view.first_mip);
  const uint64_t row_bytes = uint64_t{extent.width} * codec.bytes;
  const auto rows =
      static_cast<uint32_t>(std::clamp<uint64_t>(kClearPatternBytes / row_bytes, 1, extent.height));
  auto pattern = stage(*gpu_, uint64_t{rows} * extent.width, codec.bytes);
  if (!pattern) return pattern.error();
  uint8_t element[16] = {};
  codec.encode(element, runtime::clear_texel(view.format, command.is_float, command.values));
  for (uint64_t at = 0; at < rows * row_bytes; at += codec.bytes) {
    std::memcpy(pattern->host + at, element, codec.bytes);
  }
  const bool volume = image.type() == VK_IMAGE_TYPE_3D;
  const uint32_t end =
      std::min(view.first_slice + view.slice_count, volume ? extent.depth : image.array_size());
  const auto parts = runtime::cleared_parts(command, extent.width, extent.height);
  std::vector<VkBufferImageCopy> regions;
  for (uint32_t slice = view.first_slice; slice < end; ++slice) {
    for (const rtapi::Rect& part : parts) {
      const auto width = static_cast<uint32_t>(part.right - part.left);
      for (auto y = static_cast<uint32_t>(part.top); y < static_cast<uint32_t>(part.bottom);
           y += rows) {
        VkBufferImageCopy& region = regions.emplace_back();
        region = {};
        region.bufferOffset = pattern->offset;
        region.bufferRowLength = extent.width;
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, view.first_mip, volume ? 0 : slice,
                                   1};
        region.imageOffset = {part.left, static_cast<int32_t>(y),
                              volume ? static_cast<int32_t>(slice) : 0};
        region.imageExtent = {width, std::min(rows, static_cast<uint32_t>(part.bottom) - y), 1};
      }
    }
  }
  if (regions.empty()) return {};
  stream.everything();
  auto commands = stream.record("ClearUnorderedAccessView");
  if (!commands) return commands.error();
  gpu_->vk().vkCmdCopyBufferToImage(*commands, pattern->buffer->handle(), image.handle(),
                                    VK_IMAGE_LAYOUT_GENERAL, static_cast<uint32_t>(regions.size()),
                                    regions.data());
  stream.keep(command.resource);
  stream.keep(pattern->buffer);
  return {};
}

}  // namespace

rtapi::Result<std::unique_ptr<TextureStore>> TextureStore::create(
    std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors) {
  return std::unique_ptr<TextureStore>(
      std::make_unique<Textures>(std::move(gpu), std::move(descriptors)));
}

}  // namespace kaamos::vulkan
