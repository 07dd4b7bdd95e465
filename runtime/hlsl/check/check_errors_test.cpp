// SPDX-License-Identifier: MIT
// Tests what the checker refuses or warns about, with line and column: `@` marks the place.
#include <gtest/gtest.h>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

struct Case {
  const char* name;
  Id id;
  std::string text;  // with an @ before the token that is pointed at; without one, anywhere
  FrontendOptions options = {};
};

FrontendOptions strict() {
  FrontendOptions options;
  options.strict = true;
  return options;
}

FrontendOptions target(const char* name) {
  FrontendOptions options;
  options.target = name;
  return options;
}

FrontendOptions qualifiers(const char* name, bool enabled) {
  FrontendOptions options = target(name);
  options.payload_qualifiers = enabled;
  return options;
}

// A payload struct with these fields, plus shaders; lib_6_7 turns qualifiers on.
std::string payload(const std::string& fields, const std::string& shaders = {}) {
  return "RaytracingAccelerationStructure scene : register(t0);\n"
         "typedef BuiltInTriangleIntersectionAttributes Attributes;\n"
         "struct [raypayload] Inner { int i : read(caller) : write(miss); };\n"
         "struct Plain { int i; };\n"
         "struct [raypayload] Payload {\n" +
         fields + "\n};\n" +
         (shaders.empty() ? "[shader(\"miss\")] void M(inout Payload p) {}\n" : shaders);
}

std::string caller(const std::string& before, const std::string& after) {
  return "[shader(\"raygeneration\")] void R() {\n  RayDesc r = (RayDesc)0;\n  Payload p;\n" +
         before + "TraceRay(scene, 0, 255, 0, 0, 0, r, @p);\n" + after + "}\n";
}

