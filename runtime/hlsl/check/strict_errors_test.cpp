// SPDX-License-Identifier: MIT
// Tests what DXC refuses and this compiler does only with --strict: by default it is a warning.
#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

struct StrictCase {
  const char* name;
  Id id;
  std::string text;
  const char* target = "lib_6_6";
};

void PrintTo(const StrictCase& one, std::ostream* out) {
  *out << one.name;
}

std::string pixel(const std::string& body) {
  return "float4 main(float2 uv : TEXCOORD) : SV_Target {\n" + body + "\nreturn 0; }\n";
}

const std::vector<StrictCase>& strict_cases() {
  static const std::vector<StrictCase> all = {
      {"PackOffsetsOverlap", Id::kPackOverlap,
       kernel("results.Store(0, a + b.x);",
              "cbuffer C { float a : packoffset(c0.z);\nfloat4 @b : packoffset(c0); }")},
      {"PackOffsetOfGlobal", Id::kPackOffsetPlace,
       kernel("results.Store(0, a);", "uint a : packoffset(@c0);")},
      {"PackOffsetOfField", Id::kPackOffsetPlace,
       kernel("", "struct S { uint a : packoffset(@c0); };")},
      {"SpaceOfConstant", Id::kConstantSpace,
       kernel("results.Store(0, s.a);", "struct S { uint a; };\nS s : register(@t0, space1);")},
      {"SpaceOfResources", Id::kConstantSpace,
       kernel("results.Store(0, s.b.Load(s.a));",
              "struct S { uint a; ByteAddressBuffer b; };\nS s : register(@t0, space1);")},
      {"ShiftByFloat", Id::kShiftByFloat, kernel("uint u = 1; float f = 1;\nu = u @<< f;")},
      {"ShiftByFloatAssigned", Id::kShiftByFloat, kernel("uint u = 1; float f = 1;\nu @>>= f;")},
      {"DotOfMatrix", Id::kMixedShapes,
       kernel("float1x4 a = 1; float4 b = 1;\nresults.Store(0, @dot(a, b));")},
      {"MinOfVectorAndMatrix", Id::kMixedShapes,
       kernel("float4x1 a = 1; float4 b = 1;\nresults.Store(0, @min(b, a).x);")},
      {"OffsetOfLoad", Id::kTexelOffset,
       kernel("results.Store(0, t.Load(0, @int2(8, 0)).x);", "Texture2D<uint4> t;")},
      {"OffsetOfSample", Id::kTexelOffset,
       kernel("results.Store(0, t.SampleLevel(s, 0, 0, @int2(0, -9)).x);",
              "Texture2D<float4> t;\nSamplerState s;")},
      {"IndexOfTexture", Id::kTextureIndex,
       kernel("results.Store(0, t[@uint3(0, 0, 0)].x);", "Texture2D<uint4> t;")},
      {"AllMemoryBarrierInPixel", Id::kStageStrict, pixel("@AllMemoryBarrier();"), "ps_6_6"},
      {"StaticTextureUnassigned", Id::kUnassignedResource,
       kernel("results.Store(0, t.Load(0).x);", "static Texture2D<uint4> @t;")},
      {"LoopAndUnroll", Id::kLoopAttributes,
       kernel("[loop][unroll]\n@for (uint i = 0; i < 3; ++i) results.Store(0, i);")},
      {"SwitchWithoutCases", Id::kEmptySwitch, kernel("@switch (results.Load(0)) {}")},
      {"LitOfVector", Id::kScalarArgument, kernel("results.Store(0, lit(1, @float2(1, 2), 1).x);")},
      {"RefractByVector", Id::kScalarArgument,
       kernel("float3 n = 1;\nresults.Store(0, refract(n, n, @n).x);")},
      {"ThreadsOfPixelShader", Id::kIgnoredInStage, "[@numthreads(1, 1, 1)]\n" + pixel(""),
       "ps_6_6"},
      {"CoherentFloat", Id::kCoherentType,
       kernel("results.Store(0, f);", "globallycoherent float @f;")},
      {"CoherentLocal", Id::kCoherentType, kernel("globallycoherent uint @u = 0;")},
      {"CoherentTexture", Id::kCoherentType,
       kernel("results.Store(0, t.Load(0).x);", "globallycoherent Texture2D<uint4> @t;")},
      {"UnormIntegers", Id::kNormType, kernel("unorm @uint4 u = 0;")},
      {"NeverWritten", Id::kUndefinedStored, kernel("uint @x;\nresults.Store(0, x);")},
      {"NeverWrittenStruct", Id::kUndefinedStored,
       kernel("S @s;\nresults.Store(0, s.a);", "struct S { uint a; };")},
      {"EndlessWhile", Id::kEndlessLoop, kernel("@while (true) results.Store(0, 1);")},
      {"EndlessFor", Id::kEndlessLoop,
       kernel("@for (;;) { switch (results.Load(0)) { case 1: break; } }")},
      {"UnrollByMemory", Id::kUnrollCount,
       kernel("[@unroll] for (uint i = 0; i < n; ++i) results.Store(0, i);",
              "cbuffer C { uint n; };")},
      {"ReturnsThis", Id::kReturnsThis,
       kernel("S s = {1};\nresults.Store(0, s.copy().a);",
              "struct S { uint a; S copy() { return @this; } };")},
      {"DividesByZero", Id::kConstantDivision,
       kernel("results.Store(0, a);", "static const uint a = 7u @/ 0u;")},
      {"VariableByZero", Id::kConstantDivision,
       kernel("uint2 v = results.Load(0);\nv = v @% uint2(1, 0);")},
      {"HeapOfOlderModel", Id::kNeedsModel,
       kernel("ByteAddressBuffer b = @ResourceDescriptorHeap[0];"), "lib_6_5"},
      {"IsNormalOfOlderModel", Id::kNeedsModel, kernel("bool b = @isnormal(1.0f);"), "lib_6_8"},
      {"AtomicOfOlderModel", Id::kNeedsModel, kernel("results.@InterlockedAdd64(0, 1);"),
       "lib_6_5"},
      {"SampleCmpLevelOfOlderModel", Id::kNeedsModel,
       kernel("results.Store(0, asuint(t.@SampleCmpLevel(s, 0, 0, 0)));",
              "Texture2D<float> t;\nSamplerComparisonState s;"),
       "lib_6_6"},
      {"RayQueryOfOlderModel", Id::kNeedsModel, kernel("RayQuery<0> @q;"), "lib_6_4"},
      {"LongElement", Id::kElementSize,
       kernel("results.Store(0, asuint(b[0].x[0]));",
              "struct S { float x[600]; };\nStructuredBuffer<S> @b;")},
      {"MuchGroupshared", Id::kGroupsharedSize,
       kernel("a[0] = b[0] = 1;", "groupshared float4 a[1024];\ngroupshared float4 @b[1025];")},
      {"MoreGroupsharedThanDeclared", Id::kGroupsharedSize,
       "groupshared float4 @a[5];\n[shader(\"compute\")] [GroupSharedLimit(64)]\n"
       "[numthreads(1, 1, 1)] void main() { a[0] = 1; }",
       "lib_6_10"},
      {"GroupsharedInRays", Id::kStageStrict,
       "groupshared uint a;\n[shader(\"raygeneration\")] void main() { @a = 1; }"},
      {"FunctionBesideInstance", Id::kAmbiguousStrict,
       kernel("results.Store(0, @f(1u));",
              "uint f(uint a) { return 1; }\ntemplate <typename T> T f(T a) { return 2; }")},
      {"VectorCondition", Id::kVectorLogic, kernel("float2 a = 1;\na = a > 1 @? a : 2;")},
      {"NeverReturns", Id::kNeverReturns,
       kernel("results.Store(0, f());", "uint f() { uint a = 1; a += 2; @}")},
      {"UnrollByInput", Id::kUnrollCount,
       "float4 main(uint n : N) : SV_Target {\nfloat x = 0;\n"
       "[@unroll] for (uint i = 0; i < n; i++) x++;\nreturn x; }",
       "ps_6_6"},
      {"RootSignatureOfRays", Id::kRootSignatureStage,
       "[@RootSignature(\"\")]\n[shader(\"raygeneration\")] void main() {}"},
      {"WaveSizeTwice", Id::kAttributeTwice,
       "[WaveSize(4)] [@WaveSize(8)]\n[numthreads(1, 1, 1)] void main() {}", "cs_6_6"},
      {"ExportedResource", Id::kExportedResource,
       "export uint @f(Buffer<uint> b) { return b[0]; }"},
      {"LongAtomicOfOlderModel", Id::kNeedsModel,
       kernel("uint64_t one = 1;\n@InterlockedAdd(b[0], one);", "RWStructuredBuffer<uint64_t> b;"),
       "lib_6_5"},
      {"SnormTexels", Id::kNormType, kernel("", "Buffer<snorm @int> b;")},
  };
  return all;
}

