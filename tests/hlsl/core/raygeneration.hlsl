// SPDX-License-Identifier: MIT
// FEATURE: core raygeneration
// EXPECT u32 0 7
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, DispatchRaysIndex().x + 7);
}
