// SPDX-License-Identifier: MIT
// FEATURE: core intersection
// EXPECT u32 0 1
struct Attributes {
  float3 normal;
};
[shader("intersection")]
void Box() {
  Attributes attributes;
  attributes.normal = ObjectRayOrigin() + ObjectRayDirection() * RayTMin();
  if (!ReportHit(RayTCurrent() * 0.5, 3, attributes)) {
    ReportHit(RayTCurrent(), 4, attributes);
  }
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
