// SPDX-License-Identifier: MIT
// FEATURE: extended explicit instantiation
// EXPECT u32 0 34 7
// EXPECT f32 8 2.5
RWByteAddressBuffer results : register(u0);

template <uint N>
uint twice(uint value) {
  return N * 2 + value;
}
template uint twice<17>(uint value);

template <typename T>
T plus_one(T value) {
  return value + 1;
}
template float plus_one(float value);

template <typename T>
struct Box {
  T value;
  T get() { return value; }
};
template struct Box<uint>;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Box<uint> box = {7 + z};
  results.Store2(0, uint2(twice<17>(z), box.get()));
  results.Store(8, asuint(plus_one(1.5f + z)));
}
