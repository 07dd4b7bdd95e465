// SPDX-License-Identifier: MIT
// SPDX-License-Identifier: MIT
// A member of a call's result, as a statement of its own.
struct Payload {
  uint4 numbers;
};
Payload make() { return (Payload)0; }
RWByteAddressBuffer results : register(u0);
[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  make().numbers;
  make().numbers.x && make().numbers.y;
  results.Store(0, 1);
}
