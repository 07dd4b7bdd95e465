// SPDX-License-Identifier: MIT
//
// A geometry shader called with rows of words, as native code and interpreted: expected vertices
// are worked out by hand.
#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <vector>

#include "executors.h"
#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::test {
namespace {

constexpr char kSource[] = R"(
struct Part { float2x3 m : M; int2 n[2] : N; };
struct In { float4 p : SV_Position; Part part; bool flag : FLAG; };
struct Out { float4 p : SV_Position; Part part; min16uint sum : SUM; uint id : SV_PrimitiveID; };

static uint calls;

void put(inout TriangleStream<Out> stream, Out o) {
  ++calls;
  o.sum = calls;
  stream.Append(o);
}

[instance(3)]
[maxvertexcount(5)]
void main(line In i[2], uint id : SV_PrimitiveID, uint instance : SV_GSInstanceID,
          inout TriangleStream<Out> stream) {
  for (uint k = 0; k < 2; ++k) {
    Out o;
    o.p = i[k].p * 2;
    o.part = i[1 - k].part;
    o.part.n[1] += int(instance);
    o.sum = 0;
    o.id = i[k].flag ? id : 77;
    put(stream, o);
    if (instance == 1) stream.RestartStrip();
  }
  if (instance == 2) {
    for (uint n = 0; n < 9; ++n) put(stream, (Out)n);
  }
})";

hlsl::FrontendOptions options() {
  hlsl::FrontendOptions options;
  options.path = "geometry.hlsl";
  options.text = kSource;
  options.target = "gs_6_6";
  options.entry_point = "main";
  return options;
}

struct Emitted {
  std::vector<std::vector<uint32_t>> vertices;
  std::vector<bool> begins;
};

// Of a line whose corner c has word w as 100 c + w, as the shader's types say.
Emitted call(const shader::GraphicsDesc& code, uint32_t instance) {
  std::vector<uint32_t> rows(2 * code.input_columns, 0xFFFFFFFFu);
  for (uint32_t corner = 0; corner < 2; ++corner) {
    for (uint32_t e = 0; e < code.input_count; ++e) {
      const shader::SignatureElement& element = code.inputs[e];
      for (uint32_t c = 0; c < element.components; ++c) {
        const uint32_t word = element.first_column + c;
        const uint32_t value = 100 * corner + word;
        rows[corner * code.input_columns + word] =
            element.type == shader::ColumnType::kFloat
                ? std::bit_cast<uint32_t>(static_cast<float>(value))
                : value;
      }
      uint32_t& first = rows[corner * code.input_columns + element.first_column];
      if (element.system_value == shader::SystemValue::kPrimitiveId) first = 9;
      if (element.system_value == shader::SystemValue::kGeometryInstance) first = instance;
      if (std::string(element.semantic) == "FLAG") first = corner;
    }
  }
  const uint32_t most = code.shape.most_vertices;
  std::vector<uint32_t> out((most + 1) * code.output_columns, 0xABCDABCD);
  const auto begins = std::make_unique<bool[]>(most);
  shader::GeometryStream stream;
  stream.rows = out.data();
  stream.begins = begins.get();
  stream.columns = code.output_columns;
  stream.most = most;
  shader::DispatchConstants constants = {};
  shader::Invocation invocation;
  invocation.dispatch = &constants;
  code.geometry(invocation, {rows.data(), code.input_columns}, stream);
  EXPECT_EQ(out.back(), 0xABCDABCD) << "written behind the last vertex";
  Emitted emitted;
  for (uint32_t v = 0; v < stream.count; ++v) {
    const uint32_t* row = out.data() + size_t{v} * code.output_columns;
    emitted.vertices.emplace_back(row, row + code.output_columns);
    emitted.begins.push_back(begins[v]);
  }
  return emitted;
}

void check(const Compiled& compiled) {
  ASSERT_NE(compiled.library, nullptr) << compiled.error;
  const shader::ExportDesc& desc = compiled.library->exports[0];
  EXPECT_EQ(desc.stage, shader::Stage::kGeometry);
  const shader::GraphicsDesc& code = *desc.graphics;
  EXPECT_EQ(code.shape.corners, 2u);
  EXPECT_EQ(code.shape.output_corners, 3u);
  EXPECT_EQ(code.shape.instances, 3u);
  ASSERT_EQ(code.input_columns, 4u + 6 + 4 + 1 + 1 + 1);
  ASSERT_EQ(code.output_columns, 4u + 6 + 4 + 1 + 1);
  const auto real = [](const Emitted& from, uint32_t vertex, uint32_t word) {
    return std::bit_cast<float>(from.vertices[vertex][word]);
  };
  for (uint32_t instance = 0; instance < 3; ++instance) {
    SCOPED_TRACE(instance);
    const Emitted emitted = call(code, instance);
    ASSERT_EQ(emitted.vertices.size(), instance == 2 ? 5u : 2u);
    for (uint32_t k = 0; k < 2; ++k) {
      EXPECT_EQ(real(emitted, k, 3), static_cast<float>((100 * k + 3) * 2));
      EXPECT_EQ(real(emitted, k, 9), static_cast<float>(100 * (1 - k) + 9));  // the matrix
      EXPECT_EQ(emitted.vertices[k][10], 100 * (1 - k) + 10);
      EXPECT_EQ(emitted.vertices[k][13], 100 * (1 - k) + 13 + instance);
      EXPECT_EQ(emitted.vertices[k][14], k + 1);
      EXPECT_EQ(emitted.vertices[k][15], k == 1 ? 9u : 77u);
      EXPECT_EQ(emitted.begins[k], k == 0 || instance == 1);
    }
    if (instance == 2) {
      EXPECT_EQ(real(emitted, 4, 0), 2.0f);
    }
  }
}

TEST(GeometryStage, Native) {
  check(compile_native({options()})[0]);
}
TEST(GeometryStage, Interpreted) {
  check(compile_interpreted(options()));
}
TEST(GeometryStage, HasSpirv) {
  const auto module = compile_module(options());
  ASSERT_TRUE(module) << module.error();
  const hlsl::SpirvLibrary spirv = hlsl::compile_spirv(**module);
  EXPECT_FALSE(spirv.error) << spirv.error.message();
}

}  // namespace
}  // namespace kaamos::test
