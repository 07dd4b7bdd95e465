// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic ReportHit
// EXPECT u32 0 1
struct Attributes {
  uint id;
};
[shader("intersection")]
void Box() {
  Attributes attributes = {7};
  const bool accepted = ReportHit(1.0, 5, attributes);
  if (accepted) return;
  ReportHit(2.0, HIT_KIND_TRIANGLE_FRONT_FACE, attributes);
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  results.Store(0, 1);
}