const std::string kRayTypes =
    "struct Payload { float4 color; };\n"
    "typedef BuiltInTriangleIntersectionAttributes Attributes;\n"
    "RaytracingAccelerationStructure scene : register(t0);\n";

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      // Names
      {"UndeclaredName", Id::kUndeclared, kernel("int x = @missing;")},
      {"UndeclaredFunction", Id::kUndeclared, kernel("@nothing(1);")},
      {"UsedBeforeDeclared", Id::kUndeclared,
       "RWByteAddressBuffer r;\n[shader(\"compute\")][numthreads(1,1,1)]\nvoid main() { r.Store(0, "
       "@late); }\nstatic const uint late = 1;\n"},
      {"NoSuchMemberOfNamespace", Id::kUndeclared, kernel("int x = n::@y;", "namespace n {}")},
      {"LocalRedefined", Id::kRedefinition, kernel("int a;\nfloat @a;")},
      {"GlobalRedefined", Id::kRedefinition, kernel("", "static int g;\nstatic float @g;")},
      {"FieldRedefined", Id::kRedefinition, kernel("", "struct S { int a; int @a; };")},
      {"AliasRedefined", Id::kRedefinition, kernel("", "typedef int A;\nstatic A @A;")},
      {"MethodLikeItsStruct", Id::kRedefinition, kernel("", "struct S { void @S() {} };")},
      {"TwoValuesLikeAStruct", Id::kRedefinition,
       kernel("", "struct S { int a; };\nstatic S S;\nvoid @S() {}")},
      {"NamespaceAsValue", Id::kNotAValue, kernel("int x = 1 + @n;", "namespace n {}")},
      {"FunctionAsValue", Id::kFunctionValue, kernel("int x = @f;", "int f() { return 1; }")},
      {"ThisOutside", Id::kThisOutside, kernel("int x = @this.y;")},
      // Types
      {"VoidVariable", Id::kVoidVariable, kernel("void @x;")},
      {"NativeSixteenBit", Id::kNeeds16Bit, kernel("@float16_t h = 1;")},
      {"ZeroArray", Id::kArraySize, kernel("int a[@0];")},
      {"HugeArray", Id::kArraySize, kernel("int a[@1000000000];")},
      {"HugeNestedArray", Id::kArraySize, kernel("int a[@65536][65536];")},
      {"ArraySizeNotConstant", Id::kNotConstant, kernel("int n = 3;\nint a[@n];")},
      {"ArraySizeIsHeap", Id::kNotConstant, kernel("int a[@ResourceDescriptorHeap];")},
      {"UnboundedParameter", Id::kUnboundedVariable,
       kernel("", "struct R { Buffer<int> b; };\nvoid f(R @a[]) {}")},
      {"UnboundedOut", Id::kUnboundedVariable, kernel("", "void f(out Buffer<int> @a[]) {}")},
      {"OwnInitialiser", Id::kOwnInitialiser, kernel("int @x = x + 1;")},
      {"UnboundedLocal", Id::kUnboundedVariable, kernel("int @a[];")},
      {"IncompleteStruct", Id::kIncomplete, kernel("S @s;", "struct S;")},
      {"StructHoldsItself", Id::kIncomplete, kernel("", "struct S { S @s; };")},
      {"VectorOfFive", Id::kVectorSize, kernel("vector<float, @5> v;")},
      {"VectorOfFiveInOldModel", Id::kVectorSize, kernel("vector<float, @5> v;"),
       target("lib_6_8")},
      {"VectorOfTooMany", Id::kVectorSize, kernel("vector<float, @1025> v;"), target("lib_6_9")},
      {"VectorOfNone", Id::kVectorSize, kernel("vector<float, @0> v;"), target("lib_6_9")},
      {"MatrixOfFive", Id::kVectorSize, kernel("matrix<float, 4, @5> m;"), target("lib_6_9")},
      {"LongSwizzle", Id::kLongSwizzle, kernel("vector<double, 5> v = 0;\nv.@x = 1;"),
       target("lib_6_9")},
      {"LongSwizzleOfCast", Id::kLongSwizzle,
       kernel("int a[5] = {1, 2, 3, 4, 5};\nint2 v = ((vector<int, 5>)a).@xy;"), target("lib_6_9")},
      {"LongIndex", Id::kIndexRange, kernel("vector<float, 5> v = 0;\nfloat x = v[@5];"),
       target("lib_6_9")},
      {"LongTooFewValues", Id::kInitialiserCount, kernel("vector<float, 5> v = @{1, 2, 3, 4};"),
       target("lib_6_9")},
      {"LongTruncated", Id::kTruncation,
       kernel("vector<float, 6> v = 0;\nvector<float, 5> w = @v;"), target("lib_6_9")},
      {"LongGlobal", Id::kLongVectorPlace, kernel("", "vector<float, 5> @v;"), target("lib_6_9")},
      {"LongGlobalField", Id::kLongVectorPlace,
       kernel("", "struct S { vector<float, 5> v; };\nS @s[2];"), target("lib_6_9")},
      {"LongInBuffer", Id::kLongVectorPlace, kernel("", "cbuffer B { vector<int, 8> @v[2]; };"),
       target("lib_6_9")},
      {"LongInTextureBuffer", Id::kLongVectorPlace, kernel("", "tbuffer B { vector<int, 8> @v; };"),
       target("lib_6_9")},
      {"LongConstantBuffer", Id::kLongVectorPlace,
       kernel("", "struct S { vector<float, 5> v; };\nConstantBuffer<@S> b;"), target("lib_6_9")},
      {"LongTextureBuffer", Id::kLongVectorPlace,
       kernel("", "struct S { vector<float, 5> v; };\nTextureBuffer<@S> b;"), target("lib_6_9")},
      {"LongTexel", Id::kElementType, kernel("", "Buffer<@vector<float, 5> > b;"),
       target("lib_6_9")},
      {"LongPayload", Id::kLongVectorPlace,
       kRayTypes + "struct P { vector<float, 5> v; };\n"
                   "[shader(\"miss\")] void M(inout P @p) {}",
       qualifiers("lib_6_9", false)},
      {"LongAttributes", Id::kLongVectorPlace,
       kRayTypes + "struct A { vector<float, 5> v; };\n"
                   "[shader(\"anyhit\")] void H(inout Payload p, A @a) {}",
       qualifiers("lib_6_9", false)},
      {"LongTracePayload", Id::kLongVectorPlace,
       kRayTypes + "struct B { vector<float, 5> v; };\nstruct P : B { int i; };\n"
                   "[shader(\"raygeneration\")] void R() {\n  RayDesc r = (RayDesc)0;\n"
                   "  P p = (P)0;\n  TraceRay(scene, 0, 255, 0, 0, 0, r, @p);\n}",
       qualifiers("lib_6_9", false)},
      {"LongCallableData", Id::kLongVectorPlace,
       "struct P { vector<float, 5> v; };\n"
       "[shader(\"raygeneration\")] void R() { P p = (P)0; CallShader(0, @p); }",
       target("lib_6_9")},
      {"LongReportedAttributes", Id::kLongVectorPlace,
       "struct P { vector<float, 5> v; };\n"
       "[shader(\"intersection\")] void I() { P p = (P)0; ReportHit(1, 0, @p); }",
       target("lib_6_9")},
      {"LongCross", Id::kLongVectorArgument,
       kernel("vector<float, 5> v = 0;\nfloat3 x = cross(@v, v);"), target("lib_6_9")},
      {"LongLength", Id::kLongVectorArgument,
       kernel("vector<float, 5> v = 0;\nfloat x = length(@v);"), target("lib_6_9")},
      {"LongNormalize", Id::kLongVectorArgument,
       kernel("vector<float, 5> v = 0;\nv = normalize(@v);"), target("lib_6_9")},
      {"LongColor", Id::kLongVectorArgument,
       kernel("vector<float, 5> v = 0;\nint4 x = D3DCOLORtoUBYTE4(@v);"), target("lib_6_9")},
      {"LongAddUint64", Id::kIntrinsicArgument,
       kernel("vector<uint, 8> v = 0;\nv = AddUint64(@v, v);"), target("lib_6_9")},
      {"LongOfStructs", Id::kVectorElement, kernel("struct S { int i; };\nvector<@S, 5> v;"),
       target("lib_6_9")},
      {"TextureOfStruct", Id::kElementType, kernel("", "struct S { int a; };\nTexture2D<@S> t;")},
      {"ConstantBufferOfFloat", Id::kElementType, kernel("", "ConstantBuffer<@float> c;")},
      {"TextureBufferOfFloat", Id::kElementType, kernel("", "TextureBuffer<@float> c;")},
      {"MissingElement", Id::kMissingElement, kernel("", "@RWTexture2D t;")},
      {"RayQueryWithoutFlags", Id::kTemplateCount, kernel("@RayQuery q;")},
      {"RayQueryFlags", Id::kRayQueryFlags, kernel("RayQuery<@0x400> q;")},
      {"RayQueryAssigned", Id::kRayQueryCopy,
       kernel("RayQuery<0> a;\nRayQuery<0> b;\na.Abort();\na = @b;")},
      {"RayQueryAssignedInside", Id::kRayQueryCopy,
       kernel("RayQuery<0> a;\nRayQuery<0> b;\n{ a = @b; }")},
      {"RayQueryOfOtherFlags", Id::kConversion, kernel("RayQuery<0> a;\nRayQuery<1> b = @a;")},
      {"RayQueryArray", Id::kRayQueryPlace, kernel("RayQuery<0> @a[65];")},
      {"RayQueryArrayStatic", Id::kRayQueryPlace, kernel("static RayQuery<0> @a[2];")},
      {"RayQueryArrayOfStruct", Id::kRayQueryPlace, kernel("", "struct S { RayQuery<0> @q[2]; };")},
      {"RayQueryIndexed", Id::kIndexRange, kernel("RayQuery<0> a[2];\na[@2].Abort();")},
      {"RayQueryMember", Id::kRayQueryPlace, kernel("", "struct S { RayQuery<0> @q; };")},
      {"RayQueryGlobal", Id::kRayQueryPlace, kernel("", "RayQuery<0> @q;")},
      {"RayQueryStaticGlobal", Id::kRayQueryPlace, kernel("", "static RayQuery<0> @q;")},
      {"RayQueryMethod", Id::kNoSuchMethod, kernel("RayQuery<0> q;\nq.@Nothing();")},
      {"RayQueryArguments", Id::kArgumentCount, kernel("RayQuery<0> q;\nq.@Proceed(1);")},
      {"ReturnsArray", Id::kReturnsArray, kernel("", "typedef Buffer<int> A[3];\nA @f();")},
      {"ReturnsUnboundedArray", Id::kReturnsArray, kernel("", "int @f()[];")},
      {"TwoBodies", Id::kFunctionRedefined, kernel("", "void f() {}\nvoid @f() {}")},
      {"OnlyReturnTypeDiffers", Id::kReturnTypeDiffers, kernel("", "int f();\nfloat @f();")},
      {"MemberInitialiser", Id::kMemberInitialiser, kernel("", "struct S { int @a = 1; };")},
      {"SelfInitialised", Id::kSelfInitialised, kernel("", "static const int @a = a + 1;")},
      // Expressions
      {"StructToFloat", Id::kConversion,
       kernel("S s = (S)0;\nfloat x = @s;", "struct S { int a; };")},
      {"ShortVectorToLong", Id::kConversion, kernel("float2 a = 0;\nfloat3 b = @a;")},
      {"BadCast", Id::kCast, kernel("float2 a = 0;\nfloat4 b = @(float4)a;")},
      {"TruncationWarning", Id::kTruncation, kernel("float4 a = 1;\nfloat3 b = @a;")},
      {"VoidValue", Id::kVoidValue, kernel("int x = @f();", "void f() {}")},
      {"NoCommonType", Id::kNoCommonType, kernel("float3 a = 0;\nfloat2x2 m = 0;\na = a @+ m;")},
      {"MinusOnStruct", Id::kOperand, kernel("S s = (S)0;\n@-s;", "struct S { int a; };")},
      {"StructPlusInt", Id::kOperands, kernel("S s = (S)0;\ns @+ 1;", "struct S { int a; };")},
      {"BitsOfFloat", Id::kIntegersOnly, kernel("float a = 1;\nuint b = a @& 1;")},
      {"ConstantDividedByZero", Id::kDivisionByZero, kernel("int x = 1 @/ 0;")},
      {"VectorCondition", Id::kConditionType, kernel("float2 a = 1;\nif (@a) {}")},
      {"AssignToValue", Id::kNotAPlace, kernel("int x;\nx + 1 @= 2;")},
      {"AssignToRepeatedSwizzle", Id::kNotAPlace, kernel("float2 v;\nv.xx @= 1;")},
      {"AssignToConst", Id::kConstPlace, kernel("const int x = 1;\nx @= 2;")},
      {"AssignToConstantBuffer", Id::kConstPlace, kernel("a @= 2;", "cbuffer C { int a; };")},
      {"AssignToTextureBuffer", Id::kConstPlace, kernel("a @= 2;", "tbuffer C { int a; };")},
      {"AssignToReadOnlyBuffer", Id::kConstPlace, kernel("b[0] @= 2;", "StructuredBuffer<int> b;")},
      {"BadSwizzle", Id::kSwizzle, kernel("float4 v = 0;\nfloat2 w = v.@xq;")},
      {"MixedSwizzle", Id::kSwizzle, kernel("float4 v = 0;\nfloat2 w = v.@xg;")},
      {"SwizzleOutOfRange", Id::kSwizzleRange, kernel("float2 v = 0;\nfloat w = v.@z;")},
      {"MatrixElementOutOfRange", Id::kSwizzleRange, kernel("float2x2 m = 0;\nfloat w = m.@_m02;")},
      {"NoSuchMember", Id::kNoSuchMember,
       kernel("S s = (S)0;\nint x = s.@b;", "struct S { int a; };")},
      {"IndexOfScalar", Id::kNotIndexable, kernel("int x = 0;\nx@[0];")},
      {"ConstantIndexTooBig", Id::kIndexRange, kernel("int a[3];\na[@3] = 1;")},
      {"NegativeIndex", Id::kIndexRange, kernel("int a[3];\na[@-1] = 1;")},
      {"IndexIsStruct", Id::kIndexType,
       kernel("int a[3];\nS s = (S)0;\na[@s] = 1;", "struct S { int a; };")},
      {"TooFewInitialisers", Id::kInitialiserCount, kernel("float3 v = @{1, 2};")},
      {"TooManyInitialisers", Id::kInitialiserCount, kernel("int a[2] = @{1, 2, 3};")},
      {"TooFewComponents", Id::kConstructorCount, kernel("float3 v = @float3(1, 2);")},
      {"StringValue", Id::kStringUse, kernel("int x = @\"text\";")},
      {"UntypedHeapElement", Id::kHeapUntyped, kernel("ResourceDescriptorHeap@[0].x;")},
      {"HeapElementAsFloat", Id::kHeapType, kernel("float x = ResourceDescriptorHeap@[0];")},
      {"VectorLogicStrict", Id::kVectorLogic, kernel("bool2 a = true;\nbool2 b = a @&& a;"),
       strict()},
      {"ImplicitLevelStrict", Id::kImplicitLevel,
       kernel("t.@Sample(s, 0);", "Texture2D t;\nSamplerState s;"), strict()},
      // Calls
      {"NoOverload", Id::kNoOverload, kernel("@f(1, 2);", "void f(int a) {}")},
      {"AmbiguousCall", Id::kAmbiguousCall,
       kernel("uint u = 1;\n@f(u, u);", "void f(int a, float b) {}\nvoid f(float a, int b) {}")},
      {"OutNeedsPlace", Id::kNotAPlace, kernel("f(@1);", "void f(out int a) { a = 1; }")},
      {"NoSuchMethod", Id::kNoSuchMethod, kernel("S s;\ns.@go();", "struct S { int a; };")},
      {"NoSuchBufferMethod", Id::kNoSuchMethod, kernel("results.@Sample(1);")},
      {"StoreToReadOnly", Id::kNoSuchMethod, kernel("b.@Store(0, 1);", "ByteAddressBuffer b;")},
      {"NoBodyOfStatic", Id::kNoBody, kernel("@f();", "static void f();")},
      {"NoBodyOfMethod", Id::kNoBody, kernel("S s;\ns.@f();", "struct S { int a; void f(); };")},
      {"NoBodyOfTemplate", Id::kNoBody, kernel("@f(1);", "template<typename T> void f(T t);")},
      {"NoBodyOutsideLibraries", Id::kNoBody, kernel("@f();", "void f();"), target("cs_6_6")},
      {"Recursion", Id::kRecursion,
       "RWByteAddressBuffer r;\nint f(int n) { return n < 1 ? 0 : @f(n - 1); }\n"
       "[shader(\"compute\")][numthreads(1,1,1)]\nvoid main() { r.Store(0, f(3)); }\n"},
      {"IntrinsicArgumentCount", Id::kArgumentCount, kernel("float x = @sin(1, 2);")},
      {"IntrinsicArgument", Id::kIntrinsicArgument,
       kernel("float x = determinant(@float2(1, 2));")},
      {"AtomicOnFloat", Id::kAtomicType, kernel("InterlockedAdd(@g, 1);", "groupshared float g;")},
      {"AtomicOnLocal", Id::kAtomicTarget, kernel("int x = 0;\nInterlockedAdd(@x, 1);")},
      {"QuadInRayGeneration", Id::kStage,
       "RWByteAddressBuffer r;\n[shader(\"raygeneration\")]\nvoid main() {\n"
       "  r.Store(0, @QuadReadAcrossX(1u));\n}\n"},
      {"QuadReachedFromMiss", Id::kStage,
       "struct [raypayload] P { uint a : read(caller) : write(miss); };\n"
       "uint other(uint x) { return @QuadReadLaneAt(x, 1); }\n"
       "[shader(\"miss\")]\nvoid main(inout P p) { p.a = other(2); }\n"},
      {"WaveMatchOfAMatrix", Id::kIntrinsicArgument,
       kernel("float2x2 m = 0;\nuint x = WaveMatch(@m).x;")},
      {"WaveOfAStruct", Id::kIntrinsicArgument,
       kernel("S s;\nS t = WaveReadLaneFirst(@s);", "struct S { int a; };")},
      {"WaveOfBits", Id::kIntrinsicArgument, kernel("float x = WaveActiveBitOr(@1.0);")},
      {"WaveMultiPrefixOfBits", Id::kIntrinsicArgument,
       kernel("float x = WaveMultiPrefixBitAnd(@1.0, 1);")},
      {"WaveArguments", Id::kArgumentCount, kernel("uint x = @WaveReadLaneAt(1u);")},
      {"DerivativeWithoutQuads", Id::kNoQuads,
       "RWByteAddressBuffer r;\n"
       "[shader(\"compute\")][numthreads(3, 2, 1)] void main(uint i : SV_GroupIndex) {\n"
       "  r.Store(0, @ddx(i)); }"},
      {"DerivativeInRowsOfRows", Id::kNoQuads,
       "RWByteAddressBuffer r;\n"
       "[shader(\"compute\")][numthreads(4, 3, 1)] void main(uint i : SV_GroupIndex) {\n"
       "  r.Store(0, @fwidth(i)); }"},
      {"AtomicOfFloatTexel", Id::kUnsupported,
       kernel("float x;\nInterlockedCompareExchangeFloatBitwise(t@[uint2(0, 0)], 0.0f, 1.0f, x);",
              "RWTexture2D<float> t : register(u5);")},
      {"QuadOfRays", Id::kStage,
       "[shader(\"raygeneration\")] void main() { uint x = @QuadReadAcrossX(1u); }"},
      {"WaveSizeNoPowerOfTwo", Id::kWaveSize,
       "[shader(\"compute\")][numthreads(1, 1, 1)][WaveSize(@12)] void main() {}"},
      {"WaveSizeTooLarge", Id::kWaveSize,
       "[shader(\"compute\")][numthreads(1, 1, 1)][WaveSize(@256)] void main() {}"},
      {"WaveSizeWithoutValue", Id::kWaveSizeRange,
       "[shader(\"compute\")][numthreads(1, 1, 1)][@WaveSize] void main() {}"},
      {"WaveSizeRangeInOldModel", Id::kWaveShaderModel,
       "[shader(\"compute\")][numthreads(1, 1, 1)][@WaveSize(4, 8)] void main() {}"},
      {"MethodWithoutObject", Id::kMethodWithoutObject,
       kernel("S::@f();", "struct S { void f() {} };")},
      // Templates
      {"TemplateArguments", Id::kTemplateArguments,
       kernel("@P<float, int> p;", "template <typename T> struct P { T a; };")},
      {"TemplateDepth", Id::kTemplateDepth,
       kernel("R<0> r;", "template <int N> struct R { R<N + 1> inner; };")},
      // Statements
      {"StrayBreak", Id::kStrayJump, kernel("@break;")},
      {"StrayContinue", Id::kStrayJump, kernel("switch (1) { case 1: @continue; }")},
      {"SwitchOnFloat", Id::kSwitchType, kernel("float x = 1;\nswitch (@x) { case 1: break; }")},
      {"DuplicateCase", Id::kDuplicateCase,
       kernel("int x = 1;\nswitch (x) { case 1: break; @case 1: break; }")},
      {"UnrollNegative", Id::kNotConstant, kernel("[unroll(@-1)] for (int i = 0; i < 3; ++i);")},
      {"UnrollNotConstant", Id::kNotConstant,
       kernel("int x = 1;\n[unroll(@x)] for (int i = 0; i < 3; ++i);")},
      {"CaseNotConstant", Id::kNotConstant, kernel("int x = 1;\nswitch (x) { case @x: break; }")},
      {"VoidReturnsValue", Id::kReturnsValue, kernel("@return 1;")},
      {"ReturnsNothing", Id::kReturnsNothing, kernel("f();", "int f() { @return; }")},
      {"MissingReturn", Id::kMissingReturn, kernel("f(1);", "int f(int x) { if (x) return 1; @}")},
      // Bindings
      {"WrongRegisterClass", Id::kRegisterClass, kernel("", "Texture2D t : register(@u1);")},
      {"PackOffsetStraddles", Id::kPackOffset,
       kernel("", "cbuffer C { float3 a : packoffset(@c0.z); };")},
      {"Overlap", Id::kOverlap,
       "RWByteAddressBuffer a : register(u0, space1);\n"
       "RWStructuredBuffer<int> @b[2] : register(u0, space1);\n"
       "[shader(\"raygeneration\")] void R() { a.Store(0, 1); b[1][0] = 1; }"},
      // Entry points
      {"UnknownStage", Id::kShaderAttribute, kernel("", "[@shader(\"hit\")] void h() {}")},
      {"RayGenerationParameters", Id::kEntryParameters,
       "[shader(\"raygeneration\")] void @R(int x) {}"},
      {"MissNeedsPayload", Id::kEntryParameters, "[shader(\"miss\")] void @M() {}"},
      {"PayloadIsScalar", Id::kEntryStruct, "[shader(\"miss\")] void M(inout float @p) {}"},
      {"PayloadNotInout", Id::kEntryModifier,
       kRayTypes + "[shader(\"miss\")] void M(Payload @p) {}"},
      {"AttributesAreOut", Id::kEntryModifier,
       kRayTypes + "[shader(\"closesthit\")] void H(inout Payload p, inout Attributes @a) {}"},
      {"AttributesTooBig", Id::kAttributeSize,
       kRayTypes + "struct Big { float4 a; float4 b; float c; };\n"
                   "[shader(\"anyhit\")] void H(inout Payload p, Big @a) {}"},
      {"EntryReturnsValue", Id::kEntryResult, "[shader(\"raygeneration\")] int @R() { return 1; }"},
      {"NoThreadGroup", Id::kNoThreadGroup, "[shader(\"compute\")] void @main() {}"},
      {"ThreadGroupTooBig", Id::kThreadGroup,
       "[shader(\"compute\")][numthreads(1, 1, @65)] void main() {}"},
      {"ThreadGroupProduct", Id::kThreadGroup,
       "[shader(\"compute\")][@numthreads(64, 64, 1)] void main() {}"},
      {"MissingSemantic", Id::kMissingSemantic,
       "[shader(\"compute\")][numthreads(1, 1, 1)] void main(uint3 @id) {}"},
      {"UnknownSemantic", Id::kUnknownSemantic,
       "[shader(\"compute\")][numthreads(1, 1, 1)] void main(uint3 id : @SV_Position) {}"},
      {"SemanticType", Id::kSemanticType,
       "[shader(\"compute\")][numthreads(1, 1, 1)] void main(float3 @id : SV_GroupID) {}"},
      {"NoEntryPoint", Id::kNoEntryPoint, "void f() {}", target("cs_6_6")},
      {"UnknownTarget", Id::kUnknownTarget, "void f() {}", target("hs_6_6")},
      {"UnknownMinor", Id::kUnknownTarget, "void f() {}", target("lib_6_11")},
      {"ExperimentalTarget", Id::kExperimentalTarget, "void f() {}", target("lib_6_10")},
      {"ExperimentalPixelTarget", Id::kExperimentalTarget, "void f() {}", target("ps_6_10")},
      {"UnknownTargetAfterIt", Id::kUnknownTarget, "void f() {}", target("lib_6_11")},
      {"TraceRayFromAnyHit", Id::kStage,
       kRayTypes + "[shader(\"anyhit\")] void H(inout Payload p, Attributes a) {\n"
                   "  RayDesc r = (RayDesc)0;\n  @TraceRay(scene, 0, 255, 0, 0, 0, r, p);\n}"},
      {"IgnoreHitInHelperOfMiss", Id::kStage,
       kRayTypes +
           "void f() { @IgnoreHit(); }\n[shader(\"miss\")] void M(inout Payload p) { f(); }"},
      {"HitKindInRayGeneration", Id::kStage,
       "[shader(\"raygeneration\")] void R() { uint k = @HitKind(); }"},
      {"DerivativeInCompute", Id::kNoQuads, kernel("float x = @ddx(1.0);")},
      {"BarrierInRayGeneration", Id::kStage,
       "[shader(\"raygeneration\")] void R() { @GroupMemoryBarrierWithGroupSync(); }"},
      {"DispatchRaysIndexInCompute", Id::kStage, kernel("uint3 i = @DispatchRaysIndex();")},
      {"ReportHitAttributes", Id::kUserStruct,
       "[shader(\"intersection\")] void I() { ReportHit(1, 0, @1.0f); }"},
      {"PayloadOfTraceRay", Id::kUserStruct,
       kRayTypes +
           "[shader(\"raygeneration\")] void R() {\n  RayDesc r = (RayDesc)0;\n  float x = 0;"
           "\n  TraceRay(scene, 0, 255, 0, 0, 0, r, @x);\n}"},
      {"PayloadQualifiers", Id::kPayloadQualifiers,
       kRayTypes + "[shader(\"miss\")] void M(inout Payload @p) {}", target("lib_6_7")},
      {"PayloadQualifiersOfTrace", Id::kPayloadQualifiers,
       kRayTypes + "[shader(\"raygeneration\")] void R() {\n  RayDesc r = (RayDesc)0;\n"
                   "  Payload p;\n  TraceRay(scene, 0, 255, 0, 0, 0, r, @p);\n}",
       target("lib_6_8")},
      {"PayloadQualifiersNeeded", Id::kPayloadUnqualified,
       kRayTypes + "[shader(\"miss\")] void M(inout Payload @p) {}", target("lib_6_9")},
      {"PayloadQualifiersEnabled", Id::kPayloadQualifiers,
       kRayTypes + "[shader(\"miss\")] void M(inout Payload @p) {}", qualifiers("lib_6_6", true)},
      {"PayloadTarget", Id::kPayloadTarget, payload("int a : read() : write();"),
       qualifiers("lib_6_5", true)},
      {"PayloadIgnored", Id::kPayloadIgnored,
       "struct [raypayload] @P { int a : read() : write(); };\n"
       "[shader(\"miss\")] void M(inout P p) {}",
       target("lib_6_6")},
      {"PayloadDisabled", Id::kPayloadIgnored,
       "[raypayload] struct @P { int a : read() : write(); };\n"
       "[shader(\"miss\")] void M(inout P p) {}",
       qualifiers("lib_6_7", false)},
      {"PayloadFieldPlain", Id::kPayloadFieldPlain, payload("int @a;"), target("lib_6_7")},
      {"PayloadFieldOfPlainStruct", Id::kPayloadFieldPlain, payload("Plain @a;"),
       target("lib_6_7")},
      {"PayloadNested", Id::kPayloadNested, payload("Inner a : @read(caller) : write(miss);"),
       target("lib_6_7")},
      {"PayloadTwice", Id::kPayloadTwice,
       payload("int a : read(caller) : write(miss) : @read(miss);"), target("lib_6_7")},
      {"PayloadStage", Id::kPayloadStage,
       payload("int a : read(caller, @intersection) : write(miss);"), target("lib_6_7")},
      {"PayloadNoWrite", Id::kPayloadMissing, payload("int @a : read(caller);"), target("lib_6_7")},
      {"PayloadNoRead", Id::kPayloadMissing, payload("int @a : write(caller);"), target("lib_6_7")},
      {"PayloadReadOfMiss", Id::kPayloadProducer,
       payload("int a : read(caller, @miss) : write(closesthit);"), target("lib_6_7")},
      {"PayloadReadOfAnyHit", Id::kPayloadProducer,
       payload("int a : read(@anyhit, caller) : write(closesthit, miss);"), target("lib_6_7")},
      {"PayloadReadOfCaller", Id::kPayloadProducer, payload("int a : read(@caller) : write();"),
       target("lib_6_7")},
      {"PayloadWriteOfMiss", Id::kPayloadConsumer,
       payload("int a : read(closesthit) : write(caller, @miss);"), target("lib_6_7")},
      {"PayloadWriteOfCaller", Id::kPayloadConsumer, payload("int a : read() : write(@caller);"),
       target("lib_6_7")},
      {"PayloadBase", Id::kPayloadBase,
       "struct B { int b; };\n"
       "struct [raypayload] @P : B { int a : read(caller) : write(miss); };\n"
       "[shader(\"miss\")] void M(inout P p) {}",
       target("lib_6_7")},
      {"PayloadUndefined", Id::kPayloadUndefined,
       payload("int a : read(caller) : write(miss);",
               "[shader(\"miss\")] void M(inout Payload p) {\n  int x = 2 + p.@a;\n  p.a = x;\n}"),
       target("lib_6_7")},
      {"PayloadUndefinedOnOnePath", Id::kPayloadUndefined,
       payload("int a : read(caller) : write(miss);\nint b : read(miss) : write(caller);",
               "[shader(\"miss\")] void M(inout Payload p) {\n  if (p.b > 0) p.a = 1;\n"
               "  if (p.@a == 1) p.a = 2;\n}"),
       target("lib_6_7")},
      {"PayloadUndefinedInFunction", Id::kPayloadUndefined,
       payload("int a : read(caller) : write(miss, anyhit);",
               "int twice(in Payload q) { return 2 * q.@a; }\n"
               "[shader(\"miss\")] void M(inout Payload p) { p.a = twice(p); }"),
       target("lib_6_7")},
      {"PayloadUndefinedInLoop", Id::kPayloadUndefined,
       payload("int a : read(caller) : write(caller);\nint b : read(miss) : write(caller);",
               "[shader(\"miss\")] void M(inout Payload p) {\n"
               "  for (int i = 0; i < p.b; ++i) { if (p.b == 2) break; p.a = 1; }\n"
               "  int x = p.@a;\n}"),
       target("lib_6_7")},
      {"PayloadDropped", Id::kPayloadDropped,
       payload("int a : read(miss) : write(caller);",
               "[shader(\"miss\")] void M(inout Payload p) {\n  p.@a = 1;\n}"),
       target("lib_6_7")},
      {"PayloadDroppedElement", Id::kPayloadDropped,
       payload("int a[3] : read(miss) : write(caller);",
               "void set(inout Payload q) { q.@a[2] += 1; }\n"
               "[shader(\"miss\")] void M(inout Payload p) { set(p); }"),
       target("lib_6_7")},
      {"PayloadDroppedNested", Id::kPayloadDropped,
       payload("Inner inner;",
               "[shader(\"closesthit\")] void C(inout Payload p, Attributes a) {\n"
               "  p.inner.@i = 1;\n}"),
       target("lib_6_7")},
      {"PayloadNotReturned", Id::kPayloadNotReturned,
       payload("int a : read(miss) : write(caller);",
               "[shader(\"raygeneration\")] void R() {\n  RayDesc r = (RayDesc)0;\n"
               "  Payload p;\n  p.a = 1;\n  TraceRay(scene, 0, 255, 0, 0, 0, r, p);\n"
               "  int x = p.@a;\n}"),
       target("lib_6_7")},
      {"PayloadNotPassed", Id::kPayloadNotPassed,
       payload("int a : read(caller) : write(miss);", caller("p.a = 1;\n", "")), target("lib_6_7")},
      {"PayloadDataLoss", Id::kPayloadDataLoss,
       payload("int a : read(caller) : write(caller, miss);\nint b : read(miss) : write(caller);",
               "[shader(\"miss\")] void M(inout Payload @p) { if (p.b == 1) p.a = 1; }"),
       target("lib_6_7")},
      {"DuplicateEntry", Id::kDuplicateExport,
       kRayTypes + "[shader(\"miss\")] void M(inout Payload p) {}\n"
                   "[shader(\"raygeneration\")] void @M() {}"},
      {"LinearAlgebraType", Id::kUnsupported, kernel("@dx::linalg::Matrix<1, 2> m;"),
       target("lib_6_9")},
      {"LinearAlgebraNamespace", Id::kUnsupported, kernel("", "using namespace @linalg::inner;"),
       target("lib_6_9")},
      {"LinearAlgebraFunction", Id::kUnsupported,
       kernel("vector<float, 4> v = 0;\n@__builtin_LinAlg_FillMatrix(v, 1);"), target("lib_6_9")},
      {"NodeShader", Id::kSkippedStage,
       kernel("", "[@shader(\"node\")] [NodeLaunch(\"thread\")] void N() {}"), target("lib_6_9")},
      {"NodeShaderFunction", Id::kUnsupported, kernel("@GetRemainingRecursionLevels();"),
       target("lib_6_9")},
      {"SkippedFunction", Id::kSkipped, kernel("", "void @unused() { undeclared(); }")},
      // Subobjects
      {"SubobjectCount", Id::kSubobjectCount, "RaytracingShaderConfig @c = { 16 };"},
      {"SubobjectString", Id::kSubobjectString, "TriangleHitGroup g = { \"a\", @1 };"},
      {"SubobjectRange", Id::kSubobjectRange, "RaytracingPipelineConfig p = { @32 };"},
  };
  return all;
}

