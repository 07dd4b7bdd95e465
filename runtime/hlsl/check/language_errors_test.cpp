// SPDX-License-Identifier: MIT
// Tests what the checker says about interfaces, auto, loop variables, vertex and pixel shaders: `@`
// marks the place.
#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

struct LanguageCase {
  const char* name;
  Id id;
  std::string text;
  const char* target = "lib_6_6";
  uint32_t version = 2021;
  bool native = false;
};

std::string pixel(const std::string& body, const std::string& globals = {}) {
  return globals + "\nfloat4 main(float4 p : SV_Position) : SV_Target {\n" + body +
         "\nreturn p;\n}\n";
}

std::string closest_hit(const std::string& body) {
  return "struct [raypayload] P { int i : read(caller) : write(closesthit); };\n"
         "[shader(\"closesthit\")] void c(inout P p, BuiltInTriangleIntersectionAttributes a) {\n"
         "p.i = 0;\n" +
         body + "\n}\n";
}

const std::vector<LanguageCase>& language_cases() {
  static const std::vector<LanguageCase> all = {
      {"QueryReturnedFromInnerBlock", Id::kRayQueryPlace,
       kernel("f();", "typedef RayQuery<0> Q;\nQ @f() { { Q q; return q; } }")},
      {"OneOfTwoQueriesReturned", Id::kRayQueryPlace,
       kernel("f(true);",
              "typedef RayQuery<0> Q;\nQ f(bool b) { Q q, r; if (b) return q; return @r; }")},
      {"ExportedQuery", Id::kRayQueryPlace, "export RayQuery<0> @f() { RayQuery<0> q; return q; }"},
      {"QueryOfOtherFlagsReturned", Id::kConversion,
       kernel("f();", "RayQuery<0> f() { RayQuery<1> q; return @q; }")},
      {"NoQueryReturned", Id::kReturnsNothing,
       kernel("f();", "RayQuery<0> f() { RayQuery<0> q; @return; }")},
      {"ConstantStructChanged", Id::kConstArgument,
       kernel("const S s = {1}; f(@s);", "struct S { int i; };\nvoid f(inout S s) { s.i = 2; }")},
      {"ConstantMemberChanged", Id::kConstPlace,
       kernel("const S s = {1}; f(s.@i);", "struct S { int i; };\nvoid f(inout int i) { i = 2; }")},
      {"StaticAssertFails", Id::kStaticAssert, "@_Static_assert(1 > 2, \"one is less\");"},
      {"StaticAssertFailsInTemplate", Id::kStaticAssert,
       kernel("f<0>();",
              "template <int N> void f() {\n@_Static_assert(N != 0, \"N is not 0\"); }")},
      {"StaticAssertOfAVariable", Id::kNotConstant,
       kernel("int i = 1; _Static_assert(i @== 1, \"no constant\");")},
      {"InterfaceVariable", Id::kInterfaceObject, kernel("I @i;", "interface I { int f(); };")},
      {"InterfaceParameter", Id::kInterfaceObject,
       kernel("", "interface I { int f(); };\nvoid g(I @i) {}")},
      {"InterfaceMethodMissing", Id::kInterfaceMethod,
       kernel("", "interface I { int f(); };\nstruct @S : I { int g() { return 1; } };")},
      {"InterfaceMethodOtherTypes", Id::kInterfaceMethod,
       kernel("",
              "interface I { int f(float a); };\n"
              "struct @S : I { int f(int a) { return 1; } };")},
      {"TwoBases", Id::kUnsupported,
       kernel("", "struct A {};\nstruct B {};\nstruct C : A, @B {};")},
      {"HullShader", Id::kUnsupported, "void main(@InputPatch<float4, 3> s) {}", "ps_6_6"},
      {"HullFunctionCalled", Id::kUnsupported,
       kernel("emit(1);", "void emit(@InputPatch<float4, 3> s) {}")},
      {"StaticOfLocal", Id::kStaticUsesLocal, kernel("uint n = 1;\nstatic uint @x = n;")},
      {"StaticOfLocalByFunction", Id::kStaticUsesLocal,
       kernel("uint n = 1;\nstatic uint @x = f(n);", "uint f(uint a) { return a; }")},
      {"AutoWithoutValue", Id::kAutoWithoutValue, kernel("@auto x;")},
      {"AutoOfList", Id::kAutoWithoutValue, kernel("@auto x = {1, 2};")},
      {"AutoParameter", Id::kAutoWithoutValue, kernel("", "void f(@auto x) {}")},
      {"ConstWithoutValue", Id::kConstWithoutValue, kernel("const float @x;")},
      {"StaticConstWithoutValue", Id::kConstWithoutValue, kernel("", "static const float @x;")},
      {"ConstructorOfLongArray", Id::kConstructorCount,
       kernel("float a[3];\nfloat2 b = @float2(a);")},
      {"ConstructorOfShortArray", Id::kConstructorCount,
       kernel("float a[3];\nfloat4 b = @float4(a);")},
      {"ConstructorOfHugeArray", Id::kConstructorArgument,
       kernel("float a[32];\nfloat4 b = float4(@a);")},
      {"LoopVariableOutside", Id::kUndeclared,
       kernel("for (int i = 0; i < 3; ++i) {}\nint a = @i;")},
      {"LoopVariableAgain", Id::kLoopVariableAgain,
       kernel("for (int i = 0; i < 3; ++i) {}\nfor (uint @i = 0; i < 3; ++i) {}"), "lib_6_6", 2018},
      {"LocalAgain", Id::kRedefinition, kernel("int i;\nfor (uint @i = 0; i < 3; ++i) {}"),
       "lib_6_6", 2018},
      {"RayQuerySecondFlags", Id::kRayQuerySecondFlags, kernel("RayQuery<0, @2> q;")},
      {"RayQueryMicromaps", Id::kNeedsShaderModel,
       kernel("RayQuery<0, @RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS> q;")},
      {"RayQueryTwoState", Id::kRayQueryMicromaps,
       kernel("RayQuery<@RAY_FLAG_FORCE_OMM_2_STATE> q;"), "lib_6_9"},
      {"RayQueryThreeArguments", Id::kTemplateCount, kernel("@RayQuery<0, 0, 0> q;")},
      {"RayQuerySecondNotConstant", Id::kNotConstant, kernel("uint n = 0;\nRayQuery<0, @n> q;")},
      {"HitObject", Id::kNeedsShaderModel, kernel("@dx::HitObject h;")},
      {"Reorder", Id::kNeedsShaderModel, kernel("@dx::MaybeReorderThread(1, 2);")},
      // Shader model 6.10
      {"PositionsInOldModel", Id::kNeedsShaderModel, closest_hit("@TriangleObjectPositions();"),
       "lib_6_9"},
      {"PositionsOfOldQuery", Id::kNeedsShaderModel,
       kernel("RayQuery<0> q;\nq.@CommittedTriangleObjectPositions();"), "lib_6_9"},
      {"PositionsOfOldHit", Id::kNeedsShaderModel,
       closest_hit("dx::HitObject h;\nh.@TriangleObjectPositions();"), "lib_6_9"},
      {"PositionsInCompute", Id::kStage, kernel("@TriangleObjectPositions();"), "lib_6_10"},
      {"PositionsInMiss", Id::kStage,
       "struct [raypayload] P { int i : read(caller) : write(miss); };\n"
       "[shader(\"miss\")] void m(inout P p) { p.i = 0; @TriangleObjectPositions(); }",
       "lib_6_10"},
      {"ClusterInOldModel", Id::kNeedsShaderModel, closest_hit("@ClusterID();"), "lib_6_9"},
      {"ClusterInCompute", Id::kStage, kernel("@ClusterID();"), "lib_6_10"},
      {"PositionsWithArgument", Id::kArgumentCount, closest_hit("@TriangleObjectPositions(1);"),
       "lib_6_10"},
      {"BreakInOldModel", Id::kNeedsShaderModel, kernel("@DebugBreak();"), "lib_6_9"},
      {"GroupWaveIndex", Id::kWaveShaderModel, kernel("uint i = @GetGroupWaveIndex();"), "lib_6_9"},
      {"GroupWaveCount", Id::kStage, closest_hit("uint i = @GetGroupWaveCount();"), "lib_6_10"},
      {"LimitInOldModel", Id::kNeedsShaderModel,
       "[shader(\"compute\")] [@GroupSharedLimit(64)] [numthreads(1, 1, 1)] void main() {}",
       "lib_6_9"},
      {"LimitWithoutBytes", Id::kArgumentCount,
       "[shader(\"compute\")] [@GroupSharedLimit] [numthreads(1, 1, 1)] void main() {}",
       "lib_6_10"},
      {"NegativeLimit", Id::kGroupsharedLimit,
       "[shader(\"compute\")] [GroupSharedLimit(@-4)] [numthreads(1, 1, 1)] void main() {}",
       "lib_6_10"},
      {"BreakWithArgument", Id::kArgumentCount, kernel("@DebugBreak(1);"), "lib_6_10"},
      {"DebuggingInOldModel", Id::kUndeclared, kernel("bool b = dx::@IsDebuggingEnabled();"),
       "lib_6_9"},
      {"ClustersOfOldQuery", Id::kRayQuerySecondFlags, kernel("RayQuery<0, @2> q;"), "lib_6_9"},
      {"QueryFlagsOfNothing", Id::kRayQuerySecondFlags, kernel("RayQuery<0, @4> q;"), "lib_6_10"},
      // Vertex and pixel shaders
      {"PixelNoSemantic", Id::kGraphicsSemantic, "float4 main(float2 @p) : SV_Target { return 1; }",
       "ps_6_6"},
      {"PixelResultNoSemantic", Id::kGraphicsSemantic, "float4 @main() { return 1; }", "ps_6_6"},
      {"PixelInnerCoverage", Id::kSemanticNotOffered,
       "float4 main(uint c : @SV_InnerCoverage) : SV_Target { return c; }", "ps_6_6"},
      {"VertexCoverage", Id::kSemanticNotThere,
       "float4 main(uint c : @SV_Coverage) : SV_Position { return c; }", "vs_6_6"},
      {"CoverageOfFloat", Id::kSystemValueType, "float @main() : SV_Coverage { return 1; }",
       "ps_6_6"},
      {"CoverageTwice", Id::kSemanticTwice,
       "void main(out uint a : SV_Coverage, out uint @b : SV_Coverage) { a = b = 1; }", "ps_6_6"},
      {"VertexCullsPrimitive", Id::kSemanticNotThere,
       "bool main(out float4 p : SV_Position) : @SV_CullPrimitive { p = 0; return true; }",
       "vs_6_6"},
      {"EvaluateLocal", Id::kVertexAttribute,
       "float4 main(float4 p : P) : SV_Target {\n"
       "  float4 q = p; return EvaluateAttributeSnapped(@q, int2(1, 2)); }",
       "ps_6_6"},
      {"EvaluatePosition", Id::kVertexAttribute,
       "float4 main(float4 p : SV_Position) : SV_Target {\n"
       "  return EvaluateAttributeAtSample(@p, 0); }",
       "ps_6_6"},
      {"SampleCountInVertex", Id::kStage,
       "float4 main(float4 p : P) : SV_Position { return p * @GetRenderTargetSampleCount(); }",
       "vs_6_6"},
      {"VertexOfInterpolated", Id::kVertexAttribute,
       "float4 main(float4 p : P) : SV_Target { return GetAttributeAtVertex(@p, 1); }", "ps_6_6"},
      {"VertexOfLocal", Id::kVertexAttribute,
       "float4 main(nointerpolation float4 p : P) : SV_Target {\n"
       "  float4 q = p; return GetAttributeAtVertex(@q, 1); }",
       "ps_6_6"},
      {"VertexOfParameter", Id::kVertexAttribute,
       "float4 f(float4 p) { return GetAttributeAtVertex(@p, 1); }\n"
       "float4 main(nointerpolation float4 p : P) : SV_Target { return f(p); }",
       "ps_6_6"},
      {"VertexThree", Id::kVertexAttribute,
       "float4 main(nointerpolation float4 p : P) : SV_Target { return GetAttributeAtVertex(p, "
       "@3); }",
       "ps_6_6"},
      {"VertexInVertex", Id::kStage,
       "float4 main(float4 p : P) : SV_Position { return @GetAttributeAtVertex(p, 1); }", "vs_6_6"},
      {"EvaluateInVertex", Id::kStage,
       "float4 main(float4 p : P) : SV_Position { return @EvaluateAttributeCentroid(p); }",
       "vs_6_6"},
      {"VertexShadingRate", Id::kSemanticNotOffered,
       "float4 main(out uint r : @SV_ShadingRate) : SV_Position { r = 0; return 0; }", "vs_6_6"},
      {"ViewIdOfFloats", Id::kSystemValueType,
       "float4 main(float2 @v : SV_ViewID) : SV_Position { return v.x; }", "vs_6_6"},
      {"PixelVertexId", Id::kSemanticNotThere,
       "float4 main(uint v : @SV_VertexID) : SV_Target { return v; }", "ps_6_6"},
      {"VertexTarget", Id::kSemanticNotThere, "float4 main() : @SV_Target { return 0; }", "vs_6_6"},
      {"UnknownSystemValue", Id::kSemanticNotThere,
       "float4 main(uint v : @SV_Missing) : SV_Position { return v; }", "vs_6_6"},
      {"PositionOfThree", Id::kSystemValueType, "float3 @main() : SV_Position { return 0; }",
       "vs_6_6"},
      {"FrontFaceFloat", Id::kSystemValueType,
       "float4 main(float @f : SV_IsFrontFace) : SV_Target { return f; }", "ps_6_6"},
      {"TwoDepths", Id::kSemanticTwice,
       "void main(out float a : SV_Depth, out float @b : SV_DepthLessEqual) { a = b = 1; }",
       "ps_6_6"},
      {"DepthOfTwo", Id::kSystemValueType, "float2 @main() : SV_Depth { return 0; }", "ps_6_6"},
      {"SemanticTwice", Id::kSemanticTwice,
       "float4 main(float a : A, float @b : a0) : SV_Target { return a + b; }", "ps_6_6"},
      {"SemanticTwiceInArray", Id::kSemanticTwice,
       "float4 main(float a[2] : A, float @b : A1) : SV_Target { return a[0] + b; }", "ps_6_6"},
      {"DoubleInput", Id::kSignatureType,
       "float4 main(double @a : A) : SV_Target { return (float)a; }", "ps_6_6"},
      {"ResourceInput", Id::kSignatureType,
       "float4 main(Texture2D @a : A) : SV_Target { return 0; }", "ps_6_6"},
      {"LinearInteger", Id::kInterpolatedInteger,
       "float4 main(linear uint @a : A) : SV_Target { return a; }", "ps_6_6"},
      {"NoPerspectiveBool", Id::kInterpolatedInteger,
       "struct V { noperspective bool @a : A; };\nfloat4 main(V v) : SV_Target { return v.a; }",
       "ps_6_6"},
      {"NineDistances", Id::kClipDistances,
       "void @main(out float4 p : SV_Position, out float4 c : SV_ClipDistance,\n"
       "          out float4 d : SV_CullDistance, out float e : SV_CullDistance1) {\n"
       "  p = c = d = e = 0; }",
       "vs_6_6"},
      {"ThirtyThreeVectors", Id::kSignatureVectors,
       "void @main(out float4 p : SV_Position, out float4 a[32] : A) { p = 0; a = (float4[32])0; }",
       "vs_6_6"},
      {"NinthTarget", Id::kTargetNumber, "float4 main() : @SV_Target8 { return 0; }", "ps_6_6"},
      {"UniformParameter", Id::kUnsupported,
       "float4 main(uniform float @a) : SV_Target { return a; }", "ps_6_6"},
      {"WavesOfHelpersInOldModel", Id::kWaveShaderModel,
       "[@WaveOpsIncludeHelperLanes] float4 main() : SV_Target { return WaveActiveSum(1); }",
       "ps_6_6"},
      {"OrderedInCompute", Id::kStage, kernel("r[0] = 1;", "RasterizerOrderedBuffer<uint> @r;")},
      {"PixelOutput", Id::kPixelOutput, "float4 main() : @SV_Position { return 1; }", "ps_6_6"},
      {"VertexFieldNoSemantic", Id::kGraphicsSemantic,
       "struct V { float4 a : SV_Position; float2 @b; };\nV main() { return (V)0; }", "vs_6_0"},
      {"LongPixelInput", Id::kLongVectorPlace,
       "float4 main(vector<float, 5> @v : V) : SV_Target { return v[0]; }", "ps_6_9"},
      {"LongPixelOutput", Id::kLongVectorPlace,
       "vector<float, 5> @main(float4 v : V) : SV_Target { return v.x; }", "ps_6_9"},
      {"LongVertexField", Id::kLongVectorPlace,
       "struct V { float4 p : SV_Position; vector<float, 5> @v[2] : V; };\n"
       "V main() { return (V)0; }",
       "vs_6_9"},
      {"PixelBody", Id::kUndeclared, pixel("float x = @missing;"), "ps_6_8"},
      {"PixelConversion", Id::kConversion, pixel("float2 a = 0;\nfloat3 b = @a;"), "ps_6_6"},
      {"PixelTraceRay", Id::kStage, pixel("uint3 i = @DispatchRaysIndex();"), "ps_6_6"},
      {"PixelBarrier", Id::kStage, pixel("@GroupMemoryBarrierWithGroupSync();"), "ps_6_6"},
      {"VertexDerivative", Id::kStage,
       "float4 main(float2 a : A) : SV_Position { return @ddx(a.x); }", "vs_6_6"},
      {"VertexDiscardInFunction", Id::kStage,
       "void f() { @discard; }\nfloat4 main() : SV_Position { f(); return 1; }", "vs_6_6"},
      {"VertexImplicitLevel", Id::kStage,
       "Texture2D t;\nSamplerState s;\n"
       "float4 main() : SV_Position { return t.@Sample(s, 0); }",
       "vs_6_6"},
      {"PixelInLibraryBody", Id::kUndeclared,
       "[shader(\"pixel\")] float4 main() : SV_Target { return @missing; }"},
      {"NoPixelEntry", Id::kNoEntryPoint, "void f() {}", "ps_6_6"},
      {"HalfIsFloat16", Id::kFunctionRedefined,
       kernel("", "int f(half3 a) { return 1; }\nint @f(float16_t3 a) { return 2; }"), "lib_6_6",
       2021, true},
  };
  return all;
}

