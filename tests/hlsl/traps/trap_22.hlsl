// SPDX-License-Identifier: MIT
// TRAP: 22 payload access qualifiers are accepted
// OPTIONS: -T lib_6_7
// EXPECT u32 0 8
RaytracingAccelerationStructure scene : register(t0);
struct [raypayload] Payload {
  float a : read(caller) : write(caller, miss, closesthit);
  uint b : read(caller, anyhit) : write(caller, miss);
};
[shader("miss")]
void Miss(inout Payload payload) {
  payload.b = 4;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, sizeof(Payload));
}
