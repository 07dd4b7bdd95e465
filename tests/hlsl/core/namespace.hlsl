// SPDX-License-Identifier: MIT
// FEATURE: core namespace
// EXPECT f32 0 9.0
// EXPECT f32 4 6.0
namespace math {
struct Box {
  float side;
  float area() { return side * side; }
};
float twice(float x) { return x * 2; }
}
namespace math {
float thrice(float x) { return twice(x) + x; }
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  math::Box box = {3};
  results.Store2(0, asuint(float2(box.area(), math::thrice(2))));
}
