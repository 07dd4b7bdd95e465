// SPDX-License-Identifier: MIT
// FEATURE: core constants behind global structs that hold resources
// Each value is the number of its word in $Globals.
// EXPECT u32 0 0 1 4 5
// EXPECT u32 16 8 12 16 20 21
// EXPECT u32 36 24 28 32 33
// EXPECT u32 52 36 40 44 48 52
RWByteAddressBuffer results : register(u0);

struct None {};
struct Resources {
  ByteAddressBuffer bytes;
  Buffer<float4> texels;
};
struct Mixed {
  ByteAddressBuffer bytes;
  uint word;
};
struct Ended {
  uint word;
  Resources resources;  // begins a row that it does not fill
};
struct Listed {
  uint word;
  ByteAddressBuffer bytes[2];  // likewise
  uint behind;
};
struct Hollow {
  uint word;
  None none;
  uint behind;
};
struct Tail {
  uint word;
  None none;
};

uint first;           // 0
Resources resources;  // nothing
uint second;          // 1
Mixed mixed;          // 4
uint third;           // 5
Ended ended;          // 8 to 11
uint fourth;          // 12
Listed listed;        // 16, 20
uint fifth;           // 21
Ended list[2];        // 24, 28
uint sixth;           // 32
None none;            // nothing
uint seventh;         // 33
Hollow hollow;        // 36, 40
Tail tail;            // 44
uint eighth;          // 48
row_major float1x2 pair;    // 49, 50
Ended last;           // 52

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store4(0, uint4(first, second, mixed.word, third));
  results.Store4(16, uint4(ended.word, fourth, listed.word, listed.behind));
  results.Store(32, fifth);
  results.Store4(36, uint4(list[0].word, list[1].word, sixth, seventh));
  results.Store4(52, uint4(hollow.word, hollow.behind, tail.word, eighth));
  results.Store(68, last.word);
}
