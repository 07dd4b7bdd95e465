// SPDX-License-Identifier: MIT
#include "runtime/raster/target_codec.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "runtime/raster/narrow_float.h"
#include "runtime/shader/texture/format_codec.h"

namespace kaamos::raster {
namespace {

using rtapi::Format;
using shader::Column;

constexpr uint32_t kLanes = shader::kGraphicsLanes;
constexpr uint32_t kFormats = 116;

// Copies texels of kBytes to and from words.
template <uint32_t kBytes>
void put_words(const uint8_t* texel, Column* words, uint32_t lane) {
  constexpr uint32_t kWords = (kBytes + 3) / 4;
  uint32_t values[kWords] = {};
  std::memcpy(values, texel, kBytes);
  for (uint32_t w = 0; w < kWords; ++w) words[w][lane] = values[w];
}

template <uint32_t kFormat, uint32_t kBytes>
void encode_plain(const Column* colors, Column* words) {
  const shader::FormatCodec& codec = shader::format_codec(kFormat);
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    const shader::Texel texel{{colors[0][lane], colors[1][lane], colors[2][lane], colors[3][lane]}};
    uint8_t bytes[16];
    codec.encode(bytes, texel);
    put_words<kBytes>(bytes, words, lane);
  }
}
template <uint32_t kFormat, uint32_t kBytes>
void decode_plain(const Column* words, Column* colors) {
  const shader::FormatCodec& codec = shader::format_codec(kFormat);
  constexpr uint32_t kWords = (kBytes + 3) / 4;
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    uint32_t values[4] = {};
    for (uint32_t w = 0; w < kWords; ++w) values[w] = words[w][lane];
    const shader::Texel texel = codec.decode(reinterpret_cast<const uint8_t*>(values));
    for (int c = 0; c < 4; ++c) colors[c][lane] = texel.bits[c];
  }
}

// 16 bits for each of kChannels floats.
template <uint32_t kChannels>
void encode_halves(const Column* colors, Column* words) {
  for (uint32_t w = 0; w < (kChannels + 1) / 2; ++w) {
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      uint32_t word = half_toward_zero(colors[2 * w][lane]);
      if (2 * w + 1 < kChannels) word |= half_toward_zero(colors[2 * w + 1][lane]) << 16;
      words[w][lane] = word;
    }
  }
}
void encode_r11g11b10(const Column* colors, Column* words) {
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    words[0][lane] = positive_half_toward_zero(colors[0][lane]) >> 4 |
                     positive_half_toward_zero(colors[1][lane]) >> 4 << 11 |
                     positive_half_toward_zero(colors[2][lane]) >> 5 << 22;
  }
}
template <int kRed, int kBlue, bool kAlpha>
void encode_srgb(const Column* colors, Column* words) {
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    const auto curve = [&](int c) {
      return uint32_t{shader::linear_to_srgb(std::bit_cast<float>(colors[c][lane]))};
    };
    const auto alpha = std::bit_cast<float>(colors[3][lane]);
    uint32_t word = curve(0) << kRed | curve(1) << 8 | curve(2) << kBlue;
    if (kAlpha && alpha > 0) {
      word |= (alpha >= 1 ? 255u : static_cast<uint32_t>(alpha * 255.0f + 0.5f)) << 24;
    }
    words[0][lane] = word;
  }
}

// Bits [first, first + count) of a texel, for each component in order: red, green, blue, alpha.
struct Field {
  uint8_t first, count;
};

constexpr void set_fields(TargetCodec& codec, const std::array<Field, 4>& fields) {
  for (uint32_t c = 0; c < 4; ++c) {
    if (fields[c].count == 0) continue;
    const uint32_t bits = fields[c].count == 32 ? ~0u : (1u << fields[c].count) - 1;
    codec.component[c][fields[c].first / 32] = bits << fields[c].first % 32;
  }
}

// Formats of depth buffers, and those that shaders read them by.
constexpr bool is_of_depth(Format format) {
  return rtapi::IsDepthFormat(format) || format == Format::kR32FloatX8X24Typeless ||
         format == Format::kX32TypelessG8X24Uint || format == Format::kR24UnormX8Typeless ||
         format == Format::kX24TypelessG8Uint;
}

