// SPDX-License-Identifier: MIT
// FEATURE: compute SV_DispatchThreadID
// EXPECT u32 0 0
// EXPECT u32 4 1
// EXPECT u32 8 2
// EXPECT u32 12 3
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(2, 2, 1)]
void main(uint2 id : SV_DispatchThreadID) {
  results.Store((id.y * 2 + id.x) * 4, id.y * 2 + id.x);
}
