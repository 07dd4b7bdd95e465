// SPDX-License-Identifier: MIT
// FEATURE: extended unbounded resource array as parameter
// EXPECT u32 0 4 4 10 11
ByteAddressBuffer first[] : register(t0, space1);
ByteAddressBuffer second[] : register(t0, space2);
RWByteAddressBuffer buffers[] : register(u0, space1);
RWByteAddressBuffer results : register(u0);

uint load(ByteAddressBuffer array[], uint index, uint word) {
  return array[NonUniformResourceIndex(index)].Load(4 * word);
}

uint through(uint word, ByteAddressBuffer array[], RWByteAddressBuffer written[], uint value) {
  written[word & 1].Store(0, value);
  return load(array, 1, word) + load(second, 2, 0);
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, through(4 + z, first, buffers, 10));
  results.Store(4, through(4 + z, second, buffers, 10));
  through(5, first, buffers, 11);
  results.Store2(8, uint2(buffers[0].Load(0), buffers[1].Load(0)));
}
