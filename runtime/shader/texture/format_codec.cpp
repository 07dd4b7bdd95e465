// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/format_codec.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "kaamos/shader/half.h"

namespace kaamos::shader {

const std::array<float, 256> kSrgbToLinear = [] {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double x = i / 255.0;
    table[i] = static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
  }
  return table;
}();

namespace {

constexpr uint32_t bits_of(float value) {
  return std::bit_cast<uint32_t>(value);
}
constexpr float float_of(uint32_t bits) {
  return std::bit_cast<float>(bits);
}

template <class T>
T read(const uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}
template <class T>
void write(uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof(T));
}

// ---------------------------------------------------------------------------------------------
// Channels: from a stored integer of `Bits` bits to a Texel's value and back.

struct Unorm {
  static constexpr NumberClass number = NumberClass::kFloat;
  static constexpr bool normalized = true;
  template <int Bits>
  static uint32_t decode(uint32_t stored) {
    constexpr float kMax = static_cast<float>((1u << Bits) - 1);
    return bits_of(static_cast<float>(stored) / kMax);
  }
  template <int Bits>
  static uint32_t encode(uint32_t value) {
    constexpr uint32_t kMax = (1u << Bits) - 1;
    const float x = float_of(value);
    if (!(x > 0.0f)) return 0;
    if (x >= 1.0f) return kMax;
    return static_cast<uint32_t>(x * static_cast<float>(kMax) + 0.5f);
  }
};
struct Snorm {
  static constexpr NumberClass number = NumberClass::kFloat;
  static constexpr bool normalized = true;
  // The lowest integer means -1, too.
  template <int Bits>
  static uint32_t decode(uint32_t stored) {
    constexpr float kMax = static_cast<float>((1u << (Bits - 1)) - 1);
    const auto value = static_cast<int32_t>(stored << (32 - Bits)) >> (32 - Bits);
    const float x = static_cast<float>(value) / kMax;
    return bits_of(x < -1.0f ? -1.0f : x);
  }
  template <int Bits>
  static uint32_t encode(uint32_t value) {
    constexpr float kMax = static_cast<float>((1u << (Bits - 1)) - 1);
    float x = float_of(value);
    if (x != x) return 0;
    x = (x < -1.0f ? -1.0f : x > 1.0f ? 1.0f : x) * kMax;
    const auto rounded = static_cast<int32_t>(x + (x < 0.0f ? -0.5f : 0.5f));
    return static_cast<uint32_t>(rounded) & ((1u << Bits) - 1);
  }
};
struct Uint {
  static constexpr NumberClass number = NumberClass::kUint;
  static constexpr bool normalized = false;
  template <int Bits>
  static uint32_t decode(uint32_t stored) {
    return stored;
  }
  template <int Bits>
  static uint32_t encode(uint32_t value) {
    constexpr uint32_t kMax = static_cast<uint32_t>((uint64_t{1} << Bits) - 1);
    return value < kMax ? value : kMax;
  }
};
struct Sint {
  static constexpr NumberClass number = NumberClass::kSint;
  static constexpr bool normalized = false;
  template <int Bits>
  static uint32_t decode(uint32_t stored) {
    return static_cast<uint32_t>(static_cast<int32_t>(stored << (32 - Bits)) >> (32 - Bits));
  }
  template <int Bits>
  static uint32_t encode(uint32_t value) {
    constexpr int32_t kMax = static_cast<int32_t>((uint64_t{1} << (Bits - 1)) - 1);
    const auto x = static_cast<int32_t>(value);
    const int32_t clamped = x > kMax ? kMax : x < -kMax - 1 ? -kMax - 1 : x;
    return static_cast<uint32_t>(clamped) & static_cast<uint32_t>((uint64_t{1} << Bits) - 1);
  }
};
struct Float {
  static constexpr NumberClass number = NumberClass::kFloat;
  static constexpr bool normalized = false;
  template <int Bits>
  static uint32_t decode(uint32_t stored) {
    return Bits == 16 ? bits_of(to_float(half{static_cast<uint16_t>(stored)})) : stored;
  }
  template <int Bits>
  static uint32_t encode(uint32_t value) {
    return Bits == 16 ? to_half_toward_zero(float_of(value)).bits : value;
  }
};

