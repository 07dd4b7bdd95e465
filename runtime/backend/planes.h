// SPDX-License-Identifier: MIT
//
// Depth and stencil of a texture: planes that are copied and changed from state to state apart,
// although shaders see one texture. [D3D12: subresources, plane slices]
#pragma once

#include <cstdint>

#include <rtapi/format.h>

namespace kaamos::runtime {

enum Plane : uint32_t {
  kFirstPlane = 0,  // all of a texture without planes; else depth
  kStencilPlane = 1,
  kAllPlanes = 2,  // only of copies to a buffer: elements with both, as in memory
};

constexpr bool has_stencil_plane(rtapi::Format format) {
  return (format >= rtapi::Format::kR32G8X24Typeless &&
          format <= rtapi::Format::kX32TypelessG8X24Uint) ||
         (format >= rtapi::Format::kR24G8Typeless && format <= rtapi::Format::kX24TypelessG8Uint);
}

constexpr uint32_t plane_count(rtapi::Format format) {
  return has_stencil_plane(format) ? 2 : 1;
}

// The format that copies of a plane have. [D3D12: GetCopyableFootprints]
constexpr rtapi::Format plane_format(rtapi::Format format, uint32_t plane) {
  if (!has_stencil_plane(format) || plane == kAllPlanes) return format;
  return plane == kStencilPlane ? rtapi::Format::kR8Typeless : rtapi::Format::kR32Typeless;
}

// Whether a view in this format shows stencil.
constexpr bool shows_stencil(rtapi::Format format) {
  return format == rtapi::Format::kX32TypelessG8X24Uint ||
         format == rtapi::Format::kX24TypelessG8Uint;
}

// The place of a plane's bytes in an element that has both: 24 bits of depth and 8 of stencil, or a
// float, 8 bits of stencil and 24 that are not used.
struct PlaneBytes {
  uint32_t offset = 0;
  uint32_t count = 0;
};
constexpr PlaneBytes plane_bytes(rtapi::Format format, uint32_t plane) {
  const uint32_t element = rtapi::GetFormatInfo(format).bytes;
  if (!has_stencil_plane(format) || plane == kAllPlanes) return {0, element};
  const uint32_t depth = element == 4 ? 3 : 4;
  return plane == kStencilPlane ? PlaneBytes{depth, 1} : PlaneBytes{0, depth};
}

}  // namespace kaamos::runtime
