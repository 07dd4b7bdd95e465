// SPDX-License-Identifier: MIT
// FEATURE: extended _Static_assert
// EXPECT u32 0 3
// EXPECT u32 4 12
#include "scene.hlsli"

#define CHECKED(condition) _Static_assert(condition, "a checked condition")

static const uint kRows = 3;
CHECKED(kRows < 4 && kRows != 0);
_Static_assert(sizeof(float3) == 12, "a vector "
                                     "of three floats");

namespace sizes {
_Static_assert(true, "in a namespace");
}

struct Row {
  CHECKED(kRows == 3);
  float3 values;
};

template <typename T, uint N>
uint bytes() {
  _Static_assert(N != 0, "in a template");
  return sizeof(T);
}

[shader("raygeneration")]
void Main() {
  const uint rows = 3;
  CHECKED(rows == kRows);
  for (uint i = 0; i < rows; ++i) {
    _Static_assert(1 == 1, "in a loop");
  }
  results.Store(0, rows);
  results.Store(4, bytes<Row, 2>());
}
