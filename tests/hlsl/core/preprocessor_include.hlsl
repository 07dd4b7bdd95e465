// SPDX-License-Identifier: MIT
// FEATURE: core #include
// EXPECT u32 0 43
#include "include_me.hlsli"
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, included(z + 1));
}
