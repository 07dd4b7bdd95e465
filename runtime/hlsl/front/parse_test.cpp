// SPDX-License-Identifier: MIT
// Tests each construct of the language by the dump of its tree.
#include "runtime/hlsl/front/parse.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/front/parse_test_support.h"

namespace kaamos::hlsl::test {
namespace {

// ---- Expressions

TEST(ParseExpression, Literals) {
  EXPECT_EQ(dump_expression("1"), "1");
  EXPECT_EQ(dump_expression("0x10u"), "16u");
  EXPECT_EQ(dump_expression("5l"), "5l");
  EXPECT_EQ(dump_expression("5ull"), "5ul");
  EXPECT_EQ(dump_expression("1.5"), "1.5");
  EXPECT_EQ(dump_expression("1.5f"), "1.5f");
  EXPECT_EQ(dump_expression("2.h"), "2.0h");
  EXPECT_EQ(dump_expression("1e3"), "1000.0");
  EXPECT_EQ(dump_expression("true"), "true");
  EXPECT_EQ(dump_expression("\"a\" \"b\""), "\"ab\"");
}

TEST(ParseExpression, PrecedenceFromCommaToMultiplication) {
  EXPECT_EQ(dump_expression("a + b * c"), "(+ a (* b c))");
  EXPECT_EQ(dump_expression("a * b + c"), "(+ (* a b) c)");
  EXPECT_EQ(dump_expression("a - b - c"), "(- (- a b) c)");
  EXPECT_EQ(dump_expression("a / b % c"), "(% (/ a b) c)");
  EXPECT_EQ(dump_expression("a << b + c"), "(<< a (+ b c))");
  EXPECT_EQ(dump_expression("a < b << c"), "(< a (<< b c))");
  EXPECT_EQ(dump_expression("a == b < c"), "(== a (< b c))");
  EXPECT_EQ(dump_expression("a & b == c"), "(& a (== b c))");
  EXPECT_EQ(dump_expression("a ^ b & c"), "(^ a (& b c))");
  EXPECT_EQ(dump_expression("a | b ^ c"), "(| a (^ b c))");
  EXPECT_EQ(dump_expression("a && b | c"), "(&& a (| b c))");
  EXPECT_EQ(dump_expression("a || b && c"), "(|| a (&& b c))");
  EXPECT_EQ(dump_expression("a ? b : c || d"), "(? a b (|| c d))");
  EXPECT_EQ(dump_expression("a >= b != c <= d"), "(!= (>= a b) (<= c d))");
  EXPECT_EQ(dump_expression("a >> b > c"), "(> (>> a b) c)");
  EXPECT_EQ(dump_statements("a = b, c;"), "(, (= a b) c)\n");
}

TEST(ParseExpression, ConditionalNestsToTheRight) {
  EXPECT_EQ(dump_expression("a ? b : c ? d : e"), "(? a b (? c d e))");
  EXPECT_EQ(dump_expression("a ? b ? c : d : e"), "(? a (? b c d) e)");
  EXPECT_EQ(dump_expression("a ? b = c : d"), "(? a (= b c) d)");
}

TEST(ParseExpression, AssignmentOperators) {
  EXPECT_EQ(dump_statements("a = b = c;"), "(= a (= b c))\n");
  EXPECT_EQ(dump_statements("a += 1; a -= 1; a *= 1; a /= 1; a %= 1;"),
            "(+= a 1)\n(-= a 1)\n(*= a 1)\n(/= a 1)\n(%= a 1)\n");
  EXPECT_EQ(dump_statements("a <<= 1; a >>= 1; a &= 1; a |= 1; a ^= 1;"),
            "(<<= a 1)\n(>>= a 1)\n(&= a 1)\n(|= a 1)\n(^= a 1)\n");
}

TEST(ParseExpression, PrefixAndPostfix) {
  EXPECT_EQ(dump_expression("-a * !b"), "(* (- a) (! b))");
  EXPECT_EQ(dump_expression("- -a"), "(- (- a))");
  EXPECT_EQ(dump_expression("~a + +b"), "(+ (~ a) (+ b))");
  EXPECT_EQ(dump_expression("++a + b--"), "(+ (++ a) (post-- b))");
  EXPECT_EQ(dump_expression("-a.x[0]"), "(- ([] (. a x) 0))");
}

TEST(ParseExpression, MembersCallsAndIndices) {
  EXPECT_EQ(dump_expression("a.b.xyz"), "(. (. a b) xyz)");
  EXPECT_EQ(dump_expression("f(a, b + c)"), "(call f a (+ b c))");
  EXPECT_EQ(dump_expression("f()"), "(call f)");
  EXPECT_EQ(dump_expression("a.Load(b).x"), "(. (call (. a Load) b) x)");
  EXPECT_EQ(dump_expression("m[i][j]._m00"), "(. ([] ([] m i) j) _m00)");
  EXPECT_EQ(dump_expression("1.0.xxx"), "(. 1.0 xxx)");
  EXPECT_EQ(dump_expression("(a, b)"), "(, a b)");
  EXPECT_EQ(dump_expression("t.mips[2][p]"), "([] ([] (. t mips) 2) p)");
}

TEST(ParseExpression, ScopesAndThis) {
  EXPECT_EQ(dump_expression("a::b::c"), "a::b::c");
  EXPECT_EQ(dump_expression("::a"), "::a");
  EXPECT_EQ(dump_expression("::ns::f(1)"), "(call ::ns::f 1)");
  EXPECT_EQ(dump_expression("this.x"), "(. this x)");
  EXPECT_EQ(dump_expression("a.Base::f()", "struct Base {};"), "(call (. a Base::f))");
}

TEST(ParseExpression, CastsNeedATypeInParentheses) {
  const char* types = "struct S { float a; }; namespace n { struct T {}; }";
  EXPECT_EQ(dump_expression("(float3)a"), "(cast float3 a)");
  EXPECT_EQ(dump_expression("(float)a * b"), "(* (cast float a) b)");
  EXPECT_EQ(dump_expression("(int)-a"), "(cast int (- a))");
  EXPECT_EQ(dump_expression("(S)0", types), "(cast S 0)");
  EXPECT_EQ(dump_expression("(n::T)0", types), "(cast n::T 0)");
  EXPECT_EQ(dump_expression("(float[2])a"), "(cast float[2] a)");
  EXPECT_EQ(dump_expression("(const row_major float3x3)a"), "(cast const row_major float3x3 a)");
  EXPECT_EQ(dump_expression("(unsigned int)a"), "(cast uint a)");
  EXPECT_EQ(dump_expression("(float3)(a)"), "(cast float3 a)");
  EXPECT_EQ(dump_expression("(a) - b"), "(- a b)");
  EXPECT_EQ(dump_expression("(a)(b)", "struct b {};").substr(0, 9), "test.hlsl");
}

TEST(ParseExpression, Construction) {
  EXPECT_EQ(dump_expression("float3(1, a.xy)"), "(new float3 1 (. a xy))");
  EXPECT_EQ(dump_expression("S(1)", "struct S { int a; };"), "(new S 1)");
  EXPECT_EQ(dump_expression("vector<float, 3>(0)"), "(new vector<float, =3> 0)");
  EXPECT_EQ(dump_expression("float3x3(a, b, c)[0]"), "([] (new float3x3 a b c) 0)");
  EXPECT_EQ(dump_expression("uint(1) < uint(2)"), "(< (new uint 1) (new uint 2))");
}

TEST(ParseExpression, SizeofTakesATypeOrAnExpression) {
  EXPECT_EQ(dump_expression("sizeof(float3)"), "(sizeof float3)");
  EXPECT_EQ(dump_expression("sizeof(S[2])", "struct S {};"), "(sizeof S[2])");
  EXPECT_EQ(dump_expression("sizeof(a.b) * 2"), "(* (sizeof (. a b)) 2)");
  EXPECT_EQ(dump_expression("sizeof a"), "(sizeof a)");
}

TEST(ParseExpression, InitializerLists) {
  EXPECT_EQ(dump_expression("{1, {2, 3}, float2(4, 5)}"), "{1, {2, 3}, (new float2 4 5)}");
  EXPECT_EQ(dump_expression("{1, 2,}"), "{1, 2}");
  EXPECT_EQ(dump_expression("{}"), "{}");
  EXPECT_EQ(dump_statements("a = {1}; return {2};"), "(= a {1})\nreturn {2}\n");
}

// ---- `<`: less than, or template arguments

TEST(ParseTemplateArguments, LessThanWhereTheNameIsNoTemplate) {
  EXPECT_EQ(dump_expression("a < b"), "(< a b)");
  EXPECT_EQ(dump_expression("f(a < b, c > (d))"), "(call f (< a b) (> c d))");
  EXPECT_EQ(dump_expression("a.x < float(b) && c > d"), "(&& (< (. a x) (new float b)) (> c d))");
  EXPECT_EQ(dump_expression("i < 3 ? a : b"), "(? (< i 3) a b)");
}

TEST(ParseTemplateArguments, CallsOfTemplates) {
  const char* sum = "template<typename T, int N> T sum(T v) { return v; }";
  EXPECT_EQ(dump_expression("sum<float, 3>(a)", sum), "(call sum<float, =3> a)");
  EXPECT_EQ(dump_expression("sum<float, (1 > 2)>(a)", sum), "(call sum<float, =(> 1 2)> a)");
  EXPECT_EQ(dump_expression("buffer.Load<float4>(0)"), "(call (. buffer Load<float4>) 0)");
  EXPECT_EQ(dump_expression("b.get<3>()", "struct S { template<int N> int get() { return N; } };"),
            "(call (. b get<=3>))");
  EXPECT_EQ(dump_expression("ns::f<float>(a)", "namespace ns { template<class T> T f(T a); }"),
            "(call ns::f<float> a)");
}

TEST(ParseTemplateArguments, TwoAndThreeClosingAngles) {
  const char* box = "template<typename T> struct Box { T value; static T make(); };";
  EXPECT_EQ(dump_expression("Box<Box<float>>(a)", box), "(new Box<Box<float>> a)");
  EXPECT_EQ(dump_expression("(Box<Box<Box<int>>>)0", box), "(cast Box<Box<Box<int>>> 0)");
  EXPECT_EQ(dump_expression("Box<Box<float>>::make()", box), "(call Box<Box<float>>::make)");
  EXPECT_EQ(dump_unit("StructuredBuffer<vector<float, 3>> b;"),
            "var StructuredBuffer<vector<float, =3>> b\n");
  EXPECT_EQ(dump_unit("Texture2D<vector<float, 4> >t[];"),
            "var Texture2D<vector<float, =4>>[] t\n");
  EXPECT_EQ(dump_unit("template<typename T = vector<float, 3>> struct B { T a; };"),
            "template<typename T = vector<float, =3>> struct B\n  var T a\n");
}

TEST(ParseTemplateArguments, ValuesAndModifiers) {
  EXPECT_EQ(dump_unit("static const int N = 2; vector<float, N> v;"),
            "var static const int N = 2\nvar vector<float, =N> v\n");
  EXPECT_EQ(dump_unit("RWTexture2D<unorm float4> t;"), "var RWTexture2D<unorm float4> t\n");
  EXPECT_EQ(dump_unit("RayQuery<RAY_FLAG_NONE | RAY_FLAG_FORCE_OPAQUE> q;"),
            "var RayQuery<=(| RAY_FLAG_NONE RAY_FLAG_FORCE_OPAQUE)> q\n");
  EXPECT_EQ(dump_unit("template<int N> struct S { int a[N]; }; S<1 + 2> s; S<(3 > 2)> t;"),
            "template<int N> struct S\n  var int[N] a\nvar S<=(+ 1 2)> s\nvar S<=(> 3 2)> t\n");
}

// ---- Is this name a type?

TEST(ParseNames, AVariableHidesAType) {
  EXPECT_EQ(dump_statements("float Ray = 1; Ray * 2; float b = (Ray) - 1;", "struct Ray {};"),
            "var float Ray = 1\n(* Ray 2)\nvar float b = (- Ray 1)\n");
  EXPECT_EQ(dump_statements("{ float Ray = 1; } Ray r;", "struct Ray {};"),
            "block\n  var float Ray = 1\nvar Ray r\n");
  EXPECT_EQ(dump_unit("struct Ray {}; float f(float Ray) { return (Ray) - 1; }"),
            "struct Ray\nfunction float f(float Ray)\n  block\n    return (- Ray 1)\n");
}

TEST(ParseNames, BuiltInNamesThatAreNotReservedMayBeHidden) {
  EXPECT_EQ(dump_statements("float4x4 matrix; a = matrix * 2; float2 texture = 0; texture.x = 1;"),
            "var float4x4 matrix\n(= a (* matrix 2))\nvar float2 texture = 0\n"
            "(= (. texture x) 1)\n");
  EXPECT_EQ(dump_statements("uint sample = 1; sample += 2; float center = 3, precise = 4;"),
            "var uint sample = 1\n(+= sample 2)\nvar float center = 3\nvar float precise = 4\n");
}

TEST(ParseNames, NamespacesAndNestedTypes) {
  const char* before =
      "namespace a { namespace b { struct T { struct U {}; }; } using namespace b; }";
  EXPECT_EQ(dump_statements("a::b::T t; a::T::U u; a::b::f(1);", before),
            "var a::b::T t\nvar a::T::U u\n(call a::b::f 1)\n");
  EXPECT_EQ(dump_statements("using namespace a; T t; (T)0;", before),
            "using namespace a\nvar T t\n(cast T 0)\n");
  EXPECT_EQ(dump_statements("using a::b::T; T t;", before), "using a::b::T\nvar T t\n");
}

TEST(ParseNames, MembersOfBasesAndLaterMembersAreSeen) {
  EXPECT_EQ(dump_unit("struct A { typedef float T; }; struct B : A { T f() { T a = (T)0; } };"),
            "struct A\n  alias T = float\nstruct B : A\n  function T f()\n    block\n"
            "      var T a = (cast T 0)\n");
  EXPECT_EQ(dump_unit("struct A { void f() { In a; } struct In { int x; }; };"),
            "struct A\n  function void f()\n    block\n      var In a\n  struct In\n"
            "    var int x\n");
}

TEST(ParseNames, OutOfLineMethodSeesItsStruct) {
  EXPECT_EQ(dump_unit("struct S { struct T {}; void f(); }; void S::f() { T t; }"),
            "struct S\n  struct T\n  function void f()\nfunction void S::f()\n  block\n"
            "    var T t\n");
}

TEST(ParseNames, DependentTypes) {
  EXPECT_EQ(dump_unit("template<typename T> void f() { T a; T::V b; typename T::V c; T::g(1); }"),
            "template<typename T> function void f()\n  block\n    var T a\n    var T::V b\n"
            "    var T::V c\n    (call T::g 1)\n");
}

// ---- Types

TEST(ParseType, NumericSpellings) {
  EXPECT_EQ(dump_unit("float a; float1 b; float4 c; float4x3 d; bool e; int3 f; uint2x2 g;"),
            "var float a\nvar float1 b\nvar float4 c\nvar float4x3 d\nvar bool e\nvar int3 f\n"
            "var uint2x2 g\n");
  EXPECT_EQ(dump_unit("dword a; unsigned int b; unsigned c; uint32_t3 d; int32_t e; float32_t f;"),
            "var uint a\nvar uint b\nvar uint c\nvar uint3 d\nvar int e\nvar float f\n");
  EXPECT_EQ(dump_unit("half a; double2 b; float64_t c; float16_t4 d; int16_t e; uint16_t f;"),
            "var half a\nvar double2 b\nvar double c\nvar float16_t4 d\nvar int16_t e\n"
            "var uint16_t f\n");
  EXPECT_EQ(dump_unit("int64_t a; uint64_t2 b; min16float3 c; min10float d; min16int e;"),
            "var int64_t a\nvar uint64_t2 b\nvar min16float3 c\nvar min10float d\n"
            "var min16int e\n");
  EXPECT_EQ(dump_unit("min12int a; min16uint2 b; matrix c; vector d; matrix<float, 2, 3> e;"),
            "var min12int a\nvar min16uint2 b\nvar matrix c\nvar vector d\n"
            "var matrix<float, =2, =3> e\n");
}

TEST(ParseType, Modifiers) {
  EXPECT_EQ(dump_unit("static const float a = 1; const static float b = 1; float const c = 1;"),
            "var static const float a = 1\nvar static const float b = 1\n"
            "var const float c = 1\n");
  EXPECT_EQ(dump_unit("groupshared uint a[2]; extern uniform float b; precise float c;"),
            "var groupshared uint[2] a\nvar extern uniform float b\nvar precise float c\n");
  EXPECT_EQ(dump_unit("globallycoherent RWBuffer<snorm float> a; __const int b;"),
            "var globallycoherent RWBuffer<snorm float> a\nvar const int b\n");
  EXPECT_EQ(dump_unit("struct V { nointerpolation float a; linear centroid float b; "
                      "noperspective float c; sample float d; };"),
            "struct V\n  var nointerpolation float a\n  var linear centroid float b\n"
            "  var noperspective float c\n  var sample float d\n");
  EXPECT_EQ(dump_unit("export float f(); inline float g(); shared float h;"),
            "function export float f()\nfunction inline float g()\nvar shared float h\n");
}

TEST(ParseType, PackMatrixGovernsMatricesBehindIt) {
  EXPECT_EQ(dump_unit("float2x2 a;\n#pragma pack_matrix(row_major)\nfloat2x2 b; float4 c; "
                      "column_major matrix d; matrix e;\n#pragma pack_matrix(column_major)\n"
                      "float2x2 f;"),
            "var float2x2 a\nvar row_major float2x2 b\nvar float4 c\nvar column_major matrix d\n"
            "var row_major matrix e\nvar column_major float2x2 f\n");
}

TEST(ParseType, Arrays) {
  EXPECT_EQ(dump_unit("float a[2][3], b[4], c; Texture2D t[]; int d[1 + 2];"),
            "var float[2][3] a\nvar float[4] b\nvar float c\nvar Texture2D[] t\n"
            "var int[(+ 1 2)] d\n");
  EXPECT_EQ(dump_unit("typedef float A[3]; void f(A a, float b[2], int[4]);"),
            "alias A = float[3]\nfunction void f(A a, float[2] b, int[4])\n");
}

TEST(ParseType, EveryResourceIsATypeWithoutDeclaration) {
  for (const char* type : {"Buffer<float4>",
                           "RWBuffer<uint>",
                           "ByteAddressBuffer",
                           "RWByteAddressBuffer",
                           "StructuredBuffer<float3>",
                           "RWStructuredBuffer<float3>",
                           "Texture1D",
                           "Texture2D<float>",
                           "Texture2DArray<float4>",
                           "Texture3D<float4>",
                           "TextureCube<float3>",
                           "TextureCubeArray",
                           "RWTexture1D<float>",
                           "RWTexture2D<float4>",
                           "RWTexture2DArray<float4>",
                           "RWTexture3D<uint2>",
                           "SamplerState",
                           "SamplerComparisonState",
                           "sampler",
                           "RaytracingAccelerationStructure",
                           "RayDesc",
                           "BuiltInTriangleIntersectionAttributes",
                           "RAY_FLAG",
                           "CANDIDATE_TYPE",
                           "COMMITTED_STATUS"}) {
    EXPECT_EQ(dump_unit(std::string(type) + " a[2];"), "var " + std::string(type) + "[2] a\n");
  }
}

// ---- Declarations

TEST(ParseDeclaration, Registers) {
  EXPECT_EQ(dump_unit("float a : register(c3); Texture2D b : register(T4, space12); "
                      "Buffer c : register(space2); SamplerState d : register(ps_5_0, s1);"),
            "var float a : register(c3)\nvar Texture2D b : register(t4 space12)\n"
            "var Buffer c : register( space2)\nvar SamplerState d : register(s1)\n");
}

TEST(ParseDeclaration, BufferBlocks) {
  EXPECT_EQ(dump_unit("cbuffer C : register(b0, space1) { float4 a : packoffset(c1); float b : "
                      "packoffset(c2.w), c; struct In { int x; }; In d; };"),
            "cbuffer C : register(b0 space1)\n  var float4 a : packoffset(1 0)\n"
            "  var float b : packoffset(2 3)\n  var float c\n  struct In\n    var int x\n"
            "  var In d\n");
  EXPECT_EQ(dump_unit("tbuffer T { float a; }\nfloat b;"),
            "tbuffer T\n  var float a\nvar float b\n");
}

TEST(ParseDeclaration, StructsWithEverything) {
  EXPECT_EQ(dump_unit("struct A { float a, b[2] : TEXCOORD3; static const int k = 2; enum E { X }; "
                      "typedef int I; float f() const { return a; } static A make(); };"),
            "struct A\n  var float a\n  var float[2] b : TEXCOORD#3\n  var static const int k = 2\n"
            "  enum E { X }\n  alias I = int\n  function float f() const\n    block\n"
            "      return a\n  function static A make()\n");
  EXPECT_EQ(dump_unit("struct A {}; struct C {}; struct F; struct B : A, public C {}; class D : B "
                      "{ F f(); };"),
            "struct A\nstruct C\nstruct F;\nstruct B : A, C\nclass D : B\n  function F f()\n");
  EXPECT_EQ(dump_unit("struct { int a; } s, t; struct N { int a; } u = { 1 };"),
            "struct \n  var int a\nvar struct{} s\nvar struct{} t\nstruct N\n  var int a\n"
            "var struct{N} u = {1}\n");
  EXPECT_EQ(dump_unit("struct S {}; struct S s; void f(struct S a);"),
            "struct S\nvar S s\nfunction void f(S a)\n");
}

TEST(ParseDeclaration, PayloadAccessQualifiers) {
  EXPECT_EQ(dump_unit("struct [raypayload] P { float a : read(caller, anyhit) : write(miss); float "
                      "b : write() : read(closesthit); };"),
            "[raypayload] struct P\n  var float a : read(caller anyhit) : write(miss)\n"
            "  var float b : write() : read(closesthit)\n");
}

TEST(ParseDeclaration, OverloadedOperators) {
  EXPECT_EQ(dump_unit("struct V { V operator+(V o); V operator-(); float operator[](int i); float "
                      "operator()(int i); bool operator<(V o); bool operator>>(V o); };"),
            "struct V\n  function V operator+(V o)\n  function V operator-()\n"
            "  function float operator[](int i)\n  function float operator()(int i)\n"
            "  function bool operator<(V o)\n  function bool operator>>(V o)\n");
  EXPECT_EQ(dump_unit("struct V { V operator+(V o); }; V V::operator+(V o) { return o; }"),
            "struct V\n  function V operator+(V o)\nfunction V V::operator+(V o)\n  block\n"
            "    return o\n");
}

TEST(ParseDeclaration, Enums) {
  EXPECT_EQ(dump_unit("enum E { A, B = 1 << 2, C, }; enum class F : uint { X }; enum { Z } z;"),
            "enum E { A B=(<< 1 2) C }\nenum class F : uint { X }\nenum  { Z }\nvar enum{} z\n");
  EXPECT_EQ(dump_statements("E e = E::A; F f = F::X; (E)1;", "enum E { A }; enum class F { X };"),
            "var E e = E::A\nvar F f = F::X\n(cast E 1)\n");
}

TEST(ParseDeclaration, Aliases) {
  EXPECT_EQ(dump_unit("typedef float3 V, W[2]; using U = uint2; typedef struct { int a; } S; S s;"),
            "alias V = float3\nalias W = float3[2]\nalias U = uint2\nstruct \n  var int a\n"
            "alias S = struct{}\nvar S s\n");
  EXPECT_EQ(dump_unit("template<typename T> using P = vector<T, 2>; P<float> p;"),
            "template<typename T> alias P = vector<T, =2>\nvar P<float> p\n");
}

TEST(ParseDeclaration, Namespaces) {
  EXPECT_EQ(
      dump_unit("namespace a::b { struct S {}; } namespace a { b::S s; } namespace { int x; }"),
      "namespace a\n  namespace b\n    struct S\nnamespace a\n  var b::S s\nnamespace \n"
      "  var int x\n");
}

TEST(ParseDeclaration, Templates) {
  EXPECT_EQ(dump_unit("template<typename T, class U = int, uint N = 3> struct S { T a[N]; U b; };"),
            "template<typename T, typename U = int, uint N = 3> struct S\n  var T[N] a\n"
            "  var U b\n");
  EXPECT_EQ(
      dump_unit("template<typename> void f(); template<typename T> T S::g(T a) { return a; }"),
      "template<typename > function void f()\n"
      "template<typename T> function T S::g(T a)\n  block\n    return a\n");
}

TEST(ParseDeclaration, FunctionsAndParameters) {
  EXPECT_EQ(dump_unit("float4 f(in float a, out float b, inout float c, in out float d, const int "
                      "e = 1, uniform bool g = true) : SV_Target1;"),
            "function float4 f(in float a, out float b, in out float c, in out float d, "
            "const int e = 1, uniform bool g = true) : SV_Target#1\n");
  EXPECT_EQ(dump_unit("void f(void) {} void g(float, int3 : A, row_major float3x3 m : B) {}"),
            "function void f()\n  block\nfunction void g(float, int3 : A#0, "
            "row_major float3x3 m : B#0)\n  block\n");
  EXPECT_EQ(dump_unit("void f(Texture2D t, float a[3][4], inout uint n[2]) {}"),
            "function void f(Texture2D t, float[3][4] a, in out uint[2] n)\n  block\n");
}

TEST(ParseDeclaration, EntryPointsAndAttributes) {
  EXPECT_EQ(dump_unit("struct P {}; [shader(\"closesthit\")] void hit(inout P p : SV_RayPayload, "
                      "in float2 a : SV_IntersectionAttributes) {}"),
            "struct P\n[shader \"closesthit\"] function void hit(in out P p : SV_RayPayload#0, "
            "in float2 a : SV_IntersectionAttributes#0)\n  block\n");
  EXPECT_EQ(
      dump_unit("[Shader(\"miss\")][NumThreads(8, 8, 1)] void m(uint3 i : "
                "SV_DispatchThreadID) {}"),
      "[Shader \"miss\"] [NumThreads 8 8 1] function void m(uint3 i : SV_DispatchThreadID#0)\n"
      "  block\n");
  const Parsed vk("[[vk::binding(0, 1)]] Texture2D t; [[vk::push_constant]] float c;");
  EXPECT_EQ(dump(*vk.unit),
            "[[vk::binding 0 1]] var Texture2D t\n[[vk::push_constant]] var float c\n");
  EXPECT_EQ(positions(vk), "KA2340 1:7\nKA2340 1:42");
  EXPECT_EQ(dump_unit("[WaveSize(32)] [noinline] void f();"),
            "[WaveSize 32] [noinline] function void f()\n");
}

TEST(ParseDeclaration, Subobjects) {
  EXPECT_EQ(dump_unit("GlobalRootSignature g = { \"SRV(t0),\" \"UAV(u0)\" };"),
            "subobject GlobalRootSignature g = ( \"SRV(t0),UAV(u0)\")\n");
  EXPECT_EQ(
      dump_unit("StateObjectConfig a = { STATE_OBJECT_FLAGS_ALLOW_LOCAL_DEPENDENCIES | 2 }; "
                "LocalRootSignature b = { \"\" }; SubobjectToExportsAssociation c = { \"b\", "
                "\"x;y\" }; RaytracingShaderConfig d = { 16, 8 }; RaytracingPipelineConfig e = "
                "{ 2, }; RaytracingPipelineConfig1 f = { 2, RAYTRACING_PIPELINE_FLAG_NONE }; "
                "TriangleHitGroup h = { \"\", \"c\" }; ProceduralPrimitiveHitGroup p = { \"a\", "
                "\"b\", \"c\" };"),
      "subobject StateObjectConfig a = ( (| STATE_OBJECT_FLAGS_ALLOW_LOCAL_DEPENDENCIES 2))\n"
      "subobject LocalRootSignature b = ( \"\")\n"
      "subobject SubobjectToExportsAssociation c = ( \"b\" \"x;y\")\n"
      "subobject RaytracingShaderConfig d = ( 16 8)\n"
      "subobject RaytracingPipelineConfig e = ( 2)\n"
      "subobject RaytracingPipelineConfig1 f = ( 2 RAYTRACING_PIPELINE_FLAG_NONE)\n"
      "subobject TriangleHitGroup h = ( \"\" \"c\")\n"
      "subobject ProceduralPrimitiveHitGroup p = ( \"a\" \"b\" \"c\")\n");
}

TEST(ParseDeclaration, OldEffectSyntaxIsIgnoredWithAWarning) {
  const Parsed parsed(
      "SamplerState a { Filter = MIN_MAG_MIP_LINEAR; AddressU = Wrap; };\n"
      "sampler b = sampler_state { Texture = <t>; };\n"
      "float c <string UIName = \"x\"; float m = 0;> = 1;\n");
  EXPECT_EQ(dump(*parsed.unit), "var SamplerState a\nvar sampler b\nvar float c = 1\n");
  EXPECT_EQ(positions(parsed), "KA2252 1:16\nKA2252 2:13\nKA2252 3:9");
  EXPECT_FALSE(parsed.diagnostics.has_errors());
}

TEST(ParseDeclaration, TechniquesAreIgnoredWithAWarning) {
  const Parsed parsed("float a;\ntechnique11 T { pass P0 { SetVertexShader(f()); } }\nfloat b;");
  EXPECT_EQ(dump(*parsed.unit), "var float a\nvar float b\n");
  EXPECT_EQ(positions(parsed), "KA2252 2:1");
}

TEST(ParseDeclaration, TypesOfDx) {
  EXPECT_EQ(dump_statements("dx::HitObject h = dx::HitObject::TraceRay(a); h.x = 1;"),
            "var dx::HitObject h = (call dx::HitObject::TraceRay a)\n(= (. h x) 1)\n");
  EXPECT_EQ(dump_statements("float dx = ddx(a); dx *= 2; float HitObject;"),
            "var float dx = (call ddx a)\n(*= dx 2)\nvar float HitObject\n");
}

// ---- Statements

TEST(ParseStatement, Selection) {
  EXPECT_EQ(dump_statements("if (a) b; else if (c) { d; } else e;"),
            "if a\n  b\nelse\n  if c\n    block\n      d\n  else\n    e\n");
  EXPECT_EQ(dump_statements("if (a) if (b) c; else d;"), "if a\n  if b\n    c\n  else\n    d\n");
  EXPECT_EQ(dump_statements("[branch] if (a) {} else [flatten] if (b) {}"),
            "[branch] if a\n  block\nelse\n  [flatten] if b\n    block\n");
}

TEST(ParseStatement, Switch) {
  EXPECT_EQ(dump_statements("[forcecase] switch (a) { case 0: case E::B: b; break; default: { c; } "
                            "case 1 + 2: return; }"),
            "[forcecase] switch a\ncase 0\ncase E::B\n  b\n  break\ndefault\n  block\n    c\n"
            "case (+ 1 2)\n  return\n");
}

TEST(ParseStatement, Loops) {
  EXPECT_EQ(dump_statements("[unroll(4)] for (int i = 0, j = 1; i < 3; ++i, --j) a;"),
            "[unroll 4] for (< i 3) ; (, (++ i) (-- j))\n  init\n    var int i = 0\n"
            "    var int j = 1\n  a\n");
  EXPECT_EQ(dump_statements("for (i = 0, j = 1;;) ; for (;;) {}"),
            "for  ; \n  init\n    (, (= i 0) (= j 1))\n  ;\nfor  ; \n  block\n");
  EXPECT_EQ(dump_statements("[loop] while (a) { continue; } do { break; } while (a && b);"),
            "[loop] while a\n  block\n    continue\ndo while (&& a b)\n  block\n    break\n");
  EXPECT_EQ(dump_statements("[allow_uav_condition][fastopt] for (;;) discard;"),
            "[allow_uav_condition] [fastopt] for  ; \n  discard\n");
}

TEST(ParseStatement, DeclarationsInConditions) {
  EXPECT_EQ(dump_statements("if (float a = f()) b; else c;"),
            "block\n  var float a = (call f)\n  if a\n    b\n  else\n    c\n");
  EXPECT_EQ(dump_statements("while (int a = f()) b;"),
            "while true\n  block\n    var int a = (call f)\n    if a\n      b\n    else\n"
            "      break\n");
}

TEST(ParseStatement, DeclarationsInBodies) {
  EXPECT_EQ(dump_statements("const float a = 1, b; struct S { int x; } s; typedef int I; I i; "
                            "static const float t[] = { 1, 2 }; enum E { A }; ;"),
            "var const float a = 1\nvar const float b\nstruct S\n  var int x\nvar struct{S} s\n"
            "alias I = int\nvar I i\nvar static const float[] t = {1, 2}\nenum E { A }\n;\n");
  EXPECT_EQ(dump_statements("RayQuery<RAY_FLAG_NONE> q; Texture2D<float4> t = a[0];"),
            "var RayQuery<=RAY_FLAG_NONE> q\nvar Texture2D<float4> t = ([] a 0)\n");
}

TEST(ParseLocation, PointsAtOperatorsMembersAndNames) {
  const Parsed parsed("float f() { return ab + c.d(1); }");
  const auto* function = as<FunctionDecl>(parsed.unit->declarations[0]);
  ASSERT_NE(function, nullptr);
  const auto column = [&](SourceLocation at) { return parsed.sources.resolve(at).column; };
  EXPECT_EQ(column(function->location), 7u);
  const auto* sum = as<BinaryExpr>(as<ReturnStmt>(function->body->statements[0])->value);
  ASSERT_NE(sum, nullptr);
  EXPECT_EQ(column(sum->location), 23u);
  EXPECT_EQ(column(sum->left->location), 20u);
  EXPECT_EQ(column(as<CallExpr>(sum->right)->callee->location), 27u);
  EXPECT_EQ(column(function->body->end), 33u);
}

TEST(ParseMacro, TokensOfMacrosParseLikeOthers) {
  EXPECT_EQ(dump_expression("CAST(a)", "#define CAST(x) ((float3)(x)).xyz"),
            "(. (cast float3 a) xyz)");
  EXPECT_EQ(dump_unit("#define V(t) StructuredBuffer<vector<t, 3>>\nV(float) a;"),
            "var StructuredBuffer<vector<float, =3>> a\n");
}

TEST(ParseStruct, InterfaceAndAuto) {
  EXPECT_EQ(dump_unit("interface I { float f(int a); };\nclass C : I { float f(int a); };\n"
                      "static const auto a = 1;"),
            "interface I\n  function float f(int a)\nclass C : I\n  function float f(int a)\n"
            "var static const auto a = 1\n");
}

}  // namespace
}  // namespace kaamos::hlsl::test
