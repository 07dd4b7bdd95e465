// SPDX-License-Identifier: MIT
// FEATURE: core resource passed as function param
// EXPECT u32 0 303
ByteAddressBuffer a : register(t0);
StructuredBuffer<uint> b : register(t1);
uint read(ByteAddressBuffer bytes, StructuredBuffer<uint> words, uint index) {
  return bytes.Load(index * 4) * 100 + words[index];
}
void write(RWByteAddressBuffer target, uint value) {
  target.Store(0, value);
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  write(results, read(a, b, 3));
}
