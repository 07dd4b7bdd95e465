// SPDX-License-Identifier: MIT
// FEATURE: core resource as local variable/alias
// EXPECT u32 0 5
// EXPECT u32 4 3
// DXC refuses the variable, because it has to know which resource it is when it compiles.
ByteAddressBuffer a : register(t0);
ByteAddressBuffer b[2] : register(t1);
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  ByteAddressBuffer chosen = a;
  if (z == 0) {
    chosen = b[1];
  }
  results.Store(0, chosen.Load(20));
  RWByteAddressBuffer out_buffer = results;
  out_buffer.Store(4, 3u);
}
