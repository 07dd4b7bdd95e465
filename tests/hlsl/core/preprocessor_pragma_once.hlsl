// SPDX-License-Identifier: MIT
// FEATURE: core #pragma once
// EXPECT u32 0 42
#include "include_me.hlsli"
#include "include_me.hlsli"
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  results.Store(0, included(0));
}