class LanguageErrors : public testing::TestWithParam<size_t> {};

TEST_P(LanguageErrors, StandsAtTheMark) {
  const LanguageCase& one = language_cases()[GetParam()];
  FrontendOptions options;
  options.target = one.target;
  options.experimental = true;
  options.hlsl_version = one.version;
  options.native_16bit = one.native;
  expect_at_mark(one.id, one.text, options);
}

INSTANTIATE_TEST_SUITE_P(All, LanguageErrors, testing::Range<size_t>(0, language_cases().size()),
                         [](const testing::TestParamInfo<size_t>& one) {
                           return std::string(language_cases()[one.param].name);
                         });

std::string messages_of(const std::string& text, const char* target, bool native = false) {
  FrontendOptions options;
  options.target = target;
  options.native_16bit = native;
  return Compilation(text, options).messages();
}

TEST(GraphicsStages, WhatTheyMayUse) {
  const std::string text = pixel(
      "float4 c = t.Sample(s, p.xy) + ddx(p) + fwidth(p.x) + shade(p);\n"
      "clip(c.x);\nif (c.y < 0) discard;\np = c + QuadReadAcrossX(c.x);",
      "Texture2D t;\nSamplerState s;\nstruct V { float4 p : SV_Position; nointerpolation uint i : "
      "I; "
      "};\nfloat4 shade(float4 a) { return ddy_fine(a); }");
  const std::string messages = messages_of(text, "ps_6_6");
  EXPECT_EQ(messages.find("error"), std::string::npos) << messages;
  EXPECT_EQ(messages.find("KA2512"), std::string::npos) << messages;
}

