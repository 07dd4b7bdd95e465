// What runs here is known: "//=" stands behind each line that has code, with the number of runs that
// come there, and in brackets the arms of its branch: of a statement, or of ?, & or |. [coverage_test.cpp]
#include <kaamos/test.hlsli>
#include "coverage_part.hlsli"
#pragma kaamos geometry wall triangles (-1,-1,0) (1,-1,0) (0,1,0)
#pragma kaamos instance wall at (0,0,5)

static const bool kNever = false;
RWByteAddressBuffer Log : register(u0);

struct Counter {
  uint value;
  void add(uint amount) {  //= 1
    value += amount;  //= 1
  }
  void clear() {  //= 0
    value = 0;  //= 0
  }
};

template <class T> T larger(T a, T b) {  //= 1
  if (a > b) {  //= 1 [1 1]
    return a;  //= 1
  }
  return b;  //= 1
}

template <class T> T unused(T a) {
  return a;
}

uint classify(uint x) {  //= 1
  uint covered;
  if (x > 2) {  //= 1 [1 0]
    covered = 10;  //= 1
  } else {
    covered = 20;  //= 0
  }
  if (x == 100)  //= 1 [0 1]
    covered = 30;  //= 0
  else if (x == 3)  //= 1 [1 0]
    covered += 1;  //= 1
  if (kNever) {  //= 1
    covered = 40;
  }
  switch (x) {  //= 1 [0 1 0]
    case 1:
    case 2:
      covered = 50;  //= 0
      break;  //= 0
    case 3:
      covered += 100;  //= 1
      break;  //= 1
  }
  switch (x) {  //= 1 [0 1]
    case 7:
      covered = 60;  //= 0
      break;  //= 0
    default:
      break;  //= 1
  }
  return covered;  //= 1
}

uint loops(uint count) {  //= 1
  uint sum = 0;  //= 1
  for (uint i = 0; i < count; ++i) {  //= 1 [1 1]
    if (i == 2) continue;  //= 1 [1 1]
    sum += i;  //= 1
  }
  while (sum > 1000) {  //= 1 [0 1]
    sum -= 1000;  //= 0
  }
  do {  //= 1 [0 1]
    ++sum;  //= 1
  } while (sum < 3);
  for (;;) {  //= 1
    if (sum > 5) break;  //= 1 [1 0]
    ++sum;  //= 0
  }
  [unroll] for (uint k = 0; k < 3; ++k) sum += k;  //= 1 [1 1]
  while (sum > 2000 && sum != 7) --sum;  //= 1 [0 1] &[0 1]
  return sum;  //= 1
}

uint never_called(uint x) {  //= 0
  if (x > 1) {  //= 0 [- -]
    return 1;  //= 0
  }
  for (uint i = 0; i < x; ++i) x += i;  //= 0 [- -]
  return 2;  //= 0
}

#define EITHER(a, b) ((a) ? (b) : 0)
uint choose(uint x, bool2 both) {  //= 1
  const uint picked = x > 3 ? x : 3;  //= 1 ?[1 1]
  const uint always = kNever ? 9 : 1;  //= 1
  const uint small = x < 100 ? 0 : 50;  //= 1 ?[1 0]
  const uint in_macro = EITHER(x > 1, 4);  //= 1
  const bool odd = x == 2 || picked == 5;  //= 1 |[1 1]
  const uint2 each = select(both, uint2(1, 2), uint2(0, 0));  //= 1
  return picked + always + small + in_macro + each.x + (odd && both.y ? 100 : 0);  //= 1 &[1 1] ?[1 1]
}

groupshared uint Shared[4];

[test] void Classifies() {  //= 1
  EXPECT_EQ(classify(3), 111);  //= 1
  EXPECT_EQ(loops(5), 12);  //= 1
  EXPECT_EQ(choose(2, true) + choose(7, bool2(true, false)), 122);  //= 1
  Counter counter = {1};  //= 1
  counter.add(2);  //= 1
  EXPECT_EQ(counter.value + larger(1, 2) + uint(larger(2.0, 1.0)) + from_include(1), 9);  //= 1
}

// A loop that is cut at its barriers.
[test] [numthreads(4, 1, 1)] void Reduces(uint i : SV_GroupIndex) {  //= 1
  Shared[i] = i;  //= 1
  for (uint step = 2; step > 0; step /= 2) {  //= 1 [1 1]
    GroupMemoryBarrierWithGroupSync();  //= 1
    if (i < step) Shared[i] += Shared[i + step];  //= 1 [1 1]
  }
  GroupMemoryBarrierWithGroupSync();  //= 1
  if (i == 0 && Shared[0] != 6) Log.Store(0, 1);  //= 1 [0 1] &[1 1]
}

struct Payload {
  uint value;
};
struct Attributes {
  float2 at;
};

[shader("miss")] void Miss(inout Payload payload) {  //= 1
  payload.value = 1;  //= 1
}
[shader("closesthit")] void Hit(inout Payload payload, Attributes attributes) {  //= 0
  payload.value = 2;  //= 0
}
[shader("anyhit")] void Any(inout Payload payload, Attributes attributes) {  //= 0
  if (attributes.at.x > 2) {  //= 0 [- -]
    IgnoreHit();  //= 0
  }
}
TriangleHitGroup Group = {"Any", "Hit"};

[test("raygeneration")] void Misses() {  //= 1
  RayDesc ray = {float3(50, 0, 0), 0, float3(0, 0, 1), 100};  //= 1
  Payload payload = {0};  //= 1
  TraceRay(TestScene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray, payload);  //= 1
  EXPECT_EQ(payload.value, 1);  //= 1
}
