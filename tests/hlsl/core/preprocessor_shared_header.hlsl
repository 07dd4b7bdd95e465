// SPDX-License-Identifier: MIT
// FEATURE: core shared C++/HLSL header (__cplusplus / #ifdef HLSL)
// EXPECT u32 0 1
#ifdef __cplusplus
using uint = unsigned;
#else
#define SHARED 1
#endif
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, SHARED);
}
