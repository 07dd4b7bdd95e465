// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/format_codec.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "kaamos/shader/half.h"

namespace kaamos::shader {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float as_float(uint32_t bits) {
  return std::bit_cast<float>(bits);
}
Texel floats(float r, float g, float b, float a) {
  return {{std::bit_cast<uint32_t>(r), std::bit_cast<uint32_t>(g), std::bit_cast<uint32_t>(b),
           std::bit_cast<uint32_t>(a)}};
}

bool has_nan(const FormatCodec& codec, const Texel& texel) {
  if (codec.number != NumberClass::kFloat) return false;
  for (const uint32_t bits : texel.bits) {
    if (std::isnan(as_float(bits))) return true;
  }
  return false;
}

TEST(TextureFormats, StoredBytesSurviveDecodeAndEncode) {
  uint32_t state = 12345;
  int formats = 0;
  for (uint32_t format = 0; format < 130; ++format) {
    const FormatCodec& codec = format_codec(format);
    if (codec.encode == nullptr) continue;
    ++formats;
    for (int i = 0; i < 3000; ++i) {
      uint8_t bytes[16], back[16] = {};
      for (uint8_t& byte : bytes) {
        state = state * 1664525u + 1013904223u;
        byte = static_cast<uint8_t>(state >> 24);
      }
      if (format == 88) bytes[3] = 0;  // X
      const Texel texel = codec.decode(bytes);
      if (has_nan(codec, texel)) continue;
      codec.encode(back, texel);
      // -128 and -127 both mean -1, so compare the decoded values.
      const Texel again = codec.decode(back);
      EXPECT_EQ(std::memcmp(&texel, &again, sizeof(texel)), 0) << "format " << format;
      const bool snorm = format == 13 || format == 31 || format == 37 || format == 51 ||
                         format == 58 || format == 63;
      if (!snorm) {
        EXPECT_EQ(std::memcmp(bytes, back, codec.bytes), 0) << "format " << format;
      }
    }
  }
  EXPECT_GE(formats, 45);
}

TEST(TextureFormats, NormalizedIntegersAreCorrectlyRounded) {
  const FormatCodec& unorm8 = format_codec(61);
  const FormatCodec& snorm8 = format_codec(63);
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<uint8_t>(i);
    EXPECT_EQ(as_float(unorm8.decode(&byte).bits[0]), static_cast<float>(i / 255.0L));
    const long double s = std::max(static_cast<int8_t>(byte) / 127.0L, -1.0L);
    EXPECT_EQ(as_float(snorm8.decode(&byte).bits[0]), static_cast<float>(s));
  }
  const FormatCodec& unorm16 = format_codec(56);
  for (int i = 0; i < 65536; ++i) {
    const auto word = static_cast<uint16_t>(i);
    uint8_t bytes[2];
    std::memcpy(bytes, &word, 2);
    EXPECT_EQ(as_float(unorm16.decode(bytes).bits[0]), static_cast<float>(i / 65535.0L));
  }
}

TEST(TextureFormats, MissingChannelsAreZeroAndAlphaOne) {
  const uint8_t bytes[16] = {1, 2, 3, 4};
  const Texel r8 = format_codec(61).decode(bytes);
  EXPECT_EQ(as_float(r8.bits[1]), 0.0f);
  EXPECT_EQ(as_float(r8.bits[3]), 1.0f);
  const Texel r8_uint = format_codec(62).decode(bytes);
  EXPECT_EQ(r8_uint.bits[0], 1u);
  EXPECT_EQ(r8_uint.bits[3], 1u);
  const Texel a8 = format_codec(65).decode(bytes);
  EXPECT_EQ(as_float(a8.bits[0]), 0.0f);
  EXPECT_EQ(as_float(a8.bits[3]), 1 / 255.0f);
  EXPECT_EQ(as_float(format_codec(88).decode(bytes).bits[3]), 1.0f);  // B8G8R8X8
}

TEST(TextureFormats, ChannelOrder) {
  const uint8_t rgba[4] = {255, 0, 0, 0};
  EXPECT_EQ(as_float(format_codec(28).decode(rgba).bits[0]), 1.0f);
  EXPECT_EQ(as_float(format_codec(87).decode(rgba).bits[2]), 1.0f);  // B8G8R8A8
  EXPECT_EQ(as_float(format_codec(91).decode(rgba).bits[2]), 1.0f);
  const auto of_word = [](uint32_t format, uint32_t word, int channel) {
    uint8_t bytes[4];
    std::memcpy(bytes, &word, 4);
    return as_float(format_codec(format).decode(bytes).bits[channel]);
  };
  EXPECT_EQ(of_word(24, 0x3FFu, 0), 1.0f);  // R10G10B10A2
  EXPECT_EQ(of_word(24, 0xC0000000u, 3), 1.0f);
  EXPECT_EQ(of_word(85, 0xF800u, 0), 1.0f);  // B5G6R5
  EXPECT_EQ(of_word(85, 0x001Fu, 2), 1.0f);
  EXPECT_EQ(of_word(86, 0x8000u, 3), 1.0f);   // B5G5R5A1
  EXPECT_EQ(of_word(115, 0x0F00u, 0), 1.0f);  // B4G4R4A4
}

