// SPDX-License-Identifier: MIT
// Tests which message each mistake gives, at which line and column, and that one mistake gives one
// message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/hlsl/front/parse_test_support.h"

namespace kaamos::hlsl::test {
namespace {

struct Mistake {
  const char* name;
  const char* text;
  const char* expected;  // positions()
  const char* message;   // Part of the first message.
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.text;
}

class ParseError : public testing::TestWithParam<Mistake> {};

TEST_P(ParseError, IsReportedWhereItIs) {
  const Parsed parsed{GetParam().text};
  EXPECT_EQ(positions(parsed), GetParam().expected) << parsed.messages();
  ASSERT_FALSE(parsed.diagnostics.diagnostics().empty());
  EXPECT_THAT(parsed.diagnostics.diagnostics()[0].message, testing::HasSubstr(GetParam().message));
  // The rest of the tree can be walked.
  dump(*parsed.unit);
}

constexpr Mistake kMistakes[] = {
    // ---- Something is missing
    {"SemicolonAtLineEnd", "float a = 1\nfloat b;", "KA2201 1:12",
     "expected ';' after the declaration of 'a', found 'float'"},
    {"SemicolonInLine", "void f() { a = 1 b = 2; }", "KA2201 1:18",
     "expected ';' after the expression, found 'b'"},
    {"SemicolonAfterReturn", "float f() { return 1 }", "KA2201 1:22",
     "expected ';' after the returned value, found '}'"},
    {"SemicolonAfterBreak", "void f() { for (;;) { break } }", "KA2201 1:29",
     "expected ';' after 'break', found '}'"},
    {"SemicolonAfterStruct", "struct S { int a; }\nfloat b;", "KA2201 1:20",
     "expected ';' after the struct, found 'float'"},
    {"SemicolonAfterDo", "void f() { do { } while (a) b; }", "KA2201 1:29",
     "expected ';' after 'do ... while (...)', found 'b'"},
    {"SemicolonAfterTypedef", "typedef float A B;", "KA2201 1:17",
     "expected ';' after the typedef, found 'B'"},
    {"SemicolonInFor", "void f() { for (int i = 0; i < 3, ++i) { } }", "KA2201 1:38",
     "expected ';' after the condition of 'for', found ')'"},
    {"ClosingParenthesis", "float a = (1 + 2;", "KA2202 1:17",
     "expected ')' after the expression, found ';'"},
    {"ClosingParenthesisOfCall", "void f() { g(1, 2; }", "KA2202 1:18",
     "expected ',' or ')' after an argument, found ';'"},
    {"ClosingParenthesisOfIf", "void f() { if (a { b; } }", "KA2202 1:18",
     "expected ')' after the condition, found '{'"},
    {"ClosingParenthesisOfParameters", "void f(float a { }", "KA2202 1:16",
     "expected ',' or ')' after a parameter, found '{'"},
    {"ClosingBracket", "float a = b[1;", "KA2202 1:14", "expected ']' after the index, found ';'"},
    {"ClosingBracketOfArray", "float a[3;", "KA2202 1:10",
     "expected ']' after the size of the array, found ';'"},
    {"ClosingBraceOfList", "float a[2] = {1, 2;", "KA2202 1:19",
     "expected ',' or '}' after an element of the list, found ';'"},
    {"ClosingBraceOfEnum", "enum E { A B };", "KA2202 1:12",
     "expected ',' or '}' after an enumerator, found 'B'"},
    {"ClosingBraceOfFunction", "void f() { if (a) { b; }", "KA2202 1:25",
     "expected '}' after the statements of the block, found end of file"},
    {"ClosingBraceOfStruct", "struct S { int a;", "KA2202 1:18",
     "expected '}' after the members of the struct, found end of file"},
    {"ClosingBraceOfNamespace", "namespace n { int a;", "KA2202 1:21",
     "expected '}' after the declarations of the namespace, found end of file"},
    {"ClosingAngle", "StructuredBuffer<float a;", "KA2202 1:24",
     "expected ',' or '>' after a template argument, found 'a'"},
    {"OpeningParenthesisOfIf", "void f() { if a { } }", "KA2200 1:15",
     "expected '(' after 'if', found 'a'"},
    {"OpeningParenthesisOfFor", "void f() { for int i; }", "KA2200 1:16",
     "expected '(' after 'for', found 'int'"},
    {"OpeningBraceOfSwitch", "void f() { switch (a) case 1: b; }", "KA2200 1:23",
     "expected '{' after 'switch (...)', found 'case'"},
    {"WhileAfterDo", "void f() { do { } a; }", "KA2200 1:19",
     "expected 'while' after the body of 'do', found 'a'"},
    {"ColonOfConditional", "float a = b ? c;", "KA2200 1:16",
     "expected ':' of the conditional operator '?', found ';'"},
    {"ColonOfCase", "void f() { switch (a) { case 1 b; } }", "KA2200 1:32",
     "expected ':' after the case label, found 'b'"},
    {"FunctionBody", "void f() return;", "KA2200 1:10",
     "expected '{' or ';' after the function's parameters, found 'return'"},
    {"Operand", "float a = 3 + ;", "KA2204 1:15", "expected an expression, found ';'"},
    {"OperandOfUnary", "float a = -;", "KA2204 1:12", "expected an expression, found ';'"},
    {"ArgumentAfterComma", "float a = f(1, );", "KA2204 1:16", "expected an expression, found ')'"},
    {"Initializer", "float a = ;", "KA2204 1:11", "expected an expression, found ';'"},
    {"NameOfVariable", "float = 1;", "KA2205 1:7", "expected the name of a variable, found '='"},
    {"NameOfField", "struct S { float; float 3; };", "KA2255 1:12\nKA2205 1:25",
     "the declaration declares nothing"},
    {"NameOfMember", "float a = b.;", "KA2205 1:13", "expected the name of a member, found ';'"},
    {"NameOfNamespace", "namespace 3 { }", "KA2205 1:11",
     "expected the name of a namespace, found '3'"},
    {"NameBehindScope", "float a = n::;", "KA2205 1:14",
     "expected the name of a member, found ';'"},
    {"TypeOfParameter", "void f(, float b) { }", "KA2206 1:8", "expected a type, found ','"},
    {"TypeOfCastNotNeeded", "void f() { float a = (1) 2; }", "KA2201 1:26",
     "expected ';' after the declaration of 'a', found '2'"},
    {"Declaration", "3;", "KA2203 1:1", "expected a declaration, found '3'"},

    // ---- Something is superfluous or in the wrong place
    {"BraceTooMuch", "void f() { } }\nfloat a;", "KA2211 1:14", "'}' has no matching '{'"},
    {"ElseWithoutIf", "void f() { a; else b; }", "KA2212 1:15", "'else' without 'if'"},
    {"CaseOutsideSwitch", "void f() { case 1: a; }", "KA2213 1:12", "'case' outside of a switch"},
    {"StatementBeforeCase", "void f() { switch (a) { b; case 1: c; } }", "KA2214 1:25",
     "expected 'case' or 'default' as the first statement of a switch, found 'b'"},
    {"FunctionInFunction", "void f() {\nvoid g() { }\n}", "KA2215 2:6",
     "function 'g' is defined inside another function; is a '}' missing before it?"},
    {"NamespaceInFunction", "void f() { namespace n { } }", "KA2219 1:12",
     "a namespace can only be declared in the global scope or a namespace"},
    {"BufferInStruct", "struct S { cbuffer C { int a; } };", "KA2219 1:12",
     "a buffer block can only be declared"},
    {"SubobjectInFunction", "void f() { TriangleHitGroup h = { \"a\" }; }", "KA2219 1:12",
     "a subobject can only be declared"},
    {"StructInParameters", "void f(struct S { int a; } s) { }", "KA2219 1:8",
     "a struct can only be declared"},
    {"AttributeOnNothing", "void f() { [unroll] }", "KA2251 1:13",
     "attribute 'unroll' must come before a statement, found '}'"},
    {"ListAsArgument", "float a = f({1, 2});", "KA2218 1:13",
     "an initializer list is only allowed"},

    // ---- Names and types
    {"UnknownType", "void f() { Foo a; a.x = 1; }", "KA2207 1:12", "unknown type name 'Foo'"},
    {"UnknownTypeOfParameter", "void f(in Foo a, float b) { }", "KA2207 1:11",
     "unknown type name 'Foo'"},
    {"UnknownTypeInCast", "float a = (Foo)0;", "KA2207 1:12", "unknown type name 'Foo'"},
    {"UnknownScopedType", "namespace n { } n::Foo a;", "KA2207 1:17", "unknown type name 'n::Foo'"},
    {"UnknownTemplate", "void f() { Foo<float, 3> a; }", "KA2207 1:12",
     "unknown type name 'Foo<float, 3>'"},
    {"TypeAsValue", "float a = 1 + float3;", "KA2208 1:15", "expected an expression, found type"},
    {"TypeAsName", "float half;", "KA2216 1:7",
     "built-in type 'half' cannot be used as the name of a variable"},
    {"KeywordAsName", "float out;", "KA2217 1:7",
     "keyword 'out' cannot be used as the name of a variable"},
    {"KeywordAsValue", "void f() { float a = 1 + centroid; }", "KA2300 1:26",
     "keyword 'centroid' cannot be used as a value"},
    {"InOnLocal", "void f() { in float a; }", "KA2301 1:12",
     "'in' cannot be used on a local variable; it is for parameters"},
    {"OutOnGlobal", "out float a;", "KA2301 1:1", "'out' cannot be used on a global variable"},
    {"PointOnField", "struct S { point float4 a; };", "KA2301 1:12",
     "'point' cannot be used on a field; it is for parameters of geometry shaders"},
    {"TriangleOnFunction", "triangle float f() { return 1; }", "KA2301 1:1",
     "'triangle' cannot be used on a function"},
    {"IndicesOnGlobal", "indices uint a;", "KA2301 1:1", "it is for parameters of mesh shaders"},
    {"LinearOnLocal", "void f() { linear float a; }", "KA2301 1:12",
     "'linear' cannot be used on a local variable; it is for fields, parameters and functions"},
    {"SampleOnGlobal", "sample float a;", "KA2301 1:1", "'sample' cannot be used on a global"},
    {"SharedOnField", "struct S { shared float a; };", "KA2301 1:12", "it is for global variables"},
    {"GroupsharedOnLocal", "void f() { groupshared float a; }", "KA2301 1:12",
     "'groupshared' cannot be used on a local variable"},
    {"UniformOnLocal", "void f() { uniform float a; }", "KA2301 1:12",
     "'uniform' cannot be used on a local variable"},
    {"ExternOnParameter", "void f(extern float a) { }", "KA2301 1:8",
     "'extern' cannot be used on a parameter"},
    {"StaticOnParameter", "void f(static float a) { }", "KA2301 1:8",
     "'static' cannot be used on a parameter"},
    {"VolatileOnGlobal", "volatile float a;", "KA2301 1:1",
     "'volatile' cannot be used on a global variable; it is for local variables"},
    {"ConstOnField", "struct S { float const a; };", "KA2301 1:18",
     "'const' cannot be used on a field"},
    {"ExportOnVariable", "export float a;", "KA2301 1:1", "'export' cannot be used on a global"},
    {"InlineOnVariable", "void f() { inline float a; }", "KA2301 1:12", "it is for functions"},
    {"ReservedWordAsName", "float union;", "KA2217 1:7",
     "keyword 'union' cannot be used as the name of a variable"},
    {"ModifiersThatExclude", "row_major column_major float2x2 a;", "KA2253 1:11",
     "'row_major' cannot be combined with 'column_major'"},

    {"ModifierTwice", "static const static float a = 1;", "KA2254 1:14",
     "'static' is specified twice"},
    {"AccessSpecifiers", "class C { public: int a; private: int b; };", "KA2241 1:11\nKA2241 1:26",
     "access specifier 'public' is ignored: all members are public"},

    // ---- Not in HLSL
    {"Pointer", "void f(float* a) { }", "KA2220 1:13", "HLSL has no pointers"},
    {"PointerVariable", "void f() { int *a = 0; }", "KA2220 1:16", "HLSL has no pointers"},
    {"PointerCast", "float a = (float*)b;", "KA2220 1:17", "HLSL has no pointers"},
    {"Reference", "void f(const float& a) { }", "KA2221 1:19", "HLSL has no references"},
    {"Arrow", "float a = b->c;", "KA2222 1:12", "HLSL has no '->'; use '.'"},
    {"Address", "float a = f(&b, 1);", "KA2223 1:13", "there is no unary '&'"},
    {"Dereference", "float a = *b;", "KA2223 1:11", "there is no unary '*'"},
    {"Goto", "void f() { goto a; }", "KA2224 1:12", "HLSL has no 'goto'"},
    {"Label", "void f() { a: b; }", "KA2242 1:12", "HLSL has no labels"},
    {"Try", "void f() { try { a; } catch (int) { b; } }", "KA2225 1:12",
     "HLSL has no exceptions ('try')"},
    {"Throw", "void f() { throw 1; }", "KA2225 1:12", "HLSL has no exceptions ('throw')"},
    {"New", "float a = new float;", "KA2226 1:11", "HLSL has no dynamic memory ('new')"},
    {"Virtual", "struct S { virtual void f(); };", "KA2227 1:12", "no virtual functions"},
    {"Lambda", "void f() { a = [b](int c) { return c; }; }", "KA2228 1:16",
     "no lambda expressions"},
    {"Union", "union U { int a; float b; };", "KA2230 1:1", "HLSL has no unions"},
    {"InterfaceField", "interface I { int a; void f(); };", "KA2303 1:19",
     "an interface can only hold methods without a body, not a field or a type"},
    {"InterfaceBody", "interface I { void f() { } };", "KA2303 1:20", "not a method with a body"},
    {"InterfaceStatic", "interface I { static void f(); };", "KA2303 1:27", "not a static method"},
    {"InterfaceOperator", "interface I { int operator+(int a); };", "KA2303 1:19",
     "not an operator"},
    {"InterfaceBase", "interface I { };\ninterface J : I { };", "KA2304 2:13",
     "interface 'J' cannot inherit from another type"},
    {"HitObject", "void f() { HitObject h; }", "KA2207 1:12", "'HitObject'"},
    {"Friend", "struct S { friend void f(); };", "KA2232 1:12", "'friend' is reserved"},
    {"Long", "long a;", "KA2233 1:1", "HLSL has no type 'long'; use int64_t"},
    {"LongLong", "void f() { unsigned a; signed long long b; }", "KA2233 1:24",
     "HLSL has no type 'signed'; use int"},
    {"StaticCast", "float a = static_cast<float>(b);", "KA2234 1:11",
     "HLSL has no 'static_cast'; write '(Type)value'"},
    {"Constructor", "struct S { S(int a) : x(a) { } int x; };", "KA2235 1:12",
     "HLSL has no constructors; write a function that returns a 'S'"},
    {"Destructor", "struct S { ~S() { } };", "KA2235 1:12", "HLSL has no destructors"},
    {"ConstructorCall", "void f() { float3 v(1, 2, 3); }", "KA2236 1:19",
     "HLSL has no 'float3 v(...)'; write 'float3 v = float3(...)'"},
    {"BraceConstruction", "float3 a = float3{1, 2, 3};", "KA2239 1:12",
     "HLSL has no 'float3{...}'; write 'float3(...)'"},
    {"Variadic", "void f(int a, ...) { }", "KA2237 1:15", "a variable number of parameters"},
    {"ParameterPack", "template<typename... T> void f() { }", "KA2237 1:18",
     "a variable number of template parameters"},
    {"BoundsBeforeName", "float[3] a;", "KA2238 1:6", "array bounds go after the name"},
    {"BitFieldStatic", "struct S { static uint a : 4; uint b; };", "KA2283 1:28",
     "must be a plain field"},
    {"BitFieldArray", "struct S { uint a[2] : 4; uint b; };", "KA2283 1:24", "no array"},
    {"BitFieldSemantic", "struct S { uint a : 4 : TEXCOORD; };", "KA2283 1:21", "semantic"},
    {"SemanticBitField", "struct S { uint a : TEXCOORD : 4; };", "KA2283 1:32", "semantic"},
    {"BitFieldOfBuffer", "cbuffer B { uint a : 4; }", "KA2283 1:22", "plain field of a struct"},
    {"BitField", "static uint a : 4;", "KA2283 1:17", "plain field of a struct"},
    {"ConversionOperator", "struct S { operator float() { return 1; } };", "KA2274 1:12",
     "HLSL does not allow conversion operators"},

    // ---- Annotations, attributes, templates, subobjects
    {"RegisterClass", "Texture2D t : register(x0);", "KA2260 1:24",
     "expected a register such as t0, u1, b2, s3 or a space such as space1, found 'x0'"},
    {"RegisterWithoutNumber", "Texture2D t : register(t);", "KA2260 1:24", "expected a register"},
    {"RegisterSpace", "Texture2D t : register(t0, 1);", "KA2261 1:28",
     "expected a space such as space1, found '1'"},
    {"RegisterNumber", "Texture2D t : register(t4294967296);", "KA2262 1:24",
     "the number in 't4294967296' is too large; at most 4294967295 is allowed"},
    {"PackOffset", "cbuffer C { float a : packoffset(b0); }", "KA2263 1:34",
     "expected a constant register such as c0 or c3.y, found 'b0'"},
    {"PackOffsetComponent", "cbuffer C { float a : packoffset(c0.q); }", "KA2263 1:37",
     "expected a constant register such as c0 or c3.y, found 'q'"},
    {"SemanticTwice", "struct S { float a : A : B; };", "KA2287 1:26",
     "semantic 'B' is ignored: the first one, 'A', counts"},
    {"BitFieldByNames", "struct S { uint a : N - 1; };", "KA2286 1:21", "in parentheses"},
    {"BitFieldByScope", "struct S { uint a : n::kBits; };", "KA2286 1:21", "in parentheses"},
    {"RegisterElement", "Buffer<int> b : register(t0[x]);", "KA2200 1:29", "expected a number"},
    {"SemanticName", "float f() : 1.5 { }", "KA2205 1:13", "expected the name of a semantic"},
    {"VkAttributeOnce", "[[vk::binding(1)]] Texture2D a;\n[[vk::binding(2)]] Texture2D b;",
     "KA2340 1:7", "[[vk::binding]] is ignored: the register decides where it is bound"},
    {"VkAttributeUnknown", "[[vk::nothing]] Texture2D a;", "KA2250 1:7",
     "unknown attribute 'vk::nothing' is ignored"},
    {"UnknownAttribute", "[frobnicate] void f() { }", "KA2250 1:2",
     "unknown attribute 'frobnicate' is ignored"},
    {"AttributeName", "[3] void f() { }", "KA2205 1:2",
     "expected the name of an attribute, found '3'"},
    {"TemplateParameter", "template<3> void f() { }", "KA2270 1:10",
     "expected a template parameter such as 'typename T' or 'int N', found '3'"},
    {"TemplateOfEnum", "template<typename T> enum E { A };", "KA2271 1:22",
     "expected a function, a struct or 'using NAME =' after 'template<...>', found 'enum'"},
    {"TemplateOfVariable", "template<typename T> T a = 1;", "KA2271 1:24",
     "expected a function, a struct"},
    {"SpecializationWithoutArguments", "template<> struct S { };", "KA2284 1:19",
     "names no arguments"},
    {"InstantiationWithBody",
     "template<class T> T f(T a) { return a; } template int f(int a) { return 1; }", "KA2360 1:64",
     "cannot have a body"},
    {"InstantiationOfStructWithBody",
     "template<class T> struct S { T a; }; template struct S<int> { };", "KA2360 1:61", "'S'"},
    {"SpecializationOfVariable", "template<> int a = 1;", "KA2271 1:16", "expected a function"},
    {"SpecializationWithoutHeader", "void f<int>() { }", "KA2285 1:6",
     "'f' has template arguments"},
    {"NotOverloadable", "struct S { S operator.(int a); };", "KA2273 1:22",
     "operator '.' cannot be overloaded"},
    {"SubobjectWithoutList", "GlobalRootSignature g = \"SRV(t0)\";", "KA2280 1:25",
     "expected '= { ... }' after subobject 'g', found"},
    {"SubobjectWithoutValue", "TriangleHitGroup h;", "KA2280 1:19",
     "expected '= { ... }' after subobject 'h', found ';'"},
};

INSTANTIATE_TEST_SUITE_P(All, ParseError, testing::ValuesIn(kMistakes),
                         [](const auto& one) { return std::string(one.param.name); });

// ---- Recovery

TEST(ParseRecovery, SeveralMistakesInOneRun) {
  const Parsed parsed(
      "float a = ;\n"
      "float f(Foo x) { return (1 + 2; }\n"
      "void g() {\n"
      "  if (a b) { c = ; }\n"
      "  d = 1 e = 2;\n"
      "  for (int i = 0; i < 3 ++i) { ; }\n"
      "  h[1 = 3;\n"
      "}\n"
      "struct S { int a; float b c; Bar d; };\n"
      "cbuffer C { float x y; float z; }\n"
      "void last() { return 1 }\n");
  EXPECT_EQ(positions(parsed),
            "KA2204 1:11\nKA2207 2:9\nKA2202 2:31\nKA2202 4:9\nKA2204 4:18\nKA2201 5:9\n"
            "KA2201 6:27\nKA2202 7:10\nKA2201 9:27\nKA2207 9:30\nKA2201 10:21\nKA2201 11:24")
      << parsed.messages();
}

TEST(ParseRecovery, WhatFollowsAMistakeIsKept) {
  const Parsed parsed(
      "float a = 1 +;\nstruct S { int x = (; int y; };\nvoid f() { g(; S s; s.y = 1; }");
  const std::string tree = dump(*parsed.unit);
  EXPECT_THAT(tree, testing::HasSubstr("struct S\n"));
  EXPECT_THAT(tree, testing::HasSubstr("var int y"));
  EXPECT_THAT(tree, testing::HasSubstr("var S s\n"));
  EXPECT_THAT(tree, testing::HasSubstr("(= (. s y) 1)"));
}

TEST(ParseRecovery, BracketsPointBackToTheirOpening) {
  const Parsed parsed("void f() {\n  if (a) {\n    g(1,\n      2;\n  }\n");
  ASSERT_EQ(positions(parsed), "KA2202 4:8\nKA2202 6:1");
  const auto place = [&](size_t diagnostic) {
    const auto& notes = parsed.diagnostics.diagnostics()[diagnostic].notes;
    if (notes.empty()) return std::string("none");
    const ResolvedLocation at = parsed.sources.resolve(notes[0].location);
    return std::to_string(at.line) + ":" + std::to_string(at.column) + " " + notes[0].message;
  };
  EXPECT_EQ(place(0), "3:6 to match this '('");
  EXPECT_EQ(place(1), "1:10 to match this '{'");
}

TEST(ParseRecovery, MissingBraceIsToldAtTheNextFunction) {
  const Parsed parsed("void f() {\n  if (a) {\n    b;\n}\nvoid g() { }\n");
  EXPECT_EQ(positions(parsed), "KA2215 5:6\nKA2202 6:1");
  EXPECT_EQ(parsed.diagnostics.diagnostics()[0].notes.size(), 1u);
}

// ---- Limits

std::string repeated(std::string_view part, size_t count) {
  std::string result;
  for (size_t i = 0; i < count; ++i) result += part;
  return result;
}

TEST(ParseLimit, DeepNestingIsAnErrorWithItsLimit) {
  const Parsed parsed("float a = " + repeated("(", 300) + "1" + repeated(")", 300) + ";");
  EXPECT_EQ(positions(parsed), "KA2209 1:266");
  EXPECT_EQ(parsed.diagnostics.diagnostics()[0].message, "nested more than 256 deep");
  EXPECT_EQ(Parsed("float a = " + repeated("(", 200) + "1" + repeated(")", 200) + ";").messages(),
            "");
}

TEST(ParseLimit, LongChainsAreAnError) {
  EXPECT_EQ(positions(Parsed("float a = 1" + repeated(" + 1", 1025) + ";")), "KA2210 1:4109");
  EXPECT_EQ(Parsed("float a = 1" + repeated(" + 1", 1000) + ";").messages(), "");
  EXPECT_EQ(Parsed("float a[] = {1" + repeated(", 1", 50000) + "};").messages(), "");
}

TEST(ParseLimit, ElseIfChainsMayBeLong) {
  EXPECT_EQ(dump_statements(repeated("if (a) b; else ", 1000) + "c;").substr(0, 5), "if a\n");
  EXPECT_EQ(positions(Parsed("void f() {\n" + repeated("if (a) b; else\n", 1100) + "c; }")),
            "KA2209 1027:1");
}

// Chains inside chains, and expressions inside template arguments, are counted together, so that
// code that walks the tree does not run out of stack.
TEST(ParseLimit, LimitsHoldForTheWholePath) {
  std::string chains = "void f() {";
  for (int level = 0; level < 20; ++level) chains += repeated("if (a) b; else ", 100) + "{";
  EXPECT_THAT(positions(Parsed(chains + repeated("}", 21))), testing::HasSubstr("KA2209 1:"));

  std::string nested = "1";
  for (int level = 0; level < 20; ++level) {
    nested = "g<(" + nested + repeated("+1", 100) + ")>(0)";
  }
  EXPECT_THAT(
      positions(Parsed("template<int N> int g(int a) { return N; }\nint a = " + nested + ";")),
      testing::HasSubstr("KA2210 2:"));
}

TEST(ParseSuggestion, ForMisspeltTypesAndThoseOfGlsl) {
  const auto note = [](std::string_view type) {
    const Parsed parsed("struct MaterialData { int a; };\n" + std::string(type) + " a;");
    const auto& all = parsed.diagnostics.diagnostics();
    return all.empty() || all[0].notes.empty() ? std::string() : all[0].notes[0].message;
  };
  EXPECT_EQ(note("Texture2d"), "did you mean 'Texture2D'?");
  EXPECT_EQ(note("MaterialDatum"), "did you mean 'MaterialData'?");
  EXPECT_EQ(note("flaot"), "did you mean 'float'?");
  EXPECT_EQ(note("flot3"), "did you mean 'float3'?");
  EXPECT_EQ(note("vec3"), "did you mean 'float3'?");
  EXPECT_EQ(note("mat3x4"), "did you mean 'float4x3'?");
  EXPECT_EQ(note("Quaternion"), "");
}

// Texts that would make a careless parser overflow its stack or take quadratic time.
TEST(ParseLimit, HostileTextsEndSoon) {
  const char* openings[] = {
      "(",
      "{",
      "[",
      "a[",
      "a(",
      "-",
      "!",
      "(float)",
      "a?",
      "a?b:",
      "a=",
      "if(a)",
      "if(a){",
      "else ",
      "for(;;)",
      "while(a)",
      "do ",
      "switch(a){case 1:",
      "a<",
      "a<b,",
      "S<",
      "S<S<float>",
      "a.b<",
      "a.b<float,",
      "a::",
      "::a",
      "a.",
      "a+",
      "a,",
      "struct A{",
      "namespace a{",
      "namespace a::",
      "template<",
      "template<typename T>",
      "enum E{A=(",
      "cbuffer C{",
      "[a]",
      "[[a",
      "a:",
      "float a[",
      "float a={{",
      "sizeof(",
      "sizeof ",
      "case ",
      "void f(",
      "void f(){",
      "float f(float a=",
      "typedef ",
      "using A=",
      ":read(",
      ":register(",
      "operator",
      "vector<vector<",
      "try{",
      "union{",
      "interface I{",
      "(a)",
      "(a)b",
      "~",
      "&",
      "*",
      ">>",
      "}",
      ")",
      "]",
      ";",
  };
  for (const char* before :
       {"", "void f(){", "struct S{", "float a=", "template<class T>struct S{};void f(){"}) {
    for (const char* opening : openings) {
      const Parsed parsed(before + repeated(opening, 3000));
      dump(*parsed.unit);
    }
  }
}

}  // namespace
}  // namespace kaamos::hlsl::test
