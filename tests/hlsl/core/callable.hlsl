// SPDX-License-Identifier: MIT
// FEATURE: core callable
// EXPECT f32 0 7.5
// EXPECT u32 4 42
struct Data {
  float a;
  uint b;
};
[shader("callable")]
void Call(inout Data data) {
  data.a *= 3;
  data.b += 1;
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  Data data = {2.5, 41};
  CallShader(0, data);
  results.Store(0, asuint(data.a));
  results.Store(4, data.b);
}