template <uint32_t kFormat>
constexpr TargetCodec codec_of() {
  constexpr auto kInfo = rtapi::GetFormatInfo(static_cast<Format>(kFormat));
  using C = rtapi::FormatClass;
  constexpr auto kTheFormat = static_cast<Format>(kFormat);
  if constexpr (kInfo.type == C::kUnsupported || kInfo.type == C::kTypeless || kInfo.bytes == 12 ||
                kInfo.block_side != 1 || is_of_depth(kTheFormat) ||
                kTheFormat == Format::kR9G9B9E5Sharedexp) {
    return {};
  } else {
    TargetCodec codec;
    codec.bytes = kInfo.bytes;
    codec.words = (kInfo.bytes + 3) / 4;
    codec.integer = kInfo.type == C::kUint || kInfo.type == C::kSint;
    codec.clamped = kInfo.type == C::kUnorm || kInfo.type == C::kSnorm;
    codec.clamped_signed = kInfo.type == C::kSnorm;
    std::array<Field, 4> fields{};
    for (uint8_t c = 0; c < kInfo.channels; ++c) {
      fields[c] = {static_cast<uint8_t>(c * kInfo.channel_bits), kInfo.channel_bits};
    }
    codec.encode = encode_plain<kFormat, kInfo.bytes>;
    codec.decode = decode_plain<kFormat, kInfo.bytes>;
    if (kInfo.channel_bits == 32) codec.fast = FastEncode::kWords;
    switch (kTheFormat) {
      case Format::kR8G8B8A8Unorm:
        codec.fast = FastEncode::kRgba8;
        break;
      case Format::kR16G16B16A16Float:
        codec.encode = encode_halves<4>;
        codec.fast = FastEncode::kHalves;
        break;
      case Format::kR16G16Float:
        codec.encode = encode_halves<2>;
        codec.fast = FastEncode::kHalves;
        break;
      case Format::kR16Float:
        codec.encode = encode_halves<1>;
        break;
      case Format::kR8G8B8A8UnormSrgb:
        codec.encode = encode_srgb<0, 16, true>;
        codec.fast = FastEncode::kRgba8Srgb;
        break;
      case Format::kB8G8R8A8UnormSrgb:
        codec.encode = encode_srgb<16, 0, true>;
        codec.fast = FastEncode::kBgra8Srgb;
        fields = {{{16, 8}, {8, 8}, {0, 8}, {24, 8}}};
        break;
      case Format::kB8G8R8X8UnormSrgb:
        codec.encode = encode_srgb<16, 0, false>;
        fields = {{{16, 8}, {8, 8}, {0, 8}, {24, 0}}};
        break;
      case Format::kB8G8R8A8Unorm:
        codec.fast = FastEncode::kBgra8;
        fields = {{{16, 8}, {8, 8}, {0, 8}, {24, 8}}};
        break;
      case Format::kB8G8R8X8Unorm:
        fields = {{{16, 8}, {8, 8}, {0, 8}, {24, 0}}};
        break;
      case Format::kR10G10B10A2Unorm:
      case Format::kR10G10B10A2Uint:
        fields = {{{0, 10}, {10, 10}, {20, 10}, {30, 2}}};
        break;
      case Format::kR11G11B10Float:
        codec.encode = encode_r11g11b10;
        fields = {{{0, 11}, {11, 11}, {22, 10}, {0, 0}}};
        break;
      case Format::kB5G6R5Unorm:
        fields = {{{11, 5}, {5, 6}, {0, 5}, {0, 0}}};
        break;
      case Format::kB5G5R5A1Unorm:
        fields = {{{10, 5}, {5, 5}, {0, 5}, {15, 1}}};
        break;
      case Format::kB4G4R4A4Unorm:
        fields = {{{8, 4}, {4, 4}, {0, 4}, {12, 4}}};
        break;
      case Format::kA8Unorm:
        fields = {{{0, 0}, {0, 0}, {0, 0}, {0, 8}}};
        break;
      default:
        break;
    }
    if (codec.fast == FastEncode::kWords) codec.columns = codec.words;
    if (codec.fast == FastEncode::kHalves) codec.columns = 2 * codec.words;
    set_fields(codec, fields);
    return codec;
  }
}

template <size_t... kFormat>
constexpr std::array<TargetCodec, kFormats> every_codec(std::index_sequence<kFormat...>) {
  return {codec_of<kFormat>()...};
}
constexpr std::array<TargetCodec, kFormats> kCodecs =
    every_codec(std::make_index_sequence<kFormats>());

}  // namespace

const TargetCodec& target_codec(rtapi::Format format) {
  const auto number = static_cast<uint32_t>(format);
  return kCodecs[number < kFormats ? number : 0];
}

}  // namespace kaamos::raster
