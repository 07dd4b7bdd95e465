// SPDX-License-Identifier: MIT
// FEATURE: core string literal (non-attr)
// EXPECT u32 0 1
LocalRootSignature local_root = {"RootFlags(LOCAL_ROOT_SIGNATURE), " "CBV(b0)"};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, 1);
}
