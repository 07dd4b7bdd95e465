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
      {"UnormIntegers", Id::kNormType, kernel("unorm @uint4 u = 0;")},
      {"SnormTexels", Id::kNormType, kernel("", "Buffer<snorm @int> b;")},
  };
  return all;
}

class Strict : public testing::TestWithParam<StrictCase> {};

TEST_P(Strict, WarnsByDefault) {
  FrontendOptions options;
  options.target = GetParam().target;
  expect_at_mark(GetParam().id, GetParam().text, options);
}

TEST_P(Strict, Refuses) {
  FrontendOptions options;
  options.target = GetParam().target;
  options.strict = true;
  expect_at_mark(GetParam().id, GetParam().text, options);
}

INSTANTIATE_TEST_SUITE_P(All, Strict, testing::ValuesIn(strict_cases()),
                         [](const auto& one) { return one.param.name; });

TEST(StrictDoesNot, RefuseWhatDxcTakes) {
  FrontendOptions options;
  options.strict = true;
  const Compilation compilation(
      kernel("t = u;\nresults.Store(0, t.Load(0, int2(7, -8)).x + u[uint2(0, 0)].x + a + b);\n"
             "results.Store(0, dot(float4(1, 2, 3, 4), float4(1, 1, 1, 1)) * (1 << 2));\n"
             "[unroll] for (uint i = 0; i < 3; ++i) results.Store(0, i);",
             "static Texture2D<uint4> t;\nTexture2D<uint4> u;\n"
             "cbuffer C { uint a : packoffset(c0.y); uint b : packoffset(c0.x); }"),
      options);
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
}

}  // namespace
}  // namespace kaamos::hlsl
