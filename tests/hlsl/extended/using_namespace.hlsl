// SPDX-License-Identifier: MIT
// FEATURE: extended using namespace
// EXPECT u32 0 8
namespace math {
uint twice(uint x) { return x * 2; }
}
using namespace math;
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, twice(z + 4));
}
