// SPDX-License-Identifier: MIT
// FEATURE: core struct
// EXPECT f32 0 1.0
// EXPECT f32 4 5.0
// EXPECT u32 8 4
// EXPECT u32 12 5
struct Inner {
  float2 a;
};
struct Outer {
  Inner inner[2];
  uint b;
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Outer o;
  o.inner[0].a = float2(1, 2) + z;
  o.inner[1] = o.inner[0];
  o.inner[1].a.y += 3;
  o.b = 4;
  Outer p = o;
  p.b++;
  results.Store2(0, asuint(p.inner[1].a));
  results.Store2(8, uint2(o.b, p.b));
}