TEST(TextureFormats, WritesClamp) {
  uint8_t bytes[16] = {};
  const auto encode = [&](uint32_t format, const Texel& texel) {
    std::memset(bytes, 0, sizeof(bytes));
    format_codec(format).encode(bytes, texel);
    uint32_t word;
    std::memcpy(&word, bytes, 4);
    return word;
  };
  EXPECT_EQ(encode(28, floats(2.0f, -1.0f, kNan, 0.5f)), 0x800000FFu);
  EXPECT_EQ(encode(28, floats(kInf, -kInf, 0.2f, 1.0f)), 0xFF3300FFu);
  EXPECT_EQ(encode(31, floats(-2.0f, 1.0f, kNan, -0.5f)), 0xC0007F81u);
  EXPECT_EQ(encode(30, {{300, 5, 0xFFFFFFFFu, 0}}), 0x00FF05FFu);
  EXPECT_EQ(encode(32, {{static_cast<uint32_t>(-200), 200, static_cast<uint32_t>(-1), 0}}),
            0x00FF7F80u);
  EXPECT_EQ(encode(36, {{70000, 5, 0, 0}}), 0x0005FFFFu);
  EXPECT_EQ(encode(25, {{2000, 1023, 0, 9}}), 0xC00FFFFFu);
  EXPECT_EQ(encode(34, floats(1.0f, 1e9f, 0, 0)), 0x7BFF3C00u);
  EXPECT_EQ(encode(34, floats(-kInf, 65520.0f, 0, 0)), 0x7BFFFC00u);
  EXPECT_EQ(encode(34, floats(0.3f, -0.3f, 0, 0)), 0xB4CC34CCu);  // 0x34CD is nearer
  EXPECT_EQ(encode(34, floats(1.9e-7f, 5e-8f, 0, 0)), 0x3u);      // 3.2 and 0.8 times 2^-24
}

TEST(TextureFormats, UnsignedFloats) {
  uint8_t bytes[4];
  const auto round_trip = [&](float x, int channel) {
    format_codec(26).encode(bytes, floats(x, x, x, 0));
    return as_float(format_codec(26).decode(bytes).bits[channel]);
  };
  for (const int c : {0, 1, 2}) {
    EXPECT_EQ(round_trip(1.0f, c), 1.0f);
    EXPECT_EQ(round_trip(0.0f, c), 0.0f);
    EXPECT_EQ(round_trip(-5.0f, c), 0.0f);
    EXPECT_EQ(round_trip(-kInf, c), 0.0f);
    EXPECT_EQ(round_trip(kInf, c), kInf);
    EXPECT_TRUE(std::isnan(round_trip(kNan, c)));
    EXPECT_EQ(round_trip(1e9f, c), c == 2 ? 64512.0f : 65024.0f);
    const int mantissa = c == 2 ? 5 : 6;
    const double smallest = std::ldexp(1.0, -14 - mantissa);
    EXPECT_EQ(static_cast<double>(round_trip(static_cast<float>(smallest), c)), smallest);
    for (int i = 1; i < 2000; ++i) {
      const float x = static_cast<float>(i) * 0.0137f;
      int exponent;
      std::frexp(x, &exponent);
      const double step = std::ldexp(1.0, exponent - 1 - mantissa);
      EXPECT_EQ(static_cast<double>(round_trip(x, c)),
                std::floor(static_cast<double>(x) / step) * step)
          << x;
    }
  }
}

TEST(TextureFormats, SharedExponent) {
  const auto decode = [](uint32_t word) {
    uint8_t bytes[4];
    std::memcpy(bytes, &word, 4);
    return format_codec(67).decode(bytes);
  };
  const Texel texel = decode(16u << 27 | 256u | 128u << 9 | 511u << 18);
  EXPECT_EQ(as_float(texel.bits[0]), 1.0f);
  EXPECT_EQ(as_float(texel.bits[1]), 0.5f);
  EXPECT_EQ(as_float(texel.bits[2]), 511.0f / 256.0f);
  EXPECT_EQ(as_float(decode(31u << 27 | 511u).bits[0]), 65408.0f);
  EXPECT_EQ(as_float(decode(1u).bits[0]), 0x1p-24f);
  EXPECT_EQ(format_codec(67).encode, nullptr);
}

TEST(TextureFormats, SrgbIsExact) {
  for (int i = 0; i < 256; ++i) {
    const long double x = i / 255.0L;
    const long double linear = x <= 0.04045L ? x / 12.92L : std::pow((x + 0.055L) / 1.055L, 2.4L);
    const auto byte = static_cast<uint8_t>(i);
    EXPECT_EQ(srgb_to_linear(byte), static_cast<float>(linear)) << i;
    EXPECT_EQ(linear_to_srgb(srgb_to_linear(byte)), byte);
  }
  EXPECT_EQ(linear_to_srgb(kNan), 0);
  EXPECT_EQ(linear_to_srgb(2.0f), 255);
  EXPECT_EQ(linear_to_srgb(-1.0f), 0);
  const uint8_t bytes[4] = {188, 0, 255, 128};
  const Texel texel = format_codec(29).decode(bytes);
  EXPECT_EQ(as_float(texel.bits[0]), srgb_to_linear(188));
  EXPECT_EQ(as_float(texel.bits[3]), 128 / 255.0f);  // alpha is linear
}

TEST(TextureFormats, UnknownFormatsHaveNoBytes) {
  for (const uint32_t format : {0u, 1u, 27u, 40u, 71u, 98u, 116u, 0xFFFFFFFFu}) {
    EXPECT_EQ(format_codec(format).bytes, 0) << format;
  }
}

}  // namespace
}  // namespace kaamos::shader