TEST(GraphicsStages, LimitsAreInclusive) {
  const char* const allowed[] = {
      "void main(out float4 p : SV_Position, out float4 a[31] : A) { p = 0; a = (float4[31])0; }",
      "void main(out float4 p : SV_Position, out float a[124] : A) { p = 0; a = (float[124])0; }",
      "void main(out float4 p : SV_Position, out float4 c : SV_ClipDistance,\n"
      "          out float4 d : SV_CullDistance) { p = c = d = 0; }"};
  for (const char* text : allowed) EXPECT_EQ(messages_of(text, "vs_6_6"), "") << text;
}

TEST(GraphicsStages, AreInTheModule) {
  const Compilation compilation(
      "struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };\n"
      "static float shared_value = 2;\nRWByteAddressBuffer r : register(u0);\n"
      "float twice(float a) { return a * shared_value; }\n"
      "[shader(\"vertex\")] V Vertex(uint id : SV_VertexID) {\n"
      "  V v; v.position = twice(id); v.uv = 0; return v; }\n"
      "[shader(\"pixel\")] float4 Pixel(V v) : SV_Target1 { return ddx(v.uv.x); }\n"
      "[shader(\"raygeneration\")] void Rays() { r.Store(0, twice(2)); }");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  ASSERT_EQ(compilation.module->entry_points.size(), 3u);
  EXPECT_EQ(compilation.module->entry_points[0].name, "Vertex");
  EXPECT_EQ(compilation.module->entry_points[0].inputs.size(), 1u);
  EXPECT_EQ(compilation.module->entry_points[0].outputs.size(), 2u);
  EXPECT_EQ(compilation.module->entry_points[1].graphics_flags, shader::kGraphicsReadsQuad);
  EXPECT_EQ(compilation.module->entry_points[2].name, "Rays");
}

