// SPDX-License-Identifier: MIT
//
// Vertex and pixel shaders on 8 lanes, without a rasteriser: one by one, 8 at once, interpreted.
// Numbers as RAS-82 stand in the list of rasterisation rules.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>

#include "executors.h"
#include "graphics_runner.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::test {
namespace {

using Floats = std::array<float, 8>;
using Lanes = GraphicsRunner::Lanes;

struct Case {
  const char* name;
  const char* target;
  const char* source;
  void (*check)(GraphicsRunner& run);
  bool native_16bit = false;
};

Floats all(float value) {
  Floats out;
  out.fill(value);
  return out;
}
Lanes all_bits(uint32_t value) {
  Lanes out;
  out.fill(value);
  return out;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

const std::vector<Case>& cases() {
  static const std::vector<Case> list = {
      {"VertexSignature", "vs_6_6", R"(
struct In { float3 p : POSITION; min16uint n : NUMBER; bool b : FLAG; float4x3 m : MATRIX; };
struct Out {
  float4 p : SV_Position; nointerpolation int id : ID; float2 uv[2] : UV3; row_major float2x3 m : M;
  bool b : FLAG;
};
Out main(In i, int id : SV_VertexID, uint instance : sv_instanceid, out float depth : DEPTH,
         inout float twice : TWICE) {
  Out o;
  o.p = float4(i.p, i.n);
  o.id = id - 8;
  o.uv[0] = i.m[0].xy;
  o.uv[1] = float2(i.m[3].z, instance);
  o.m = float2x3(1, 2, 3, 4, 5, 6) * i.p.x;
  o.b = !i.b;
  depth = i.p.z + 1;
  twice *= 2;
  return o;
})",
       [](GraphicsRunner& run) {
         const shader::GraphicsDesc& g = run.graphics();
         // A matrix that is not row_major is passed by columns.
         EXPECT_EQ(g.input_count, 9u);
         EXPECT_EQ(g.input_columns, 3u + 1 + 1 + 12 + 1 + 1 + 1);
         EXPECT_EQ(g.output_count, 9u);
         EXPECT_EQ(g.outputs[0].system_value, shader::SystemValue::kPosition);
         EXPECT_EQ(g.outputs[1].interpolation, shader::Interpolation::kNoInterpolation);
         EXPECT_EQ(g.outputs[1].type, shader::ColumnType::kInt);
         EXPECT_EQ(g.outputs[3].semantic_index, 4u);
         EXPECT_EQ(g.flags, 0u);
         EXPECT_NE(g.vertex, nullptr);
         run.set("POSITION", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.set("POSITION", 0, 2, all(0.5f));
         run.in("NUMBER", 0) = all_bits(60000);
         run.in("FLAG", 0) = {0, 1, 2, 0, 0, 0, 0, 0};
         run.in("SV_VertexID", 0) = {0, 1, 2, 3, 4, 5, 6, 7};
         run.in("sv_instanceid", 0) = all_bits(9);
         run.set("MATRIX", 0, 0, all(10));
         run.set("MATRIX", 1, 0, all(11));
         run.set("MATRIX", 2, 3, all(12));
         run.set("TWICE", 0, 0, {1, 2, 3, 4, 5, 6, 7, 8});
         run.active = 0x7F;
         run.run();
         const Floats x = run.floats("SV_Position", 0, 0);
         for (int i = 0; i < 7; ++i) {
           const auto f = static_cast<float>(i);
           const auto at = static_cast<size_t>(i);
           EXPECT_EQ(x[at], f);
           EXPECT_EQ(run.floats("SV_Position", 0, 3)[at], 60000.0f);
           EXPECT_EQ(run.out("ID", 0)[at], static_cast<uint32_t>(i - 8));
           EXPECT_EQ(run.floats("UV", 3, 0)[at], 10.0f);
           EXPECT_EQ(run.floats("UV", 3, 1)[at], 11.0f);
           EXPECT_EQ(run.floats("UV", 4, 0)[at], 12.0f);
           EXPECT_EQ(run.floats("UV", 4, 1)[at], 9.0f);
           EXPECT_EQ(run.floats("M", 0, 2)[at], 3 * f);
           EXPECT_EQ(run.floats("M", 1, 0)[at], 4 * f);
           EXPECT_EQ(run.out("FLAG", 0)[at], i == 1 || i == 2 ? 0u : 1u);
           EXPECT_EQ(run.floats("DEPTH", 0)[at], 1.5f);
           EXPECT_EQ(run.floats("TWICE", 0)[at], 2 * (f + 1));
         }
       }},
      // Each vertex is a wave of its own.
      {"WavesOfVertices", "vs_6_6", R"(
float4 main(uint id : SV_VertexID, out uint4 a : A, out uint4 b : B) : SV_Position {
  a = uint4(WaveGetLaneCount(), WaveGetLaneIndex(), WaveActiveSum(id), WavePrefixSum(id));
  b = uint4(WaveIsFirstLane(), WaveReadLaneAt(id, 3), WaveMatch(id).x, WaveActiveBallot(id > 1).x);
  return WavePrefixProduct(2.0) + WaveReadLaneFirst(float(id));
})",
       [](GraphicsRunner& run) {
         const Lanes ids = {0, 1, 2, 3, 4, 5, 6, 7};
         run.in("SV_VertexID", 0) = ids;
         run.run();
         EXPECT_EQ(run.out("A", 0, 0), all_bits(1));
         EXPECT_EQ(run.out("A", 0, 1), all_bits(0));
         EXPECT_EQ(run.out("A", 0, 2), ids);
         EXPECT_EQ(run.out("A", 0, 3), all_bits(0));
         EXPECT_EQ(run.out("B", 0, 0), all_bits(1));
         EXPECT_EQ(run.out("B", 0, 1), ids);
         EXPECT_EQ(run.out("B", 0, 2), all_bits(1));
         EXPECT_EQ(run.out("B", 0, 3), (Lanes{0, 0, 1, 1, 1, 1, 1, 1}));
         EXPECT_EQ(run.floats("SV_Position", 0, 1), (Floats{1, 2, 3, 4, 5, 6, 7, 8}));
       }},
      // There is one view, so its number is no input.
      {"ViewOfVertex", "vs_6_6", R"(
float4 main(uint view : SV_ViewID, uint id : SV_VertexID) : SV_Position { return view + id; })",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().input_count, 1u);
         run.in("SV_VertexID", 0) = {0, 1, 2, 3, 4, 5, 6, 7};
         run.run();
         EXPECT_EQ(run.floats("SV_Position", 0, 1), (Floats{0, 1, 2, 3, 4, 5, 6, 7}));
       }},
      {"SampleViewAndRate", "ps_6_6", R"(
float4 main(float4 a : A, uint sample : SV_SampleIndex, uint view : SV_ViewID,
            int rate : SV_ShadingRate) : SV_Target {
  return a + sample + 10 * view + 100 * rate;
})",
       [](GraphicsRunner& run) {
         EXPECT_NE(run.graphics().flags & shader::kGraphicsRunsPerSample, 0u);
         run.set("A", 0, 2, {0, 1, 2, 3, 4, 5, 6, 7});
         run.in("SV_SampleIndex", 0) = all_bits(3);
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 2), (Floats{3, 4, 5, 6, 7, 8, 9, 10}));
       }},
      {"HalfInputs", "vs_6_6", R"(
float4 main(half2 a : A, int16_t b : B, out uint16_t c : C) : SV_Position {
  c = uint16_t(b) + uint16_t(1);
  return float4(a, sizeof(a), b);
})",
       [](GraphicsRunner& run) {
         run.set("A", 0, 0, all(0.1f));
         run.in("B", 0) = all_bits(0xFFFFFFFF);
         run.run();
         EXPECT_EQ(run.floats("SV_Position", 0, 0), all(0x1.998p-4f));  // 0.1 as a half
         EXPECT_EQ(run.floats("SV_Position", 0, 2), all(4));
         EXPECT_EQ(run.floats("SV_Position", 0, 3), all(-1));
         EXPECT_EQ(run.out("C", 0), all_bits(0));
       },
       true},
      {"PixelOutputs", "ps_6_6", R"(
void main(float4 p : SV_Position, uint id : SV_PrimitiveID, bool front : SV_IsFrontFace,
          noperspective float3 b : SV_Barycentrics, out float4 color : SV_Target,
          out uint2 ids : SV_Target2, out float depth : SV_Depth) {
  color.x = p.w;
  if (front) color.y = b.z;
  ids = uint2(id, front);
  depth = p.z / 2;
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags, 0u);
         EXPECT_EQ(run.graphics().inputs[3].interpolation, shader::Interpolation::kNoPerspective);
         run.set("SV_Position", 0, 3, {1, 2, 3, 4, 5, 6, 7, 8});
         run.set("SV_Position", 0, 2, all(0.5f));
         run.set("SV_Barycentrics", 0, 2, all(0.75f));
         run.in("SV_PrimitiveID", 0) = all_bits(77);
         run.in("SV_IsFrontFace", 0) = all_bits(1);
         run.run();
         EXPECT_EQ(run.live, 0xFFu);
         EXPECT_EQ(run.floats("SV_Target", 0, 0), (Floats{1, 2, 3, 4, 5, 6, 7, 8}));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(0.75f));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(0)) << "RAS-111: not written";
         EXPECT_EQ(run.floats("SV_Target", 0, 3), all(0));
         EXPECT_EQ(run.out("SV_Target", 2, 0), all_bits(77));
         EXPECT_EQ(run.out("SV_Target", 2, 1), all_bits(1));
         EXPECT_EQ(run.floats("SV_Depth", 0), all(0.25f));
       }},
      // The depth that a shader gives is bounded by the pixel's own.
      {"DepthThatRises", "ps_6_6", R"(
float4 main(float a : A, out float depth : SV_DepthGreaterEqual) : SV_Target {
  depth = a;
  return a;
})",
       [](GraphicsRunner& run) {
         run.set("A", 0, 0, {0.25f, 0.5f, 0.75f, 1, -1, kNan, 0.4f, 0.6f});
         run.set("SV_Position", 0, 2, all(0.5f));
         run.run();
         EXPECT_EQ(run.floats("SV_DepthGreaterEqual", 0),
                   (Floats{0.5f, 0.5f, 0.75f, 1, 0.5f, 0.5f, 0.5f, 0.6f}));
         EXPECT_EQ(run.floats("SV_Target", 0, 0)[4], -1.0f);
       }},
      {"DepthThatFalls", "ps_6_6", R"(
struct Out { float depth : SV_DepthLessEqual; float4 color : SV_Target; };
Out main(float a : A, float4 p : SV_Position) {
  Out o;
  o.depth = a;
  o.color = p;
  return o;
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().input_count, 2u);
         run.set("A", 0, 0, {0.25f, 0.5f, 0.75f, 1, -1, 0.1f, 0.4f, 0.6f});
         run.set("SV_Position", 0, 2, all(0.5f));
         run.run();
         EXPECT_EQ(run.floats("SV_DepthLessEqual", 0),
                   (Floats{0.25f, 0.5f, 0.5f, 0.5f, -1, 0.1f, 0.4f, 0.5f}));
       }},
      // RAS-85, RAS-86
      {"DiscardEndsEffects", "ps_6_6", R"(
RWByteAddressBuffer r : register(u0);
float4 main(float x : X, float i : I) : SV_Target {
  uint before = 7, after = 7;
  r.InterlockedAdd(0, 1, before);
  if (x < 0) discard;
  r.InterlockedAdd(4, 1, after);
  r.Store(16 + 4 * uint(i), 1);
  return float4(before, after, x, 1);
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags,
                   uint32_t{shader::kGraphicsDiscards} | shader::kGraphicsWritesMemory);
         run.set("X", 0, 0, {1, -1, 1, -1, 1, 1, 1, 1});
         run.set("I", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.live = 0x3F;  // 6 and 7 are helpers
         run.run();
         EXPECT_EQ(run.live, 0x35u);
         EXPECT_EQ(run.memory[0], 6u);
         EXPECT_EQ(run.memory[1], 4u);
         const uint32_t stored[] = {1, 0, 1, 0, 1, 1, 0, 0};
         for (size_t i = 0; i < 8; ++i) EXPECT_EQ(run.memory[4 + i], stored[i]) << i;
       }},
      // The same while helpers run for a derivative.
      {"HelpersWriteNothing", "ps_6_6", R"(
RWByteAddressBuffer r : register(u0);
float4 main(float x : X) : SV_Target {
  uint old = 7;
  r.InterlockedAdd(0, 1, old);
  if (x == 1) discard;
  uint later = 7;
  r.InterlockedAdd(4, 1, later);
  return float4(ddx(x), ddy(x), old, later);
})",
       [](GraphicsRunner& run) {
         run.set("X", 0, 0, {0, 1, 10, 11, 0, 1, 10, 11});
         run.live = 0x2F;
         run.run();
         EXPECT_EQ(run.live, 0x0Du);
         EXPECT_EQ(run.memory[0], 5u);
         EXPECT_EQ(run.memory[1], 3u);
         EXPECT_EQ(run.floats("SV_Target", 0, 0), all(1));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(10));
         const Floats later = run.floats("SV_Target", 0, 3);
         EXPECT_EQ(later[1], 0.0f) << "discarded";
         EXPECT_EQ(later[4], 0.0f) << "a helper";
         EXPECT_EQ(run.floats("SV_Target", 0, 2)[4], 0.0f);
       }},
      // RAS-87
      {"Clip", "ps_6_6", R"(
float4 main(float2 x : X) : SV_Target { clip(x); return 1; })",
       [](GraphicsRunner& run) {
         run.set("X", 0, 0, {-0.0f, kNan, -1, 1, 0, 1, 1e-45f, -1e-45f});
         run.set("X", 0, 1, {0, 0, 0, 0, -1, 1, 1, 1});
         run.run();
         // The last one is denormal, which may count as 0.
         EXPECT_EQ(run.live & 0x7Fu, 0x6Bu);
       }},
      // RAS-82, RAS-83: f = x * y
      {"CoarseAndFine", "ps_6_6", R"(
void main(float4 p : SV_Position, out float4 a : SV_Target0, out float4 b : SV_Target1) {
  const float f = p.x * p.y;
  a = float4(ddx_fine(f), ddy_fine(f), ddx_coarse(f), ddy_coarse(f));
  b = float4(ddx(f), ddy(f), fwidth(f), 0);
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags, uint32_t{shader::kGraphicsReadsQuad});
         run.set_position();
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0),
                   (Floats{20.5f, 20.5f, 21.5f, 21.5f, 20.5f, 20.5f, 21.5f, 21.5f}));
         EXPECT_EQ(run.floats("SV_Target", 0, 1),
                   (Floats{10.5f, 11.5f, 10.5f, 11.5f, 12.5f, 13.5f, 12.5f, 13.5f}));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(20.5f));
         const Floats down = {10.5f, 10.5f, 10.5f, 10.5f, 12.5f, 12.5f, 12.5f, 12.5f};
         EXPECT_EQ(run.floats("SV_Target", 0, 3), down);
         EXPECT_EQ(run.floats("SV_Target", 1, 0), all(20.5f));
         EXPECT_EQ(run.floats("SV_Target", 1, 1), down);
         EXPECT_EQ(run.floats("SV_Target", 1, 2)[0], 31.0f);
       }},
      // RAS-86: a checkerboard
      {"DerivativeAfterDiscard", "ps_6_6", R"(
float4 main(float4 p : SV_Position) : SV_Target {
  if ((uint(p.x) + uint(p.y)) & 1) discard;
  return float4(ddx(p.x), ddy(p.y), ddx_fine(p.y), ddy_fine(p.x));
})",
       [](GraphicsRunner& run) {
         run.set_position();
         run.run();
         EXPECT_EQ(run.live, 0x99u);
         EXPECT_EQ(run.floats("SV_Target", 0, 0), all(1));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(1));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(0));
       }},
      {"DerivativesOfManyTypes", "ps_6_6", R"(
float slope(float2 at) { return ddx_fine(at).x + ddy_fine(at).y; }
float4 main(float4 p : SV_Position) : SV_Target {
  float2x2 m = {p.x, 2 * p.x, 3 * p.x, p.y};
  float total = 0;
  for (int i = 0; i < 3; ++i) total += slope(p.xy * i);
  const half h = p.x;
  return float4(ddx(m)[1][0], ddx(h), total, ddx(int(p.x) * 3));
})",
       [](GraphicsRunner& run) {
         run.set_position();
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0), all(3));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(1));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(6));
         EXPECT_EQ(run.floats("SV_Target", 0, 3), all(3));
       },
       true},
      {"QuadReads", "ps_6_7", R"(
uint4 main(uint4 v : V, float f : F) : SV_Target {
  const uint x = uint(f);
  return uint4(QuadReadAcrossX(x), QuadReadAcrossY(x), QuadReadLaneAt(x, 3), QuadAny(x == 6));
})",
       [](GraphicsRunner& run) {
         run.set("F", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.run();
         EXPECT_EQ(run.out("SV_Target", 0, 0), (Lanes{1, 0, 3, 2, 5, 4, 7, 6}));
         EXPECT_EQ(run.out("SV_Target", 0, 1), (Lanes{2, 3, 0, 1, 6, 7, 4, 5}));
         EXPECT_EQ(run.out("SV_Target", 0, 2), (Lanes{3, 3, 3, 3, 7, 7, 7, 7}));
         EXPECT_EQ(run.out("SV_Target", 0, 3), (Lanes{0, 0, 0, 0, 1, 1, 1, 1}));
       }},
      // RAS-91, RAS-95, RAS-96: mips that hold their number, 4 texels to a pixel.
      {"WavesLeaveOutHelpers", "ps_6_6", R"(
void main(float f : F, out uint4 a : SV_Target0, out uint4 b : SV_Target1,
          out uint4 c : SV_Target2, out uint4 d : SV_Target3, out float4 e : SV_Target4) {
  const uint x = uint(f);
  a = uint4(WaveGetLaneCount(), WaveGetLaneIndex(), WaveActiveCountBits(true), WaveActiveSum(x));
  b = uint4(WaveIsFirstLane(), WaveReadLaneFirst(x), WaveReadLaneAt(x, 2), WavePrefixSum(x));
  c = uint4(WaveActiveBallot(true).x, WaveMatch(x & 1).x, WaveActiveMax(x), WavePrefixCountBits(x > 1));
  d = uint4(WaveActiveAllTrue(x != 0), WaveActiveAnyTrue(x == 7),
            WaveMultiPrefixSum(x, uint4(0x7, 0, 0, 0)), QuadReadAcrossDiagonal(x));
  if (x == 2) discard;
  e = float4(WaveActiveCountBits(true), WaveActiveMin(f), ddx(f), WaveActiveAllEqual(x));
})",
       [](GraphicsRunner& run) {
         run.set("F", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.live = 0x6E;  // 0, 4 and 7 are helpers
         run.run();
         EXPECT_EQ(run.live, 0x6Au);
         struct Row {
           uint32_t target, component;
           Lanes wanted;  // of lanes 1 to 3, 5 and 6
         };
         const Row rows[] = {
             {0, 0, {4, 4, 4, 4, 4, 4, 4, 4}},    {0, 1, {0, 1, 2, 3, 0, 1, 2, 3}},
             {0, 2, {0, 3, 3, 3, 0, 2, 2, 0}},    {0, 3, {0, 6, 6, 6, 0, 11, 11, 0}},
             {1, 0, {0, 1, 0, 0, 0, 1, 0, 0}},    {1, 1, {0, 1, 1, 1, 0, 5, 5, 0}},
             {1, 2, {0, 2, 2, 2, 0, 6, 6, 0}},    {1, 3, {0, 0, 1, 3, 0, 0, 5, 0}},
             {2, 0, {0, 14, 14, 14, 0, 6, 6, 0}}, {2, 1, {0, 10, 4, 10, 0, 2, 4, 0}},
             {2, 2, {0, 3, 3, 3, 0, 6, 6, 0}},    {2, 3, {0, 0, 0, 1, 0, 0, 1, 0}},
             {3, 0, {0, 1, 1, 1, 0, 1, 1, 0}},    {3, 1, {}},
             {3, 2, {0, 0, 1, 3, 0, 0, 5, 0}},    {3, 3, {0, 2, 1, 0, 0, 6, 5, 0}}};
         for (const Row& row : rows) {
           const Lanes found = run.out("SV_Target", row.target, row.component);
           for (const size_t lane : {1, 2, 3, 5, 6}) {
             EXPECT_EQ(found[lane], row.wanted[lane])
                 << row.target << ", " << row.component << ", lane " << lane;
           }
         }
         const auto after = [&](uint32_t component, size_t lane) {
           return run.floats("SV_Target", 4, component)[lane];
         };
         EXPECT_EQ(after(0, 1), 2.0f) << "without the one that is discarded";
         EXPECT_EQ(after(0, 5), 2.0f);
         EXPECT_EQ(after(1, 3), 1.0f);
         EXPECT_EQ(after(2, 5), 1.0f);
         EXPECT_EQ(after(3, 3), 0.0f);
       }},
      // Helpers leave loops as others do, and go along where what decides is the same for all.
      {"LoopsOfWavesEnd", "ps_6_6", R"(
float4 main(float f : F) : SV_Target {
  float4 result = 0;
  for (;;) {
    const float first = WaveReadLaneFirst(f);
    result.x += 1;
    if (first == f) { result.y = WaveActiveCountBits(true); break; }
  }
  for (uint i = 0; i < WaveActiveMax(uint(f)); ++i) result.z += ddx(f * i);
  if (WaveActiveAnyTrue(f > 2)) result.w = ddy(result.z + f);
  return result;
})",
       [](GraphicsRunner& run) {
         run.set("F", 0, 0, {0, 1, 2, 3, 5, 5, 7, 7});
         run.live = 0x2A;
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0)[1], 1.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 0)[3], 2.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 1)[3], 1.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 1)[5], 1.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 2)[1], 3.0f)
             << "0 + 1 + 2, though lane 0 is a helper";
         EXPECT_EQ(run.floats("SV_Target", 0, 2)[3], 3.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 2)[5], 0.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 3)[1], 2.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 3)[5], 2.0f);
       }},
      {"WavesOfHelpers", "ps_6_7", R"(
[WaveOpsIncludeHelperLanes] uint4 main(float f : F) : SV_Target {
  if (f == 3) discard;
  return uint4(WaveActiveCountBits(true), WaveActiveSum(uint(f)), WaveIsFirstLane(),
               WaveReadLaneAt(uint(f), 0));
})",
       [](GraphicsRunner& run) {
         run.set("F", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.live = 0x2A;
         run.run();
         EXPECT_EQ(run.live, 0x22u);
         EXPECT_EQ(run.out("SV_Target", 0, 0), all_bits(4));
         EXPECT_EQ(run.out("SV_Target", 0, 1), (Lanes{6, 6, 6, 6, 22, 22, 22, 22}));
         EXPECT_EQ(run.out("SV_Target", 0, 2), (Lanes{1, 0, 0, 0, 1, 0, 0, 0}));
         EXPECT_EQ(run.out("SV_Target", 0, 3), (Lanes{0, 0, 0, 0, 4, 4, 4, 4}));
       }},
      {"IsHelperLane", "ps_6_6", R"(
RWByteAddressBuffer r : register(u0);
uint4 main(float f : F) : SV_Target {
  const bool before = IsHelperLane();
  const uint helpers = QuadReadAcrossX(uint(before));
  if (f == 1) discard;
  const uint others = QuadReadAcrossX(uint(IsHelperLane()));
  r.Store(4 * uint(f), IsHelperLane() ? 2 : 1);
  return uint4(before, helpers, others, ddx(f));
})",
       [](GraphicsRunner& run) {
         run.set("F", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.live = 0x2F;
         run.run();
         EXPECT_EQ(run.live, 0x2Du);
         const Lanes own = run.out("SV_Target", 0, 0);
         const Lanes helpers = run.out("SV_Target", 0, 1);
         const Lanes others = run.out("SV_Target", 0, 2);
         for (const size_t lane : {0, 2, 3, 5}) EXPECT_EQ(own[lane], 0u) << lane;
         EXPECT_EQ(helpers[0], 0u);
         EXPECT_EQ(helpers[5], 1u);
         EXPECT_EQ(others[0], 1u) << "discarded";
         EXPECT_EQ(others[2], 0u);
         EXPECT_EQ(run.memory[0], 1u);
         EXPECT_EQ(run.memory[1], 0u);
         EXPECT_EQ(run.memory[4], 0u);
       }},
      // A column each way; the caller takes samples out.
      {"Coverage", "ps_6_6", R"(
RWByteAddressBuffer r : register(u0);
struct Out { uint mask : SV_Coverage; float4 c : SV_Target; };
Out main(float f : F, uint covered : SV_Coverage) {
  r.InterlockedAdd(0, 1);
  Out o;
  o.mask = f == 2 ? 0 : f == 3 ? 2 : f == 5 ? 0xFFFFFFFF : covered;
  o.c = float4(covered, QuadReadAcrossX(covered), ddx(f), 1);
  return o;
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags & shader::kGraphicsDiscards, 0u);
         run.set("F", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.in("SV_Coverage", 0) = {1, 3, 1, 1, 0, 7, 0, 0};
         run.live = 0x2F;
         run.run();
         EXPECT_EQ(run.live, 0x2Fu);
         const auto mask = run.out("SV_Coverage", 0);
         EXPECT_EQ(mask[1], 3u);
         EXPECT_EQ(mask[2], 0u);
         EXPECT_EQ(mask[3], 2u);
         EXPECT_EQ(mask[5], ~0u);
         EXPECT_EQ(run.memory[0], 5u) << "a mask of 0 undoes no stores";
         EXPECT_EQ(run.floats("SV_Target", 0, 0)[1], 3.0f);
         EXPECT_EQ(run.floats("SV_Target", 0, 1)[5], 0.0f) << "its neighbour is a helper";
         EXPECT_EQ(run.floats("SV_Target", 0, 2)[5], 1.0f);
       }},
      // The other vertices are inputs of their own, behind those that are declared.
      {"AttributesAtVertices", "ps_6_6", R"(
struct In { float other : OTHER; nointerpolation float3 a[2] : A; nointerpolation uint n : N; };
float4 main(In i) : SV_Target {
  return float4(GetAttributeAtVertex(i.a[1].yx, 1), GetAttributeAtVertex(i.a[1], 0).z,
                GetAttributeAtVertex(i.n, 2) + GetAttributeAtVertex(i.a[1], 1).z);
})",
       [](GraphicsRunner& run) {
         const shader::GraphicsDesc& g = run.graphics();
         ASSERT_EQ(g.input_count, 6u);
         EXPECT_EQ(g.inputs[4].interpolation, shader::Interpolation::kSecondVertex);
         EXPECT_EQ(g.inputs[4].semantic_index, 1u);
         EXPECT_EQ(g.inputs[4].components, 3u);
         EXPECT_EQ(g.inputs[5].interpolation, shader::Interpolation::kThirdVertex);
         EXPECT_EQ(g.inputs[5].type, shader::ColumnType::kUint);
         run.set("A", 1, 2, all(0.25f));
         const float values[] = {1, 2, 3};
         for (uint32_t c = 0; c < 3; ++c) {
           run.inputs[g.inputs[4].first_column + c].fill(std::bit_cast<uint32_t>(values[c]));
         }
         run.inputs[g.inputs[5].first_column].fill(40);
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0), all(2));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(1));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(0.25f));
         EXPECT_EQ(run.floats("SV_Target", 0, 3), all(43));
       }},
      // What is linear on the screen is the input over w, and 1 / w.
      {"EvaluateAttributes", "ps_6_6", R"(
float4 main(float2 a : A, noperspective float b : B, centroid float3x2 m : M) : SV_Target {
  return float4(EvaluateAttributeSnapped(a, int2(8, 0)).y, EvaluateAttributeSnapped(b, int2(0, -4)),
                EvaluateAttributeCentroid(m)[2].x, EvaluateAttributeAtSample(a.y, 0));
})",
       [](GraphicsRunner& run) {
         const shader::GraphicsDesc& g = run.graphics();
         Floats a, b, w;
         for (uint32_t i = 0; i < 8; ++i) {
           const auto x = static_cast<float>((i & 1) + (i / 4) * 2);
           const auto y = static_cast<float>(i >> 1 & 1);
           w[i] = 1 / (1 + x / 2);
           a[i] = (2 + 3 * x + y) * w[i];
           b[i] = 10 + 4 * y;
         }
         run.set("A", 0, 1, a);
         run.set("B", 0, 0, b);
         run.set("M", 0, 2, all(9));
         for (uint32_t i = 0; i < g.input_count; ++i) {
           if (g.inputs[i].system_value != shader::SystemValue::kPosition) continue;
           for (uint32_t k = 0; k < 8; ++k) {
             run.inputs[g.inputs[i].first_column + 3][k] = std::bit_cast<uint32_t>(w[k]);
           }
         }
         run.run();
         const Floats moved = run.floats("SV_Target", 0, 0),
                      straight = run.floats("SV_Target", 0, 1);
         for (uint32_t i = 0; i < 8; ++i) {
           const auto x = static_cast<float>((i & 1) + (i / 4) * 2) + 0.5f;
           const auto y = static_cast<float>(i >> 1 & 1);
           EXPECT_NEAR(moved[i], (2 + 3 * x + y) / (1 + x / 2), 1e-5f) << i;
           EXPECT_NEAR(straight[i], b[i] - 1, 1e-5f) << i;
         }
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(9));
         EXPECT_EQ(run.floats("SV_Target", 0, 3), a) << "the only sample is in the middle";
       }},
      {"ImplicitLevels", "ps_6_6", R"(
Texture2D<float> t;
SamplerState s;
SamplerComparisonState c;
static Texture2D<float> alias = t;
static SamplerState assigned;
float look(float2 uv) { return alias.Sample(assigned, uv); }
void main(float4 p : SV_Position, out float4 a : SV_Target0, out float4 b : SV_Target1) {
  assigned = s;
  const float2 uv = p.xy * 4 / 64;
  a = float4(look(uv), t.SampleBias(s, uv, 1), t.SampleBias(s, uv, -0.5), t.SampleLevel(s, uv, 0));
  b = float4(t.CalculateLevelOfDetail(s, uv * 64), t.CalculateLevelOfDetailUnclamped(s, uv * 64),
             t.CalculateLevelOfDetail(s, uv), t.SampleCmp(c, uv, 1.5));
})",
       [](GraphicsRunner& run) {
         std::vector<std::vector<float>> mips;
         run.texture.format = 41;  // R32_FLOAT
         run.texture.mip_count = 7;
         for (uint32_t mip = 0; mip < 7; ++mip) {
           const uint32_t size = 64u >> mip;
           mips.emplace_back(size * size, static_cast<float>(mip));
           run.texture.mips[mip] = {reinterpret_cast<uint8_t*>(mips.back().data()),
                                    size,
                                    size,
                                    1,
                                    size * 4,
                                    size * size * 4};
         }
         run.sampler.comparison = 2;  // LESS: 1.5 < texel
         run.set_position();
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0), all(2));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), all(3));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), all(1.5f));
         EXPECT_EQ(run.floats("SV_Target", 0, 3), all(0));
         EXPECT_EQ(run.floats("SV_Target", 1, 0), all(6));
         EXPECT_EQ(run.floats("SV_Target", 1, 1), all(8));
         EXPECT_EQ(run.floats("SV_Target", 1, 2), all(2));
         EXPECT_EQ(run.floats("SV_Target", 1, 3), all(1));
       }},
      // RAS-88: where all lanes have the value, its derivative is right in any flow.
      {"DerivativesOfFixedValues", "ps_6_6", R"(
Texture2D<float> t;
SamplerState s;
float slope(float v) { return ddx_fine(v * 2); }
float4 main(float4 p : SV_Position) : SV_Target {
  if (uint(p.y) == 20) return -1;
  const float x = p.x * 3;
  float a = 0, b = 0;
  for (uint i = 0; i < uint(p.x) - 10; ++i) {
    a += ddx_fine(x);
    b += ddy_fine(p.y * p.x) + ddx_fine(ddy(p.y * p.x)) + ddx_fine(x);
  }
  if (uint(p.x) & 1) b += slope(p.x + ddx_coarse(p.x * 8));
  return float4(a, b, p.x > 12 ? t.CalculateLevelOfDetailUnclamped(s, p.xy * 4) : 0, 0);
})",
       [](GraphicsRunner& run) {
         run.texture.format = 41;
         run.texture.mip_count = 1;
         float texel = 0;
         run.texture.mips[0] = {reinterpret_cast<uint8_t*>(&texel), 1, 1, 1, 4, 4};
         run.set_position();
         run.run();
         // x has no value in the upper pixels, where its derivative would be the same.
         EXPECT_EQ(run.floats("SV_Target", 0, 0), (Floats{-1, -1, 0, 3, -1, -1, 6, 9}));
         // 11.5 + 0 + 3; twice 12.5 + 3, three times 13.5 + 3; slope() runs in odd pixels only.
         EXPECT_EQ(run.floats("SV_Target", 0, 1), (Floats{-1, -1, 0, 14.5f, -1, -1, 31, 49.5f}));
         EXPECT_EQ(run.floats("SV_Target", 0, 2), (Floats{-1, -1, 0, 0, -1, -1, 2, 2}));
       }},
      // Other values belong to the lanes that run the statement.
      {"DivergentDerivatives", "ps_6_6", R"(
float4 main(float4 p : SV_Position) : SV_Target {
  const float x = p.x * 2;
  float a = -1, b = -1;
  if (uint(p.x) == 10 || uint(p.x) > 11) a = ddx_fine(x + 0 * a);
  if (uint(p.y) == 20) return float4(a, 0, 0, 0);
  b = ddx_fine(x + a);
  return float4(a, b, 0, 0);
})",
       [](GraphicsRunner& run) {
         run.set_position();
         run.run();
         EXPECT_EQ(run.floats("SV_Target", 0, 0), (Floats{0, -1, 0, -1, 2, 2, 2, 2}));
         EXPECT_EQ(run.floats("SV_Target", 0, 1), (Floats{0, 0, 1, 1, 0, 0, 2, 2}));
       }},
      {"Globals", "ps_6_6", R"(
static uint count = 3;
RWStructuredBuffer<uint> r : register(u0);
[earlydepthstencil] uint main(nointerpolation uint id : ID) : SV_Target {
  count += id;
  if (id == 4) r[id] = count;
  return count;
})",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags,
                   uint32_t{shader::kGraphicsEarlyDepthStencil} | shader::kGraphicsWritesMemory);
         run.in("ID", 0) = all_bits(4);
         run.live = 0x10;
         run.run();
         EXPECT_EQ(run.out("SV_Target", 0)[4], 7u);
         EXPECT_EQ(run.memory[4], 7u);
       }},
      {"OrderedViews", "ps_6_6", R"(
RasterizerOrderedStructuredBuffer<uint> r : register(u0);
void main(float i : I) { r[uint(i)] = r[uint(i)] * 3 + 1; })",
       [](GraphicsRunner& run) {
         EXPECT_EQ(run.graphics().flags,
                   uint32_t{shader::kGraphicsOrdersPixels} | shader::kGraphicsWritesMemory);
         EXPECT_EQ(run.graphics().output_count, 0u);
         run.set("I", 0, 0, {0, 1, 2, 3, 4, 5, 6, 7});
         run.memory[5] = 10;
         run.run();
         EXPECT_EQ(run.memory[5], 31u);
         EXPECT_EQ(run.memory[0], 1u);
       }},
  };
  return list;
}

