// SPDX-License-Identifier: MIT
// No input makes the front end crash or hang: neither texts that are built to hurt it, nor good
// texts with pieces removed, duplicated and swapped.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/ir/verify.h"

namespace kaamos::hlsl {
namespace {

std::string repeat(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

const char kSample[] = R"(
RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> output : register(u0);
struct Base { uint kind; uint get() { return kind; } };
struct Item : Base { float3 a; float4x4 m[2]; static const uint kCount = 3; };
StructuredBuffer<Item> items : register(t1);
RWStructuredBuffer<Item> out_items : register(u1);
Texture2D<float4> textures[] : register(t0, space1);
SamplerState samp : register(s0);
cbuffer C : register(b0) { float4x4 view; float3 eye; bool flag; float2 v[3]; };
enum class Mode : uint { A, B = 4, C };
namespace n { static const float kTable[3] = { 1, 2.5, 3 }; template <typename T> T twice(T x) { return x + x; } }
typedef vector<float, 3> F3;
groupshared uint shared_data[64];
static uint counter = 2;
float3 helper(F3 v, inout uint seed, out float w, float s = 2.0) {
  seed = seed * 1664525u + 1013904223u; w = s;
  for (int i = 0; i < 3; ++i) { if (i == 1) continue; v.xy += n::kTable[i]; while (v.x > 9) { v.x -= 1; break; } }
  switch (seed & 3) { case 0: case 1: v = v.zyx; break; default: v *= 2; }
  return seed > 3 && v.x > 0 ? n::twice(v) : v.xxx;
}
struct Payload { float4 color; uint depth; };
float outside(float x, inout Payload p);
export float inside(float x) { Payload p = (Payload)0; return outside(x, p); }
[shader("miss")] void Miss(inout Payload p) { p.color.x = outside(1, p); }
[shader("raygeneration")]
void RayGen() {
  uint2 id = DispatchRaysIndex().xy; uint seed = id.x; float w;
  Item item = items[id.x]; Item zero = (Item)0; float2x3 m = { 1, 2, 3, float3(4, 5, 6) };
  RayDesc ray = { eye, 0.0, helper(item.a, seed, w), 1e30 };
  Payload p = { float4(m[0], w), 0u };
  TraceRay(scene, RAY_FLAG_FORCE_OPAQUE, 0xff, 0, 1, 0, ray, p);
  out_items[id.y].m[1][2].xz = mul(view, p.color).yw; out_items[1].a._x = 1;
  output[id].rgb += textures[NonUniformResourceIndex(id.x)].SampleLevel(samp, v[1], 0).bgr * (float)Mode::C;
  output[id] = float4(sin(p.color.xyz), asfloat(item.get() + counter++)); do { id.x /= 2; } while (id.x);
}
[shader("closesthit")]
void Hit(inout Payload p, BuiltInTriangleIntersectionAttributes a) { p.color.xy = a.barycentrics; if (p.depth++ < 3) { RayDesc r = (RayDesc)0; TraceRay(scene, 0, 1, 0, 0, 0, r, p); } }
[shader("compute")] [numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID, uint i : SV_GroupIndex) { shared_data[i] = id.x; GroupMemoryBarrierWithGroupSync(); InterlockedAdd(shared_data[0], 1u, id.y); }
)";

TEST(CheckMutation, TheSampleItselfIsAccepted) {
  std::string text = kSample;
  const size_t wrong = text.find(" out_items[1].a._x = 1;");
  text.erase(wrong, std::string(" out_items[1].a._x = 1;").size());
  const Compilation compilation(text);
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
}

// The modules of all HLSL test files obey the rules of ir.h.
TEST(CheckMutation, TestFilesMakeModulesByTheRules) {
  namespace fs = std::filesystem;
  size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(KAAMOS_SOURCE_DIR "/tests/hlsl")) {
    // The files in parse contain what the checker rejects.
    if (entry.path().extension() != ".hlsl" || entry.path().parent_path().filename() == "parse") {
      continue;
    }
    FrontendOptions options;
    options.path = entry.path().string();
    options.include_folders = {KAAMOS_SOURCE_DIR "/tests/hlsl"};
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    options.native_16bit = text.find("OPTIONS: -enable-16bit-types") != std::string::npos;
    if (text.find("OPTIONS: -HV 2018") != std::string::npos) options.hlsl_version = 2018;
    if (text.find("OPTIONS: -T lib_6_7") != std::string::npos) options.target = "lib_6_7";
    if (text.find(" -T lib_6_9") != std::string::npos) options.target = "lib_6_9";
    options.experimental = text.find(" -T lib_6_10") != std::string::npos;
    if (options.experimental) options.target = "lib_6_10";
    if (text.find(" -disable-payload-qualifiers") != std::string::npos) {
      options.payload_qualifiers = false;
    }
    DiskFileLoader loader;
    SourceManager sources(loader);
    DiagnosticEngine diagnostics;
    const auto module = compile_to_ir(options, sources, diagnostics);
    ASSERT_NE(module, nullptr) << render_all(diagnostics, sources);
    EXPECT_EQ(verify(*module), "") << options.path;
    ++count;
  }
  EXPECT_GT(count, 0u);
}

TEST(CheckMutation, HurtfulTexts) {
  const std::string texts[] = {
      kernel("int x = " + repeat("(1+", 3000) + "1" + repeat(")", 3000) + ";"),
      kernel("int x = 1" + repeat("+1", 20000) + ";"),
      kernel("int y; int x = y" + repeat("+y", 5000) + ";"),
      kernel(repeat("{", 3000) + repeat("}", 3000)),
      kernel("int a" + repeat("[65535]", 40) + ";"),
      kernel("", "static const int a[4294967295] = {1};"),
      kernel("", "struct S { float4x4 a[1000000]; };\ncbuffer C { S s[1000000]; };"),
      kernel("int x = 0x7fffffff * 0x7fffffff << 70 >> -1;"),
      kernel("int x = (-2147483647 - 1) / -1; int y = (-2147483647 - 1) % -1;"),
      kernel("int x = int(1e300) + uint(-1e300) + int(0.0 / 0.0);"),
      kernel("uint64_t x = 18446744073709551615ull * 18446744073709551615ull;"),
      kernel("f<0>();", "template <int N> void f() { f<N + 1>(); }"),
      kernel("R<0> r;", "template <int N> struct R { R<N + 1> r; };"),
      kernel("", "struct A : A { };"),
      kernel("", "struct A; struct B : A { }; struct A : B { };"),
      kernel("", "typedef T T; T x;"),
      kernel("", "static const int a = b; static const int b = a;"),
      kernel("", "enum E { A = B, B = A };"),
      kernel("f();", "void f(); void g() { f(); } void f() { g(); }"),
      kernel("S s = (S)0; s.f();", "struct S { void f() { this.f(); } };"),
      kernel("float4 v; v.xxxx.yyyy.zzzz.wwww = 1;"),
      kernel("float4x4 m; m[0][1][2] = 1; m._m00_m00 = 2; m[5] = 0;"),
      kernel("int a[2]; a[0xffffffff] = 1; a[-1] = 2; a[1.9] = 3;"),
      kernel("S s = { {{{{{ 1 }}}}} };", "struct S { int a; };"),
      kernel("float x = {};"),
      kernel("switch (1) { default: default: case 0x100000000: ; }"),
      kernel("ResourceDescriptorHeap; SamplerDescriptorHeap[1] = 2; ResourceDescriptorHeap[0][1];"),
      kernel("t.mips; t.mips[0]; t.mips[0][1] = 2; t.mips.x;", "Texture2D t;"),
      kernel("r[0][1][2];", "Texture2D r[2][3];"),
      kernel("t.sample; t.sample[0]; t.sample[0][1] = 2; t.sample.x; t[0]; t.Load(t); "
             "t.GetDimensions(t, 1, t); t.sample[t][t]; t.Load(int2(0, 0), 1, 2, 3);",
             "Texture2DMS<float4> t;"),
      kernel(
          "a.Append(); a.Append(a); a.Consume(1); a[0].Append(1); a.Append({1, 2}); c.Consume(c);",
          "AppendStructuredBuffer<float4> a; ConsumeStructuredBuffer<uint> c;"),
      kernel("vk::RawBufferLoad<S>(); vk::RawBufferLoad<vk>(1); vk::f<1>(); vk::DeviceScope(1);"),
      kernel("vk::vk::x; vk::ReadClock(t); vk; vk(1); ::vk::DeviceScope; vk::RawBufferStore(1, t);",
             "Texture2D t;"),
      kernel("InterlockedAdd(b[0].x, 1); b[0] += b; InterlockedMax(b, b); b[b];",
             "RWBuffer<uint64_t2> b;"),
      kernel("AddUint64(); AddUint64(1, 2); AddUint64(b, b); dot2add(b, b, b); "
             "dot4add_u8packed(1.5, true, float2(1, 2)); dot4add_i8packed({1}, {2}, {3});",
             "Texture2D b;"),
      "[[vk::binding]] [[vk::]] [[::x]] [[vk::a::b(1)]] [[vk]] Texture2D t;",
      "Texture2DMS<float, t> t; RWTexture2DMS<> u; Texture2DMSArray<float4, -1> v;",
      "Texture2DMS<float4, 99999999999> w; AppendStructuredBuffer<Texture2D> x; ",
      "[RootSignature(f)] [RootSignature(\"a\" \"b\", 1)] [shader(\"miss\")] void f() {}",
      kernel("TraceRay(); ReportHit(); CallShader(1); IgnoreHit(1); mul(1); select(1); sincos(1);"),
      kernel("GroupMemoryBarrier(1); InterlockedAdd(); InterlockedCompareExchange(1, 2, 3, 4);"),
      "cbuffer C { float a : packoffset(c99999999.w); Texture2D t; float b[]; };",
      "Texture2D t[4294967295][4294967295] : register(t4294967295, space4294967295);",
      "template <typename T, T N> struct S { T a[N]; }; S<int, 3> s; S<float, 2> t; S<S, S> u;",
      "struct S { static S s; S f(S s = s) { return s; } }; static S g;",
      "void f(int a = b, int b = a) {} [shader(\"raygeneration\")] void r() { f(); }",
      "[shader()] [shader(1, 2)] [numthreads()] [numthreads(-1, 1.5, \"x\")] void main() {}",
      "[shader(\"compute\")] [numthreads(1, 1, 1)] void main(inout uint3 a : SV_GroupID, S b) {}",
      "TriangleHitGroup g = { }; RaytracingPipelineConfig p = { p }; GlobalRootSignature r = { 1 "
      "};",
      "export int f(int x[3][4], out float2x2 m, Texture2D t[]) { return x[1][2]; }",
  };
  for (const std::string& text : texts) {
    const Compilation compilation(text);
    // A module is returned if and only if there are no errors.
    bool failed = false;
    for (const Diagnostic& diagnostic : compilation.diagnostics()) {
      failed = failed || diagnostic.severity == Severity::kError;
    }
    EXPECT_EQ(failed, compilation.module == nullptr) << text.substr(0, 200);
    if (compilation.module) {
      EXPECT_EQ(verify(*compilation.module), "") << text.substr(0, 200);
    }
  }
}

TEST(CheckMutation, MutatedSample) {
  const std::string sample = kSample;
  // Pieces cut at word boundaries get further into the checker than single characters do.
  std::vector<std::string> words;
  for (size_t at = 0; at < sample.size();) {
    size_t end = at + 1;
    const auto is_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    if (is_word(sample[at])) {
      while (end < sample.size() && is_word(sample[end])) ++end;
    }
    words.push_back(sample.substr(at, end - at));
    at = end;
  }
  std::mt19937 random(1);
  const auto start = std::chrono::steady_clock::now();
  int runs = 0;
  // At least 21, however slow the machine is.
  while (runs <= 20 ||
         (runs < 400 && std::chrono::steady_clock::now() - start < std::chrono::seconds(2))) {
    std::vector<std::string> mutated = words;
    const uint32_t changes = 1 + random() % 4;
    for (uint32_t i = 0; i < changes; ++i) {
      const size_t at = random() % mutated.size();
      switch (random() % 4) {
        case 0:
          mutated.erase(mutated.begin() + static_cast<ptrdiff_t>(at));
          break;
        case 1:
          mutated[at] = words[random() % words.size()];
          break;
        case 2:
          std::swap(mutated[at], mutated[random() % mutated.size()]);
          break;
        default:
          mutated.insert(mutated.begin() + static_cast<ptrdiff_t>(at),
                         words[random() % words.size()]);
      }
    }
    std::string text;
    for (const std::string& word : mutated) text += word;
    const Compilation compilation(text);
    bool failed = false;
    for (const Diagnostic& diagnostic : compilation.diagnostics()) {
      failed = failed || diagnostic.severity == Severity::kError;
    }
    EXPECT_EQ(failed, compilation.module == nullptr) << text;
    if (compilation.module) {
      EXPECT_EQ(verify(*compilation.module), "") << text;
    }
    ++runs;
  }
  EXPECT_GT(runs, 20);
}

}  // namespace
}  // namespace kaamos::hlsl
