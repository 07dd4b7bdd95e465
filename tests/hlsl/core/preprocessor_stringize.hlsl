// SPDX-License-Identifier: MIT
// FEATURE: core # stringize
// EXPECT u32 0 1
#define TEXT(x) #x
LocalRootSignature local_root = {TEXT(CBV(b0))};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 1);
}
