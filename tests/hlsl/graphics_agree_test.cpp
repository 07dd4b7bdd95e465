// SPDX-License-Identifier: MIT
//
// A pixel shader in which lanes part and meet in every way gives the same bits one lane after
// another, 8 at once and interpreted.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "executors.h"
#include "graphics_runner.h"

namespace kaamos::test {
namespace {

using Lanes = GraphicsRunner::Lanes;

constexpr char kShader[] = R"(
Texture2D<float> t : register(t0);
SamplerState s : register(s0);
RWByteAddressBuffer r : register(u0);
struct Base { float4 p : SV_Position; };
struct V : Base {
  struct { float2 uv : UV; centroid float3 n : NORMAL; } in_;
  float f[3] : F;
  nointerpolation uint id : ID;
  float twice() { return f[1] * 2; }
};
static float h() { return ddx(3.0) + 1; }
static float start = h();
struct O { float4 c[2] : SV_Target1; float d : SV_Depth; };
bool odd(uint2 p) { return (p.x ^ p.y) & 1; }
void kill(uint2 p, float f) {
  if (f > 0.5 && odd(p)) { r.InterlockedAdd(0, 1); discard; }
  r.InterlockedAdd(4, p.x);
}
float fade(float x) {
  if (x < 0.25) return ddx_fine(x);
  return ddy(x * x) + t.Sample(s, x);
}
O main(in V v) {
  O o = (O)0;
  kill(uint2(v.p.xy), v.f[0]);
  for (int i = 0; i < 3; ++i) {
    if (v.f[i] < 0) continue;
    o.c[0] += t.Sample(s, v.in_.uv * v.f[i]) + ddx_fine(o.c[0].x + v.f[i]);
    if (v.f[i] > 0.75) break;
  }
  switch (uint(v.p.x) + v.id & 3) {
    case 0:
      o.c[1] = t.SampleBias(s, v.in_.n.xy, v.f[2]);
      break;
    case 1:
      if (v.f[1] > 0) discard;
      o.c[1].x = fwidth(v.f[1] * o.c[0].y);
    default:
      o.c[1].yzw = v.twice() + start + fade(v.f[2]);
  }
  while (ddx_fine(o.d * v.f[1]) < 1 && o.d < 3 * v.f[0]) o.d += 0.5;
  clip(v.f[1] + 0.75);
  r.InterlockedAdd(8, v.id);
  return o;
}
)";

struct Result {
  std::vector<Lanes> outputs;
  std::vector<uint32_t> memory;
  uint32_t live;
};

Result run(const shader::LibraryDesc& library, uint32_t seed) {
  GraphicsRunner runner(library, "main");
  const auto next = [&] {
    seed = seed * 1664525 + 1013904223;
    return seed >> 8;
  };
  for (Lanes& lanes : runner.inputs) {
    for (uint32_t& bits : lanes) {
      bits = std::bit_cast<uint32_t>(static_cast<float>(next() % 64) / 32 - 1);
    }
  }
  runner.set_position();
  runner.in("ID", 0).fill(next() % 4);
  runner.active = next() % 4 == 0 ? 0x0F : 0xFF;
  runner.live = next() & runner.active;
  std::vector<float> texels(64 + 16 + 4 + 1);
  for (float& texel : texels) texel = static_cast<float>(next() % 256) / 16;
  runner.texture.format = 41;  // R32_FLOAT
  runner.texture.mip_count = 4;
  size_t first = 0;
  for (uint32_t mip = 0; mip < 4; ++mip) {
    const uint32_t size = 8u >> mip;
    runner.texture.mips[mip] = {reinterpret_cast<uint8_t*>(texels.data() + first),
                                size,
                                size,
                                1,
                                size * 4,
                                size * size * 4};
    first += size_t{size} * size;
  }
  runner.run();
  // Values there from lanes that did not run to the end do not count.
  for (Lanes& lanes : runner.outputs) {
    for (uint32_t lane = 0; lane < 8; ++lane) {
      if ((runner.live >> lane & 1u) == 0) lanes[lane] = 0;
    }
  }
  return {runner.outputs, runner.memory, runner.live};
}

TEST(GraphicsAgree, EveryWayGivesTheSameBits) {
  hlsl::FrontendOptions options;
  options.path = "agree.hlsl";
  options.text = kShader;
  options.target = "ps_6_6";
  options.entry_point = "main";
  const Compiled native = compile_native({options}, hlsl::WideThreads::kNever)[0];
  const Compiled wide = compile_native({options}, hlsl::WideThreads::kAlways)[0];
  const Compiled interpreted = compile_interpreted(options);
  ASSERT_NE(native.library, nullptr) << native.error;
  ASSERT_NE(wide.library, nullptr) << wide.error;
  ASSERT_NE(interpreted.library, nullptr) << interpreted.error;
  EXPECT_NE(native.library->exports[0].graphics->pixel_thread, nullptr);
  EXPECT_NE(wide.library->exports[0].graphics->pixel, nullptr);
  uint32_t lived = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    const Result expected = run(*native.library, seed);
    lived += static_cast<uint32_t>(__builtin_popcount(expected.live));
    for (const Compiled* other : {&wide, &interpreted}) {
      const Result result = run(*other->library, seed);
      ASSERT_EQ(result.live, expected.live) << seed;
      ASSERT_EQ(result.outputs, expected.outputs) << seed << (other == &wide ? " wide" : "");
      ASSERT_EQ(result.memory, expected.memory) << seed;
    }
  }
  EXPECT_GT(lived, 300u);
}

}  // namespace
}  // namespace kaamos::test
