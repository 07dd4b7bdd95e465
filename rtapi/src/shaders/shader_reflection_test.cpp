// SPDX-License-Identifier: MIT
#include <rtapi/shader_compiler.h>

#include <map>

#include "rtapi/testing/expect_error.h"

namespace rtapi {
namespace {

using ::testing::ElementsAre;

ShaderCompilation check(const char* source, const char* target = "lib_6_6",
                        const char* entry = "") {
  ShaderCompileOptions options;
  options.File = "reflection.hlsl";
  options.Source = source;
  options.Target = target;
  options.EntryPoint = entry;
  options.CheckOnly = true;
  return CompileShaderLibrary(options);
}

const ShaderBindingInfo* find(const ShaderCompilation& compiled, const std::string& name) {
  for (const ShaderBindingInfo& binding : compiled.Reflection.Bindings) {
    if (binding.Name == name) return &binding;
  }
  return nullptr;
}

constexpr char kLibrary[] = R"hlsl(
struct Light { float3 position; float intensity; };
cbuffer Frame : register(b2, space1) {
  float4x4 view;
  row_major float3x2 shear;
  Light lights[3];
  bool is_on;
};
ConstantBuffer<Light> sun : register(b3);
RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<Light> more[] : register(t1, space2);
RWTexture2D<float4> target : register(u0);
Texture2DArray<uint2> layers[4] : register(t5);
SamplerState linear_sampler : register(s1);
SamplerComparisonState unreached : register(s2);
struct [raypayload] Payload { float3 color : read(caller) : write(caller, miss); };
[shader("raygeneration")] void Trace() {
  Payload payload; payload.color = 0;
  RayDesc ray = {0, 0, 0, 0, 0, 0, 1, 1};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray, payload);
  float x = mul(view, float4(payload.color, 1)).x + shear[0].x + lights[1].intensity + is_on;
  target[uint2(0, 0)] = x + more[2][0].position.x + layers[1][uint3(0, 0, 0)].x;
}
[shader("miss")] void Sky(inout Payload payload) { payload.color = sun.position; }
[RootSignature("UAV(u0)")] [shader("compute")] [numthreads(8, 4, 2)] void Fill() { target[uint2(1, 1)] = 0; }
)hlsl";

TEST(ShaderReflection, EntriesHaveWhatTheyReach) {
  const auto compiled = check(kLibrary, "lib_6_7");
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  std::map<std::string, ShaderEntryInfo> entries;
  for (const auto& entry : compiled.Reflection.Entries) entries[entry.Export.Name] = entry;
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries["Trace"].Export.Stage, ShaderStage::kRayGeneration);
  EXPECT_EQ(entries["Trace"].Bindings.size(), 5u);
  EXPECT_EQ(entries["Sky"].Export.Stage, ShaderStage::kMiss);
  EXPECT_EQ(entries["Sky"].Export.PayloadSizeInBytes, 12u);
  EXPECT_THAT(entries["Sky"].Export.Resources, ElementsAre("sun"));
  EXPECT_THAT(entries["Fill"].Export.ThreadGroup, ElementsAre(8u, 4u, 2u));
  EXPECT_EQ(entries["Fill"].RootSignature, "UAV(u0)");
  ASSERT_EQ(entries["Fill"].Bindings.size(), 1u);
  EXPECT_EQ(compiled.Reflection.Bindings[entries["Fill"].Bindings[0]].Name, "target");
  EXPECT_EQ(find(compiled, "unreached"), nullptr);
}

TEST(ShaderReflection, BindingsHaveRegistersAndCounts) {
  const auto compiled = check(kLibrary, "lib_6_7");
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  const ShaderBindingInfo* more = find(compiled, "more");
  ASSERT_NE(more, nullptr);
  EXPECT_EQ(more->Type, ShaderResourceType::kStructuredBuffer);
  EXPECT_EQ(more->RegisterClass, 't');
  EXPECT_EQ(more->Register, 1u);
  EXPECT_EQ(more->Space, 2u);
  EXPECT_EQ(more->Count, 0xFFFFFFFFu);
  EXPECT_EQ(more->SizeInBytes, 16u);
  EXPECT_EQ(more->Element.Name, "Light");
  const ShaderBindingInfo* layers = find(compiled, "layers");
  ASSERT_NE(layers, nullptr);
  EXPECT_EQ(layers->Type, ShaderResourceType::kTexture2DArray);
  EXPECT_EQ(layers->Count, 4u);
  EXPECT_EQ(layers->Element.Name, "uint2");
  EXPECT_FALSE(layers->IsWritable);
  const ShaderBindingInfo* target = find(compiled, "target");
  ASSERT_NE(target, nullptr);
  EXPECT_TRUE(target->IsWritable);
  EXPECT_EQ(target->RegisterClass, 'u');
  ASSERT_NE(find(compiled, "scene"), nullptr);
  EXPECT_EQ(find(compiled, "scene")->Type, ShaderResourceType::kAccelerationStructure);
}

