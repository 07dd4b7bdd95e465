// SPDX-License-Identifier: MIT
// FEATURE: compute Interlocked operations on components of vectors and matrices
// groupshared: vector.y, row.y, row[i], element
// EXPECT u32 0 0 1 0 0
// EXPECT u32 16 0 0 0 7
// memory: the matrix is column-major, so its element 1,1 is the last word of four
// EXPECT u32 32 8 9 10 15
// EXPECT u32 48 16 17 18 21
// EXPECT u32 64 20 25 22 23
// casts to the same type: a texel
// EXPECT u32 80 3 3
RWByteAddressBuffer results : register(u0);
RWStructuredBuffer<uint2x2> matrices : register(u1);
RWStructuredBuffer<uint4> vectors : register(u2);
RWBuffer<uint> texels : register(u3);
groupshared row_major uint2x2 shared_matrix;
groupshared uint4 shared_vector;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  shared_matrix = z;
  shared_vector = z;
  InterlockedOr(shared_vector.y, 1);
  InterlockedOr(shared_matrix[1].y, 2);
  InterlockedOr(shared_matrix[1][1], 3);
  InterlockedOr(shared_matrix._m11, 4);
  results.Store4(0, shared_vector);
  results.Store4(16, uint4(shared_matrix[0], shared_matrix[1]));
  // 8 9 10 11
  InterlockedOr(matrices[2 + z]._m11, 4);
  results.Store4(32, uint4(matrices[2]._m00_m10, matrices[2]._m01_m11));
  // 16 17 18 19
  InterlockedAdd(matrices[4 + z][1].y, 1);
  InterlockedAdd(matrices[4 + z][1][1 + z], 1);
  results.Store4(48, uint4(matrices[4]._m00_m10, matrices[4]._m01_m11));
  InterlockedAdd(vectors[5 + z].wzyx.z, 4);
  results.Store4(64, vectors[5]);
  uint before;
  InterlockedOr((uint)texels[3 + z], 1, before);
  results.Store2(80, uint2(before, texels[3]));
}