class CheckErrors : public testing::TestWithParam<size_t> {};

TEST_P(CheckErrors, StandsAtTheMark) {
  const Case& one = cases()[GetParam()];
  expect_at_mark(one.id, one.text, one.options);
}

INSTANTIATE_TEST_SUITE_P(All, CheckErrors, testing::Range<size_t>(0, cases().size()),
                         [](const testing::TestParamInfo<size_t>& one) {
                           return std::string(cases()[one.param].name);
                         });

std::string payload_messages(const std::string& fields, const std::string& shaders) {
  const Compilation compilation(payload(fields, shaders), target("lib_6_7"));
  EXPECT_NE(compilation.module, nullptr);
  return compilation.messages();
}

TEST(CheckPayloads, NoWarningWhereEveryPathHasAValue) {
  const std::string fields =
      "int a : read(caller) : write(miss, closesthit);\n"
      "int b : read(miss, closesthit) : write(caller);\n"
      "int c : read() : write();\nInner inner;";
  EXPECT_EQ(payload_messages(fields,

                             "[shader(\"miss\")] void M(inout Payload p) {\n"
                             "  if (p.b > 1) p.a = 2; else p.a = 3;\n  p.a = p.a + p.b;\n"
                             "  switch (p.a) { case 1: p.inner.i = 2; break;\n"
                             "    default: p.inner.i = 3; }\n  p.a += p.inner.i;\n}\n"),
            "");
  EXPECT_EQ(payload_messages(fields,
                             "[shader(\"raygeneration\")] void R() {\n"
                             "  RayDesc r = (RayDesc)0;\n  Payload p = (Payload)0;\n  p.b = 4;\n"
                             "  TraceRay(scene, 0, 255, 0, 0, 0, r, p);\n  p.b = p.a;\n"
                             "  p.b += p.inner.i;\n}\n"),
            "");
}

