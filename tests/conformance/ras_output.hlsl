// SPDX-License-Identifier: MIT
// Shaders of the rules of outputs and blending.
#include "ras.hlsli"

struct Three {
  float4 a : SV_Target0;
  float4 b : SV_Target1;
  float4 c : SV_Target2;
};

[shader("pixel")]
Three ToThree() {
  Three result;
  result.a = tint;
  result.b = tint * 2.0;
  result.c = tint * 4.0;
  return result;
}

[shader("pixel")]
float2 TwoComponents() : SV_Target {
  return tint.xy;
}

[shader("pixel")]
int4 Signed() : SV_Target {
  return int4(tint);
}

[shader("pixel")]
uint4 Unsigned() : SV_Target {
  return uint4(tint);
}

// Read-only depth: what is tested against, and what was stored.
Texture2D<float> depth_texels : register(t1);

[shader("pixel")]
float4 BesideDepth(float4 position : SV_Position) : SV_Target {
  return float4(depth_texels.Load(int3(position.xy, 0)), position.z, 0.0, 1.0);
}
