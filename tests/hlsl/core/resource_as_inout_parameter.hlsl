// SPDX-License-Identifier: MIT
// FEATURE: core resources as inout parameters
// EXPECT u32 0 5
// EXPECT u32 4 6
// EXPECT u32 8 11
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<uint> counters : register(u1);

void put(uint offset, uint value, inout RWByteAddressBuffer target) {
  target.Store(offset, value);
}

void put_twice(uint value, inout RWByteAddressBuffer target) {
  put(0, value, target);
  put(4, value + 1, target);
}

void count(inout RWStructuredBuffer<uint> target, uint amount) {
  target[0] = amount;
  target[0] += 1;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  put_twice(5, results);
  count(counters, 10);
  results.Store(8, counters[0]);
}
