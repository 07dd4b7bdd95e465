// SPDX-License-Identifier: MIT
// FEATURE: core intrinsic CallShader
// EXPECT u32 0 7
struct Data {
  uint values[3];
};
[shader("callable")]
void Call(inout Data data) {
  data.values[2] = data.values[0] + data.values[1];
}
RWByteAddressBuffer results : register(u0);

[shader("raygeneration")]
void Main() {
  Data data = {3, 4, 0};
  CallShader(0, data);
  results.Store(0, data.values[2]);
}
