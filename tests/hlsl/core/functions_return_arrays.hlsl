// SPDX-License-Identifier: MIT
// FEATURE: core functions that return arrays
// EXPECT u32 0 3 4 5
// EXPECT f32 12 1 2 3 4
// EXPECT u32 28 7 6
RWByteAddressBuffer results : register(u0);

uint counts(uint first)[3];

struct Box {
  float2 low, high;
  float2 corners()[2] {
    float2 result[2] = {low, high};
    return result;
  }
};
typedef uint Pair[2];
Pair swapped(Pair pair) {
  Pair result = {pair[1], pair[0]};
  return result;
}
template <typename T>
T repeated(T value)[2][2] {
  T result[2][2] = {value, value + 1, value + 2, value + 3};
  return result;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  uint all[3] = counts(3 + z);
  results.Store3(0, uint3(all[0], counts(3 + z)[1 + z], all[2]));
  Box box = {float2(1 + z, 2), float2(3, 4)};
  const float2 corners[2] = box.corners();
  results.Store4(12, asuint(float4(corners[0], corners[1])));
  Pair pair = {6, repeated(4 + z)[1][1]};
  results.Store<Pair>(28, swapped(pair));
}

uint counts(uint first)[3] {
  uint result[3];
  for (uint i = 0; i < 3; ++i) result[i] = first + i;
  return result;
}