// A closest-hit shader's write to its copy matters if it passes the payload on.
TEST(CheckPayloads, AWriteForANestedTraceIsNotDropped) {
  EXPECT_EQ(payload_messages("int a : read(miss, caller) : write(caller, miss);",
                             "[shader(\"closesthit\")]\n"
                             "void C(inout Payload p, Attributes a) {\n"
                             "  RayDesc r = (RayDesc)0;\n  p.a = 4;\n"
                             "  TraceRay(scene, 0, 255, 0, 0, 0, r, p);\n}\n"),
            "");
}

TEST(CheckPayloads, AnnotationsWithoutEffectBelow67) {
  for (const char* name : {"lib_6_3", "lib_6_6"}) {
    const Compilation compilation(payload("int a;"), target(name));
    EXPECT_NE(compilation.module, nullptr) << compilation.messages();
    EXPECT_TRUE(compilation.has(Id::kPayloadIgnored));
  }
  const Compilation enabled(payload("int a : read(caller) : write(miss);"),
                            qualifiers("lib_6_6", true));
  EXPECT_NE(enabled.module, nullptr) << enabled.messages();
  EXPECT_FALSE(enabled.has(Id::kPayloadIgnored));
  EXPECT_TRUE(
      Compilation(payload("int a;"), qualifiers("lib_6_6", true)).has(Id::kPayloadFieldPlain));
}

