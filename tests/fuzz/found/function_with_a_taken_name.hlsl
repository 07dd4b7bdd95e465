// SPDX-License-Identifier: MIT
// --strict lowered the function, whose signature was never resolved.
static uint taken;
uint taken(uint x) { return x; }
[shader("compute")] [numthreads(1, 1, 1)] void main() {}
