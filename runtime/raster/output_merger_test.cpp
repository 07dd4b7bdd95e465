// SPDX-License-Identifier: MIT
//
// Writing to render targets: RAS-25, RAS-109 to RAS-111, RAS-113 to RAS-128.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kaamos/shader/half.h"
#include "runtime/raster/narrow_float.h"
#include "runtime/raster/target_codec.h"
#include "runtime/raster/testing/scene.h"
#include "runtime/shader/texture/format_codec.h"

namespace kaamos::raster {
namespace {

using rtapi::Blend;
using rtapi::BlendOp;
using rtapi::ColorWriteEnable;
using rtapi::Format;
using testing::as_bits;
using testing::as_float;
using testing::Scene;
using testing::TestTexture;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// The first bytes of a texel of `format` after a write of this colour; all pixels hold the same.
template <class T>
T written(Format format, float r, float g = 0, float b = 0, float a = 0) {
  Scene scene(9, 7);
  TestTexture& target = scene.add_target(format);
  scene.shade_constant(r, g, b, a);
  scene.quad_px(0, 0, 9, 7);
  scene.run();
  const T first = target.at<T>(0, 0);
  EXPECT_EQ(target.count(first), 63u);
  EXPECT_TRUE(target.padding_is_intact());
  return first;
}

TEST(RasterOutput, Unorm) {  // RAS-113
  EXPECT_EQ(written<uint8_t>(Format::kR8Unorm, 0.5f), 128);
  EXPECT_EQ(written<uint8_t>(Format::kR8Unorm, 1.5f), 255);
  EXPECT_EQ(written<uint8_t>(Format::kR8Unorm, -1), 0);
  EXPECT_EQ(written<uint8_t>(Format::kR8Unorm, kNaN), 0);
  EXPECT_EQ(written<uint16_t>(Format::kR16Unorm, 0.5f), 32768);
  EXPECT_EQ(written<uint32_t>(Format::kR10G10B10A2Unorm, 0.5f, 0, 1, 0.5f),
            512u | 1023u << 20 | 2u << 30);
  EXPECT_EQ(written<uint32_t>(Format::kR8G8B8A8Unorm, 0.2f, 0.4f, 0.6f, 0.8f), 0xCC996633u);
  EXPECT_EQ(written<uint32_t>(Format::kB8G8R8A8Unorm, 0.2f, 0.4f, 0.6f, 0.8f), 0xCC336699u);
}

TEST(RasterOutput, Snorm) {  // RAS-114
  EXPECT_EQ(written<int16_t>(Format::kR16Snorm, -1), -32767);
  EXPECT_EQ(written<int16_t>(Format::kR16Snorm, 0.5f), 16384);
  EXPECT_EQ(written<int16_t>(Format::kR16Snorm, -0.5f), -16384);
  EXPECT_EQ(written<int16_t>(Format::kR16Snorm, -7), -32767);
  EXPECT_EQ(written<int16_t>(Format::kR16Snorm, kNaN), 0);
}

TEST(RasterOutput, NarrowFloatsRoundTowardZero) {  // RAS-115
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, 0.3f), 0x34CC);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, -0.3f), 0xB4CC);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, 65520), 0x7BFF);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, 1e6f), 0x7BFF);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, kInfinity), 0x7C00);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, -kInfinity), 0xFC00);
  EXPECT_GT(written<uint16_t>(Format::kR16Float, kNaN) & 0x7FFF, 0x7C00);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, 0x1.8p-24f), 1);
  EXPECT_EQ(written<uint16_t>(Format::kR16Float, 0x1.ffcp-15f), 0x3FF);
  const uint32_t packed = written<uint32_t>(Format::kR11G11B10Float, 0.3f, -1, 1e6f);
  EXPECT_EQ(packed & 0x7FF, 0x34Cu);
  EXPECT_EQ(packed >> 11 & 0x7FF, 0u);
  EXPECT_EQ(packed >> 22, 0x3DFu);
  EXPECT_EQ(written<uint32_t>(Format::kR11G11B10Float, kInfinity, -kInfinity), 0x7C0u);
  EXPECT_GT(written<uint32_t>(Format::kR11G11B10Float, kNaN), 0x7C0u);
}

TEST(RasterOutput, HalvesAreTheNearestTowardZero) {  // RAS-115
  for (uint32_t bits = 0; bits < 0x7C00; ++bits) {
    const float exact = shader::to_float(shader::half{static_cast<uint16_t>(bits)});
    ASSERT_EQ(half_toward_zero(as_bits(exact)), bits);
    const float above = std::nextafter(exact, kInfinity);
    if (bits >= 0x400) {
      ASSERT_EQ(half_toward_zero(as_bits(above)), bits);
    }
    const float next = shader::to_float(shader::half{static_cast<uint16_t>(bits + 1)});
    if (bits + 1 < 0x7C00) {
      ASSERT_EQ(half_toward_zero(as_bits(std::nextafter(next, 0.0f))), bits);
      ASSERT_EQ(half_toward_zero(as_bits(-std::nextafter(next, 0.0f))), bits | 0x8000);
    }
  }
}

