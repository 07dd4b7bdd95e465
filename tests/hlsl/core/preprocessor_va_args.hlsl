// SPDX-License-Identifier: MIT
// FEATURE: core __VA_ARGS__
// EXPECT u32 0 7
#define CALL(f, ...) f(__VA_ARGS__)
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, CALL(max, 3u, 7u));
}
