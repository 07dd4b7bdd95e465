// SPDX-License-Identifier: MIT
// FEATURE: compute casts to a base or to the same type are places, groupshared ones too
// EXPECT u32 0 1 2 3
// EXPECT u32 12 4 5
class Base {
  uint3 u;
  void set_y(uint value) { u.y = value; }
};
class Derived : Base {
  float weight;
};

groupshared Derived shared_item;
RWByteAddressBuffer results : register(u0);

void set_z(inout Base b, uint value) { b.u.z = value; }
void double_it(inout uint value) { value *= 2; }

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  shared_item.u.x = 1 + z;
  shared_item.set_y(2 + z);
  set_z((Base)shared_item, 3 + z);
  results.Store3(0, shared_item.u);
  Derived item = (Derived)0;
  uint value = 2 + z;
  double_it((uint)value);
  set_z((Base)item, 5 + z);
  results.Store2(12, uint2(value, item.u.z));
}
