// SPDX-License-Identifier: MIT
// FEATURE: core enum operators
// EXPECT u32 0 5
// EXPECT u32 4 4
// EXPECT u32 8 0xFFFFFFFC
// EXPECT u32 12 7
// EXPECT u32 16 1
// EXPECT u32 20 6
// EXPECT u32 24 13
// EXPECT u32 28 5
// EXPECT u32 32 3
// EXPECT u32 36 1
// EXPECT f32 40 4294967295
// EXPECT f32 44 -3
// EXPECT u32 48 8
// EXPECT u32 52 0x80000000
// EXPECT f32 56 2147483648
// EXPECT u32 60 12
// EXPECT u32 64 1
// EXPECT u32 68 3
// EXPECT i32 72 -8
// EXPECT u32 76 2
RWByteAddressBuffer results : register(u0);

enum Flags { kNone, kA = 1, kB = 2, kC = 1 << 2, kAll = kA | kB | kC, kTop = 1u << 31 };
enum Signed { kMinus = -3, kPlus = 3 };
enum Wide : uint64_t { kBig = 0x100000001, kSmall = 2 };
enum Switch : bool { kOff, kOn };
enum class Mode : uint { kFirst = 4, kSecond = kFirst << 1, kBoth = kFirst | kSecond };

struct Material {
  enum Kind { kGlass = 3, kMetal };
  Kind kind;
};

Flags either(Flags a, Flags b) { return a | b; }
uint count(Flags flags) { return countbits(flags); }

static const Flags kStart = kA | kC;

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Flags flags = kA | kC;
  flags = (Flags)(flags + z);
  results.Store(0, flags);
  Flags changed = flags;
  changed &= ~kA;
  results.Store(4, changed);
  results.Store(8, ~(flags ^ kTop ^ kTop ^ kA ^ kB) ^ 5);
  const Flags list[2] = {kAll, kA | kB};
  results.Store(12, list[z]);
  results.Store(16, (flags & kA) != 0 ? 1 : 0);
  results.Store(20, either(kB, z == 0 ? kC : kNone));
  // Beside another number it is an int, and the other side decides everything else.
  results.Store(24, flags + 8);
  results.Store(28, uint2(kStart, z).x);
  results.Store(32, count(list[0]));
  results.Store(36, !flags ? 0 : 1);
  // As unsigned as its values.
  Flags all_bits = (Flags)(0xFFFFFFFF - z);
  results.Store(40, asuint((float)all_bits));
  results.Store(44, asuint((float)(Signed)(z - 3)));
  results.Store(48, 1 << (Signed)(kPlus + z));
  results.Store(52, kTop + z);
  results.Store(56, asuint(kTop + (float)z));
  results.Store(60, (uint)Mode::kBoth + z);
  // 64 bits are cut off next to an int.
  results.Store(64, kBig + (int)z);
  Material material = {(Material::Kind)(z + Material::kGlass)};
  results.Store(68, material.kind);
  results.Store(72, -(Signed)(kPlus + z) - 5);
  Switch state = kOn;
  if (state && kOn) results.Store(76, state + 1 + z);
}
