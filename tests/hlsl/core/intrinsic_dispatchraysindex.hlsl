// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic DispatchRaysIndex
// EXPECT u32 0 3
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, DispatchRaysIndex().x + 3);
}