TEST(RasterOutput, IntegersAreClampedAndBitsPass) {  // RAS-116
  EXPECT_EQ(written<uint16_t>(Format::kR16Uint, as_float(70000)), 65535);
  EXPECT_EQ(written<uint8_t>(Format::kR8Uint, as_float(300)), 255);
  EXPECT_EQ(written<int8_t>(Format::kR8Sint, as_float(static_cast<uint32_t>(-300))), -128);
  EXPECT_EQ(written<int8_t>(Format::kR8Sint, as_float(300)), 127);
  EXPECT_EQ(written<uint32_t>(Format::kR32Uint, as_float(0x7FA00001)), 0x7FA00001u);
  EXPECT_EQ(written<uint32_t>(Format::kR32Float, as_float(0x7FA00001)), 0x7FA00001u);
  const auto four = written<std::array<uint32_t, 4>>(Format::kR32G32B32A32Uint, as_float(1),
                                                     as_float(2), as_float(3), as_float(4));
  EXPECT_EQ(four, (std::array<uint32_t, 4>{1, 2, 3, 4}));
}

TEST(RasterOutput, Srgb) {  // RAS-117, RAS-118
  EXPECT_EQ(written<uint32_t>(Format::kR8G8B8A8UnormSrgb, 0.5f, 0.0031308f, 2, 0.5f),
            188u | 10u << 8 | 255u << 16 | 128u << 24);
  EXPECT_EQ(written<uint32_t>(Format::kB8G8R8A8UnormSrgb, 0.5f, 0.0031308f, 2, 0.5f),
            255u | 10u << 8 | 188u << 16 | 128u << 24);
  EXPECT_EQ(written<uint32_t>(Format::kR8G8B8A8UnormSrgb, kNaN, -1, kInfinity, kNaN), 0xFF0000u);
  for (float x = 0; x < 1; x += 0.00037f) {
    ASSERT_EQ(written<uint8_t>(Format::kR8G8B8A8UnormSrgb, x), shader::linear_to_srgb(x)) << x;
  }
}

TEST(RasterOutput, TargetsMayBeMissing) {  // RAS-109, RAS-110
  Scene scene(64, 64);
  TestTexture& zero = scene.add_target(Format::kR32Float);
  scene.add_target(Format::kR32Float);
  TestTexture& two = scene.add_target(Format::kR32Float);
  scene.shade_constant(1, 0, 0, 0);
  scene.color[1].reset();
  TestTexture& three = scene.add_target(Format::kR32Float);  // the shader does not have it
  three.fill(5.0f);
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(zero.count(1.0f), 4096u);
  EXPECT_EQ(two.count(1.0f), 4096u);
  EXPECT_EQ(three.count(5.0f), 4096u);
}

TEST(RasterOutput, ComponentsThatAreNotDeclaredAreZero) {  // RAS-111
  Scene scene(64, 64);
  TestTexture& target = scene.add_target(Format::kR8G8B8A8Unorm);
  target.fill(0xFFFFFFFFu);
  scene.shade_constant(1, 1, 1, 1);
  scene.linked.pixel_columns.targets[0].components = 2;
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(target.count(0x0000FFFFu), 4096u);
}

TEST(RasterOutput, WithoutPixelShaderColorsStay) {  // RAS-25
  Scene scene(64, 64);
  TestTexture& target = scene.add_target(Format::kR32Float);
  TestTexture& depth = scene.add_depth(Format::kD32Float);
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(target.count(0.0f), 4096u);
  EXPECT_EQ(depth.count(0.5f), 4096u);
  scene.depth.reset();
  scene.run();
  EXPECT_EQ(target.count(0.0f), 4096u);
}

TEST(RasterOutput, WriteMask) {  // RAS-119
  Scene scene(64, 64);
  TestTexture& bytes = scene.add_target(Format::kR8G8B8A8Unorm);
  TestTexture& words = scene.add_target(Format::kR16G16B16A16Uint);
  TestTexture& none = scene.add_target(Format::kR32Float);
  bytes.fill(0x11223344u);
  words.fill(uint64_t{0x1111222233334444});
  none.fill(3.0f);
  for (auto& blend : scene.linked.blend) blend.RenderTargetWriteMask = ColorWriteEnable::kGreen;
  scene.linked.blend[2].RenderTargetWriteMask = ColorWriteEnable::kNone;
  scene.shade_constant(1, 1, 1, 1);  // 0x3F800000: clamped to 65535
  scene.quad_px(0, 0, 64, 64);
  scene.run();
  EXPECT_EQ(bytes.count(0x1122FF44u), 4096u);
  EXPECT_EQ(words.count(uint64_t{0x11112222FFFF4444}), 4096u);
  EXPECT_EQ(none.count(3.0f), 4096u);
}

