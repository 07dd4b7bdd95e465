// SPDX-License-Identifier: MIT
// FEATURE: compute 64-bit integers in typed buffers and textures, and their Interlocked operations
// DISPATCH: 16 1 1
// loads: element i of a buffer is 2 i | (2 i + 1) << 32; a texel is x + 10 y + 1000 z | 1 << 32
// EXPECT u64 0 0x700000006 0x700000006 0x100000015 0x1000003F3
// stores
// EXPECT u64 32 0x123456789ABCDEF0 0xFFFFFFFF00000001
// EXPECT u64 48 0xFFFFFFFED5FA0E00
// EXPECT f64 56 1.5
// sums of all threads
// EXPECT u64 64 0x88100002040 0x80100001FC7 0x801000023F5 0x801000023C8
// operations, the value before each, then the last one
// EXPECT u64 96 0x100000021 0x100000020 0xFFFFFFFFFFFFFFFF 5 5 0x700000000
// signed ones: -7e9, -7e9, 8e9
// EXPECT u64 144 0xFFFFFFFE5EC47A00 0xFFFFFFFE5EC47A00 0x1DCD65000
// out of bounds, and views of another format: zero
// EXPECT u64 168 0 0 0
RWByteAddressBuffer results : register(u0);
Buffer<uint64_t> in_pairs : register(t1);
RWBuffer<uint64_t> sum_pairs : register(u1);
RWBuffer<int64_t> signed_pairs_signed : register(u2);
RWTexture2D<uint64_t> image_pairs : register(u3);
RWTexture2D<int64_t> image_pairs_signed : register(u4);
RWTexture1D<uint64_t> image_1d_pairs : register(u5);
RWTexture2DArray<uint64_t> image_array_pairs : register(u6);
RWTexture3D<uint64_t> image_3d_pairs : register(u7);
Texture2D<uint64_t> texture_pairs : register(t2);
RWBuffer<double> double_pairs : register(u8);
RWBuffer<uint64_t> other_uint : register(u9);
RWTexture2D<uint64_t> other_image_uint : register(u10);

void operations() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, in_pairs[3 + z]);
  results.Store(8, in_pairs.Load(3 + z));
  results.Store(16, texture_pairs[uint2(1, 2)]);
  results.Store(24, image_array_pairs[uint3(1, 1, 1)]);
  image_pairs[uint2(5, 5)] = 0x123456789ABCDEF0ull + z;
  results.Store(32, image_pairs[uint2(5, 5)]);
  sum_pairs[9] = 0xFFFFFFFF00000001ull;
  results.Store(40, sum_pairs[9]);
  signed_pairs_signed[2] = -5000000000ll - z;
  results.Store(48, signed_pairs_signed[2]);
  double_pairs[4] = 1.5L + z;
  results.Store(56, double_pairs[4]);

  uint64_t before;
  InterlockedXor(image_pairs[uint2(3, 3)], 1ull, before);
  results.Store(96, before);
  InterlockedMax(image_pairs[uint2(3, 3)], 0xFFFFFFFFFFFFFFFFull, before);
  results.Store(104, before);
  InterlockedExchange(image_pairs[uint2(3, 3)], 5ull, before);
  results.Store(112, before);
  InterlockedCompareExchange(image_pairs[uint2(3, 3)], 6ull, 7ull, before);
  results.Store(120, before);
  InterlockedCompareStore(image_pairs[uint2(3, 3)], 5ull, 0x7000000FFull);
  InterlockedAnd(image_pairs[uint2(3, 3)], 0x700000000ull);
  results.Store(128, 5ull);
  results.Store(136, image_pairs[uint2(3, 3)]);

  int64_t old;
  image_pairs_signed[uint2(0, 0)] = 1;
  InterlockedMin(image_pairs_signed[uint2(0, 0)], -7000000000ll);
  InterlockedMin(image_pairs_signed[uint2(0, 0)], 8000000000ll, old);
  results.Store(144, old);
  InterlockedMax(image_pairs_signed[uint2(0, 0)], 8000000000ll, old);
  results.Store(152, old);
  results.Store(160, image_pairs_signed[uint2(0, 0)]);

  InterlockedAdd(image_pairs[uint2(8, 0)], 1ull, before);
  results.Store(168, before);
  InterlockedAdd(other_uint[3], 1ull, before);
  results.Store(176, before);
  InterlockedAdd(other_image_uint[uint2(3, 3)], 1ull, before);
  results.Store(184, before);
}

[shader("compute")]
[numthreads(8, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  // 128 threads: 128 * 2^36 + 0 + 1 + .. + 127 above what was there before; the carries matter.
  const uint64_t part = (1ull << 36) + id.x;
  InterlockedAdd(sum_pairs[64], part);
  InterlockedAdd(image_1d_pairs[7], part);
  InterlockedAdd(image_array_pairs[uint3(7, 7, 1)], part);
  InterlockedAdd(image_3d_pairs[uint3(2, 3, 1)], part);
  if (id.x == 0) operations();
  DeviceMemoryBarrier();
  uint finished;
  results.InterlockedAdd(65000, 1u, finished);
  if (finished != 127) return;
  results.Store(64, sum_pairs[64]);
  results.Store(72, image_1d_pairs[7]);
  results.Store(80, image_array_pairs[uint3(7, 7, 1)]);
  results.Store(88, image_3d_pairs[uint3(2, 3, 1)]);
}
