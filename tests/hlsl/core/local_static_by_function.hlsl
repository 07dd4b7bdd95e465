// SPDX-License-Identifier: MIT
// FEATURE: core local static variables whose value a function computes
// EXPECT f32 0 2
// EXPECT f32 4 12
// EXPECT f32 8 5
// EXPECT f32 12 6
RWByteAddressBuffer results : register(u0);

float weight(float x, float a) {
  float sum = 0;
  for (uint i = 0; i < 2; ++i) sum += a * x;
  return sum;
}

float2 weights(uint i) {
  static const float2 table[2] = {
      float2(weight(1, 1), weight(2, 1)),
      float2(weight(2, 2), weight(3, 2)),
  };
  return table[i];
}

float runs() {
  static float count = weight(2, 1);
  count += 1;
  return count;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, asuint(weights(z).x));
  results.Store(4, asuint(weights(1 + z).y));
  results.Store(8, asuint(runs()));
  results.Store(12, asuint(runs()));
}
