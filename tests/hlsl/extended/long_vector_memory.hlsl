// SPDX-License-Identifier: MIT
// FEATURE: extended long vectors in buffers and groupshared memory
// OPTIONS: -T lib_6_9
// EXPECT u32 0 12 13 14 15 16 17
// EXPECT u32 24 31 32 33 34 0
// EXPECT u32 44 61 65 100
// EXPECT u32 56 24 31 255
// EXPECT u32 68 5 7 9 0 0
// EXPECT u64 88 8589934592 25769803780 42949672968
// EXPECT u32 112 1 0 1
// EXPECT u32 124 20
// EXPECT u32 128 10 20 30 40 50 60
// EXPECT u32 160 24
RWByteAddressBuffer results : register(u0);
ByteAddressBuffer words : register(t1);
StructuredBuffer<vector<uint, 6> > six : register(t2);
struct Mixed {
  uint head;
  vector<uint, 5> tail;
  float3 rest;
};
StructuredBuffer<Mixed> mixed : register(t3);
RWStructuredBuffer<vector<uint, 6> > written : register(u1);
RWByteAddressBuffer raw : register(u2);

groupshared vector<uint, 6> shared_one;
groupshared Mixed shared_many[2];

[shader("compute")]
[numthreads(6, 1, 1)]
void main(uint i : SV_GroupIndex) {
  const uint z = results.Load(65532);  // 0, known at run time only

  // A component of memory that all threads share; one writes the whole.
  if (i == 0) shared_many[1 - z].tail = 10;
  GroupMemoryBarrierWithGroupSync();
  shared_one[i] = (i + 1) * shared_many[1].tail[i % 5];
  GroupMemoryBarrierWithGroupSync();
  if (i != 0) return;
  results.Store(128, shared_one);

  // Word i of a buffer is i.
  results.Store(0, six[2 + z]);
  const Mixed m = mixed[3 + z];  // words 27 to 35
  results.Store(24, uint4(m.tail[3], m.tail[4], asuint(m.rest.x), asuint(m.rest.y)));
  results.Store(40, mixed[1000 + z].tail[2]);
  const vector<uint, 5> loaded = words.Load<vector<uint, 5> >(61 * 4 + z);
  const vector<uint, 100> far = words.Load<vector<uint, 100> >(4);
  results.Store3(44, uint3(loaded[0], loaded[4], far[99]));

  // Written elements: one component, and the whole.
  written[1] = six[4];
  written[1][5] += 2;
  written[0][2] = 255;
  results.Store3(56, uint3(written[1 + z][0], written[1][5], written[0][2 + z]));

  // Past the end of a buffer of 1,024 bytes.
  const vector<uint, 5> part = {5, 7, 9, 11, 13};
  raw.Store(1012 + z, part);
  results.Store(68, raw.Load<vector<uint, 5> >(1012));

  // Pairs of words; bools take four bytes each, and a stride is that of the components.
  const vector<uint64_t, 6> pairs = words.Load<vector<uint64_t, 6> >(z);
  const vector<uint64_t, 6> doubled = pairs + pairs;
  for (uint k = 0; k < 3; ++k) results.Store<uint64_t>(88 + 8 * k, doubled[k]);
  const vector<bool, 5> bits = words.Load<vector<bool, 5> >(z);
  results.Store4(112, uint4(bits[1], bits[0], bits[4], sizeof(vector<float, 5>)));
  uint count, stride;
  six.GetDimensions(count, stride);
  results.Store(160, stride);
}
