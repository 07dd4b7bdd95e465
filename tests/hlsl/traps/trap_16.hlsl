// SPDX-License-Identifier: MIT
// TRAP: 16 ReportHit may not return
// EXPECT u32 0 1
struct Attributes {
  float2 uv;
};
bool report(float t, Attributes attributes) {
  return ReportHit(t, 0, attributes);
}
[shader("intersection")]
void Box() {
  Attributes attributes = {float2(0.5, 0.25)};
  for (uint i = 0; i < 3; ++i) {
    if (report(i, attributes) && RayTCurrent() < 1) {
      break;
    }
  }
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