Texel empty_texel(NumberClass number) {
  return {{0, 0, 0, missing_channel(number, 3)}};
}

// ---------------------------------------------------------------------------------------------
// N channels of type T, red first.

template <class Channel, class T, int N>
struct Plain {
  static constexpr int kBits = sizeof(T) * 8;
  static Texel decode(const uint8_t* at) {
    Texel texel = empty_texel(Channel::number);
    for (int i = 0; i < N; ++i) {
      texel.bits[i] = Channel::template decode<kBits>(read<T>(at + i * sizeof(T)));
    }
    return texel;
  }
  static void encode(uint8_t* at, const Texel& texel) {
    for (int i = 0; i < N; ++i) {
      write(at + i * sizeof(T), static_cast<T>(Channel::template encode<kBits>(texel.bits[i])));
    }
  }
  static constexpr FormatCodec codec() {
    return {sizeof(T) * N, (1u << N) - 1, Channel::number, Channel::normalized, decode, encode};
  }
};

// One integer T with bit fields: Shift and Bits for each channel; 0 bits: not stored.
template <class Channel, class T, int RShift, int RBits, int GShift, int GBits, int BShift,
          int BBits, int AShift, int ABits>
struct Packed {
  template <int Shift, int Bits>
  static uint32_t decode_channel(uint32_t word) {
    return Channel::template decode<Bits>(word >> Shift & ((1u << Bits) - 1));
  }
  template <int Shift, int Bits>
  static uint32_t encode_channel(uint32_t value) {
    return Channel::template encode<Bits>(value) << Shift;
  }
  static Texel decode(const uint8_t* at) {
    const uint32_t word = read<T>(at);
    Texel texel = empty_texel(Channel::number);
    texel.bits[0] = decode_channel<RShift, RBits>(word);
    texel.bits[1] = decode_channel<GShift, GBits>(word);
    texel.bits[2] = decode_channel<BShift, BBits>(word);
    if constexpr (ABits > 0) texel.bits[3] = decode_channel<AShift, ABits>(word);
    return texel;
  }
  static void encode(uint8_t* at, const Texel& texel) {
    uint32_t word = encode_channel<RShift, RBits>(texel.bits[0]) |
                    encode_channel<GShift, GBits>(texel.bits[1]) |
                    encode_channel<BShift, BBits>(texel.bits[2]);
    if constexpr (ABits > 0) word |= encode_channel<AShift, ABits>(texel.bits[3]);
    write(at, static_cast<T>(word));
  }
  static constexpr FormatCodec codec() {
    return {sizeof(T), ABits > 0 ? 15 : 7, Channel::number, Channel::normalized, decode, encode};
  }
};

Texel decode_a8(const uint8_t* at) {
  return {{0, 0, 0, Unorm::decode<8>(*at)}};
}
void encode_a8(uint8_t* at, const Texel& texel) {
  *at = static_cast<uint8_t>(Unorm::encode<8>(texel.bits[3]));
}

// ---------------------------------------------------------------------------------------------
// sRGB

// Blue first, or red first; alpha is linear.
template <int Red, int Blue, bool Alpha>
Texel decode_srgb(const uint8_t* at) {
  return {{bits_of(kSrgbToLinear[at[Red]]), bits_of(kSrgbToLinear[at[1]]),
           bits_of(kSrgbToLinear[at[Blue]]), Alpha ? Unorm::decode<8>(at[3]) : bits_of(1.0f)}};
}

// ---------------------------------------------------------------------------------------------
// Small floats: 5 exponent bits like float16, no sign.

