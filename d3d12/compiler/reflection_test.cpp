// SPDX-License-Identifier: MIT
#include "d3d12/compiler/reflection.h"

#include <gmock/gmock.h>

#include <map>
#include <string>

#include <wrl/client.h>

#include "d3d12/compiler/compile.h"
#include "d3d12/compiler/reflection_nodes.h"

namespace kaamos::d3d12 {
namespace {

using Microsoft::WRL::ComPtr;
using testing::HasSubstr;

template <class T>
ComPtr<T> reflect(const char* source, const char* target, const IID& iid, const char* entry = "") {
  DxcArguments arguments;
  arguments.options.File = "reflection.hlsl";
  arguments.options.Source = source;
  arguments.options.Target = target;
  arguments.options.EntryPoint = entry;
  const CompiledSource compiled = compile_source(arguments);
  EXPECT_TRUE(compiled.ok) << compiled.messages;
  ComPtr<T> out;
  EXPECT_EQ(create_reflection(compiled.container.data(), compiled.container.size(), iid,
                              reinterpret_cast<void**>(out.GetAddressOf())),
            S_OK);
  return out;
}

constexpr char kLibrary[] = R"hlsl(
struct Light { float3 position; float intensity; };
cbuffer Frame : register(b2, space1) { float4x4 view; Light lights[3]; int2 size; };
ConstantBuffer<Light> sun : register(b3);
StructuredBuffer<Light> more[] : register(t1, space2);
RWTexture2D<float2> image : register(u0);
ByteAddressBuffer bytes : register(t7);
struct Payload { float3 color; };
[shader("miss")] void Sky(inout Payload p) {
  p.color = sun.position + lights[1].position + view[0].xyz + more[1][0].position + size.x;
}
[shader("callable")] void Draw(inout Payload p) { image[uint2(0, 0)] = bytes.Load(0); }
)hlsl";

std::map<std::string, ID3D12FunctionReflection*> functions_of(ID3D12LibraryReflection* library) {
  std::map<std::string, ID3D12FunctionReflection*> out;
  D3D12_LIBRARY_DESC desc = {};
  EXPECT_EQ(library->GetDesc(&desc), S_OK);
  for (UINT i = 0; i < desc.FunctionCount; ++i) {
    auto* function = library->GetFunctionByIndex(static_cast<INT>(i));
    D3D12_FUNCTION_DESC one = {};
    EXPECT_EQ(function->GetDesc(&one), S_OK);
    const std::string name = one.Name;
    out[name.substr(2, name.find('@') - 2)] = function;  // of "\1?Sky@@YAXUPayload@@@Z"
  }
  return out;
}

TEST(LibraryReflection, FunctionsHaveKindsAndResources) {
  const auto library =
      reflect<ID3D12LibraryReflection>(kLibrary, "lib_6_5", IID_ID3D12LibraryReflection);
  auto functions = functions_of(library.Get());
  ASSERT_EQ(functions.size(), 2u);
  D3D12_FUNCTION_DESC desc = {};
  ASSERT_EQ(functions["Sky"]->GetDesc(&desc), S_OK);
  EXPECT_EQ(D3D12_SHVER_GET_TYPE(desc.Version), UINT{D3D12_SHVER_MISS_SHADER});
  EXPECT_EQ(D3D12_SHVER_GET_MAJOR(desc.Version), 6u);
  EXPECT_EQ(D3D12_SHVER_GET_MINOR(desc.Version), 5u);
  EXPECT_EQ(desc.BoundResources, 3u);
  EXPECT_EQ(desc.ConstantBuffers, 3u);  // the structured buffer's element too
  ASSERT_EQ(functions["Draw"]->GetDesc(&desc), S_OK);
  EXPECT_EQ(D3D12_SHVER_GET_TYPE(desc.Version), UINT{D3D12_SHVER_CALLABLE_SHADER});
  EXPECT_EQ(desc.BoundResources, 2u);
  EXPECT_EQ(library->GetFunctionByIndex(2)->GetDesc(&desc), E_FAIL);
  EXPECT_EQ(library->GetFunctionByIndex(-1)->GetDesc(&desc), E_FAIL);
}

TEST(LibraryReflection, BindingsAreDescribed) {
  const auto library =
      reflect<ID3D12LibraryReflection>(kLibrary, "lib_6_5", IID_ID3D12LibraryReflection);
  auto functions = functions_of(library.Get());
  D3D12_SHADER_INPUT_BIND_DESC desc = {};
  ASSERT_EQ(functions["Sky"]->GetResourceBindingDescByName("more", &desc), S_OK);
  EXPECT_EQ(desc.Type, D3D_SIT_STRUCTURED);
  EXPECT_EQ(desc.BindPoint, 1u);
  EXPECT_EQ(desc.Space, 2u);
  EXPECT_EQ(desc.BindCount, 0u);  // unbounded
  EXPECT_EQ(desc.NumSamples, 16u);
  ASSERT_EQ(functions["Draw"]->GetResourceBindingDescByName("image", &desc), S_OK);
  EXPECT_EQ(desc.Type, D3D_SIT_UAV_RWTYPED);
  EXPECT_EQ(desc.Dimension, D3D_SRV_DIMENSION_TEXTURE2D);
  EXPECT_EQ(desc.ReturnType, D3D_RETURN_TYPE_FLOAT);
  EXPECT_EQ(desc.uFlags, UINT{D3D_SIF_TEXTURE_COMPONENT_0});  // two components
  ASSERT_EQ(functions["Draw"]->GetResourceBindingDesc(0, &desc), S_OK);
  EXPECT_STREQ(desc.Name, "bytes");  // views before unordered ones
  EXPECT_EQ(functions["Draw"]->GetResourceBindingDesc(2, &desc), E_INVALIDARG);
  EXPECT_NE(functions["Draw"]->GetResourceBindingDescByName("more", &desc), S_OK);
}

TEST(LibraryReflection, TextureBuffersAreBuffersOfRows) {
  const auto library = reflect<ID3D12LibraryReflection>(
      "tbuffer Frame : register(t2) { float2 scale; float list[3]; };\n"
      "struct Payload { float color; };\n"
      "[shader(\"miss\")] void Sky(inout Payload p) { p.color = list[1]; }\n",
      "lib_6_5", IID_ID3D12LibraryReflection);
  auto* sky = functions_of(library.Get())["Sky"];
  D3D12_SHADER_INPUT_BIND_DESC desc = {};
  ASSERT_EQ(sky->GetResourceBindingDescByName("Frame", &desc), S_OK);
  EXPECT_EQ(desc.Type, D3D_SIT_TBUFFER);
  EXPECT_EQ(desc.Dimension, D3D_SRV_DIMENSION_BUFFER);
  EXPECT_EQ(desc.BindPoint, 2u);
  D3D12_SHADER_BUFFER_DESC buffer = {};
  ASSERT_EQ(sky->GetConstantBufferByName("Frame")->GetDesc(&buffer), S_OK);
  EXPECT_EQ(buffer.Type, D3D_CT_TBUFFER);
  EXPECT_EQ(buffer.Variables, 2u);
  EXPECT_EQ(buffer.Size, 64u);
}

TEST(LibraryReflection, ConstantBuffersHaveVariables) {
  const auto library =
      reflect<ID3D12LibraryReflection>(kLibrary, "lib_6_5", IID_ID3D12LibraryReflection);
  auto* sky = functions_of(library.Get())["Sky"];
  auto* frame = sky->GetConstantBufferByName("Frame");
  D3D12_SHADER_BUFFER_DESC buffer = {};
  ASSERT_EQ(frame->GetDesc(&buffer), S_OK);
  EXPECT_EQ(buffer.Type, D3D_CT_CBUFFER);
  EXPECT_EQ(buffer.Variables, 3u);
  EXPECT_EQ(buffer.Size, 128u);  // 64 + 3 * 16 + 8, in whole rows
  D3D12_SHADER_VARIABLE_DESC variable = {};
  ASSERT_EQ(frame->GetVariableByName("lights")->GetDesc(&variable), S_OK);
  EXPECT_EQ(variable.StartOffset, 64u);
  EXPECT_EQ(variable.Size, 48u);
  D3D12_SHADER_TYPE_DESC type = {};
  ASSERT_EQ(frame->GetVariableByIndex(0)->GetType()->GetDesc(&type), S_OK);
  EXPECT_EQ(type.Class, D3D_SVC_MATRIX_COLUMNS);
  EXPECT_EQ(type.Type, D3D_SVT_FLOAT);
  EXPECT_EQ(type.Rows, 4u);
  EXPECT_STREQ(type.Name, "float4x4");
  auto* light = frame->GetVariableByName("lights")->GetType();
  ASSERT_EQ(light->GetDesc(&type), S_OK);
  EXPECT_EQ(type.Class, D3D_SVC_STRUCT);
  EXPECT_EQ(type.Elements, 3u);
  EXPECT_EQ(type.Members, 2u);
  EXPECT_EQ(type.Columns, 4u);
  EXPECT_STREQ(light->GetMemberTypeName(1), "intensity");
  ASSERT_EQ(light->GetMemberTypeByName("intensity")->GetDesc(&type), S_OK);
  EXPECT_EQ(type.Offset, 12u);
  EXPECT_EQ(type.Class, D3D_SVC_SCALAR);
  EXPECT_EQ(frame->GetVariableByIndex(0)->GetBuffer(), frame);
  ASSERT_EQ(sky->GetVariableByName("size")->GetDesc(&variable), S_OK);
  EXPECT_EQ(variable.StartOffset, 112u);

  auto* sun = sky->GetConstantBufferByName("sun");
  ASSERT_EQ(sun->GetDesc(&buffer), S_OK);
  EXPECT_EQ(buffer.Variables, 1u);
  ASSERT_EQ(sun->GetVariableByIndex(0)->GetDesc(&variable), S_OK);
  EXPECT_STREQ(variable.Name, "sun");
  auto* more = sky->GetConstantBufferByName("more");
  ASSERT_EQ(more->GetDesc(&buffer), S_OK);
  EXPECT_EQ(buffer.Type, D3D_CT_RESOURCE_BIND_INFO);
  ASSERT_EQ(more->GetVariableByName("$Element")->GetDesc(&variable), S_OK);
  EXPECT_EQ(variable.Size, 16u);
}

// As in D3D12, chains of look-ups need no checks until the end.
TEST(LibraryReflection, WhatIsNotThereFails) {
  const auto library =
      reflect<ID3D12LibraryReflection>(kLibrary, "lib_6_5", IID_ID3D12LibraryReflection);
  auto* sky = functions_of(library.Get())["Sky"];
  auto* none = sky->GetConstantBufferByName("none");
  D3D12_SHADER_BUFFER_DESC buffer = {};
  EXPECT_EQ(none->GetDesc(&buffer), E_FAIL);
  D3D12_SHADER_VARIABLE_DESC variable = {};
  EXPECT_EQ(none->GetVariableByIndex(3)->GetDesc(&variable), E_FAIL);
  D3D12_SHADER_TYPE_DESC type = {};
  EXPECT_EQ(none->GetVariableByName("x")->GetType()->GetMemberTypeByIndex(0)->GetDesc(&type),
            E_FAIL);
  EXPECT_EQ(sky->GetConstantBufferByIndex(9)->GetDesc(&buffer), E_FAIL);
  EXPECT_EQ(sky->GetConstantBufferByName(nullptr)->GetDesc(&buffer), E_FAIL);
}

TEST(ShaderReflectionOfD3D12, ComputeShaderHasItsGroup) {
  const auto shader = reflect<ID3D12ShaderReflection>(
      "RWBuffer<uint> o : register(u3);\n[numthreads(8, 4, 2)] void Main() { o[0] = 1; }", "cs_6_2",
      IID_ID3D12ShaderReflection, "Main");
  UINT x = 0, y = 0, z = 0;
  EXPECT_EQ(shader->GetThreadGroupSize(&x, &y, &z), 64u);
  EXPECT_EQ(x * 100 + y * 10 + z, 842u);
  D3D12_SHADER_DESC desc = {};
  ASSERT_EQ(shader->GetDesc(&desc), S_OK);
  EXPECT_EQ(D3D12_SHVER_GET_TYPE(desc.Version), UINT{D3D12_SHVER_COMPUTE_SHADER});
  EXPECT_EQ(desc.BoundResources, 1u);
  D3D12_SHADER_INPUT_BIND_DESC bind = {};
  ASSERT_EQ(shader->GetResourceBindingDesc(0, &bind), S_OK);
  EXPECT_EQ(bind.ReturnType, D3D_RETURN_TYPE_UINT);
  EXPECT_EQ(bind.Dimension, D3D_SRV_DIMENSION_BUFFER);
}

TEST(ShaderReflectionOfD3D12, VertexShaderHasASignature) {
  const auto shader = reflect<ID3D12ShaderReflection>(
      "float4 Main(float3 p : POSITION, uint2 c : CELL3, uint v : SV_VertexID,\n"
      "            out float4 at : SV_Position) : COLOR { at = float4(p, v); return c.x; }",
      "vs_6_0", IID_ID3D12ShaderReflection, "Main");
  D3D12_SHADER_DESC desc = {};
  ASSERT_EQ(shader->GetDesc(&desc), S_OK);
  EXPECT_EQ(desc.InputParameters, 3u);
  EXPECT_EQ(desc.OutputParameters, 2u);
  D3D12_SIGNATURE_PARAMETER_DESC input = {};
  ASSERT_EQ(shader->GetInputParameterDesc(0, &input), S_OK);
  EXPECT_STREQ(input.SemanticName, "POSITION");
  EXPECT_EQ(input.Mask, 7);
  EXPECT_EQ(input.ComponentType, D3D_REGISTER_COMPONENT_FLOAT32);
  ASSERT_EQ(shader->GetInputParameterDesc(1, &input), S_OK);
  EXPECT_EQ(input.SemanticIndex, 3u);
  EXPECT_EQ(input.ComponentType, D3D_REGISTER_COMPONENT_UINT32);
  ASSERT_EQ(shader->GetInputParameterDesc(2, &input), S_OK);
  EXPECT_EQ(input.SystemValueType, D3D_NAME_VERTEX_ID);
  EXPECT_EQ(shader->GetInputParameterDesc(3, &input), E_INVALIDARG);
  bool has_position = false;
  for (UINT i = 0; i < desc.OutputParameters; ++i) {
    ASSERT_EQ(shader->GetOutputParameterDesc(i, &input), S_OK);
    has_position = has_position || input.SystemValueType == D3D_NAME_POSITION;
  }
  EXPECT_TRUE(has_position);
}

TEST(ShaderReflectionOfD3D12, InterfacesBelongToProfiles) {
  DxcArguments arguments;
  arguments.options.File = "a.hlsl";
  arguments.options.Source = "[numthreads(1, 1, 1)] void main() {}";
  arguments.options.Target = "cs_6_0";
  const CompiledSource compiled = compile_source(arguments);
  ComPtr<ID3D12LibraryReflection> library;
  EXPECT_EQ(create_reflection(compiled.container.data(), compiled.container.size(),
                              IID_ID3D12LibraryReflection,
                              reinterpret_cast<void**>(library.GetAddressOf())),
            E_NOINTERFACE);
  EXPECT_EQ(create_reflection("no", 2, IID_ID3D12LibraryReflection,
                              reinterpret_cast<void**>(library.GetAddressOf())),
            E_INVALIDARG);
  EXPECT_EQ(library, nullptr);
}

}  // namespace
}  // namespace kaamos::d3d12