// The texel of `format` after a colour was blended over another one.
struct Blended {
  Format format = Format::kR8G8B8A8Unorm;
  rtapi::RenderTargetBlendDesc desc;
  float factor[4] = {1, 1, 1, 1};

  template <class T>
  T over(std::array<float, 4> destination, std::array<float, 4> source) const {
    Scene scene(5, 5);
    TestTexture& target = scene.add_target(format);
    scene.quad_px(0, 0, 5, 5);
    const auto [dr, dg, db, da] = destination;
    scene.shade_constant(dr, dg, db, da);
    scene.run();
    const auto [r, g, b, a] = source;
    scene.shade_constant(r, g, b, a);
    scene.linked.blend[0] = desc;
    scene.linked.blend[0].BlendEnable = true;
    for (int i = 0; i < 4; ++i) scene.state.blend_factor[i] = factor[i];
    scene.run();
    EXPECT_EQ(target.count(target.at<T>(0, 0)), 25u);
    return target.at<T>(0, 0);
  }
};

Blended blend_of(Blend source, Blend destination, BlendOp op = BlendOp::kAdd) {
  Blended blended;
  blended.desc.SrcBlend = source;
  blended.desc.DestBlend = destination;
  blended.desc.BlendOp = op;
  blended.desc.SrcBlendAlpha = Blend::kOne;
  blended.desc.DestBlendAlpha = Blend::kZero;
  return blended;
}

TEST(RasterOutput, BlendFactors) {  // RAS-120
  const std::array<float, 4> d = {0.25f, 0.5f, 1, 0.75f};
  const std::array<float, 4> s = {0.5f, 0.25f, 0.125f, 0.5f};
  const auto red = [&](Blend source, Blend destination) {
    Blended blended = blend_of(source, destination);
    blended.format = Format::kR32G32B32A32Float;
    for (int i = 0; i < 4; ++i) blended.factor[i] = 0.375f;
    return blended.over<float>(d, s);
  };
  EXPECT_EQ(red(Blend::kZero, Blend::kOne), 0.25f);
  EXPECT_EQ(red(Blend::kOne, Blend::kZero), 0.5f);
  EXPECT_EQ(red(Blend::kSrcColor, Blend::kZero), 0.25f);
  EXPECT_EQ(red(Blend::kInvSrcColor, Blend::kOne), 0.5f);
  EXPECT_EQ(red(Blend::kSrcAlpha, Blend::kInvSrcAlpha), 0.375f);
  EXPECT_EQ(red(Blend::kDestAlpha, Blend::kZero), 0.375f);
  EXPECT_EQ(red(Blend::kInvDestAlpha, Blend::kZero), 0.125f);
  EXPECT_EQ(red(Blend::kDestColor, Blend::kZero), 0.125f);
  EXPECT_EQ(red(Blend::kInvDestColor, Blend::kZero), 0.375f);
  EXPECT_EQ(red(Blend::kSrcAlphaSat, Blend::kZero), 0.125f);
  EXPECT_EQ(red(Blend::kBlendFactor, Blend::kZero), 0.1875f);
  EXPECT_EQ(red(Blend::kInvBlendFactor, Blend::kZero), 0.3125f);
}

TEST(RasterOutput, BlendOps) {  // RAS-120
  const std::array<float, 4> d = {0.25f, 0, 0, 0.5f};
  const std::array<float, 4> s = {1, 0, 0, 1};
  const auto red = [&](BlendOp op) {
    Blended blended = blend_of(Blend::kSrcAlpha, Blend::kZero, op);
    blended.format = Format::kR32G32B32A32Float;
    blended.desc.DestBlend = Blend::kOne;
    return blended.over<float>(d, s);
  };
  EXPECT_EQ(red(BlendOp::kAdd), 1.25f);
  EXPECT_EQ(red(BlendOp::kSubtract), 0.75f);
  EXPECT_EQ(red(BlendOp::kRevSubtract), -0.75f);
  EXPECT_EQ(red(BlendOp::kMin), 0.25f);
  EXPECT_EQ(red(BlendOp::kMax), 1.0f);
}

