// SPDX-License-Identifier: MIT
/// @file
/// Element formats: the names and numbers of DXGI_FORMAT, and what is known about each.
#pragma once

#include <cstdint>

namespace rtapi {

/// The layout in which one element of a texture, typed buffer or vertex is stored. Names and
/// numbers are those of DXGI_FORMAT; GetFormatInfo tells which of them can be used, and backends
/// may lack some as views (KA0626, KA0961). [DXGI_FORMAT]
enum class Format : uint32_t {
  kUnknown = 0,
  kR32G32B32A32Typeless = 1,
  kR32G32B32A32Float = 2,
  kR32G32B32A32Uint = 3,
  kR32G32B32A32Sint = 4,
  kR32G32B32Typeless = 5,
  kR32G32B32Float = 6,
  kR32G32B32Uint = 7,
  kR32G32B32Sint = 8,
  kR16G16B16A16Typeless = 9,
  kR16G16B16A16Float = 10,
  kR16G16B16A16Unorm = 11,
  kR16G16B16A16Uint = 12,
  kR16G16B16A16Snorm = 13,
  kR16G16B16A16Sint = 14,
  kR32G32Typeless = 15,
  kR32G32Float = 16,
  kR32G32Uint = 17,
  kR32G32Sint = 18,
  kR32G8X24Typeless = 19,
  kD32FloatS8X24Uint = 20,
  kR32FloatX8X24Typeless = 21,
  kX32TypelessG8X24Uint = 22,
  kR10G10B10A2Typeless = 23,
  kR10G10B10A2Unorm = 24,
  kR10G10B10A2Uint = 25,
  kR11G11B10Float = 26,
  kR8G8B8A8Typeless = 27,
  kR8G8B8A8Unorm = 28,
  kR8G8B8A8UnormSrgb = 29,
  kR8G8B8A8Uint = 30,
  kR8G8B8A8Snorm = 31,
  kR8G8B8A8Sint = 32,
  kR16G16Typeless = 33,
  kR16G16Float = 34,
  kR16G16Unorm = 35,
  kR16G16Uint = 36,
  kR16G16Snorm = 37,
  kR16G16Sint = 38,
  kR32Typeless = 39,
  kD32Float = 40,
  kR32Float = 41,
  kR32Uint = 42,
  kR32Sint = 43,
  kR24G8Typeless = 44,
  kD24UnormS8Uint = 45,
  kR24UnormX8Typeless = 46,
  kX24TypelessG8Uint = 47,
  kR8G8Typeless = 48,
  kR8G8Unorm = 49,
  kR8G8Uint = 50,
  kR8G8Snorm = 51,
  kR8G8Sint = 52,
  kR16Typeless = 53,
  kR16Float = 54,
  kD16Unorm = 55,
  kR16Unorm = 56,
  kR16Uint = 57,
  kR16Snorm = 58,
  kR16Sint = 59,
  kR8Typeless = 60,
  kR8Unorm = 61,
  kR8Uint = 62,
  kR8Snorm = 63,
  kR8Sint = 64,
  kA8Unorm = 65,
  kR1Unorm = 66,
  kR9G9B9E5Sharedexp = 67,
  kR8G8B8G8Unorm = 68,
  kG8R8G8B8Unorm = 69,
  kBC1Typeless = 70,
  kBC1Unorm = 71,
  kBC1UnormSrgb = 72,
  kBC2Typeless = 73,
  kBC2Unorm = 74,
  kBC2UnormSrgb = 75,
  kBC3Typeless = 76,
  kBC3Unorm = 77,
  kBC3UnormSrgb = 78,
  kBC4Typeless = 79,
  kBC4Unorm = 80,
  kBC4Snorm = 81,
  kBC5Typeless = 82,
  kBC5Unorm = 83,
  kBC5Snorm = 84,
  kB5G6R5Unorm = 85,
  kB5G5R5A1Unorm = 86,
  kB8G8R8A8Unorm = 87,
  kB8G8R8X8Unorm = 88,
  kR10G10B10XrBiasA2Unorm = 89,
  kB8G8R8A8Typeless = 90,
  kB8G8R8A8UnormSrgb = 91,
  kB8G8R8X8Typeless = 92,
  kB8G8R8X8UnormSrgb = 93,
  kBC6HTypeless = 94,
  kBC6HUf16 = 95,
  kBC6HSf16 = 96,
  kBC7Typeless = 97,
  kBC7Unorm = 98,
  kBC7UnormSrgb = 99,
  kB4G4R4A4Unorm = 115,
};

/// The way in which the channels of a format are read. Typeless formats can be stored and copied,
/// and are viewed as a typed format of their family.
enum class FormatClass : uint8_t { kUnsupported, kTypeless, kFloat, kUnorm, kSnorm, kUint, kSint };

/// The layout of a format in memory. The channel that a name names first lies first, in B8G8R8A8
/// and B8G8R8X8 too (blue first).
struct FormatInfo {
  FormatClass type = FormatClass::kUnsupported;  ///< kUnsupported: bytes and channels are 0
  uint8_t bytes = 0;                             ///< of one element: a texel, or a block of texels
  uint8_t channels = 0;                          ///< X counts as one
  /// Bits of each channel; 0 where channels differ (R10G10B10A2, R11G11B10, R9G9B9E5, B5G6R5, ...)
  /// and in blocks.
  uint8_t channel_bits = 0;
  bool srgb = false;  ///< red, green and blue are stored by the sRGB curve
  /// Texels along a side of a block: 4 for BC1 to BC7, which only textures can have; else 1.
  uint8_t block_side = 1;
};

/// Returns the layout of a format in memory, for every format that textures, typed buffers and
/// vertices can have. The type is kUnsupported for all others (video and packed YUV formats, and
/// numbers that are none); CreateTexture refuses them by KA0909, views by KA0626. [DXGI_FORMAT]
constexpr FormatInfo GetFormatInfo(Format format) {
  using F = Format;
  using C = FormatClass;
  switch (format) {
    case F::kR32G32B32A32Typeless:
      return {C::kTypeless, 16, 4, 32};
    case F::kR32G32B32A32Float:
      return {C::kFloat, 16, 4, 32};
    case F::kR32G32B32A32Uint:
      return {C::kUint, 16, 4, 32};
    case F::kR32G32B32A32Sint:
      return {C::kSint, 16, 4, 32};
    case F::kR32G32B32Typeless:
      return {C::kTypeless, 12, 3, 32};
    case F::kR32G32B32Float:
      return {C::kFloat, 12, 3, 32};
    case F::kR32G32B32Uint:
      return {C::kUint, 12, 3, 32};
    case F::kR32G32B32Sint:
      return {C::kSint, 12, 3, 32};
    case F::kR16G16B16A16Typeless:
      return {C::kTypeless, 8, 4, 16};
    case F::kR16G16B16A16Float:
      return {C::kFloat, 8, 4, 16};
    case F::kR16G16B16A16Unorm:
      return {C::kUnorm, 8, 4, 16};
    case F::kR16G16B16A16Uint:
      return {C::kUint, 8, 4, 16};
    case F::kR16G16B16A16Snorm:
      return {C::kSnorm, 8, 4, 16};
    case F::kR16G16B16A16Sint:
      return {C::kSint, 8, 4, 16};
    case F::kR32G32Typeless:
      return {C::kTypeless, 8, 2, 32};
    case F::kR32G32Float:
      return {C::kFloat, 8, 2, 32};
    case F::kR32G32Uint:
      return {C::kUint, 8, 2, 32};
    case F::kR32G32Sint:
      return {C::kSint, 8, 2, 32};
    case F::kR32G8X24Typeless:
      return {C::kTypeless, 8, 2, 0};
    case F::kD32FloatS8X24Uint:
      return {C::kFloat, 8, 2, 0};
    case F::kR32FloatX8X24Typeless:
      return {C::kFloat, 8, 1, 0};
    case F::kX32TypelessG8X24Uint:
      return {C::kUint, 8, 2, 0};
    case F::kR10G10B10A2Typeless:
      return {C::kTypeless, 4, 4, 0};
    case F::kR10G10B10A2Unorm:
      return {C::kUnorm, 4, 4, 0};
    case F::kR10G10B10A2Uint:
      return {C::kUint, 4, 4, 0};
    case F::kR11G11B10Float:
      return {C::kFloat, 4, 3, 0};
    case F::kR8G8B8A8Typeless:
      return {C::kTypeless, 4, 4, 8};
    case F::kR8G8B8A8Unorm:
      return {C::kUnorm, 4, 4, 8};
    case F::kR8G8B8A8UnormSrgb:
      return {C::kUnorm, 4, 4, 8, true};
    case F::kR8G8B8A8Uint:
      return {C::kUint, 4, 4, 8};
    case F::kR8G8B8A8Snorm:
      return {C::kSnorm, 4, 4, 8};
    case F::kR8G8B8A8Sint:
      return {C::kSint, 4, 4, 8};
    case F::kR16G16Typeless:
      return {C::kTypeless, 4, 2, 16};
    case F::kR16G16Float:
      return {C::kFloat, 4, 2, 16};
    case F::kR16G16Unorm:
      return {C::kUnorm, 4, 2, 16};
    case F::kR16G16Uint:
      return {C::kUint, 4, 2, 16};
    case F::kR16G16Snorm:
      return {C::kSnorm, 4, 2, 16};
    case F::kR16G16Sint:
      return {C::kSint, 4, 2, 16};
    case F::kR32Typeless:
      return {C::kTypeless, 4, 1, 32};
    case F::kD32Float:
      return {C::kFloat, 4, 1, 32};
    case F::kR32Float:
      return {C::kFloat, 4, 1, 32};
    case F::kR32Uint:
      return {C::kUint, 4, 1, 32};
    case F::kR32Sint:
      return {C::kSint, 4, 1, 32};
    case F::kR24G8Typeless:
      return {C::kTypeless, 4, 2, 0};
    case F::kD24UnormS8Uint:
      return {C::kUnorm, 4, 2, 0};
    case F::kR24UnormX8Typeless:
      return {C::kUnorm, 4, 1, 0};
    case F::kX24TypelessG8Uint:
      return {C::kUint, 4, 2, 0};
    case F::kR8G8Typeless:
      return {C::kTypeless, 2, 2, 8};
    case F::kR8G8Unorm:
      return {C::kUnorm, 2, 2, 8};
    case F::kR8G8Uint:
      return {C::kUint, 2, 2, 8};
    case F::kR8G8Snorm:
      return {C::kSnorm, 2, 2, 8};
    case F::kR8G8Sint:
      return {C::kSint, 2, 2, 8};
    case F::kR16Typeless:
      return {C::kTypeless, 2, 1, 16};
    case F::kR16Float:
      return {C::kFloat, 2, 1, 16};
    case F::kD16Unorm:
      return {C::kUnorm, 2, 1, 16};
    case F::kR16Unorm:
      return {C::kUnorm, 2, 1, 16};
    case F::kR16Uint:
      return {C::kUint, 2, 1, 16};
    case F::kR16Snorm:
      return {C::kSnorm, 2, 1, 16};
    case F::kR16Sint:
      return {C::kSint, 2, 1, 16};
    case F::kR8Typeless:
      return {C::kTypeless, 1, 1, 8};
    case F::kR8Unorm:
      return {C::kUnorm, 1, 1, 8};
    case F::kR8Uint:
      return {C::kUint, 1, 1, 8};
    case F::kR8Snorm:
      return {C::kSnorm, 1, 1, 8};
    case F::kR8Sint:
      return {C::kSint, 1, 1, 8};
    case F::kA8Unorm:
      return {C::kUnorm, 1, 1, 8};
    case F::kR9G9B9E5Sharedexp:
      return {C::kFloat, 4, 3, 0};
    case F::kB5G6R5Unorm:
      return {C::kUnorm, 2, 3, 0};
    case F::kB5G5R5A1Unorm:
      return {C::kUnorm, 2, 4, 0};
    case F::kB8G8R8A8Typeless:
      return {C::kTypeless, 4, 4, 8};
    case F::kB8G8R8A8Unorm:
      return {C::kUnorm, 4, 4, 8};
    case F::kB8G8R8A8UnormSrgb:
      return {C::kUnorm, 4, 4, 8, true};
    case F::kB8G8R8X8Typeless:
      return {C::kTypeless, 4, 4, 8};
    case F::kB8G8R8X8Unorm:
      return {C::kUnorm, 4, 4, 8};
    case F::kB8G8R8X8UnormSrgb:
      return {C::kUnorm, 4, 4, 8, true};
    case F::kBC1Typeless:
      return {C::kTypeless, 8, 4, 0, false, 4};
    case F::kBC1Unorm:
      return {C::kUnorm, 8, 4, 0, false, 4};
    case F::kBC1UnormSrgb:
      return {C::kUnorm, 8, 4, 0, true, 4};
    case F::kBC2Typeless:
    case F::kBC3Typeless:
      return {C::kTypeless, 16, 4, 0, false, 4};
    case F::kBC2Unorm:
    case F::kBC3Unorm:
      return {C::kUnorm, 16, 4, 0, false, 4};
    case F::kBC2UnormSrgb:
    case F::kBC3UnormSrgb:
      return {C::kUnorm, 16, 4, 0, true, 4};
    case F::kBC4Typeless:
      return {C::kTypeless, 8, 1, 0, false, 4};
    case F::kBC4Unorm:
      return {C::kUnorm, 8, 1, 0, false, 4};
    case F::kBC4Snorm:
      return {C::kSnorm, 8, 1, 0, false, 4};
    case F::kBC5Typeless:
      return {C::kTypeless, 16, 2, 0, false, 4};
    case F::kBC5Unorm:
      return {C::kUnorm, 16, 2, 0, false, 4};
    case F::kBC5Snorm:
      return {C::kSnorm, 16, 2, 0, false, 4};
    case F::kBC6HTypeless:
      return {C::kTypeless, 16, 3, 0, false, 4};
    case F::kBC6HUf16:
    case F::kBC6HSf16:
      return {C::kFloat, 16, 3, 0, false, 4};
    case F::kBC7Typeless:
      return {C::kTypeless, 16, 4, 0, false, 4};
    case F::kBC7Unorm:
      return {C::kUnorm, 16, 4, 0, false, 4};
    case F::kBC7UnormSrgb:
      return {C::kUnorm, 16, 4, 0, true, 4};
    default:
      return {};
  }
}

/// Returns whether a depth-stencil view can have the format. Shaders read such textures through the
/// other formats of the family. [D3D12: depth-stencil formats]
constexpr bool IsDepthFormat(Format format) {
  return format == Format::kD32Float || format == Format::kD16Unorm ||
         format == Format::kD24UnormS8Uint || format == Format::kD32FloatS8X24Uint;
}

/// Returns whether a depth format has stencil, too.
constexpr bool HasStencil(Format format) {
  return format == Format::kD24UnormS8Uint || format == Format::kD32FloatS8X24Uint;
}

/// The depth format of a typeless one's family, or `format` itself if it is one; else kUnknown.
constexpr Format GetDepthFormat(Format format) {
  switch (format) {
    case Format::kR32Typeless:
      return Format::kD32Float;
    case Format::kR16Typeless:
      return Format::kD16Unorm;
    case Format::kR24G8Typeless:
      return Format::kD24UnormS8Uint;
    case Format::kR32G8X24Typeless:
      return Format::kD32FloatS8X24Uint;
    default:
      return IsDepthFormat(format) ? format : Format::kUnknown;
  }
}

}  // namespace rtapi
