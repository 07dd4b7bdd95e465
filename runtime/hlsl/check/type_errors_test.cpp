// SPDX-License-Identifier: MIT
// Tests what the checker refuses about types and their values: `@` marks the place.
#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

struct TypeCase {
  const char* name;
  Id id;
  std::string text;
};

const std::string kHolder = "struct R { ByteAddressBuffer b; uint i; };\n";

std::string enums(const std::string& body, const std::string& globals = {}) {
  return kernel("const uint z = results.Load(0);\n" + body,
                "enum E { kA = 1, kB = 2 };\nenum F { kC = 4 };\n"
                "enum class Mode { kX, kY };\nvoid take(E e) {}\n"
                "template <E e> struct S { int i; };\n"
                "template <E e> uint get() { return e; }\n" +
                    globals);
}

const std::vector<TypeCase>& type_cases() {
  static const std::vector<TypeCase> all = {
      {"EnumFromNumber", Id::kConversion, enums("E e = @1;")},
      {"EnumFromSum", Id::kConversion, enums("E e = kA @+ 1;")},
      {"EnumArgumentFromNumber", Id::kNoOverload, enums("@take(1);")},
      {"EnumFromOtherEnum", Id::kConversion, enums("E e = @kC;")},
      {"EnumOrNumber", Id::kConversion, enums("E e = kA;\ne @|= 2;")},
      {"EnumOrOtherEnum", Id::kOperands, enums("uint u = kA @| kC;")},
      {"EnumBesideOtherEnum", Id::kOperands, enums("bool b = kA @== kC;")},
      {"EnumOrOtherEnumChosen", Id::kNoCommonType, enums("uint u = z @? kA : kC;")},
      {"EnumShifted", Id::kOperands, enums("uint u = kA @<< 1;")},
      {"EnumIncremented", Id::kOperand, enums("E e = kA;\n@++e;")},
      {"ScopedToInt", Id::kConversion, enums("int i = Mode::@kY;")},
      {"ScopedSum", Id::kOperands, enums("int i = (int)(Mode::kY @+ 1);")},
      {"ScopedOr", Id::kOperands, enums("Mode m = Mode::kY @| Mode::kX;")},
      {"ScopedOrder", Id::kOperands, enums("bool b = Mode::kX @< Mode::kY;")},
      {"ScopedNot", Id::kOperand, enums("bool b = @!Mode::kX;")},
      {"ScopedComplement", Id::kOperand, enums("Mode m = @~Mode::kX;")},
      {"ScopedCondition", Id::kConditionType, enums("Mode m = Mode::kX;\nif (@m) return;")},
      {"ScopedAnd", Id::kConditionType, enums("bool b = z != 0 && Mode::@kX;")},
      {"EnumBaseFloat", Id::kEnumBase, enums("", "enum G : @float { kG };")},
      {"EnumeratorTwice", Id::kRedefinition, enums("", "enum G { @kA };")},
      {"NumberForEnumParameter", Id::kTemplateArguments, enums("@S<1> s;")},
      {"OtherEnumForEnumParameter", Id::kTemplateArguments, enums("@S<kC> s;")},
      {"SumForEnumParameter", Id::kTemplateArguments, enums("@S<kA + 1> s;")},
      {"NumberForEnumParameterOfFunction", Id::kNoOverload, enums("uint u = @get<1>();")},
      {"NumberAsDefaultOfEnumParameter", Id::kTemplateArguments,
       enums("@T<> t;", "template <E e = 1> struct T { int i; };\n")},
      {"ScalarIndexed", Id::kNotIndexable, kernel("float f = 1;\nfloat g = f@[0];")},
      {"SingleColumnIndex", Id::kIndexRange, kernel("float3x1 m;\nm[0][@1] = 1;")},
      {"SingleColumnRow", Id::kIndexRange, kernel("float3x1 m;\nm[@3][0] = 1;")},
      {"SingleRowColumn", Id::kIndexRange, kernel("float1x3 m;\nm[0][@3] = 1;")},
      {"SelectOfStructs", Id::kSelectOfStructs,
       kernel("P a = {1}; P b = {2};\nP c = @select(true, a, b);", "struct P { int i; };")},
      {"SelectOfDifferentStructs", Id::kNoCommonType,
       kernel("P a = {1}; Q b = {2};\nP c = @select(true, a, b);",
              "struct P { int i; };\nstruct Q { int i; };")},
      {"ResourceStructIndex", Id::kSplitIndex,
       kernel("uint u = r[results.@Load(0)].b.Load(0);", kHolder + "R r[2];")},
      {"ResourceStructRange", Id::kIndexRange,
       kernel("uint u = r[@2].b.Load(0);", kHolder + "R r[2];")},
      {"ResourceStructRegister", Id::kSplitRegister, kernel("", kHolder + "R r : register(@s0);")},
      {"ResourceStructTwoRegisters", Id::kTwoRegisters,
       kernel("", kHolder + "R r : register(t0) : register(@t1);")},
      {"ResourceStructSize", Id::kSplitSize, kernel("", kHolder + "R @r[5000];")},
      {"ResourceStructAssigned", Id::kConstPlace, kernel("r.i @= 1;", kHolder + "R r;")},
      {"ResourceStructOverlap", Id::kOverlap,
       kernel("uint u = r.b.Load(0) + c.Load(0);",
              kHolder + "R r : register(t3);\nByteAddressBuffer @c : register(t3);")},
      {"BitFieldByConstant", Id::kSemanticIsValue,
       kernel("", "static const uint N = 3;\nstruct S { uint a : @N; };")},
      {"BitFieldByEnumerator", Id::kSemanticIsValue,
       kernel("", "enum E { kBits = 3 };\nstruct S { E a : @kBits; };")},
      {"BitFieldByParameter", Id::kSemanticIsValue,
       kernel("S<3> s;", "template <int N> struct S { int a : @N; };")},
      {"UnsignedFloat", Id::kUnsignedBase, kernel("unsigned @F f;", "typedef float F;")},
      {"BitFieldTooWide", Id::kBitFieldWidth, kernel("", "struct S { uint b : @33; };")},
      {"BitFieldOfNoBits", Id::kBitFieldWidth, kernel("", "struct S { uint b : @0; };")},
      {"BitFieldNegative", Id::kBitFieldWidth, kernel("", "struct S { uint b : @-1; };")},
      {"BitFieldOfFloat", Id::kBitFieldType, kernel("", "struct S { float @b : 3; };")},
      {"BitFieldOfVector", Id::kBitFieldType, kernel("", "struct S { uint2 @b : 3; };")},
      {"BitFieldOfStruct", Id::kBitFieldType,
       kernel("", "struct P { int i; }; struct S { P @: 1; };")},
      {"BitFieldWidthUnknown", Id::kNotConstant,
       kernel("", "static int n;\nstruct S { uint b : (@n); };")},
      {"BitFieldTwice", Id::kRedefinition, kernel("", "struct S { uint b : 3; uint @b : 4; };")},
      {"BitFieldOut", Id::kBitFieldUse,
       kernel("S s; f(s.@b);", "struct S { uint b : 3; };\nvoid f(out uint u) { u = 1; }")},
      {"BitFieldAtomic", Id::kBitFieldUse,
       kernel("InterlockedOr(s.@b, 1);", "struct S { uint b : 3; };\ngroupshared S s;")},
      {"BitFieldSizeof", Id::kBitFieldUse,
       kernel("S s; uint u = @sizeof(s.b);", "struct S { uint b : 3; };")},
      {"BitFieldInitialisers", Id::kInitialiserCount,
       kernel("S s = @{1, 2, 3};", "struct S { uint a : 3; uint : 4; uint b : 3; };")},
      {"InstantiatesNoStruct", Id::kSpecializesNothing, kernel("", "template struct @S<int>;")},
      {"InstantiatesNoFunction", Id::kSpecializesNothing,
       kernel("", "template<typename T> T f(T a) { return a; }\ntemplate int @f(float a);")},
      {"SpecializesNoStruct", Id::kSpecializesNothing, kernel("", "template<> struct @S<int> {};")},
      {"SpecializesPlainStruct", Id::kSpecializesNothing,
       kernel("", "struct S { int i; };\ntemplate<> struct @S<int> {};")},
      {"SpecializationOfOtherCount", Id::kTemplateArguments,
       kernel("", "template<typename T> struct S {};\ntemplate<> struct @S<int, int> {};")},
      {"SpecializedTwice", Id::kSpecializedLate,
       kernel("",
              "template<typename T> struct S {};\ntemplate<> struct S<int> { int i; };\n"
              "template<> struct @S<int> { int j; };")},
      {"SpecializedAfterUse", Id::kSpecializedLate,
       kernel("",
              "template<typename T> struct S {};\nstruct U { S<int> s; };\n"
              "template<> struct @S<int> { int j; };")},
      {"PartialsTie", Id::kAmbiguousPartial,
       kernel("@S<int, int> s;",
              "template<typename A, typename B> struct S {};\n"
              "template<typename A> struct S<A, int> { int i; };\n"
              "template<typename B> struct S<int, B> { int i; };")},
      {"SpecializesNoFunction", Id::kSpecializesNothing,
       kernel("", "template<> void @f<int>(int i) {}")},
      {"SpecializesOtherParameters", Id::kSpecializesNothing,
       kernel("", "template<typename T> void f(T t) {}\ntemplate<> void @f<int>(float i) {}")},
      {"FunctionSpecializedTwice", Id::kSpecializedLate,
       kernel("",
              "template<typename T> void f(T t) {}\ntemplate<> void f<int>(int i) {}\n"
              "template<> void @f<int>(int i) {}")},
      {"NoSuchOuterMember", Id::kNoSuchMethod,
       kernel("",
              "template<typename T> struct S { T t; };\n"
              "template<typename T> T S<T>::@get() { return t; }")},
      {"OuterMemberOfOtherSignature", Id::kNoSuchMethod,
       kernel("S<int> s = {1};",
              "template<typename T> struct S { T t; T get(); };\n"
              "template<typename T> T S<T>::@get(T more) { return t; }")},
      {"OuterMemberTwice", Id::kFunctionRedefined,
       kernel("S<int> s = {1};",
              "template<typename T> struct S { T t; T get() { return t; } };\n"
              "template<typename T> T S<T>::@get() { return t; }")},
      {"OuterMemberOfOtherCount", Id::kTemplateArguments,
       kernel("",
              "template<typename T> struct S { T get(); };\n"
              "template<typename T, typename U> T S<T>::@get() { return 0; }")},
      {"NoSuchStatic", Id::kNoSuchStatic, kernel("", "struct S { int i; };\nint S::@count = 3;")},
      {"StaticOfOtherType", Id::kRedefinition,
       kernel("", "struct S { static int count; };\nfloat S::@count = 3;")},
      {"StaticTwice", Id::kRedefinition,
       kernel("", "struct S { static int count; };\nint S::count = 3;\nint S::@count = 3;")},
      {"StaticWithoutValue", Id::kConstWithoutValue,
       kernel("", "struct S { static const int @count; };")},
  };
  return all;
}

class TypeErrors : public testing::TestWithParam<size_t> {};

TEST_P(TypeErrors, StandsAtTheMark) {
  const TypeCase& one = type_cases()[GetParam()];
  expect_at_mark(one.id, one.text);
}

INSTANTIATE_TEST_SUITE_P(All, TypeErrors, testing::Range<size_t>(0, type_cases().size()),
                         [](const testing::TestParamInfo<size_t>& one) {
                           return std::string(type_cases()[one.param].name);
                         });

}  // namespace
}  // namespace kaamos::hlsl
