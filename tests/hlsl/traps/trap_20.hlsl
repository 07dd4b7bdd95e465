// SPDX-License-Identifier: MIT
// TRAP: 20 system values in helpers
// EXPECT u32 0 1
// EXPECT u32 4 1
// EXPECT u32 8 2
static uint invocation_count = 1;
uint next() {
  return invocation_count++ + DispatchRaysIndex().x;
}
uint shared_by_stages(bool hit) {
  return hit ? 1 : next();
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store3(0, uint3(shared_by_stages(false), shared_by_stages(true), shared_by_stages(false)));
}