class Strict : public testing::TestWithParam<StrictCase> {};

TEST_P(Strict, WarnsByDefault) {
  FrontendOptions options;
  options.target = GetParam().target;
  options.experimental = true;
  expect_at_mark(GetParam().id, GetParam().text, options);
}

TEST_P(Strict, Refuses) {
  FrontendOptions options;
  options.target = GetParam().target;
  options.experimental = true;
  options.strict = true;
  expect_at_mark(GetParam().id, GetParam().text, options);
}

INSTANTIATE_TEST_SUITE_P(All, Strict, testing::ValuesIn(strict_cases()),
                         [](const auto& one) { return one.param.name; });

TEST(StrictOnly, ChecksBodiesThatNothingReaches) {
  const std::string text = "void unused() {\nreturn @nonsense; }\n" + kernel("");
  FrontendOptions options;
  EXPECT_NE(Compilation(strip_mark(text).text, options).module, nullptr);
  options.strict = true;
  expect_at_mark(Id::kUndeclared, text, options);
  // What depends on the caller, or is a limit of this compiler, does not count.
  const Compilation whole(
      "uint twice(uint a) { return a == 0 ? 0 : twice(a - 1); }\nuint other(uint a);\n"
      "uint third(uint a) { uint b; return other(a) / 0u + b; }\n" +
          kernel(""),
      options);
  EXPECT_NE(whole.module, nullptr) << whole.messages();
}