// Negative numbers give 0; others are rounded toward zero, so that what is finite stays finite.
// [D3D11.3 3.1.3.3, 3.2.2]
template <int Mantissa>
uint32_t encode_unsigned_float(uint32_t value) {
  constexpr uint32_t kInfinity = 31u << Mantissa;
  const float x = float_of(value);
  if (x != x) return kInfinity | 1u << (Mantissa - 1);
  if (!(x > 0.0f)) return 0;
  if (value == 0x7F800000u) return kInfinity;
  if (x < 0x1p-14f) {
    return static_cast<uint32_t>(x * static_cast<float>(1 << (14 + Mantissa)));
  }
  constexpr int kShift = 23 - Mantissa;
  const uint32_t result = (value >> kShift) - (112u << Mantissa);
  return result < kInfinity ? result : kInfinity - 1;
}

Texel decode_r11g11b10(const uint8_t* at) {
  const uint32_t word = read<uint32_t>(at);
  const auto widen = [](uint32_t bits) {
    return bits_of(to_float(half{static_cast<uint16_t>(bits)}));
  };
  return {{widen((word & 0x7FFu) << 4), widen((word >> 11 & 0x7FFu) << 4), widen((word >> 22) << 5),
           bits_of(1.0f)}};
}
void encode_r11g11b10(uint8_t* at, const Texel& texel) {
  write(at, encode_unsigned_float<6>(texel.bits[0]) |
                encode_unsigned_float<6>(texel.bits[1]) << 11 |
                encode_unsigned_float<5>(texel.bits[2]) << 22);
}

Texel decode_r9g9b9e5(const uint8_t* at) {
  const uint32_t word = read<uint32_t>(at);
  const float scale = std::ldexp(1.0f, static_cast<int>(word >> 27) - 24);
  const auto channel = [&](int shift) {
    return bits_of(static_cast<float>(word >> shift & 0x1FFu) * scale);
  };
  return {{channel(0), channel(9), channel(18), bits_of(1.0f)}};
}

// ---------------------------------------------------------------------------------------------
// Depth and stencil of textures that hold both, each by itself: depth is red, stencil green.
// [D3D12: R24G8 and R32G8X24 families]

Texel decode_depth24(const uint8_t* at) {
  const uint32_t depth = read<uint32_t>(at) & 0xFFFFFFu;
  return {{bits_of(static_cast<float>(depth) / 16777215.0f), 0, 0, bits_of(1.0f)}};
}
Texel decode_depth32(const uint8_t* at) {
  return {{read<uint32_t>(at), 0, 0, bits_of(1.0f)}};
}
template <int kByte>
Texel decode_stencil(const uint8_t* at) {
  return {{0, at[kByte], 0, 1}};
}

// ---------------------------------------------------------------------------------------------

