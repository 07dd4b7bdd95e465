// SPDX-License-Identifier: MIT
// TRAP: 18 callable data of several types
// EXPECT u32 0 12
// EXPECT u32 4 40
// EXPECT f32 8 2.5
// EXPECT f32 12 3
// EXPECT u32 16 6
#include "scene.hlsli"

struct Words {
  uint x;
  uint y;
};
struct Floats {
  float3 v;
  bool flag;
};
[shader("callable")]
void Call0(inout Words words) {
  words.x = words.x * 2;
  Floats inner = {float3(1, 2, 3) * words.y, true};
  CallShader(1, inner);
  words.y = inner.flag ? 1 : (uint)inner.v.z;
}
[shader("callable")]
void Call1(inout Floats data) {
  data.v += 0.5 * DispatchRaysDimensions().x;
  data.v.z += 9.5;
  data.flag = !data.flag;
}

[shader("raygeneration")]
void Main() {
  Words words = {6, 10};
  Floats floats = {float3(2, 0, 2.5), false};
  CallShader(0, words);
  results.Store2(0, uint2(words.x, words.y));
  CallShader(1, floats);
  results.Store(8, asuint(floats.v.x));
  results.Store(12, asuint(floats.flag ? 3.0 : 0.0));
  words.x = 3;
  CallShader(words.x - 3, words);
  results.Store(16, words.x);
}
