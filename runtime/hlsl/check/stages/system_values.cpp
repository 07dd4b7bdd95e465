// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/system_values.h"

#include <algorithm>
#include <cctype>

namespace kaamos::hlsl {
namespace {

using shader::SystemValue;

struct Row {
  std::string_view name;
  SystemValue value;
  // For each SignaturePoint: '.' not there, 'a' arbitrary, 's' system value, 'z' an input that is
  // always 0, 'n' not offered.
  std::string_view points;
};

constexpr Row kRows[] = {
    {"SV_Position", SystemValue::kPosition, "ass.ss"},
    {"SV_VertexID", SystemValue::kVertexId, "s....."},
    {"SV_InstanceID", SystemValue::kInstanceId, "saa.aa"},
    {"SV_PrimitiveID", SystemValue::kPrimitiveId, "..s.ss"},
    {"SV_IsFrontFace", SystemValue::kIsFrontFace, "..s..n"},
    {"SV_Barycentrics", SystemValue::kBarycentrics, "..s..."},
    {"SV_ClipDistance", SystemValue::kClipDistance, "ass.ss"},
    {"SV_CullDistance", SystemValue::kCullDistance, "ass.ss"},
    {"SV_RenderTargetArrayIndex", SystemValue::kRenderTargetArrayIndex, "ass.as"},
    {"SV_ViewportArrayIndex", SystemValue::kViewportArrayIndex, "ass.as"},
    {"SV_Target", SystemValue::kTarget, "...s.."},
    {"SV_Depth", SystemValue::kDepth, "...s.."},
    {"SV_DepthGreaterEqual", SystemValue::kDepth, "...s.."},
    {"SV_DepthLessEqual", SystemValue::kDepth, "...s.."},
    {"SV_Coverage", SystemValue::kCoverage, "..ss.."},
    {"SV_StencilRef", SystemValue::kNone, "...n.."},
    {"SV_SampleIndex", SystemValue::kSampleIndex, "..s..."},
    {"SV_InnerCoverage", SystemValue::kNone, "..n..."},
    {"SV_ViewID", SystemValue::kNone, "z.z.z."},
    {"SV_ShadingRate", SystemValue::kNone, ".nz..n"},
    {"SV_CullPrimitive", SystemValue::kNone, "..n..."},
    {"SV_StartVertexLocation", SystemValue::kStartVertexLocation, "s....."},
    {"SV_StartInstanceLocation", SystemValue::kStartInstanceLocation, "s....."},
    {"SV_GSInstanceID", SystemValue::kGeometryInstance, "....s."},
};

}  // namespace

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

SemanticRule find_semantic(std::string_view base, SignaturePoint point) {
  for (const Row& row : kRows) {
    if (!same_letters(row.name, base)) continue;
    switch (row.points[static_cast<size_t>(point)]) {
      case 'a':
        return {SemanticMeaning::kArbitrary, SystemValue::kNone};
      case 's':
        return {SemanticMeaning::kSystemValue, row.value};
      case 'z':
        return {SemanticMeaning::kZero, SystemValue::kNone};
      case 'n':
        return {SemanticMeaning::kNotOffered, SystemValue::kNone};
      default:
        return {SemanticMeaning::kNotThere, SystemValue::kNone};
    }
  }
  const bool is_system = base.size() > 3 && same_letters(base.substr(0, 3), "SV_");
  if (is_system || point == SignaturePoint::kPixelOut) {
    return {SemanticMeaning::kNotThere, SystemValue::kNone};
  }
  return {};
}

bool fits_system_value(SystemValue value, const Type* type, std::string_view& wanted) {
  const bool number = type->is_numeric() && !type->is_matrix();
  const uint32_t count = type->components();
  const bool real = number && is_floating(type->scalar);
  const bool whole = number && is_integer(type->scalar);
  switch (value) {
    case SystemValue::kNone:
      return true;
    case SystemValue::kPosition:
      wanted = "float4";
      return real && count == 4;
    case SystemValue::kBarycentrics:
      wanted = "float3";
      return real && count == 3;
    case SystemValue::kIsFrontFace:
      wanted = "bool or uint";
      return number && count == 1 && !is_floating(type->scalar);
    case SystemValue::kClipDistance:
    case SystemValue::kCullDistance:
      wanted = "float or a vector of floats";
      return real;
    case SystemValue::kTarget:
      wanted = "a number or a vector";
      return number;
    case SystemValue::kDepth:
      wanted = "float";
      return real && count == 1;
    default:
      wanted = "uint";
      return whole && count == 1;
  }
}

}  // namespace kaamos::hlsl
