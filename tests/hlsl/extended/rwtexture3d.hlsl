// SPDX-License-Identifier: MIT
// FEATURE: extended RWTexture3D
// EXPECT u32 0 1
RWTexture3D<float> volume : register(u1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  if (z == 1) {
    volume[uint3(1, 2, 3)] = 4;
  }
  results.Store(0, 1);
}
