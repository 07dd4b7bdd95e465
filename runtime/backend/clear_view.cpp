// SPDX-License-Identifier: MIT
#include "runtime/backend/clear_view.h"

#include <algorithm>
#include <cstring>

#include "runtime/shader/texture/format_codec.h"
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::runtime {
namespace {

// UINT clear of a normalized format: each channel takes the low bits of its value.
shader::Texel raw_channels(const shader::FormatCodec& codec, rtapi::FormatInfo info,
                           const uint32_t values[4]) {
  shader::Texel texel = {};
  for (int i = 0; i < 4; ++i) {
    uint8_t element[16] = {};
    const uint32_t bytes = info.channel_bits / 8;
    if (i * bytes < sizeof(element)) std::memcpy(element + i * bytes, &values[i], bytes);
    if (codec.decode != nullptr) texel.bits[i] = codec.decode(element).bits[i];
  }
  return texel;
}

}  // namespace

shader::Texel clear_texel(rtapi::Format format, bool is_float, const uint32_t values[4]) {
  const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
  const rtapi::FormatInfo info = rtapi::GetFormatInfo(format);
  if (!is_float && codec.normalized && info.channel_bits != 0) {
    return raw_channels(codec, info, values);
  }
  return {{values[0], values[1], values[2], values[3]}};
}

void clear_buffer_view(const shader::Descriptor& view, bool is_float, const uint32_t values[4]) {
  if (view.kind == shader::DescriptorKind::kRawBuffer ||
      view.kind == shader::DescriptorKind::kStructuredBuffer) {
    std::fill_n(reinterpret_cast<uint32_t*>(view.address), view.size_bytes / 4, values[0]);
    return;
  }
  const shader::FormatCodec& codec = shader::format_codec(view.format);
  if (view.kind != shader::DescriptorKind::kTypedBuffer || codec.bytes == 0) return;
  const shader::Texel value =
      clear_texel(static_cast<rtapi::Format>(view.format), is_float, values);
  const uint64_t elements = view.size_bytes / codec.bytes;
  for (uint64_t i = 0; i < elements; ++i) {
    shader::store_typed(view, static_cast<uint32_t>(i), value);
  }
}

}  // namespace kaamos::runtime
