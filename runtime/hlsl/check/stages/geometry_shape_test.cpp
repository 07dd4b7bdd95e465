// SPDX-License-Identifier: MIT
// Tests what the checker says about geometry shaders: `@` marks the place.
#include "runtime/hlsl/check/marked_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

std::string geometry(const std::string& attributes, const std::string& parameters,
                     const std::string& body = {}) {
  return "struct V { float4 p : SV_Position; };\n" + attributes + "\nvoid " +
         (parameters.find('@') == std::string::npos && attributes.find('@') == std::string::npos &&
                  body.find('@') == std::string::npos
              ? "@"
              : "") +
         "main(" + parameters + ") {\n" + body + "\n}\n";
}

const std::string kThree = "[maxvertexcount(3)]";
const std::string kTriangles = "triangle V i[3], inout TriangleStream<V> o";

TEST(GeometryShaders, SayWhatTheyTakeAndMake) {
  const std::pair<Id, std::string> cases[] = {
      {Id::kGeometryShader, geometry("", kTriangles)},
      {Id::kGeometryShader, geometry(kThree, "inout TriangleStream<V> o")},
      {Id::kGeometryShader, geometry(kThree, "triangle V i[3]")},
      {Id::kGeometryShader, geometry(kThree, "triangle V @i[2], inout TriangleStream<V> o")},
      {Id::kGeometryShader, geometry(kThree, "line V i[2], line V @k[2], inout LineStream<V> o")},
      {Id::kGeometryShader, geometry(kThree, "line V i[2], LineStream<V> @o")},
      {Id::kGeometryShader, geometry("[maxvertexcount(@1025)]", kTriangles)},
      {Id::kGeometryShader, geometry("[maxvertexcount(@0)]", kTriangles)},
      {Id::kGeometryShader, geometry("[maxvertexcount(257)]", kTriangles)},
      {Id::kGeometryShader, geometry(kThree + " [instance(@33)]", kTriangles)},
      {Id::kArgumentCount, geometry("[@maxvertexcount]", kTriangles)},
      {Id::kUnsupported, geometry(kThree, "lineadj V @i[4], inout LineStream<V> o")},
      {Id::kUnsupported,
       geometry(kThree, "point V i[1], inout PointStream<V> o, inout PointStream<V> @q")},
      {Id::kElementType, geometry(kThree, "point V i[1], inout PointStream<@float4> o")},
      {Id::kTemplateCount, geometry(kThree, "point V i[1], inout @PointStream<V, V> o")},
      {Id::kNoSuchMethod, geometry(kThree, kTriangles, "o.@Push(i[0]);")},
      {Id::kArgumentCount, geometry(kThree, kTriangles, "o.@Append(i[0], i[1]);")},
      {Id::kSemanticNotThere,
       geometry(kThree, "point uint id[1] : @SV_PrimitiveID, inout PointStream<V> o")},
      {Id::kSemanticNotThere,
       geometry(kThree, "point V i[1], float2 uv : @UV, inout PointStream<V> o")}};
  FrontendOptions options;
  options.target = "gs_6_0";
  for (const auto& [id, text] : cases) {
    SCOPED_TRACE(text);
    expect_at_mark(id, text, options);
  }
}

TEST(GeometryShaders, AloneHaveStreams) {
  expect_at_mark(Id::kStage,
                 "struct V { float4 p : SV_Position; };\n"
                 "void f(inout PointStream<V> s) { s.@RestartStrip(); }\n"
                 "[shader(\"compute\")] [numthreads(1, 1, 1)]\n"
                 "void main() { PointStream<V> s; f(s); }\n");
}

TEST(GeometryShaders, HaveElementsForEachCorner) {
  FrontendOptions options;
  options.target = "gs_6_0";
  const Compilation compilation(
      "struct V { float4 p : SV_Position; float2x3 m : M; int n[2] : N; };\n"
      "[instance(5)] [maxvertexcount(4 + 2)]\n"
      "void main(line V i[2], uint id : SV_PrimitiveID, inout TriangleStream<V> o) {\n"
      "  o.Append(i[id & 1]);\n}\n",
      options);
  ASSERT_NE(compilation.module, nullptr) << compilation.messages();
  const ir::EntryPoint& entry = compilation.module->entry_points[0];
  EXPECT_EQ(entry.geometry.corners, 2u);
  EXPECT_EQ(entry.geometry.output_corners, 3u);
  EXPECT_EQ(entry.geometry.most_vertices, 6u);
  EXPECT_EQ(entry.geometry.instances, 5u);
  ASSERT_EQ(entry.inputs.size(), 7u);  // a matrix by columns
  ASSERT_EQ(entry.outputs.size(), 6u);
  EXPECT_EQ(entry.inputs[3].semantic_index, 2u);
  EXPECT_EQ(entry.outputs[5].first_column, 11u);
  EXPECT_EQ(entry.parameters.size(), entry.inputs.size());
  EXPECT_EQ(entry.function->parameters[1]->type->kind, ir::TypeKind::kArray);
  EXPECT_EQ(entry.function->parameters[6]->type->kind, ir::TypeKind::kScalar);
}

}  // namespace
}  // namespace kaamos::hlsl
