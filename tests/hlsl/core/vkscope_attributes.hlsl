// SPDX-License-Identifier: MIT
// FEATURE: core [[vk::...]] attributes
// EXPECT u32 0 4
[[vk::binding(3, 1)]] StructuredBuffer<uint> a : register(t0);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  [[vk::whatever]] uint x = a[4];
  results.Store(0, x);
}