TEST(ShaderReflection, ConstantBuffersHaveTheirLayout) {
  const auto compiled = check(kLibrary, "lib_6_7");
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  const ShaderBindingInfo* frame = find(compiled, "Frame");
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frame->IsCBuffer);
  EXPECT_EQ(frame->Register, 2u);
  EXPECT_EQ(frame->Space, 1u);
  const auto& members = frame->Element.Members;
  ASSERT_EQ(members.size(), 4u);
  EXPECT_EQ(members[0].Name, "view");
  EXPECT_EQ(members[0].OffsetInBytes, 0u);
  EXPECT_EQ(members[0].SizeInBytes, 64u);
  EXPECT_EQ(members[0].Type.Name, "float4x4");
  EXPECT_FALSE(members[0].Type.IsRowMajor);
  EXPECT_EQ(members[1].Name, "shear");
  EXPECT_EQ(members[1].OffsetInBytes, 64u);
  EXPECT_EQ(members[1].SizeInBytes, 40u);  // three rows of 16 bytes, the last of two floats
  EXPECT_TRUE(members[1].Type.IsRowMajor);
  EXPECT_EQ(members[2].OffsetInBytes, 112u);  // an array begins a row
  EXPECT_EQ(members[2].SizeInBytes, 48u);
  EXPECT_THAT(members[2].Type.Elements, ElementsAre(3u));
  EXPECT_TRUE(members[2].Type.IsStruct);
  ASSERT_EQ(members[2].Type.Members.size(), 2u);
  EXPECT_EQ(members[2].Type.Members[1].Name, "intensity");
  EXPECT_EQ(members[2].Type.Members[1].OffsetInBytes, 12u);
  EXPECT_EQ(members[3].Type.Scalar, ShaderScalarType::kBool);
  EXPECT_EQ(frame->SizeInBytes, members[3].OffsetInBytes + 4);
  const ShaderBindingInfo* sun = find(compiled, "sun");
  ASSERT_NE(sun, nullptr);
  EXPECT_FALSE(sun->IsCBuffer);
  EXPECT_EQ(sun->Element.Name, "Light");
}

TEST(ShaderReflection, TextureBuffersHaveTheLayoutOfConstantBuffers) {
  const auto compiled = check(
      "struct Light { float3 position; float2 size; };\n"
      "tbuffer Frame : register(t2, space1) { float2 scale; float list[3]; };\n"
      "TextureBuffer<Light> lights[4];\n"
      "RWBuffer<float> target;\n"
      "[shader(\"compute\")] [numthreads(1, 1, 1)] void Fill() {\n"
      "  target[0] = list[1] + lights[2].size.y;\n}\n",
      "lib_6_7");
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  const ShaderBindingInfo* frame = find(compiled, "Frame");
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->Type, ShaderResourceType::kTextureBuffer);
  EXPECT_EQ(frame->RegisterClass, 't');
  EXPECT_EQ(frame->Register, 2u);
  EXPECT_TRUE(frame->IsCBuffer);
  EXPECT_EQ(frame->SizeInBytes, 52u);
  ASSERT_EQ(frame->Element.Members.size(), 2u);
  EXPECT_EQ(frame->Element.Members[1].OffsetInBytes, 16u);
  const ShaderBindingInfo* lights = find(compiled, "lights");
  ASSERT_NE(lights, nullptr);
  EXPECT_EQ(lights->RegisterClass, 't');
  EXPECT_EQ(lights->Count, 4u);
  EXPECT_FALSE(lights->IsCBuffer);
  ASSERT_EQ(lights->Element.Members.size(), 2u);
  EXPECT_EQ(lights->Element.Members[1].OffsetInBytes, 16u);
}

