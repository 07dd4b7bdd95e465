// SPDX-License-Identifier: MIT
// A library; the project names its export.
RWStructuredBuffer<uint> numbers : register(u0);

[shader("raygeneration")]
void NAME() {
  const uint i = DispatchRaysIndex().x;
  numbers[i] = i * i * i;
}
