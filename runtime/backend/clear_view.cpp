// SPDX-License-Identifier: MIT
#include "runtime/backend/clear_view.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "runtime/shader/texture/format_codec.h"
#include "runtime/shader/texture/texel_access.h"

namespace kaamos::runtime {
namespace {

// Returns an element whose channels all hold the low bits of `value`.
void fill_channels(rtapi::Format format, uint32_t bits, uint32_t value, uint8_t element[16]) {
  const auto put = [&](uint32_t packed) { std::memcpy(element, &packed, sizeof packed); };
  if (format == rtapi::Format::kR11G11B10Float) {
    return put((value & 0x7FF) | (value & 0x7FF) << 11 | value << 22);
  }
  if (bits == 0) {  // R10G10B10A2
    return put((value & 0x3FF) | (value & 0x3FF) << 10 | (value & 0x3FF) << 20 | value << 30);
  }
  const uint32_t bytes = bits / 8;
  for (uint32_t at = 0; at + bytes <= 16; at += bytes) std::memcpy(element + at, &value, bytes);
}

// Returns the bits of an element that has no room for every NaN's payload once it is decoded.
std::optional<uint32_t> packed_floats(rtapi::Format format, const ClearUavCommand& command) {
  if (command.is_float || format != rtapi::Format::kR11G11B10Float) return {};
  const uint32_t* values = command.values;
  return (values[0] & 0x7FF) | (values[1] & 0x7FF) << 11 | values[2] << 22;
}

}  // namespace

shader::Texel clear_texel(rtapi::Format format, bool is_float, const uint32_t values[4]) {
  const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
  const rtapi::FormatInfo info = rtapi::GetFormatInfo(format);
  if (is_float || codec.decode == nullptr) return {{values[0], values[1], values[2], values[3]}};
  shader::Texel texel = {};
  for (int i = 0; i < 4; ++i) {
    uint8_t element[16] = {};
    fill_channels(format, info.channel_bits, values[i], element);
    texel.bits[i] = codec.decode(element).bits[i];
  }
  return texel;
}

std::vector<rtapi::Rect> cleared_parts(const ClearUavCommand& command, uint32_t width,
                                       uint32_t height) {
  const auto right = static_cast<int32_t>(width);
  const auto bottom = static_cast<int32_t>(height);
  if (command.whole) return {{0, 0, right, bottom}};
  std::vector<rtapi::Rect> parts;
  for (rtapi::Rect rect : command.rects) {
    rect.right = std::min(rect.right, right);
    rect.bottom = std::min(rect.bottom, bottom);
    if (rect.left < rect.right && rect.top < rect.bottom) parts.push_back(rect);
  }
  return parts;
}

void clear_buffer_view(const shader::Descriptor& view, const ClearUavCommand& command) {
  const bool typed = view.kind == shader::DescriptorKind::kTypedBuffer;
  const bool structured = view.kind == shader::DescriptorKind::kStructuredBuffer;
  if (!typed && !structured && view.kind != shader::DescriptorKind::kRawBuffer) return;
  const shader::FormatCodec& codec = shader::format_codec(view.format);
  const uint64_t bytes = typed ? codec.bytes : structured ? view.stride_bytes : 4;
  if (bytes == 0) return;
  const auto count = static_cast<uint32_t>(std::min<uint64_t>(view.size_bytes / bytes, INT32_MAX));
  const auto format = static_cast<rtapi::Format>(view.format);
  const shader::Texel value = clear_texel(format, command.is_float, command.values);
  const std::optional<uint32_t> packed = typed ? packed_floats(format, command) : std::nullopt;
  for (const rtapi::Rect& part : cleared_parts(command, count, 1)) {
    const auto first = static_cast<uint32_t>(part.left);
    const auto end = static_cast<uint32_t>(part.right);
    if (!typed || packed) {
      std::fill_n(reinterpret_cast<uint32_t*>(view.address + first * bytes),
                  (end - first) * bytes / 4, packed.value_or(command.values[0]));
      continue;
    }
    for (uint32_t i = first; i < end; ++i) shader::store_typed(view, i, value);
  }
}

}  // namespace kaamos::runtime