TEST(ShaderReflection, VertexShadersHaveTheirInputs) {
  const auto compiled = check(R"(
float4 Main(float3 position : POSITION, uint2 cell : CELL3, out float fade : FADE) : SV_Position {
  fade = cell.x;
  return float4(position, 1);
})",
                              "vs_6_0", "Main");
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  ASSERT_EQ(compiled.Reflection.Entries.size(), 1u);
  const ShaderEntryInfo& entry = compiled.Reflection.Entries[0];
  ASSERT_EQ(entry.Inputs.size(), 2u);
  EXPECT_EQ(entry.Inputs[0].Semantic, "POSITION");
  EXPECT_EQ(entry.Inputs[0].Components, 3u);
  EXPECT_EQ(entry.Inputs[1].Semantic, "CELL");
  EXPECT_EQ(entry.Inputs[1].SemanticIndex, 3u);
  EXPECT_EQ(entry.Inputs[1].Type, ShaderScalarType::kUint32);
  EXPECT_EQ(entry.Outputs.size(), 2u);
}

TEST(ShaderReflection, ErrorsLeaveItEmpty) {
  const auto compiled = check("float x");
  EXPECT_FALSE(compiled.Status.ok());
  EXPECT_TRUE(compiled.Reflection.Entries.empty());
}

// A compilation's Sources are all that another one needs.
TEST(ShaderCompilerFiles, SourcesReplayACompilation) {
  std::map<std::string, std::string> files = {
      {"shaders/main.hlsl",
       "#include \"part/a.hlsli\"\n#include <b.hlsli>\n"
       "[shader(\"compute\")] [numthreads(A, B, 1)] void Main() {}"},
      {"shaders/part/a.hlsli", "#define A 3\n#include \"../c.hlsli\"\n"},
      {"shaders/c.hlsli", ""},
      {"library/b.hlsli", "#define B 5\n"}};
  const auto read = [&files](const std::string& path) -> std::optional<std::string> {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  ShaderCompileOptions options;
  options.File = "shaders/main.hlsl";
  options.IncludeDirectories = {"empty", "library"};
  options.CheckOnly = true;
  options.ReadFile = read;
  const auto first = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(first.Status), "ok");
  ASSERT_EQ(first.Sources.size(), 4u);
  EXPECT_EQ(first.Dependencies.front(), "shaders/main.hlsl");
  files.clear();
  for (const ShaderSourceFile& file : first.Sources) files[file.Path] = file.Text;
  const auto second = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(second.Status), "ok");
  EXPECT_THAT(second.Reflection.Entries[0].Export.ThreadGroup, ElementsAre(3u, 5u, 1u));
  files.erase("library/b.hlsli");
  EXPECT_ERROR(CompileShaderLibrary(options).Status, "KA2752", "shaders/main.hlsl:2", "b.hlsli");
}

TEST(ShaderPreprocessing, TextCompilesToTheSame) {
  ShaderCompileOptions options;
  options.File = "main.hlsl";
  options.Source = R"hlsl(#include "a.hlsli"
#pragma pack_matrix(row_major)
#define NEGATIVE -1
#define TEXT "UAV(u0), CBV" "(b0)"
cbuffer C : register(b0) { float3x2 m; }
[RootSignature(TEXT)] [shader("compute")] [numthreads(SIZE, 1 -NEGATIVE, 1)]
void Main() { o.Store(0, mul(m, float2(1, 2)).x); })hlsl";
  options.Defines = {{"SIZE", "4"}};
  options.CheckOnly = true;
  options.ReadFile = [](const std::string&) { return "RWByteAddressBuffer o : register(u0);\n"; };
  const auto text = PreprocessShader(options);
  ASSERT_EQ(testing::MessageOf(text.Status), "ok");
  EXPECT_EQ(text.Text.find("SIZE"), std::string::npos);
  EXPECT_THAT(text.Text, ::testing::HasSubstr("\"a.hlsli\""));

  ShaderCompileOptions again;
  again.File = "preprocessed.hlsl";
  again.Source = text.Text;
  again.CheckOnly = true;
  const auto compiled = CompileShaderLibrary(again);
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  ASSERT_EQ(compiled.Reflection.Entries.size(), 1u);
  EXPECT_THAT(compiled.Reflection.Entries[0].Export.ThreadGroup, ElementsAre(4u, 2u, 1u));
  EXPECT_EQ(compiled.Reflection.Entries[0].RootSignature, "UAV(u0), CBV(b0)");
  ASSERT_NE(find(compiled, "C"), nullptr);
  EXPECT_TRUE(find(compiled, "C")->Element.Members[0].Type.IsRowMajor);

  options.Source = "#error stop here";
  EXPECT_ERROR(PreprocessShader(options).Status, "KA2752", "stop here");
  options.Target = "xs_1_0";
  EXPECT_ERROR(PreprocessShader(options).Status, "KA2752", "xs_1_0");
}

}  // namespace
}  // namespace rtapi