TEST(RasterOutput, AlphaHasItsOwnEquation) {  // RAS-120
  Blended blended = blend_of(Blend::kZero, Blend::kOne);
  blended.format = Format::kR32G32B32A32Float;
  blended.desc.SrcBlendAlpha = Blend::kSrcAlphaSat;
  blended.desc.DestBlendAlpha = Blend::kSrcAlpha;
  blended.desc.BlendOpAlpha = BlendOp::kSubtract;
  const auto texel = blended.over<std::array<float, 4>>({1, 2, 3, 0.5f}, {9, 9, 9, 0.25f});
  EXPECT_EQ(texel, (std::array<float, 4>{1, 2, 3, 0.25f - 0.125f}));
}

TEST(RasterOutput, BlendClampsToTheFormat) {  // RAS-120, RAS-125
  const Blended add = blend_of(Blend::kOne, Blend::kOne);
  EXPECT_EQ(add.over<uint8_t>({0, 0, 0, 0}, {2, 0, 0, 0}), 255);
  EXPECT_EQ(add.over<uint8_t>({0.5f, 0, 0, 0}, {-1, 0, 0, 0}), 128);
  EXPECT_EQ(add.over<uint8_t>({0.5f, 0, 0, 0}, {kNaN, 0, 0, 0}), 128);
  Blended snorm = add;
  snorm.format = Format::kR8G8B8A8Snorm;
  EXPECT_EQ(snorm.over<int8_t>({0.5f, 0, 0, 0}, {-1, 0, 0, 0}), -63);
  Blended factor = blend_of(Blend::kBlendFactor, Blend::kZero);
  factor.factor[0] = 3;
  EXPECT_EQ(factor.over<uint8_t>({0, 0, 0, 0}, {0.5f, 0, 0, 0}), 128);
}

TEST(RasterOutput, AbsentAlphaIsOne) {  // RAS-121
  Blended blended = blend_of(Blend::kInvDestAlpha, Blend::kOne);
  blended.format = Format::kR11G11B10Float;
  EXPECT_EQ(blended.over<uint32_t>({1, 0, 0, 0}, {8, 0, 0, 0}) & 0x7FF, 0x3C0u);
}

TEST(RasterOutput, NaNIsPropagated) {  // RAS-124
  Blended blended = blend_of(Blend::kOne, Blend::kZero);
  blended.format = Format::kR32G32B32A32Float;
  EXPECT_TRUE(std::isnan(as_float(blended.over<uint32_t>({kNaN, 0, 0, 0}, {1, 0, 0, 0}))));
}

TEST(RasterOutput, SrgbBlendsLinearly) {  // RAS-128
  Blended blended = blend_of(Blend::kSrcAlpha, Blend::kInvSrcAlpha);
  blended.format = Format::kR8G8B8A8UnormSrgb;
  EXPECT_EQ(blended.over<uint32_t>({0, 0, 0, 1}, {1, 1, 1, 0.5f}), 0x80BCBCBCu);
}

TEST(RasterOutput, SampleMask) {  // RAS-127
  for (const uint32_t mask : {0xFFFFFFFEu, 1u}) {
    Scene scene(64, 64);
    TestTexture& target = scene.add_target(Format::kR32Float);
    TestTexture& depth = scene.add_depth(Format::kD32Float);
    scene.shade_constant(1, 1, 1, 1);
    scene.linked.sample_mask = mask;
    scene.quad_px(0, 0, 64, 64);
    scene.run();
    EXPECT_EQ(target.count(1.0f), mask == 1 ? 4096u : 0u);
    EXPECT_EQ(depth.count(0.5f), mask == 1 ? 4096u : 0u);
  }
}

// Every format stores what the texture code reads back.
TEST(RasterOutput, FormatsAreReadBack) {
  for (uint32_t number = 0; number < 116; ++number) {
    const auto format = static_cast<Format>(number);
    const TargetCodec& codec = target_codec(format);
    if (codec.bytes == 0) continue;
    Scene scene(64, 64);
    TestTexture& target = scene.add_target(format);
    const float one = codec.integer ? as_float(1) : 1.0f;
    scene.shade_constant(one, one, one, one);
    scene.quad_px(0, 0, 64, 64);
    scene.run();
    const auto texel = shader::format_codec(number).decode(target.texel(63, 63));
    uint32_t stored = 0;
    for (int c = 0; c < 4; ++c) {
      if (shader::format_codec(number).channels >> c & 1) {
        EXPECT_EQ(texel.bits[c], as_bits(one)) << number << ' ' << c;
        stored |= 1u << c;
      }
    }
    uint32_t masks = 0;
    for (uint32_t c = 0; c < 4; ++c) {
      for (const uint32_t bits : codec.component[c]) masks |= bits != 0 ? 1u << c : 0;
    }
    EXPECT_EQ(masks, stored) << number;
  }
}

}  // namespace
}  // namespace kaamos::raster
