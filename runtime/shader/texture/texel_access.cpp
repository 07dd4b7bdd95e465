// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::shader {
namespace {

bool is_1d(TextureDimension dimension) {
  return dimension == TextureDimension::k1D || dimension == TextureDimension::k1DArray;
}

// A negative coordinate becomes a large unsigned one and is out of range, too.
uint8_t* addressed(const TextureView& view, uint32_t bytes, const int32_t at[4]) {
  return texel_pointer(view, bytes, static_cast<uint32_t>(at[0]),
                       is_1d(view.dimension) ? 0 : static_cast<uint32_t>(at[1]),
                       static_cast<uint32_t>(at[2]), static_cast<uint32_t>(at[3]));
}

bool is_r32(const FormatCodec& codec) {
  return codec.bytes == 4 && codec.channels == 1;
}

// Returns the bytes that atomics work on: 4 of R32, 8 of R32G32 in integers; 0 otherwise.
uint32_t atomic_bytes(uint32_t format) {
  constexpr uint32_t kR32G32Uint = 17, kR32G32Sint = 18;
  if (format == kR32G32Uint || format == kR32G32Sint) return 8;
  return is_r32(format_codec(format)) ? 4 : 0;
}

// Null unless the atomic takes as many bytes as a texel has.
void* atomic_place(uint8_t* texel, uint32_t format, uint32_t bytes) {
  const bool fits =
      atomic_bytes(format) == bytes && reinterpret_cast<uintptr_t>(texel) % bytes == 0;
  return fits ? texel : nullptr;
}

uint8_t* element_pointer(const Descriptor& buffer, const FormatCodec& codec, uint32_t element) {
  const uint64_t at = static_cast<uint64_t>(element) * codec.bytes;
  if (buffer.kind != DescriptorKind::kTypedBuffer || codec.bytes == 0 ||
      buffer.size_bytes < codec.bytes || at > buffer.size_bytes - codec.bytes) {
    return nullptr;
  }
  return reinterpret_cast<uint8_t*>(buffer.address + at);
}

}  // namespace

Texel load_texel(const Descriptor& texture, const int32_t coordinates[4]) {
  const TextureView* view = texture_view(texture);
  if (view == nullptr) return {};
  const FormatCodec& codec = format_codec(view->format);
  if (codec.bytes == 0) return {};
  const uint8_t* texel = addressed(*view, codec.bytes, coordinates);
  return texel != nullptr ? swizzled(*view, codec.number, codec.decode(texel)) : Texel{};
}

void store_texel(const Descriptor& texture, const int32_t coordinates[4], const Texel& value) {
  const TextureView* view = texture_view(texture);
  if (view == nullptr || !view->unordered_access) return;
  const FormatCodec& codec = format_codec(view->format);
  if (codec.encode == nullptr) return;
  uint8_t* texel = addressed(*view, codec.bytes, coordinates);
  if (texel != nullptr) codec.encode(texel, value);
}

void* texel_address(const Descriptor& texture, const int32_t coordinates[4], uint32_t bytes) {
  const TextureView* view = texture_view(texture);
  if (view == nullptr || !view->unordered_access) return nullptr;
  uint8_t* texel = addressed(*view, format_codec(view->format).bytes, coordinates);
  return atomic_place(texel, view->format, bytes);
}

Texel load_typed(const Descriptor& buffer, uint32_t element) {
  const FormatCodec& codec = format_codec(buffer.format);
  const uint8_t* at = element_pointer(buffer, codec, element);
  return at != nullptr ? codec.decode(at) : Texel{};
}

void store_typed(const Descriptor& buffer, uint32_t element, const Texel& value) {
  const FormatCodec& codec = format_codec(buffer.format);
  if (buffer.access != DescriptorAccess::kUnorderedAccess || codec.encode == nullptr) return;
  uint8_t* at = element_pointer(buffer, codec, element);
  if (at != nullptr) codec.encode(at, value);
}

void* typed_address(const Descriptor& buffer, uint32_t element, uint32_t bytes) {
  if (buffer.access != DescriptorAccess::kUnorderedAccess) return nullptr;
  uint8_t* at = element_pointer(buffer, format_codec(buffer.format), element);
  return atomic_place(at, buffer.format, bytes);
}

TextureDimensions texture_dimensions(const Descriptor& descriptor, uint32_t mip) {
  if (descriptor.kind == DescriptorKind::kTypedBuffer) {
    const uint32_t bytes = format_codec(descriptor.format).bytes;
    const uint64_t elements = bytes != 0 ? descriptor.size_bytes / bytes : 0;
    return {elements < ~0u ? static_cast<uint32_t>(elements) : ~0u, 0, 0, 0};
  }
  const TextureView* view = texture_view(descriptor);
  if (view == nullptr) return {};
  if (mip >= view->mip_count) return {0, 0, 0, view->mip_count};
  const TextureMip& m = view->mips[mip];
  const bool cube =
      view->dimension == TextureDimension::kCube || view->dimension == TextureDimension::kCubeArray;
  const uint32_t elements = view->dimension == TextureDimension::k3D ? m.depth
                            : cube                                   ? view->slice_count / 6
                                                                     : view->slice_count;
  return {m.width, m.height, elements, view->mip_count};
}

}  // namespace kaamos::shader