// A function that a pixel shader shares with other stages is made twice, so that theirs does not
// change.
TEST(GraphicsStages, SharedFunctionsAreCopied) {
  const Compilation compilation(
      "Texture2D t;\nSamplerState s;\nRWByteAddressBuffer r : register(u0);\n"
      "float4 look(float2 uv) { r.Store(4, 1); return t.SampleBias(s, uv, 2); }\n"
      "[shader(\"pixel\")] float4 Pixel(float2 uv : UV) : SV_Target { return look(uv); }\n"
      "[shader(\"raygeneration\")] void Rays() { r.Store(0, asuint(look(0).x)); }");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  std::vector<std::string> looks;
  for (const ir::Function* function : compilation.module->functions) {
    if (function->name == "look") looks.push_back(dump(*function));
  }
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_NE(looks[0].find("sample_level"), std::string::npos) << looks[0];
  EXPECT_NE(looks[0].find(", 0)"), std::string::npos) << looks[0];
  EXPECT_EQ(looks[0].find("live"), std::string::npos) << looks[0];
  EXPECT_NE(looks[1].find("sample_gradient"), std::string::npos) << looks[1];
  EXPECT_NE(looks[1].find("if live"), std::string::npos) << looks[1];
}

TEST(ComputeDerivatives, NeedShaderModel66) {
  const std::string text =
      "RWByteAddressBuffer r : register(u0);\n"
      "[numthreads(2, 2, 1)] void main(uint i : SV_GroupIndex) { r.Store(0, ddx(i)); }";
  EXPECT_EQ(messages_of(text, "cs_6_6"), "");
  EXPECT_NE(messages_of(text, "cs_6_5").find("[KA2576]"), std::string::npos);
}

