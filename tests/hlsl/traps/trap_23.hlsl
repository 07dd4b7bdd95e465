// SPDX-License-Identifier: MIT
// TRAP: 23 methods, bases, templates, enums together
// EXPECT u32 0 60
// EXPECT u32 4 8
// EXPECT u32 8 8
// EXPECT u32 12 4
// EXPECT f32 16 2.5
namespace n {
enum class Kind : uint { kA = 3, kB };
template <typename T>
struct Base {
  T value;
  T get(T add = 1) { return value + add; }
};
struct Derived : Base<uint> {
  static const uint kScale = 10;
  uint get(float unused, uint add) { return Base<uint>::get(add) * kScale; }
  uint twice() {
    value *= 2;
    return this.value;
  }
};
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  n::Derived d;
  d.value = 4 + z;
  results.Store4(0, uint4(d.get(1.0, 2), d.twice(), d.value, (uint)n::Kind::kB));
  n::Base<float> f = {1.5};
  results.Store(16, asuint(f.get()));
}
