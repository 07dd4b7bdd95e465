// SPDX-License-Identifier: MIT
#include "effects/engine/texel.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace kaamos::effects {
namespace {

using rtapi::Format;

template <class T>
T load(std::span<const std::byte> bytes, std::size_t index) {
  T value;
  std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
  return value;
}

std::uint32_t channels_of(Format format) {
  switch (format) {
    case Format::kR32Float:
      return 1;
    case Format::kR16G16Snorm:
    case Format::kR32G32Float:
    case Format::kR32G32Uint:
      return 2;
    case Format::kR32G32B32A32Float:
    case Format::kR16G16B16A16Float:
    case Format::kR8G8B8A8Unorm:
      return 4;
    default:
      return 0;
  }
}

float value_at(Format format, std::span<const std::byte> texels, std::size_t index) {
  switch (format) {
    case Format::kR16G16Snorm:
      // -32768 and -32767 both mean -1. [D3D11.3 3.2.3.3]
      return std::max(-1.0f, static_cast<float>(load<std::int16_t>(texels, index)) / 32767.0f);
    case Format::kR32G32Uint:
      return static_cast<float>(load<std::uint32_t>(texels, index));
    case Format::kR16G16B16A16Float:
      return glm::unpackHalf1x16(load<std::uint16_t>(texels, index));
    case Format::kR8G8B8A8Unorm:
      return static_cast<float>(load<std::uint8_t>(texels, index)) / 255.0f;
    default:
      return load<float>(texels, index);
  }
}

}  // namespace

std::uint32_t texel_bytes(Format format) {
  switch (format) {
    case Format::kR32Float:
    case Format::kR16G16Snorm:
    case Format::kR8G8B8A8Unorm:
      return 4;
    case Format::kR32G32Float:
    case Format::kR32G32Uint:
    case Format::kR16G16B16A16Float:
      return 8;
    case Format::kR32G32B32A32Float:
      return 16;
    default:
      return 0;
  }
}

FloatImage decode_texels(Format format, std::uint32_t width, std::uint32_t height,
                         std::span<const std::byte> texels) {
  FloatImage image(width, height, channels_of(format));
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    image.values[i] = value_at(format, texels, i);
  }
  return image;
}

}  // namespace kaamos::effects
