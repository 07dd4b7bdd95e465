// SPDX-License-Identifier: MIT
// Shows a texel of a block-compressed texture to a callable shader.

Texture2D<float4> blocks : register(t0);

struct Seen {
  float4 color;
};

[shader("callable")]
void Show(inout Seen seen) {
}

[shader("raygeneration")]
void ReadBlocks() {
  Seen seen;
  seen.color = blocks.Load(int3(DispatchRaysIndex().xy, 0));
  CallShader(0, seen);
}
