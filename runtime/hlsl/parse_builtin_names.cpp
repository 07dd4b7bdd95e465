// SPDX-License-Identifier: MIT
#include "parse_builtin_names.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace kaamos::hlsl {
namespace {

struct ScalarName {
  std::string_view text;
  ScalarKind kind;
};

constexpr ScalarName kScalars[] = {
    {"bool", ScalarKind::kBool},
    {"int", ScalarKind::kInt},
    {"uint", ScalarKind::kUint},
    {"dword", ScalarKind::kUint},
    {"half", ScalarKind::kHalf},
    {"float", ScalarKind::kFloat},
    {"double", ScalarKind::kDouble},
    {"int16_t", ScalarKind::kInt16},
    {"uint16_t", ScalarKind::kUint16},
    {"float16_t", ScalarKind::kFloat16},
    {"int32_t", ScalarKind::kInt},
    {"uint32_t", ScalarKind::kUint},
    {"float32_t", ScalarKind::kFloat},
    {"int64_t", ScalarKind::kInt64},
    {"uint64_t", ScalarKind::kUint64},
    {"float64_t", ScalarKind::kDouble},
    {"min10float", ScalarKind::kMin10Float},
    {"min16float", ScalarKind::kMin16Float},
    {"min12int", ScalarKind::kMin12Int},
    {"min16int", ScalarKind::kMin16Int},
    {"min16uint", ScalarKind::kMin16Uint},
};

constexpr std::string_view kTypes[] = {
    "vector",
    "matrix",
    "string",
    "Buffer",
    "RWBuffer",
    "ByteAddressBuffer",
    "RWByteAddressBuffer",
    "StructuredBuffer",
    "RWStructuredBuffer",
    "AppendStructuredBuffer",
    "ConsumeStructuredBuffer",
    "ConstantBuffer",
    "TextureBuffer",
    "Texture1D",
    "Texture1DArray",
    "Texture2D",
    "Texture2DArray",
    "Texture2DMS",
    "Texture2DMSArray",
    "Texture3D",
    "TextureCube",
    "TextureCubeArray",
    "RWTexture1D",
    "RWTexture1DArray",
    "RWTexture2D",
    "RWTexture2DArray",
    "RWTexture2DMS",
    "RWTexture2DMSArray",
    "RWTexture3D",
    "RasterizerOrderedBuffer",
    "RasterizerOrderedByteAddressBuffer",
    "RasterizerOrderedStructuredBuffer",
    "RasterizerOrderedTexture1D",
    "RasterizerOrderedTexture1DArray",
    "RasterizerOrderedTexture2D",
    "RasterizerOrderedTexture2DArray",
    "RasterizerOrderedTexture3D",
    "FeedbackTexture2D",
    "FeedbackTexture2DArray",
    "SamplerState",
    "SamplerComparisonState",
    "sampler",
    "sampler1D",
    "sampler2D",
    "sampler3D",
    "samplerCUBE",
    "texture",
    "texture1D",
    "texture2D",
    "texture3D",
    "textureCUBE",
    "RaytracingAccelerationStructure",
    "RayDesc",
    "RayQuery",
    "BuiltInTriangleIntersectionAttributes",
    "InputPatch",
    "OutputPatch",
    "PointStream",
    "LineStream",
    "TriangleStream",
};

struct SubobjectName {
  std::string_view text;
  SubobjectKind kind;
};

constexpr SubobjectName kSubobjects[] = {
    {"StateObjectConfig", SubobjectKind::kStateObjectConfig},
    {"GlobalRootSignature", SubobjectKind::kGlobalRootSignature},
    {"LocalRootSignature", SubobjectKind::kLocalRootSignature},
    {"SubobjectToExportsAssociation", SubobjectKind::kSubobjectToExportsAssociation},
    {"RaytracingShaderConfig", SubobjectKind::kRaytracingShaderConfig},
    {"RaytracingPipelineConfig", SubobjectKind::kRaytracingPipelineConfig},
    {"RaytracingPipelineConfig1", SubobjectKind::kRaytracingPipelineConfig1},
    {"TriangleHitGroup", SubobjectKind::kTriangleHitGroup},
    {"ProceduralPrimitiveHitGroup", SubobjectKind::kProceduralPrimitiveHitGroup},
};

const std::unordered_map<std::string_view, BuiltinName>& names() {
  static const std::unordered_map<std::string_view, BuiltinName> table = [] {
    std::unordered_map<std::string_view, BuiltinName> result;
    for (std::string_view text : kTypes) result[text].kind = BuiltinName::kType;
    for (const SubobjectName& subobject : kSubobjects) {
      BuiltinName& name = result[subobject.text];
      name.kind = BuiltinName::kSubobject;
      name.subobject = subobject.kind;
    }
    for (const ScalarName& scalar : kScalars) {
      BuiltinName& name = result[scalar.text];
      name.kind = BuiltinName::kNumeric;
      name.scalar = scalar.kind;
    }
    return result;
  }();
  return table;
}

// 1..4, or 0.
uint8_t dimension(char c) {
  return c >= '1' && c <= '4' ? static_cast<uint8_t>(c - '0') : 0;
}

BuiltinName shaped(std::string_view scalar, uint8_t rows, uint8_t columns) {
  auto found = names().find(scalar);
  if (found == names().end() || found->second.kind != BuiltinName::kNumeric) return {};
  BuiltinName result = found->second;
  result.rows = rows;
  result.columns = columns;
  return result;
}

}  // namespace

BuiltinName find_builtin_name(std::string_view text) {
  if (auto found = names().find(text); found != names().end()) return found->second;
  const size_t size = text.size();
  if (size < 4) return {};
  const uint8_t last = dimension(text[size - 1]);
  if (last == 0) return {};
  if (BuiltinName vector = shaped(text.substr(0, size - 1), 0, last); vector.kind) return vector;
  const uint8_t rows = size > 4 && text[size - 2] == 'x' ? dimension(text[size - 3]) : 0;
  return rows == 0 ? BuiltinName{} : shaped(text.substr(0, size - 3), rows, last);
}

}  // namespace kaamos::hlsl
