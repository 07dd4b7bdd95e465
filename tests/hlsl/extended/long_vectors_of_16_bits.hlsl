// SPDX-License-Identifier: MIT
// FEATURE: extended long vectors of 16-bit types
// OPTIONS: -enable-16bit-types -T lib_6_9
// EXPECT u32 0 1 0 2 0 3 0
// EXPECT u32 24 1000 65535 32767
// EXPECT f32 36 0.333251953125 2.666015625
// EXPECT u32 44 10 14
// EXPECT u32 52 65537 131073 3
// EXPECT u32 64 0 16384
RWByteAddressBuffer results : register(u0);
ByteAddressBuffer words : register(t1);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  // Halfword 2 i of the buffer is i; components are two bytes apart.
  const vector<uint16_t, 6> loaded = words.Load<vector<uint16_t, 6> >(4 + z);
  for (uint i = 0; i < 6; ++i) results.Store(4 * i, loaded[i]);
  const vector<uint16_t, 6> less = loaded - (uint16_t)(1 + z);
  const vector<int16_t, 6> most = (vector<int16_t, 6>)less;
  results.Store3(24, uint3(less[0] + 1000, less[1], (uint16_t)most[1] >> 1));

  vector<float16_t, 8> third = (float16_t)(1.0 + z);
  third /= (vector<float16_t, 8>)3;
  results.Store2(36, asuint(float2(third[7], (float)(third * (float16_t)8)[0])));
  results.Store2(44, uint2(sizeof(vector<half, 5>), sizeof(vector<int16_t, 7>)));

  // Stored without gaps.
  results.Store(52, vector<uint16_t, 5>(1, 1, 1, 2, 3));
  results.Store2(64, uint2(isnan(third)[3], asuint16(third + third + third + (float16_t)1)[2]));
}
