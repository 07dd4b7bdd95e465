// SPDX-License-Identifier: MIT
#include "runtime/raster/clear.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "runtime/raster/target_codec.h"

namespace kaamos::raster {
namespace {

constexpr uint32_t kMostTexelBytes = 16;

// A texel, and which of its bits are written.
struct Fill {
  uint32_t bytes = 0;
  bool all_bits = true;  // then the mask does not count
  uint8_t value[kMostTexelBytes] = {};
  uint8_t mask[kMostTexelBytes] = {};
};

// The integer part, as far as a column of the class can hold it; the codec clamps to the format.
uint32_t integer_part(float value, bool is_signed) {
  if (std::isnan(value)) return 0;
  const double part = std::trunc(static_cast<double>(value));
  if (is_signed) {
    const double limited = std::fmin(std::fmax(part, -2147483648.0), 2147483647.0);
    return static_cast<uint32_t>(static_cast<int32_t>(limited));
  }
  return static_cast<uint32_t>(std::fmin(std::fmax(part, 0.0), 4294967295.0));
}

Fill color_fill(rtapi::Format format, const float color[4]) {
  const TargetCodec& codec = target_codec(format);
  const rtapi::FormatClass type = rtapi::GetFormatInfo(format).type;
  shader::Column columns[4] = {};
  for (int c = 0; c < 4; ++c) {
    const uint32_t bits = type == rtapi::FormatClass::kSint   ? integer_part(color[c], true)
                          : type == rtapi::FormatClass::kUint ? integer_part(color[c], false)
                                                              : std::bit_cast<uint32_t>(color[c]);
    for (uint32_t& lane : columns[c]) lane = bits;
  }
  shader::Column words[4] = {};
  codec.encode(columns, words);
  Fill fill;
  fill.bytes = codec.bytes;
  for (uint32_t byte = 0; byte < codec.bytes; ++byte) {
    fill.value[byte] = static_cast<uint8_t>(words[byte / 4][0] >> (byte % 4 * 8));
  }
  return fill;
}

void put(Fill& fill, uint32_t first, std::span<const uint8_t> bytes) {
  std::memcpy(fill.value + first, bytes.data(), bytes.size());
  std::memset(fill.mask + first, 0xFF, bytes.size());
}

// `steps` of a normalized depth: whole. [RAS-60]
uint32_t normalized(float depth, double steps) {
  return static_cast<uint32_t>(static_cast<double>(depth) * steps + 0.5);
}

Fill depth_fill(rtapi::Format format, const runtime::ClearTargetCommand& command) {
  Fill fill;
  fill.bytes = rtapi::GetFormatInfo(format).bytes;
  const auto put_word = [&](uint32_t first, uint32_t word, uint32_t bytes) {
    uint8_t memory[4];
    std::memcpy(memory, &word, sizeof memory);
    put(fill, first, std::span(memory, bytes));
  };
  if (command.clear_depth) {
    switch (format) {
      case rtapi::Format::kD16Unorm:
        put_word(0, normalized(command.depth, 65535), 2);
        break;
      case rtapi::Format::kD24UnormS8Uint:
        put_word(0, normalized(command.depth, 16777215), 3);
        break;
      default:
        put_word(0, std::bit_cast<uint32_t>(command.depth), 4);
        break;
    }
  }
  if (command.clear_stencil && rtapi::HasStencil(format)) {
    put_word(format == rtapi::Format::kD24UnormS8Uint ? 3 : 4, command.stencil, 1);
  }
  fill.all_bits = std::count(fill.mask, fill.mask + fill.bytes, 0xFF) == fill.bytes;
  return fill;
}

Fill fill_of(rtapi::Format format, const runtime::ClearTargetCommand& command) {
  return command.depth_stencil ? depth_fill(format, command) : color_fill(format, command.color);
}

void fill_row(uint8_t* texels, uint32_t count, const Fill& fill) {
  if (count == 0) return;
  if (fill.all_bits) {
    const size_t bytes = size_t{count} * fill.bytes;
    std::memcpy(texels, fill.value, fill.bytes);
    for (size_t done = fill.bytes; done < bytes; done *= 2) {
      std::memcpy(texels + done, texels, std::min(done, bytes - done));
    }
    return;
  }
  for (uint32_t x = 0; x < count; ++x, texels += fill.bytes) {
    for (uint32_t byte = 0; byte < fill.bytes; ++byte) {
      if (fill.mask[byte] != 0) texels[byte] = fill.value[byte];
    }
  }
}

// Calls f(texel (0, 0)) for each slice and sample.
template <class F>
void each_plane(const Surface& surface, const F& f) {
  for (uint32_t slice = 0; slice < surface.slices; ++slice) {
    for (uint32_t sample = 0; sample < surface.samples; ++sample) {
      f(surface.texels + slice * surface.slice_pitch + sample * surface.sample_pitch);
    }
  }
}

}  // namespace

void clear(const Surface& surface, const runtime::ClearTargetCommand& command) {
  if (surface.texels == nullptr) return;
  const Fill fill = fill_of(surface.format, command);
  const rtapi::Rect whole = {0, 0, static_cast<int32_t>(surface.width),
                             static_cast<int32_t>(surface.height)};
  const std::span<const rtapi::Rect> rects =
      command.whole ? std::span(&whole, 1) : std::span<const rtapi::Rect>(command.rects);
  each_plane(surface, [&](uint8_t* const texels) {
    for (const rtapi::Rect& rect : rects) {
      for (int32_t y = rect.top; y < rect.bottom; ++y) {
        uint8_t* const row = texels + static_cast<uint64_t>(y) * surface.row_pitch;
        fill_row(row + static_cast<uint64_t>(rect.left) * fill.bytes,
                 static_cast<uint32_t>(rect.right - rect.left), fill);
      }
    }
  });
}

bool set_cleared(Surface& surface, const runtime::ClearTargetCommand& command) {
  if (surface.texels == nullptr || !command.whole || surface.read_only) return false;
  // A tile keeps depth and stencil apart; `value` is a word of depth.
  if (command.depth_stencil && rtapi::HasStencil(surface.format)) return false;
  const Fill fill = fill_of(surface.format, command);
  if (!fill.all_bits) return false;
  surface.cleared = true;
  surface.value = {};
  std::memcpy(surface.value.data(), fill.value, fill.bytes);
  return true;
}

void write_cleared(Surface& surface) {
  surface.cleared = false;
  Fill fill;
  fill.bytes = rtapi::GetFormatInfo(surface.format).bytes;
  std::memcpy(fill.value, surface.value.data(), fill.bytes);
  each_plane(surface, [&](uint8_t* const texels) {
    for (uint32_t y = 0; y < surface.height; ++y) {
      fill_row(texels + y * surface.row_pitch, surface.width, fill);
    }
  });
}

}  // namespace kaamos::raster
