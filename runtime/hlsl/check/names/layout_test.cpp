// SPDX-License-Identifier: MIT
// Checks offsets against DXC's placement, and mangled names against DXC's spelling.
#include "runtime/hlsl/check/names/layout.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/check/check_test_support.h"
#include "runtime/hlsl/check/names/mangle.h"
#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl {
namespace {

struct LayoutCase {
  const char* name;
  const char* members;                                    // of a constant buffer; all are read
  std::vector<std::pair<const char*, uint32_t>> offsets;  // byte offset of each
  uint32_t size;
};

// Figures from DXC's tests vk.layout.cbuffer.fxc.* and from [HLSL: Packing rules for constant
// variables].
const LayoutCase kCases[] = {
    {"TailIsReused", "float3 a; float b;", {{"a.x", 0}, {"b", 12}}, 16},
    {"VectorMovesToNextRow", "float2 a; float3 b;", {{"a.x", 0}, {"b.x", 16}}, 28},
    {"ArrayTailIsFree", "float e[2]; float f;", {{"e[1]", 16}, {"f", 20}}, 24},
    {"ArrayStartsARow", "float a; float b[1]; float c;", {{"b[0]", 16}, {"c", 20}}, 24},
    {"StructStartsARow", "float a; S s; float b;", {{"s.x", 16}, {"s.y.x", 20}, {"b", 28}}, 32},
    {"StructArray", "S s[2]; float b;", {{"s[1].x", 16}, {"s[1].y.y", 24}, {"b", 28}}, 32},
    {"ColumnMajor3x2Array",
     "float4 pad; float3x2 foo[7]; float1x3 bar[5]; float end;",
     {{"foo[1]._m00", 48},
      {"foo[6]._m21", 16 + 6 * 32 + 16 + 8},
      {"bar[0]._m00", 240},
      {"bar[4]._m02", 240 + 4 * 48 + 32},
      {"end", 468}},
     472},
    {"ColumnMajor1x2",
     "float dummy; float1x2 foo; float end;",
     {{"foo._m01", 32}, {"end", 36}},
     40},
    {"RowMajor1x2",
     "float dummy; row_major float1x2 foo; float end;",
     {{"foo._m01", 8}, {"end", 12}},
     16},
    {"RowMajor2x3",
     "row_major float2x3 foo; float end;",
     {{"foo._m10", 16}, {"foo._m12", 24}, {"end", 28}},
     32},
    {"ColumnMajor4x4", "float4x4 m; float end;", {{"m._m10", 4}, {"m._m03", 48}, {"end", 64}}, 68},
    {"BoolIsAWord", "bool a; bool b; float2 c;", {{"b", 4}, {"c.x", 8}}, 16},
    {"DoubleAligns", "float a; double b; double3 c;", {{"b", 8}, {"c.x", 16}}, 40},
    {"PackOffset",
     "float4 a : packoffset(c2); float b : packoffset(c1.z);",
     {{"a.x", 32}, {"b", 24}},
     48},
    {"OthersComeBehindPackOffset",
     "float a; float b : packoffset(c2); float c;",
     {{"a", 36}, {"b", 32}, {"c", 40}},
     44},
    {"EmptyStructBeginsNoRow", "float a; E e; float b;", {{"b", 4}}, 8},
    {"EmptyStructInAStruct", "float a; F f; float b;", {{"f.x", 16}, {"f.y", 32}, {"b", 36}}, 40},
    {"EmptyStructEndsARow", "G g; float b;", {{"g.x", 0}, {"b", 16}}, 20},
    {"ResourcesTakeNoMemory", "float a; R r; float b; R rs[2]; float c;", {{"b", 4}, {"c", 8}}, 12},
    {"StructWithAResource", "float a; M m; float b;", {{"m.x", 16}, {"b", 20}}, 24},
    {"StructOfResourcesEndsARow", "N n; float b;", {{"n.x", 0}, {"b", 16}}, 20},
    {"ArrayOfResourcesEndsARow", "O o; float b;", {{"o.x", 0}, {"o.y", 16}, {"b", 20}}, 24},
    {"ArrayOfStructsWithResources",
     "N n[2]; float b;",
     {{"n[0].x", 0}, {"n[1].x", 16}, {"b", 32}},
     36},
    {"PackOffsetOfResources",
     "M m : packoffset(c3); float b : packoffset(c1.y);",
     {{"m.x", 48}, {"b", 20}},
     52},
    // DXC's test cbufferMinPrec.hlsl
    {"MinTypesHaveRowsOfTheirOwn",
     "min16float a; float3 b; min16float2 c; float3 d; float2 e; min16float4 f; min16float2 g; "
     "min16float3 h; double i;",
     {{"a", 0},
      {"b.x", 16},
      {"c.x", 32},
      {"d.x", 48},
      {"e.x", 64},
      {"f.x", 80},
      {"g.x", 96},
      {"h.x", 112},
      {"i", 128}},
     136},
    {"MinTypesInStructsDoNot", "H h; min16int b; int c;", {{"h.y", 4}, {"b", 16}, {"c", 32}}, 36},
    {"Row2Dimensional", "float a[2][3]; float b;", {{"a[1][2]", 80}, {"b", 84}}, 88},
};

constexpr char kStructs[] =
    "struct S { float x; float2 y; };\nstruct E {};\nstruct F { float x; E e; float y; };\n"
    "struct G { float x; E e; };\nstruct H { float x; min16float y; };\n"
    "struct R { ByteAddressBuffer a; SamplerState s; };\nstruct M { ByteAddressBuffer a; float x; "
    "};\n"
    "struct N { float x; R r; };\nstruct O { float x; ByteAddressBuffer a[2]; float y; };\n";

// All offsets at which a function's text reads a constant buffer.
std::vector<uint32_t> loaded_offsets(const std::string& text) {
  std::vector<uint32_t> offsets;
  for (size_t at = text.find("load_cb_"); at != std::string::npos;
       at = text.find("load_cb_", at + 1)) {
    const size_t comma = text.find(", ", at);
    offsets.push_back(static_cast<uint32_t>(std::stoul(text.substr(comma + 2))));
  }
  return offsets;
}

TEST(Layout, ConstantBufferOffsets) {
  for (const LayoutCase& one : kCases) {
    for (const auto& [member, offset] : one.offsets) {
      const Compilation compilation(
          kernel(std::string("results.Store(0, (uint)") + member + ");",
                 std::string(kStructs) + "cbuffer C { " + one.members + " };"));
      ASSERT_NE(compilation.module, nullptr) << one.name << compilation.messages();
      const std::string text = compilation.function("main");
      std::vector<uint32_t> offsets = loaded_offsets(text);
      ASSERT_EQ(offsets.size(), 1u) << one.name << " " << member << "\n" << text;
      if (text.find("._m") != std::string::npos) {
        // Read as a whole matrix, so the element's position in it comes from the type.
        const ir::Binding& binding = compilation.module->bindings[0];
        EXPECT_EQ(binding.size_bytes, one.size) << one.name;
        continue;
      }
      EXPECT_EQ(offsets[0], offset) << one.name << " " << member << "\n" << text;
      for (const ir::Binding& binding : compilation.module->bindings) {
        if (binding.name == "C") {
          EXPECT_EQ(binding.size_bytes, one.size) << one.name;
        }
      }
    }
  }
}

class LayoutTypes : public testing::Test {
 protected:
  ir::Module module_;
  IrTypes ir_types_{module_};
  TypeTable types_{ir_types_};
};

TEST_F(LayoutTypes, MatricesOfConstantBuffers) {
  const auto size = [&](uint32_t rows, uint32_t columns, bool row_major, uint32_t count) {
    const Type* matrix = types_.matrix(Scalar::kFloat32, rows, columns, row_major);
    return layout_of(count ? types_.array(matrix, count) : matrix, ir::Layout::kConstantBuffer)
        .size;
  };
  EXPECT_EQ(size(3, 2, false, 7), 220u);  // float3x2 foo[7], stride 32
  EXPECT_EQ(size(1, 3, false, 5), 228u);  // float1x3 bar[5], stride 48
  EXPECT_EQ(size(1, 2, false, 0), 20u);
  EXPECT_EQ(size(4, 4, false, 0), 64u);
  EXPECT_EQ(size(3, 4, false, 0), 60u);
  EXPECT_EQ(size(3, 4, true, 0), 48u);
  EXPECT_EQ(size(4, 3, true, 0), 60u);
}

TEST_F(LayoutTypes, StructuredBuffersAreTight) {
  const auto layout = [&](const Type* type) { return layout_of(type, ir::Layout::kStructured); };
  EXPECT_EQ(layout(types_.vector(Scalar::kFloat32, 3)).size, 12u);
  EXPECT_EQ(layout(types_.matrix(Scalar::kFloat32, 3, 4)).size, 48u);
  EXPECT_EQ(layout(types_.array(types_.vector(Scalar::kFloat32, 3), 3)).size, 36u);
  EXPECT_EQ(layout(types_.scalar(Scalar::kBool)).size, 4u);
  EXPECT_EQ(layout(types_.vector(Scalar::kFloat16, 3)).size, 6u);
  EXPECT_EQ(layout(types_.scalar(Scalar::kUint64)).alignment, 8u);
}

TEST(Layout, StructuredStrideAndPadding) {
  const Compilation compilation(
      kernel("results.Store(0, b[0].c + sizeof(S) + (uint)d[0].b);",
             "struct S { float3 a; float b; uint c; };\nstruct D { uint a; double b; uint c; };\n"
             "StructuredBuffer<S> b;\nStructuredBuffer<D> d;"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  for (const ir::Binding& binding : compilation.module->bindings) {
    if (binding.name != "results") {
      EXPECT_EQ(binding.size_bytes, binding.name == "b" ? 20u : 24u);
    }
  }
}

// The emitter computes the layout of the same types on its own; the two must agree.
TEST(Layout, AgreesWithTheEmitter) {
  const Compilation compilation(
      kernel("results.Store(0, (uint)c.h + (uint)s[0].h);",
             "struct I { float a; float2 b; };\nstruct T { float a; row_major float2x3 b; I c[2]; "
             "float3x2 d[2]; double e; bool f; I g; float h; };\n"
             "ConstantBuffer<T> c;\nStructuredBuffer<T> s;"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  for (const ir::Binding& binding : compilation.module->bindings) {
    if (binding.name == "results") continue;
    const auto layout = binding.name == "c" ? ir::Layout::kConstantBuffer : ir::Layout::kStructured;
    EXPECT_EQ(ir::extent_of(binding.type->element, layout, false).size, binding.size_bytes)
        << binding.name;
  }
}

TEST_F(LayoutTypes, PayloadBytesCountWords) {
  EXPECT_EQ(payload_bytes(types_.vector(Scalar::kFloat16, 3)), 12u);
  EXPECT_EQ(payload_bytes(types_.vector(Scalar::kUint64, 2)), 16u);
  EXPECT_EQ(payload_bytes(types_.array(types_.vector(Scalar::kFloat32, 3), 4)), 48u);
}

TEST_F(LayoutTypes, HugeSizesSaturate) {
  const Type* array =
      types_.array(types_.array(types_.scalar(Scalar::kFloat64), 1u << 24), 1u << 24);
  EXPECT_LE(layout_of(array, ir::Layout::kStructured).size, kMaxLayoutBytes);
  EXPECT_LE(payload_bytes(array), kMaxLayoutBytes);
}

struct MangleCase {
  const char* declaration;
  const char* mangled;  // without the leading \01
};

// From DXC's own tests and from names quoted by its users.
const MangleCase kNames[] = {
    {"void f() {}", "?f@@YAXXZ"},
    {"float f(float a) { return a; }", "?f@@YAMM@Z"},
    {"void f(inout float x, float size) {}", "?f@@YAXAIAMM@Z"},
    {"void f(inout int p, uint a, uint b, uint c) {}", "?f@@YAXAIAHIII@Z"},
    {"float4 f(int3 coord) { return 0; }", "?f@@YA?AV?$vector@M$03@@V?$vector@H$02@@@Z"},
    {"float3 f(float3 v) { return v; }", "?f@@YA?AV?$vector@M$02@@V1@@Z"},
    {"bool f(bool b, uint u, uint v) { return b; }", "?f@@YA_N_NII@Z"},
    {"void f(S s, S t) {}", "?f@@YAXUS@@0@Z"},
    {"void f(inout S s) {}", "?f@@YAXUS@@@Z"},
    {"void f(RWByteAddressBuffer b, uint i) {}", "?f@@YAXURWByteAddressBuffer@@I@Z"},
    {"void f(float4x4 m) {}", "?f@@YAXV?$matrix@M$03$03@@@Z"},
    {"void f(inout float a, inout uint b, inout float2 c, float3 d, float3 e) {}",
     "?f@@YAXAIAMAIAIAIAV?$vector@M$01@@V?$vector@M$02@@3@Z"},
};

TEST(Mangling, AsDxc) {
  for (const MangleCase& one : kNames) {
    const Compilation compilation(std::string("struct S { int a; };\nexport ") + one.declaration);
    ASSERT_NE(compilation.module, nullptr) << compilation.messages();
    ASSERT_EQ(compilation.module->library_functions.size(), 1u);
    EXPECT_EQ(compilation.module->library_functions[0].mangled, std::string("\01") + one.mangled)
        << one.declaration;
  }
}

TEST(Mangling, EntryPointWithPayload) {
  const Compilation compilation(
      "struct Payload { int a; };\n[shader(\"closesthit\")]\n"
      "void Hit(inout Payload p, BuiltInTriangleIntersectionAttributes a) {}");
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(compilation.module->entry_points[0].function->mangled,
            "\01?Hit@@YAXUPayload@@UBuiltInTriangleIntersectionAttributes@@@Z");
}

TEST(Mangling, NamespacesAndTemplates) {
  const Compilation compilation(kernel("results.Store(0, n::f(1u) + g<uint>(2u));",
                                       "namespace n { uint f(uint x) { return x; } }\n"
                                       "template <typename T> T g(T x) { return x; }"));
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  EXPECT_EQ(compilation.module->functions[0]->mangled, "\01?f@n@@YAII@Z");
  EXPECT_EQ(compilation.module->functions[1]->mangled, "\01??$g@I@@YAII@Z");
}

}  // namespace
}  // namespace kaamos::hlsl
