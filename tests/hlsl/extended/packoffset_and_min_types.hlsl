// SPDX-License-Identifier: MIT
// FEATURE: extended packoffset on some members, and members of min16 types
// Each value is the number of its word in the buffer.
// EXPECT u32 0 9 8 10 12
// EXPECT u32 16 16 20 24 25
RWByteAddressBuffer results : register(u0);

// What has no packoffset comes behind everything that has one.
cbuffer Constants : register(b0) {
  uint a;                    // c2.y
  uint b : packoffset(c2);
  uint c;                    // c2.z
  min16uint d;               // c3: no row holds min16 types and others
  uint e;                    // c4
  min16uint f[1];            // c5
  min16uint g;               // c6
  min16uint h;               // c6.y
};

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(a, b, c, d));
  results.Store4(16, uint4(e, f[0], g, h));
}
