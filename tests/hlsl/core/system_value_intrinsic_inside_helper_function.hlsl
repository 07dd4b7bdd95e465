// SPDX-License-Identifier: MIT
// FEATURE: core system-value intrinsic inside helper function
// EXPECT u32 0 1
uint linear_index() {
  return DispatchRaysIndex().y * DispatchRaysDimensions().x + DispatchRaysIndex().x;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, linear_index() + DispatchRaysDimensions().z);
}