// What a shader without quads shares keeps mip 0.
TEST(ComputeDerivatives, SharedFunctionsAreCopied) {
  const Compilation compilation(
      "Texture2D t;\nSamplerState s;\nRWByteAddressBuffer r : register(u0);\n"
      "float4 look(float2 uv) { return t.Sample(s, uv); }\n"
      "[shader(\"compute\")] [numthreads(2, 2, 1)] void Squares(uint3 i : SV_GroupThreadID) {\n"
      "  r.Store(0, look(i.xy).x); }\n"
      "[shader(\"compute\")] [numthreads(1, 2, 1)] void Alone(uint3 i : SV_GroupThreadID) {\n"
      "  r.Store(0, look(i.xy).x); }");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  std::vector<std::string> looks;
  for (const ir::Function* function : compilation.module->functions) {
    if (function->name == "look") looks.push_back(dump(*function));
  }
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_NE(looks[0].find("sample_level"), std::string::npos) << looks[0];
  EXPECT_NE(looks[1].find("sample_gradient"), std::string::npos) << looks[1];
}

TEST(LanguageMessages, AMissingIncludeIsTheOnlyError) {
  const std::string messages =
      messages_of("#include \"nowhere.hlsli\"\n" + kernel("Thing t = Make(3);"), "lib_6_6");
  EXPECT_NE(messages.find("KA2002"), std::string::npos) << messages;
  EXPECT_NE(messages.find("1 error\n"), std::string::npos) << messages;
}

