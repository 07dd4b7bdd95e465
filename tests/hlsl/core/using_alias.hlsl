// SPDX-License-Identifier: MIT
// FEATURE: core using alias
// EXPECT f32 0 2.0
// EXPECT u32 4 5
using Color = float3;
template <typename T>
using Pair = vector<T, 2>;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Color c = {1, 2, 3};
  Pair<uint> p = uint2(4, 5) + z;
  results.Store(0, asuint(c.y));
  results.Store(4, p.y);
}
