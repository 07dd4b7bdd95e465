// SPDX-License-Identifier: MIT
// FEATURE: core members, variables and functions named like a struct or an enum
// EXPECT f32 0 5
// EXPECT f32 4 7
// EXPECT u32 8 12
// EXPECT u32 12 2
// EXPECT u32 16 40
// EXPECT u32 20 9
RWByteAddressBuffer results : register(u0);

struct Camera {
  float depth;
  float2 Camera;  // hides the struct's name in here only
  struct Camera twice() {
    struct Camera result = {depth * 2, Camera * 2};
    return result;
  }
};

// Up to the variable, the name means the struct.
float first(Camera camera) { return camera.Camera.x + camera.depth; }
static const Camera Camera = {2, float2(3, 5)};

enum Mode { kFast = 1, kExact = 2 };
static enum Mode Mode = kExact;

struct Counter {
  static const uint kLimit = 40;
  uint value;
};
uint Counter(uint value) {
  struct Counter counter = {value};
  return counter.value + 3;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  struct Camera camera = Camera;
  camera.depth += z;
  results.Store(0, asuint(first(camera)));
  results.Store(4, asuint(camera.twice().depth + Camera.Camera.x));
  results.Store(8, Counter(9 + z));
  enum Mode mode = Mode;
  results.Store(12, mode + z);
  results.Store(16, Counter::kLimit + z);
  struct Local {
    uint value;
  } Local = {9 + z};
  results.Store(20, Local.value);
}