TEST(CheckPayloads, TwoNamesOfOneShaderShareItsWorkingCopy) {
  FrontendOptions options = target("lib_6_7");
  options.exports = "A,B=M";
  const Compilation compilation(payload("int a : read(caller) : write(miss);"), options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  ASSERT_EQ(compilation.module->entry_points.size(), 2u);
  EXPECT_EQ(compilation.module->entry_points[0].function,
            compilation.module->entry_points[1].function);
}

TEST(CheckMessages, StageErrorNamesStageAndEntryPoint) {
  const Compilation compilation(
      "void helper() { IgnoreHit(); }\nstruct P { int a; };\n"
      "[shader(\"miss\")] void Sky(inout P p) { helper(); }");
  EXPECT_NE(compilation.messages().find("KA2576"), std::string::npos) << compilation.messages();
  EXPECT_NE(compilation.messages().find("miss shader 'Sky'"), std::string::npos)
      << compilation.messages();
}

TEST(CheckMessages, AmbiguityListsCandidates) {
  const Compilation compilation(
      kernel("uint u = 1; f(u, u);", "void f(int a, float b) {}\nvoid f(float a, int b) {}"));
  EXPECT_NE(compilation.messages().find("candidate: void f(int, float)"), std::string::npos);
  EXPECT_NE(compilation.messages().find("candidate: void f(float, int)"), std::string::npos);
}

TEST(CheckMessages, SuggestsSimilarNames) {
  const Compilation compilation(
      kernel("uint counter = 1;\nresults.Store(0, countr);\nfloat x = normalise(1.0);\n"
             "S s = (S)0;\ns.colour = 1;",
             "struct S { float color; };"));
  EXPECT_NE(compilation.messages().find("did you mean 'counter'?"), std::string::npos);
  EXPECT_NE(compilation.messages().find("did you mean 'normalize'?"), std::string::npos);
  EXPECT_NE(compilation.messages().find("did you mean 'color'?"), std::string::npos);
}

TEST(CheckMessages, SeveralErrorsInOneRun) {
  const Compilation compilation(kernel("int a = missing1;\nint b = missing2;\nfloat2 c = 1.zz;"));
  EXPECT_GE(compilation.diagnostics().size(), 3u) << compilation.messages();
}

TEST(CheckMessages, UnreachedBodiesAreNotChecked) {
  const Compilation compilation(
      kernel("", "void a() { nonsense(); }\nvoid b() { WaveGetLaneIndex(); }"));
  EXPECT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_NE(compilation.messages().find("2 function(s)"), std::string::npos);
  EXPECT_NE(compilation.messages().find("a, b"), std::string::npos);
}

}  // namespace
}  // namespace kaamos::hlsl
