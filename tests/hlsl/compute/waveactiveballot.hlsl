// SPDX-License-Identifier: MIT
// FEATURE: compute WaveActiveBallot
// EXPECT u32 0 5 0 0 0 5 0 0 0 5 0 0 0 5 0 0 0
// EXPECT u32 64 8 2 8 8
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(4, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);
  const uint v = (0x080B0205u >> (8 * i) & 255) + z;  // 5, 2, 11, 8
  results.Store4(16 * i, WaveActiveBallot((v & 1) != 0));
  if (i != 1) {
    results.Store(64 + 4 * i, WaveActiveBallot(v == 8).x);
  } else {
    results.Store(64 + 4 * i, WaveActiveBallot(true).x);
  }
}
