// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic DispatchRaysDimensions
// EXPECT u32 0 3
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, DispatchRaysDimensions().y + 2);
}