// What a constant condition leaves out may have any index.
TEST(Indices, OutOfRangeInDeadBranches) {
  const std::string declared =
      "uint a[3] = {1, 2, 3};\nresults.Store(0, kCount > 3 ? a[3] : a[0]);\n"
      "if (kCount > 4) { results.Store(4, a[4]); } else { results.Store(4, a[1]); }";
  const Compilation compilation(kernel(declared, "static const uint kCount = 3;"));
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
  expect_at_mark(Id::kIndexRange, kernel("uint a[3] = {1, 2, 3};\nif (true) a[@3] = 1;"));
}

TEST(Variables, ReadAndNeverWritten) {
  expect_at_mark(Id::kUninitialised, kernel("uint @a;\nresults.Store(0, a + 1);"));
}

TEST(OutParameters, NeverWritten) {
  expect_at_mark(Id::kOutUnwritten,
                 kernel("uint a;\nput(a);\nresults.Store(0, a);", "void put(out uint @v) {}"));
}

TEST(StrictDoesNot, RefuseWhatDxcTakes) {
  FrontendOptions options;
  options.strict = true;
  const Compilation compilation(
      kernel("t = u;\nresults.Store(0, t.Load(0, int2(7, -8)).x + u[uint2(0, 0)].x + a + b);\n"
             "results.Store(0, dot(float4(1, 2, 3, 4), float4(1, 1, 1, 1)) * (1 << 2));\n"
             "[unroll] for (uint i = 0; i < 3; ++i) results.Store(0, i);\n"
             "uint undefined; results.Store(0, (undefined & 0) | (1u << 33));\n"
             "E e; results.Store(0, e.get()); P p; p.a = 1; results.Store(0, p.a + p.b);\n"
             "while (true) { if (results.Load(0) == 1) break; }\n"
             "for (;;) { if (results.Load(0) == 1) return; }",
             "struct E { uint get() { return 1; } };\nstruct P { uint a; uint b; };\n"
             "static Texture2D<uint4> t;\nTexture2D<uint4> u;\n"
             "cbuffer C { uint a : packoffset(c0.y); uint b : packoffset(c0.x); }"),
      options);
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
}

}  // namespace
}  // namespace kaamos::hlsl