TEST(LanguageMessages, HalfSaysThatItIsAnotherType) {
  const std::string messages =
      messages_of(kernel("", "int f(half3 a) { return 1; }\nint f(float16_t3 a) { return 2; }"),
                  "lib_6_6", true);
  EXPECT_NE(messages.find("both parameters are 'float16_t3'"), std::string::npos) << messages;
}

TEST(LanguageMessages, TheNearestNameIsSuggested) {
  const std::pair<std::string, const char*> cases[] = {
      {kernel("uint x = countr;", "static uint counter;\nstatic uint counts;"), "'counter'"},
      {kernel("uint x = lenght;", "static uint lengths;\nstatic uint length_;"), "'length'"},
      {kernel("uint x = widht;", "static uint width;\nstatic uint wide;"), "'width'"},
      {kernel("uint x = aTob;", "static uint aToc;\nstatic uint aTobe;\nstatic uint atob;"),
       "'aTobe'"},
      {kernel("flaot3 x;"), "'float3'"},
      {kernel("Ligth2 x;", "struct Light2 { int a; };"), "'Light2'"},
      {kernel("Flot3 x;", "struct Float3 { int a; };"), "'Float3'"},
      {kernel("uin x;"), "'uint'"}};
  for (const auto& [text, name] : cases) {
    const std::string messages = messages_of(text, "lib_6_6");
    EXPECT_NE(messages.find("did you mean " + std::string(name) + "?"), std::string::npos)
        << text << messages;
  }
}

TEST(VertexInputs, RayDescHasTheNumbersOfItsFields) {
  FrontendOptions options;
  options.target = "vs_6_6";
  const Compilation compilation(
      "float4 main(RayDesc r : TEXCOORD) : SV_Position { return r.Origin.xyzx + r.TMax; }",
      options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const auto& inputs = compilation.module->entry_points[0].inputs;
  ASSERT_EQ(inputs.size(), 4u);
  EXPECT_EQ(inputs[3].semantic_index, 3u);
}

TEST(RayQueries, AreConstructedAndNamedAgain) {
  const Compilation compilation(
      kernel("RayQuery<0> a = RayQuery<0>();\nRayQuery<0> b;\nb = a;\n"
             "b.Abort();\na.CommitNonOpaqueTriangleHit();"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const std::string text = compilation.function("main");
  EXPECT_EQ(text.find("b."), std::string::npos) << text;
}

}  // namespace
}  // namespace kaamos::hlsl
