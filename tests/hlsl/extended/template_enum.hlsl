// SPDX-License-Identifier: MIT
// FEATURE: extended enum and RayQuery template arguments
// EXPECT u32 0 3
// EXPECT u32 4 1
// EXPECT u32 8 6
// EXPECT u32 12 24
// EXPECT u32 16 7
// EXPECT u32 20 2
// EXPECT u32 24 513
// EXPECT u32 28 5
RWByteAddressBuffer results : register(u0);

enum Flags { kNone, kA, kB, kC = 4 };
enum class Mode { kFast, kExact };

template <Flags F>
struct Features {
  static uint mask() { return F; }
  bool has(Flags flag) { return (F & flag) != 0; }
};

template <Flags F = kB | kC>
uint defaulted() {
  return F;
}

template <Mode M>
uint steps() {
  return M == Mode::kExact ? 24 : 8;
}

template <typename T, Flags F>
T first(Features<F> features, T value) {
  return value + F;
}

struct Tools {
  template <Flags F>
  uint get(uint value) {
    return value + F;
  }
};

template <uint F>
uint flags_of(RayQuery<F> query) {
  return F;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, Features<kA | kB>::mask() + z);
  Features<kC> features;
  results.Store(4, features.has((Flags)(z + 4)) ? 1 : 0);
  results.Store(8, defaulted() + z);
  results.Store(12, steps<Mode::kExact>() + z);
  results.Store(16, first(features, 3u + z));
  Tools tools;
  results.Store(20, tools.get<kA | kNone>(1 + z));
  RayQuery<RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES | RAY_FLAG_FORCE_OPAQUE> query;
  results.Store(24, flags_of(query) + z);
  results.Store(28, tools.get < kC > (1 + z));
}
