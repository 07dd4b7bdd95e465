// SPDX-License-Identifier: MIT
#include "first_use.hlsli"

RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(64, 1, 1)]
void Angles(uint3 id : SV_DispatchThreadID) {
  results.Store(4 * id.x, asuint(angle_of(id.x)));
}
