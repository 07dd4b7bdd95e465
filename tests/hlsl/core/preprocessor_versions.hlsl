// SPDX-License-Identifier: MIT
// FEATURE: core __HLSL_VERSION/__SHADER_* / __spirv__
// EXPECT u32 0 1
// EXPECT u32 4 6
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  #if __HLSL_VERSION >= 2021 && __SHADER_TARGET_MAJOR == 6 && !defined(__spirv__) && defined(__hlsl_dx_compiler)
  results.Store(0, 1);
  #endif
  results.Store(4, __SHADER_TARGET_MINOR);
}
