// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/parse_builtin_names.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/hlsl/front/edit_distance.h"

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
    {"int8_t4_packed", ScalarKind::kUint},
    {"uint8_t4_packed", ScalarKind::kUint},
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
    "RAY_FLAG",
    "RAYQUERY_FLAG",
    "CANDIDATE_TYPE",
    "COMMITTED_STATUS",
    "RayDesc",
    "RayQuery",
    "BuiltInTriangleIntersectionAttributes",
    "BuiltInTrianglePositions",
    "RAY_FLAG",
    "CANDIDATE_TYPE",
    "COMMITTED_STATUS",
    "InputPatch",
    "OutputPatch",
    "PointStream",
    "LineStream",
    "TriangleStream",
    "DispatchNodeInputRecord",
    "RWDispatchNodeInputRecord",
    "GroupNodeInputRecords",
    "RWGroupNodeInputRecords",
    "ThreadNodeInputRecord",
    "RWThreadNodeInputRecord",
    "EmptyNodeInput",
    "NodeOutput",
    "NodeOutputArray",
    "EmptyNodeOutput",
    "EmptyNodeOutputArray",
    "ThreadNodeOutputRecords",
    "GroupNodeOutputRecords",
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
    result["dx"].kind = BuiltinName::kNamespace;
    result["HitObject"].kind = BuiltinName::kScopedType;
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

// 1 to 4, or 0 if it is not a dimension.
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

// vec3 becomes float3, mat4 float4x4, mat3x4 (3 columns) float4x3.
std::string from_glsl(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kVectors[] = {
      {"vec", "float"}, {"ivec", "int"}, {"uvec", "uint"}, {"bvec", "bool"}, {"dvec", "double"}};
  for (const auto& [glsl, hlsl] : kVectors) {
    if (text.size() == glsl.size() + 1 && text.starts_with(glsl) && dimension(text.back())) {
      return std::string(hlsl) + text.back();
    }
  }
  if (!text.starts_with("mat")) return "";
  const std::string_view shape = text.substr(3);
  if (shape.size() == 1 && dimension(shape[0])) {
    return std::string("float") + shape[0] + "x" + shape[0];
  }
  const bool is_shape =
      shape.size() == 3 && shape[1] == 'x' && dimension(shape[0]) && dimension(shape[2]);
  return is_shape ? std::string("float") + shape[2] + "x" + shape[0] : "";
}

}  // namespace

bool is_type_keyword(std::string_view text) {
  return text == "int" || text == "float" || text == "bool" || text == "half" || text == "double";
}

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

std::string similar_type_name(std::string_view text, std::span<const std::string_view> declared) {
  if (std::string glsl = from_glsl(text); !glsl.empty()) return glsl;
  const size_t limit = text.size() <= 4 ? 1 : 2;
  size_t best = limit + 1;
  std::string result;
  const auto offer = [&](std::string_view candidate) {
    const size_t found = edit_distance(text, candidate, limit);
    // Ties go to the alphabetically first, so that the result does not depend on hash table order.
    const bool is_better = found < best || (found == best && candidate < result);
    if (found > limit || !is_better) return;
    best = found;
    result = candidate;
  };
  for (std::string_view candidate : declared) offer(candidate);
  // `flaot3`: only scalars are in the table.
  const bool has_dimension = text.size() > 4 && dimension(text.back()) != 0;
  for (const auto& [candidate, name] : names()) {
    const bool is_type = name.kind == BuiltinName::kType || name.kind == BuiltinName::kNumeric;
    if (is_type) offer(candidate);
    if (!has_dimension || name.kind != BuiltinName::kNumeric) continue;
    const std::string vector = std::string(candidate) + text.back();
    offer(vector);
  }
  return result;
}

}  // namespace kaamos::hlsl
