// SPDX-License-Identifier: MIT
// Tests what the checker makes of a text: types, overloads, evaluation order, exports, registers.
#include "runtime/hlsl/check/check.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/ir/verify.h"

namespace kaamos::hlsl {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const ir::Binding* binding(const Compilation& compilation, std::string_view name) {
  if (!compilation.module) return nullptr;
  for (const ir::Binding& one : compilation.module->bindings) {
    if (one.name == name) return &one;
  }
  return nullptr;
}

// Returns which overload a call picks; each returns a different number.
std::string picked(const std::string& functions, const std::string& call) {
  const Compilation compilation(kernel("results.Store(0, " + call + ");", functions));
  if (!compilation.module) return compilation.messages();
  for (const ir::Function* function : compilation.module->functions) {
    if (function->name != "f" && !function->name.starts_with("f<")) continue;
    return dump(*function->body.back()->value);
  }
  return "none";
}

TEST(Overloads, ExactBeatsConversion) {
  const std::string functions =
      "uint f(float x) { return 1; }\nuint f(int x) { return 2; }\nuint f(uint x) { return 3; }";
  EXPECT_EQ(picked(functions, "f(1.0f)"), "1u");
  EXPECT_EQ(picked(functions, "f(int(1))"), "2u");
  EXPECT_EQ(picked(functions, "f(1u)"), "3u");
  EXPECT_EQ(picked(functions, "f(1.5)"), "1u");
}

TEST(Overloads, ShapeBeatsScalar) {
  const std::string functions = "uint f(float x) { return 1; }\nuint f(float3 x) { return 2; }";
  EXPECT_EQ(picked(functions, "f(int3(1, 2, 3))"), "2u");
  EXPECT_EQ(picked(functions, "f(2)"), "1u");
}

TEST(Overloads, SplatBeatsTruncation) {
  const std::string functions = "uint f(float2 x) { return 1; }\nuint f(float4 x) { return 2; }";
  EXPECT_EQ(picked(functions, "f(float4(1, 2, 3, 4))"), "2u");
  EXPECT_EQ(picked(functions, "f(float3(1, 2, 3))"), "1u");
}

TEST(Overloads, OwnFunctionBeatsIntrinsic) {
  const Compilation compilation(kernel("results.Store(0, asuint(lerp(1.0f, 2.0f, 0.5f)));",
                                       "float lerp(float a, float b, float t) { return 7; }"));
  EXPECT_TRUE(contains(compilation.function("main"), "= lerp(1, 2, 0.5)"));
}

TEST(Overloads, IntrinsicWhereOwnDoesNotFit) {
  const Compilation compilation(
      kernel("float2 x = float2(results.Load(0), 1);\n"
             "results.Store(0, asuint(max(x.x, x.y)));",
             "float max(float a, float b, float c) { return 7; }"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_TRUE(contains(compilation.function("main"), "max(x"));
}

TEST(Overloads, PlainBeatsTemplate) {
  const std::string functions =
      "template <typename T> uint f(T x) { return 1; }\nuint f(float x) { return 2; }";
  EXPECT_EQ(picked(functions, "f(1.0f)"), "2u");
  EXPECT_EQ(picked(functions, "f(1u)"), "1u");
}

TEST(Templates, DeducedAndExplicit) {
  const Compilation compilation(
      kernel("results.Store(0, sum<uint, 3>(uint3(1, 2, 3)) + sum(uint2(4, 5)) + "
             "first(P<uint>::make(6)));",
             "template <typename T, int N> T sum(vector<T, N> v) {\n"
             "  T s = 0;\n  for (int i = 0; i < N; ++i) s += v[i];\n  return s;\n}\n"
             "template <typename T> struct P { T a; static P<T> make(T x) { P<T> p; p.a = x; "
             "return p; } };\n"
             "template <typename T> T first(P<T> p) { return p.a; }"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_FALSE(compilation.function("sum<uint, 3>").empty());
  EXPECT_FALSE(compilation.function("sum<uint, 2>").empty());
  EXPECT_FALSE(compilation.function("first<uint>").empty());
}

TEST(Lowering, EffectsKeepTheirOrder) {
  const Compilation compilation(
      kernel("uint i = results.Load(0);\nuint x = i + i++ * 2 + i;\nresults.Store(0, x);"));
  const std::string text = compilation.function("main");
  // The first i is saved before the increment; the last one is read after it.
  const size_t saved = text.find("uint t$2 = i$0");
  const size_t increment = text.find("i$0 = (t$1 + 1u)");
  const size_t last = text.find("((t$2 + (t$1 * 2u)) + i$0)");
  ASSERT_NE(saved, std::string::npos) << text;
  ASSERT_NE(last, std::string::npos) << text;
  EXPECT_LT(saved, increment) << text;
  EXPECT_LT(increment, last) << text;
}

TEST(Lowering, ArgumentsAreReadBeforeLaterEffects) {
  const Compilation compilation(
      kernel("S s = {1, 2};\nresults.Store(0, sum(s.x, next(s), s.x));",
             "struct S { uint x, y; };\nuint next(inout S s) { return s.x++; }\n"
             "uint sum(uint a, uint b, uint c) { return a * 100 + b * 10 + c; }"));
  const std::string text = compilation.function("main");
  const size_t saved = text.find("= s$0.x\n");
  const size_t call = text.find("= next(s$0)");
  ASSERT_NE(saved, std::string::npos) << text;
  EXPECT_LT(saved, call) << text;
  EXPECT_TRUE(contains(text, ", s$0.x)")) << text;
}

TEST(Lowering, ShortCircuitKeepsCallsBehindTheTest) {
  const Compilation compilation(kernel("bool b = results.Load(0) > 0 && f();\nresults.Store(0, b);",
                                       "bool f() { return true; }"));
  const std::string text = compilation.function("main");
  const size_t test = text.find("if t$");
  ASSERT_NE(test, std::string::npos) << text;
  EXPECT_LT(test, text.find("= f()")) << text;
}

TEST(Lowering, BothSidesBefore2021) {
  FrontendOptions options;
  options.hlsl_version = 2018;
  const Compilation compilation(
      kernel("bool b = results.Load(0) > 0 && f();\nbool2 v = b && bool2(true, false);\n"
             "results.Store(0, b ? f() : v.y);",
             "bool f() { return true; }"),
      options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_TRUE(compilation.diagnostics().empty()) << compilation.messages();
  EXPECT_FALSE(contains(compilation.function("main"), "if ")) << compilation.function("main");
}

TEST(Lowering, AliasedInoutGetsACopy) {
  const Compilation compilation(kernel("int x = 1;\nf(x, x);\nresults.Store(0, x);",
                                       "void f(inout int a, inout int b) { a += 1; b += 2; }"));
  const std::string text = compilation.function("main");
  EXPECT_FALSE(contains(text, "f(x$1, x$1)")) << text;
}

TEST(Lowering, PlainLocalIsPassedItself) {
  const Compilation compilation(
      kernel("int x = 1;\nf(x);\nresults.Store(0, x);", "void f(inout int a) { a += 1; }"));
  EXPECT_TRUE(contains(compilation.function("main"), "f(x$")) << compilation.function("main");
}

TEST(Lowering, PartOfATexelIsReadChangedWritten) {
  const Compilation compilation(
      kernel("tex[uint2(1, 2)].y = 3;", "RWTexture2D<float4> tex : register(u1);"));
  const std::string text = compilation.function("main");
  EXPECT_TRUE(contains(text, "typed_load_float4")) << text;
  EXPECT_TRUE(contains(text, ".y = ")) << text;
  EXPECT_TRUE(contains(text, "typed_store")) << text;
}

TEST(Lowering, CallGraphFacts) {
  const Compilation compilation(
      "RaytracingAccelerationStructure scene : register(t0);\nstruct P { float a; };\n"
      "void shoot(inout P p) { RayDesc r = (RayDesc)0; TraceRay(scene, 0, 255, 0, 0, 0, r, p); }\n"
      "void outer(inout P p) { shoot(p); }\nfloat pure(float x) { return x * x; }\n"
      "[shader(\"raygeneration\")] void R() { P p = (P)0; outer(p); p.a = pure(p.a); }\n"
      "[shader(\"miss\")] void M(inout P p) { p.a = pure(p.a); }\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  std::vector<std::string> order;
  for (const ir::Function* function : compilation.module->functions) {
    order.push_back(function->name);
    EXPECT_EQ(function->may_trace, function->name != "pure" && function->name != "M")
        << function->name;
    if (function->name == "pure") {
      EXPECT_EQ(function->stages, ir::kStageRayGeneration | ir::kStageMiss);
    }
  }
  EXPECT_EQ(order, (std::vector<std::string>{"shoot", "outer", "pure", "R", "M"}));
}

TEST(Lowering, GlobalsStartPerInvocation) {
  const Compilation compilation(
      kernel("counter += 1;\nresults.Store(0, counter + start + kTable[1]);",
             "static uint counter = 5;\nuint make() { return 3; }\nstatic uint start = make();\n"
             "static const uint kTable[2] = {7, 8};"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const std::string text = dump(*compilation.module);
  EXPECT_TRUE(contains(text, "global uint counter$")) << text;
  // start's initialiser calls a function, so it runs as statements in the entry point.
  EXPECT_TRUE(contains(compilation.function("main"), "= make()")) << text;
  for (const ir::Variable* global : compilation.module->globals) {
    EXPECT_EQ(global->storage == ir::Storage::kConstant, global->name == "kTable") << global->name;
  }
}

TEST(Lowering, ConstLocalsAreConstants) {
  const Compilation compilation(
      kernel("const uint n = 2 + 1;\nuint a[n * 2];\nresults.Store(0, a[n]);"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_TRUE(contains(compilation.function("main"), "uint[6] a"));
}

TEST(Lowering, MethodsDefinedOutside) {
  const Compilation compilation(kernel("S s = {1}; s.add(2); results.Store(0, s.a);",
                                       "struct S { uint a; void add(uint x); };\n"
                                       "void S::add(uint x) { a += x; }"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_TRUE(compilation.diagnostics().empty()) << compilation.messages();
}

TEST(Verifier, FindsBrokenRules) {
  Compilation compilation(kernel("float x = results.Load(0); results.Store(0, asuint(x * 2));"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(verify(*compilation.module), "");
  // A float times an integer, as a forgotten conversion would leave it.
  ir::Expr& integer = compilation.module->expr_pool.emplace_back();
  integer.kind = ir::ExprKind::kLiteral;
  integer.literal = {2};
  for (ir::Expr& one : compilation.module->expr_pool) {
    if (one.kind == ir::ExprKind::kLoad) integer.type = one.type;
    if (one.kind == ir::ExprKind::kBinary) one.operands[1] = &integer;
  }
  EXPECT_NE(verify(*compilation.module), "");
}

// A function that other stages reach too is copied for pixel shaders.
TEST(Bindings, CopiesForPixelShadersUseTheSame) {
  const Compilation compilation(R"(
Texture2D<float4> one : register(t0);
Texture2D<float4> many[] : register(t0, space1);
RWByteAddressBuffer results : register(u0);
float Look(uint i) {
  const uint next = i + 1;
  return many[NonUniformResourceIndex(next)].Load(int3(0, 0, 0)).x;
}
[shader("compute")] [numthreads(1, 1, 1)]
void Count(uint3 id : SV_DispatchThreadID) {
  results.Store(0, asuint(Look(id.x) + one.Load(int3(0, 0, 0)).x));
}
[shader("pixel")] float4 Paint(nointerpolation uint i : ID) : SV_Target { return Look(i); }
)");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(verify(*compilation.module), "");
}

TEST(Bindings, AutomaticRegistersFillGapsByClass) {
  const Compilation good(
      kernel("results.Store(0, a[0] + b[0] + c[0] + k + many[1][0]);",
             "StructuredBuffer<uint> a;\nStructuredBuffer<uint> b : register(t0);\n"
             "StructuredBuffer<uint> unused;\nStructuredBuffer<uint> many[];\n"
             "StructuredBuffer<uint> c;\ncbuffer C { uint k; };"));
  ASSERT_NE(good.module, nullptr) << good.messages();
  EXPECT_EQ(binding(good, "a")->register_index, 1u);
  EXPECT_EQ(binding(good, "b")->register_index, 0u);
  EXPECT_EQ(binding(good, "c")->register_index, 2u);
  EXPECT_EQ(binding(good, "many")->register_index, 3u);
  EXPECT_EQ(binding(good, "many")->count, 0xFFFFFFFFu);
  EXPECT_EQ(binding(good, "C")->register_index, 0u);
  EXPECT_EQ(binding(good, "unused"), nullptr);
  EXPECT_TRUE(binding(good, "a")->automatic);
  EXPECT_FALSE(binding(good, "b")->automatic);
}

// As DXC has it: what nothing reads is gone before registers are given out, unless
// -flegacy-resource-reservation says otherwise.
TEST(Bindings, UnusedRegistersAreFreeUnlessReserved) {
  const std::string source = kernel("results.Store(0, a[0] + pair[1][0]);",
                                    "StructuredBuffer<uint> spare : register(t0);\n"
                                    "StructuredBuffer<uint> also_spare : register(t0);\n"
                                    "StructuredBuffer<uint> two[2] : register(t2);\n"
                                    "StructuredBuffer<uint> a;\nStructuredBuffer<uint> pair[2];");
  const Compilation free(source);
  ASSERT_NE(free.module, nullptr) << free.messages();
  EXPECT_EQ(binding(free, "a")->register_index, 0u);
  EXPECT_EQ(binding(free, "pair")->register_index, 1u);
  FrontendOptions options;
  options.reserve_unused = true;
  const Compilation reserved(source, options);
  ASSERT_NE(reserved.module, nullptr) << reserved.messages();
  EXPECT_EQ(binding(reserved, "a")->register_index, 1u);
  EXPECT_EQ(binding(reserved, "pair")->register_index, 4u);
  EXPECT_EQ(binding(reserved, "spare"), nullptr);
}

TEST(Bindings, ConstantRegistersEndWithTheBuffer) {
  const Compilation last(kernel("results.Store(0, a.x);", "uint4 a : register(c4095);"));
  ASSERT_NE(last.module, nullptr) << last.messages();
  EXPECT_EQ(binding(last, "$Globals")->size_bytes, 65536u);
  const Compilation past(kernel("results.Store(0, a.x);", "uint4 a : register(c4096);"));
  EXPECT_EQ(past.module, nullptr);
  EXPECT_NE(past.messages().find("KA2545"), std::string::npos) << past.messages();
}

TEST(Bindings, GlobalsComeFirst) {
  const Compilation compilation(kernel("results.Store(0, a + b + c);",
                                       "cbuffer A { uint a; };\nuint b;\n"
                                       "cbuffer C : register(b0) { uint c; };"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(binding(compilation, "$Globals")->register_index, 1u);
  EXPECT_EQ(binding(compilation, "A")->register_index, 2u);
}

TEST(Bindings, AutomaticSpace) {
  FrontendOptions options;
  options.automatic_space = 7;
  const Compilation compilation(
      kernel("results.Store(0, a[0] + b[0]);",
             "StructuredBuffer<uint> a;\nStructuredBuffer<uint> b : register(space3);"),
      options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(binding(compilation, "a")->space, 7u);
  EXPECT_EQ(binding(compilation, "b")->space, 3u);
  EXPECT_EQ(binding(compilation, "results")->space, 0u);
}

TEST(Bindings, EachEntryPointHasItsOwn) {
  const Compilation compilation(
      "RWByteAddressBuffer x : register(u0);\nRWByteAddressBuffer y : register(u1);\n"
      "void put() { y.Store(0, 1); }\n"
      "[shader(\"raygeneration\")] void A() { x.Store(0, 1); }\n"
      "[shader(\"raygeneration\")] void B() { put(); }\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const auto& entries = compilation.module->entry_points;
  EXPECT_EQ(entries[0].bindings, std::vector<uint32_t>{0});
  EXPECT_EQ(entries[1].bindings, std::vector<uint32_t>{1});
}

TEST(Exports, RenamesAndLists) {
  FrontendOptions options;
  options.exports = "A1,A2=A;B";
  const Compilation compilation(
      "[shader(\"raygeneration\")] void A() {}\n[shader(\"raygeneration\")] void B() {}\n"
      "[shader(\"raygeneration\")] void C() {}\n",
      options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  std::vector<std::string> names;
  for (const ir::EntryPoint& entry : compilation.module->entry_points) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"A1", "A2", "B"}));
}

TEST(Exports, ExternalLinkageExportsEveryNonStaticFunction) {
  const std::string text =
      "float helper(float x) { return x; }\nstatic float hidden(float x) { return x; }\n"
      "export float shown(float x) { return x; }\n[shader(\"raygeneration\")] void A() {}\n";
  const Compilation internal(text);
  ASSERT_NE(internal.module, nullptr) << internal.messages();
  ASSERT_EQ(internal.module->library_functions.size(), 1u);
  EXPECT_EQ(internal.module->library_functions[0].name, "shown");
  FrontendOptions options;
  options.external_linkage = true;
  const Compilation external(text, options);
  ASSERT_NE(external.module, nullptr) << external.messages();
  ASSERT_EQ(external.module->library_functions.size(), 2u);
  EXPECT_EQ(external.module->library_functions[0].name, "helper");
  EXPECT_EQ(external.module->library_functions[0].mangled, "\01?helper@@YAMM@Z");
}

TEST(Exports, RequestSyntax) {
  const auto requests = parse_exports("A;B1,B2=C");
  ASSERT_TRUE(requests.has_value());
  ASSERT_EQ(requests->size(), 2u);
  EXPECT_EQ((*requests)[0].function, "A");
  EXPECT_EQ((*requests)[1].names, (std::vector<std::string>{"B1", "B2"}));
  EXPECT_EQ((*requests)[1].function, "C");
  EXPECT_FALSE(parse_exports("A,,B=C").has_value());
  EXPECT_FALSE(parse_exports("A=").has_value());
}

TEST(EntryPoints, PayloadsAndAttributesAreMeasured) {
  const Compilation compilation(
      "struct P { float3 a; bool b; uint64_t c; };\nstruct A { float2 uv; uint id; };\n"
      "[shader(\"closesthit\")] void H(inout P p, in A a) {}\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(compilation.module->entry_points[0].payload_bytes, 24u);
  EXPECT_EQ(compilation.module->entry_points[0].attribute_bytes, 12u);
}

TEST(EntryPoints, AttributesOfReportHitAreMeasured) {
  const Compilation compilation(
      "struct A { float2 uv; uint id; };\n"
      "void Report(float t) { A a = (A)0; ReportHit(t, 0, a); }\n"
      "[shader(\"intersection\")] void I() { Report(RayTMin()); }\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(compilation.module->entry_points[0].attribute_bytes, 12u);
}

TEST(EntryPoints, ComputeInputsInAnyShape) {
  const Compilation compilation(
      "RWByteAddressBuffer results : register(u0);\n"
      "struct In { uint3 group : SV_GroupID; uint index : SV_GroupIndex; };\n"
      "[shader(\"compute\")][numthreads(8, 4, 2)]\n"
      "void main(In i, uint2 id : SV_DispatchThreadID, int t : SV_GroupThreadID) {\n"
      "  results.Store(0, i.group.x + i.index + id.y + t);\n}\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const ir::EntryPoint& entry = compilation.module->entry_points[0];
  EXPECT_EQ(entry.thread_group[0] * 100 + entry.thread_group[1] * 10 + entry.thread_group[2], 842u);
  EXPECT_EQ(entry.parameters,
            (std::vector<ir::EntryParameter>{
                ir::EntryParameter::kGroupId, ir::EntryParameter::kGroupIndex,
                ir::EntryParameter::kDispatchThreadId, ir::EntryParameter::kGroupThreadId}));
}

TEST(Subobjects, AllForms) {
  const Compilation compilation(
      "GlobalRootSignature g = { \"UAV(u0)\" };\nLocalRootSignature l = { \"CBV(b0)\" };\n"
      "SubobjectToExportsAssociation a = { \"l\", \"Hit;Miss\" };\n"
      "RaytracingShaderConfig s = { 16, 8 };\nRaytracingPipelineConfig p = { 2 };\n"
      "RaytracingPipelineConfig1 q = { 3, RAYTRACING_PIPELINE_FLAG_SKIP_TRIANGLES };\n"
      "TriangleHitGroup t = { \"\", \"Hit\" };\n"
      "ProceduralPrimitiveHitGroup b = { \"Any\", \"Hit\", \"Box\" };\n"
      "StateObjectConfig c = { STATE_OBJECT_FLAGS_ALLOW_LOCAL_DEPENDENCIES_ON_EXTERNAL_DEFINITONS "
      "};\n");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const auto& all = compilation.module->subobjects;
  ASSERT_EQ(all.size(), 9u);
  const uint32_t types[] = {1, 2, 8, 9, 10, 12, 11, 11, 0};
  for (size_t i = 0; i < 9; ++i) EXPECT_EQ(all[i].type, types[i]) << all[i].name;
  EXPECT_EQ(all[2].strings, (std::vector<std::string>{"l", "Hit;Miss"}));
  EXPECT_EQ(all[3].values, (std::vector<uint32_t>{16, 8}));
  EXPECT_EQ(all[5].values, (std::vector<uint32_t>{3, 0x100}));
  EXPECT_EQ(all[7].strings[2], "Box");
  EXPECT_EQ(all[7].values, std::vector<uint32_t>{1});
}

TEST(Speed, MostlyDeadLibrary) {
  // 10,000 lines, almost all of them dead: bodies that nothing reaches must cost no more than
  // parsing.
  std::string text;
  for (int i = 0; i < 1600; ++i) {
    const std::string n = std::to_string(i);
    text += "struct S" + n + " { float3 a; uint b; };\nfloat f" + n + "(S" + n +
            " s, float x) {\n  float y = s.a.x * x + s.b;\n  return y > 1 ? sin(y) : cos(y);\n}\n";
  }
  const Compilation compilation(text + kernel("S7 s = (S7)0; results.Store(0, asuint(f7(s, 1)));"));
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
}

// DXC accepts these with a warning, so strict mode does, too.
TEST(CheckStrict, RefusesNothingThatDxcTakes) {
  using Id = DiagnosticId;
  FrontendOptions options;
  options.strict = true;
  const std::pair<Id, std::string> accepted[] = {
      {Id::kConstWithoutStatic, kernel("results.Store(0, k);", "const uint k = 1;")},
      {Id::kMulShape, kernel("float4 a = 1;\nresults.Store(0, mul(a, (float3x3)1).x);")},
      {Id::kFloatBecomesInfinite, kernel("results.Store(0, asuint(1e39f));")}};
  for (const auto& [id, text] : accepted) {
    const Compilation compilation(text, options);
    EXPECT_NE(compilation.module, nullptr) << compilation.messages();
    EXPECT_TRUE(compilation.has(id)) << compilation.messages();
  }
}

}  // namespace
}  // namespace kaamos::hlsl
