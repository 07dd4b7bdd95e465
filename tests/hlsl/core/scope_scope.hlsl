// SPDX-License-Identifier: MIT
// FEATURE: core scope ::
// EXPECT u32 0 3
// EXPECT u32 4 4
// EXPECT u32 8 40
// EXPECT u32 12 1
namespace outer {
namespace inner {
static const uint kValue = 3;
uint get() { return kValue + 1; }
}
uint get() { return inner::get() * 10; }
}
uint get() { return 1; }
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(outer::inner::kValue, outer::inner::get(), outer::get(), ::get()));
}
