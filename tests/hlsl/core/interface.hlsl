// SPDX-License-Identifier: MIT
// FEATURE: core interface
// EXPECT u32 0 12
// EXPECT u32 4 25
// EXPECT u32 8 49
// EXPECT u32 12 5
interface Shape {
  uint area();
  void grow(uint by);
};
interface Named {
  uint name(uint first);
};
struct Base {
  uint id;
};
class Box : Shape, Named {
  uint width;
  uint height;
  uint area() { return width * height; }
  void grow(uint by) { width += by; }
  uint name(uint first) { return first + 1; }
};
// A base and interfaces, in any order. Interfaces have no place in memory.
struct Square : Shape, Base, Named {
  uint side;
  uint area() { return side * side; }
  void grow(uint by);
  uint name(uint first) { return first + id; }
};
void Square::grow(uint by) { side += by; }
template <typename T> uint grown(inout T shape, uint by) {
  shape.grow(by);
  return shape.area();
}
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Box box;
  box.width = 2 + z;
  box.height = 4;
  Square square;
  square.side = 5;
  square.id = 3;
  const uint before = square.area();
  results.Store3(0, uint3(grown(box, 1), before + z, grown(square, 2)));
  results.Store(12, square.name(1 + z) + box.name(0) * (sizeof(Square) / 8));
}