hlsl::FrontendOptions options_of(const Case& one) {
  hlsl::FrontendOptions options;
  options.path = std::string(one.name) + ".hlsl";
  options.text = one.source;
  options.target = one.target;
  options.entry_point = "main";
  options.native_16bit = one.native_16bit;
  return options;
}

enum class Way { kNative, kWide, kInterpreted };

// All cases in one shared object.
const std::vector<Compiled>& compiled(Way way) {
  static std::map<Way, std::vector<Compiled>> libraries;
  std::vector<Compiled>& out = libraries[way];
  if (!out.empty()) return out;
  std::vector<hlsl::FrontendOptions> sources;
  for (const Case& one : cases()) sources.push_back(options_of(one));
  if (way == Way::kInterpreted) {
    for (const hlsl::FrontendOptions& source : sources) out.push_back(compile_interpreted(source));
  } else {
    out = compile_native(
        sources, way == Way::kWide ? hlsl::WideThreads::kAlways : hlsl::WideThreads::kNever);
  }
  return out;
}

class GraphicsStage : public testing::TestWithParam<size_t> {
 protected:
  static void check(Way way) {
    const Compiled& code = compiled(way)[GetParam()];
    ASSERT_NE(code.library, nullptr) << code.error;
    GraphicsRunner run(*code.library, "main");
    cases()[GetParam()].check(run);
  }
};

TEST_P(GraphicsStage, Native) {
  check(Way::kNative);
}
TEST_P(GraphicsStage, Wide) {
  check(Way::kWide);
  const GraphicsRunner run(*compiled(Way::kWide)[GetParam()].library, "main");
  EXPECT_EQ(run.graphics().pixel_thread, nullptr) << "it does not run 8 at once";
}
TEST_P(GraphicsStage, Interpreted) {
  check(Way::kInterpreted);
}
TEST_P(GraphicsStage, HasSpirv) {
  const auto module = compile_module(options_of(cases()[GetParam()]));
  ASSERT_TRUE(module) << module.error();
  const hlsl::SpirvLibrary spirv = hlsl::compile_spirv(**module);
  EXPECT_FALSE(spirv.error) << spirv.error.message();
}

INSTANTIATE_TEST_SUITE_P(All, GraphicsStage, testing::Range<size_t>(0, cases().size()),
                         [](const testing::TestParamInfo<size_t>& one) {
                           return std::string(cases()[one.param].name);
                         });

}  // namespace
}  // namespace kaamos::test
