// SPDX-License-Identifier: MIT
// Each ray generation shader writes one number: the square of its index.

RWStructuredBuffer<uint> squares : register(u0);

[shader("raygeneration")]
void Squares() {
  const uint i = DispatchRaysIndex().x;
  squares[i] = i * i;
}
