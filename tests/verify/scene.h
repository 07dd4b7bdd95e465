// SPDX-License-Identifier: MIT
//
// The scene of the picture that kaamos-verify traces: what is given to the device, and what the
// expected texels are computed from.
#pragma once

#include <array>
#include <cstdint>

namespace kaamos::verify {

inline constexpr uint32_t kWidth = 64;
inline constexpr uint32_t kHeight = 48;
inline constexpr uint32_t kTexels = kWidth * kHeight;

using Point = std::array<float, 3>;
using Triangle = std::array<Point, 3>;
using Transform = std::array<std::array<float, 4>, 3>;  // from object to world space

struct Texel {
  float t = 0;               // along a direction that is not normalised; -1: nothing is seen
  float attributes[2] = {};  // barycentrics, or x and y of the sphere's normal
  float code = 0;            // InstanceID + 16 * PrimitiveIndex, + 64 for a lit floor
};

inline constexpr Point kEye = {0.3f, 0.2f, -5.0f};
inline constexpr Point kLight = {2.0f, 3.0f, -2.5f};

inline constexpr uint32_t kFloorId = 1, kTriangleId = 2, kSphereId = 3;
inline constexpr std::array<Triangle, 2> kFloor = {
    {{{{-3, -1.1f, -3}, {-3, -1.1f, 5}, {3, -1.1f, 5}}},
     {{{-3, -1.1f, -3}, {3, -1.1f, 5}, {3, -1.1f, -3}}}}};
inline constexpr Triangle kTilted = {{{0, 1, 0}, {1, -1, 0.4f}, {-1, -0.8f, -0.3f}}};
inline constexpr float kRadius = 0.8f;

inline constexpr Transform kFloorToWorld = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
// Turned by 30 degrees about y, and 1.2 times as large.
inline constexpr Transform kTiltedToWorld = {
    {{1.0392305f, 0, 0.6f, -1.2f}, {0, 1.2f, 0, 0.2f}, {-0.6f, 0, 1.0392305f, 0.6f}}};
inline constexpr Transform kSphereToWorld = {
    {{1, 0, 0, 1.3f}, {0, 1.25f, 0, -0.2f}, {0, 0, 0.75f, 0.4f}}};

}  // namespace kaamos::verify