constexpr FormatCodec codec_of(uint32_t format) {
  constexpr NumberClass kF = NumberClass::kFloat;
  switch (format) {
    case 2:
      return Plain<Float, uint32_t, 4>::codec();
    case 3:
      return Plain<Uint, uint32_t, 4>::codec();
    case 4:
      return Plain<Sint, uint32_t, 4>::codec();
    case 6:
      return Plain<Float, uint32_t, 3>::codec();
    case 7:
      return Plain<Uint, uint32_t, 3>::codec();
    case 8:
      return Plain<Sint, uint32_t, 3>::codec();
    case 10:
      return Plain<Float, uint16_t, 4>::codec();
    case 11:
      return Plain<Unorm, uint16_t, 4>::codec();
    case 12:
      return Plain<Uint, uint16_t, 4>::codec();
    case 13:
      return Plain<Snorm, uint16_t, 4>::codec();
    case 14:
      return Plain<Sint, uint16_t, 4>::codec();
    case 16:
      return Plain<Float, uint32_t, 2>::codec();
    case 17:
      return Plain<Uint, uint32_t, 2>::codec();
    case 18:
      return Plain<Sint, uint32_t, 2>::codec();
    case 21:
      return {8, 1, kF, false, decode_depth32, nullptr};
    case 22:
      return {8, 2, NumberClass::kUint, false, decode_stencil<4>, nullptr};
    case 24:
      return Packed<Unorm, uint32_t, 0, 10, 10, 10, 20, 10, 30, 2>::codec();
    case 25:
      return Packed<Uint, uint32_t, 0, 10, 10, 10, 20, 10, 30, 2>::codec();
    case 26:
      return {4, 7, kF, false, decode_r11g11b10, encode_r11g11b10};
    case 28:
      return Plain<Unorm, uint8_t, 4>::codec();
    case 29:
      return {4, 15, kF, true, decode_srgb<0, 2, true>, nullptr};
    case 30:
      return Plain<Uint, uint8_t, 4>::codec();
    case 31:
      return Plain<Snorm, uint8_t, 4>::codec();
    case 32:
      return Plain<Sint, uint8_t, 4>::codec();
    case 34:
      return Plain<Float, uint16_t, 2>::codec();
    case 35:
      return Plain<Unorm, uint16_t, 2>::codec();
    case 36:
      return Plain<Uint, uint16_t, 2>::codec();
    case 37:
      return Plain<Snorm, uint16_t, 2>::codec();
    case 38:
      return Plain<Sint, uint16_t, 2>::codec();
    case 41:
      return Plain<Float, uint32_t, 1>::codec();
    case 42:
      return Plain<Uint, uint32_t, 1>::codec();
    case 43:
      return Plain<Sint, uint32_t, 1>::codec();
    case 46:
      return {4, 1, kF, true, decode_depth24, nullptr};
    case 47:
      return {4, 2, NumberClass::kUint, false, decode_stencil<3>, nullptr};
    case 49:
      return Plain<Unorm, uint8_t, 2>::codec();
    case 50:
      return Plain<Uint, uint8_t, 2>::codec();
    case 51:
      return Plain<Snorm, uint8_t, 2>::codec();
    case 52:
      return Plain<Sint, uint8_t, 2>::codec();
    case 54:
      return Plain<Float, uint16_t, 1>::codec();
    case 56:
      return Plain<Unorm, uint16_t, 1>::codec();
    case 57:
      return Plain<Uint, uint16_t, 1>::codec();
    case 58:
      return Plain<Snorm, uint16_t, 1>::codec();
    case 59:
      return Plain<Sint, uint16_t, 1>::codec();
    case 61:
      return Plain<Unorm, uint8_t, 1>::codec();
    case 62:
      return Plain<Uint, uint8_t, 1>::codec();
    case 63:
      return Plain<Snorm, uint8_t, 1>::codec();
    case 64:
      return Plain<Sint, uint8_t, 1>::codec();
    case 65:
      return {1, 8, kF, true, decode_a8, encode_a8};
    case 67:
      return {4, 7, kF, false, decode_r9g9b9e5, nullptr};
    case 85:
      return Packed<Unorm, uint16_t, 11, 5, 5, 6, 0, 5, 0, 0>::codec();
    case 86:
      return Packed<Unorm, uint16_t, 10, 5, 5, 5, 0, 5, 15, 1>::codec();
    case 87:
      return Packed<Unorm, uint32_t, 16, 8, 8, 8, 0, 8, 24, 8>::codec();
    case 88:
      return Packed<Unorm, uint32_t, 16, 8, 8, 8, 0, 8, 0, 0>::codec();
    case 91:
      return {4, 15, kF, true, decode_srgb<2, 0, true>, nullptr};
    case 93:
      return {4, 7, kF, true, decode_srgb<2, 0, false>, nullptr};
    case 115:
      return Packed<Unorm, uint16_t, 8, 4, 4, 4, 0, 4, 12, 4>::codec();
    default:
      return {};
  }
}

constexpr uint32_t kFormatCount = 116;

constexpr std::array<FormatCodec, kFormatCount> kCodecs = [] {
  std::array<FormatCodec, kFormatCount> codecs{};
  for (uint32_t i = 0; i < kFormatCount; ++i) codecs[i] = codec_of(i);
  return codecs;
}();

}  // namespace

const FormatCodec& format_codec(uint32_t dxgi_format) {
  return kCodecs[dxgi_format < kFormatCount ? dxgi_format : 0];
}

uint8_t linear_to_srgb(float value) {
  const double x = static_cast<double>(value);
  if (!(x > 0.0)) return 0;
  if (x >= 1.0) return 255;
  const double encoded = x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(encoded * 255.0 + 0.5);
}

}  // namespace kaamos::shader
