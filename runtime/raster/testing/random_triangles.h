// SPDX-License-Identifier: MIT
//
// Random triangles of several kinds for a Scene.
#pragma once

#include <cstdlib>
#include <random>
#include <string_view>

#include "runtime/raster/testing/scene.h"

namespace kaamos::raster::testing {

enum class TriangleKind {
  kSmall,    // a few pixels
  kMedium,   // up to a quarter of the target
  kHuge,     // corners thousands of pixels away, but within the guard band
  kSliver,   // long, and a fraction of a pixel wide
  kCenters,  // corners at centres of pixels
};

// Per setting; KAAMOS_FULL=1 asks for many more.
inline uint32_t random_triangle_count() {
  const char* full = std::getenv("KAAMOS_FULL");
  return full != nullptr && std::string_view(full) == "1" ? 100000 : 2000;
}

// With random z and w.
inline void add_random_triangles(Scene& scene, TriangleKind kind, uint32_t count,
                                 std::mt19937& random) {
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  const auto width = static_cast<float>(scene.width);
  const auto height = static_cast<float>(scene.height);
  for (uint32_t i = 0; i < count; ++i) {
    const float x = between(-20, width + 20);
    const float y = between(-20, height + 20);
    const float along_x = between(-150, 150);
    const float along_y = between(-150, 150);
    for (int corner = 0; corner < 3; ++corner) {
      float px = x;
      float py = y;
      switch (kind) {
        case TriangleKind::kSmall:
          px += between(-4, 4);
          py += between(-4, 4);
          break;
        case TriangleKind::kMedium:
          px += between(-80, 80);
          py += between(-80, 80);
          break;
        case TriangleKind::kHuge:
          px += between(-7000, 7000);
          py += between(-7000, 7000);
          break;
        case TriangleKind::kSliver: {
          const float t = static_cast<float>(corner) * 0.5f;
          px += along_x * t + between(-0.6f, 0.6f);
          py += along_y * t + between(-0.6f, 0.6f);
          break;
        }
        case TriangleKind::kCenters:
          px = static_cast<float>(static_cast<int>(x + between(-20, 20))) + 0.5f;
          py = static_cast<float>(static_cast<int>(y + between(-20, 20))) + 0.5f;
          break;
      }
      const float w = between(0.5f, 20);
      scene.vertex((px / (width * 0.5f) - 1) * w, (1 - py / (height * 0.5f)) * w, between(0, 1) * w,
                   w);
    }
  }
}

struct Corners {
  float v[3][4];
};
inline Corners corners_of(const Scene& scene, uint32_t triangle) {
  Corners out;
  for (uint32_t corner = 0; corner < 3; ++corner) {
    for (uint32_t c = 0; c < 4; ++c) {
      out.v[corner][c] = scene.floats[(triangle * 3 + corner) * scene.columns + c];
    }
  }
  return out;
}

}  // namespace kaamos::raster::testing
