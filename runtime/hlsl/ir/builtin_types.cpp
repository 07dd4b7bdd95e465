// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/builtin_types.h"

#include <algorithm>
#include <iterator>

namespace kaamos::hlsl {
namespace {

using K = ir::ResourceKind;
using E = ElementRule;

// In the order of ir::ResourceKind.
constexpr ResourceTraits kTraits[] = {
    {"ConstantBuffer", K::kConstantBuffer, E::kStruct, 2, 0, false, false},
    {"TextureBuffer", K::kTextureBuffer, E::kStruct, 0, 0, false, false},
    {"ByteAddressBuffer", K::kByteAddressBuffer, E::kNone, 0, 0, false, false},
    {"RWByteAddressBuffer", K::kRWByteAddressBuffer, E::kNone, 1, 0, false, true},
    {"StructuredBuffer", K::kStructuredBuffer, E::kStruct, 0, 0, false, false},
    {"RWStructuredBuffer", K::kRWStructuredBuffer, E::kStruct, 1, 0, false, true},
    {"Buffer", K::kBuffer, E::kTexel, 0, 1, false, false},
    {"RWBuffer", K::kRWBuffer, E::kRequiredTexel, 1, 1, false, true},
    {"Texture1D", K::kTexture1D, E::kTexel, 0, 1, false, false},
    {"Texture1DArray", K::kTexture1DArray, E::kTexel, 0, 2, true, false},
    {"Texture2D", K::kTexture2D, E::kTexel, 0, 2, false, false},
    {"Texture2DArray", K::kTexture2DArray, E::kTexel, 0, 3, true, false},
    {"Texture3D", K::kTexture3D, E::kTexel, 0, 3, false, false},
    {"TextureCube", K::kTextureCube, E::kTexel, 0, 3, false, false},
    {"TextureCubeArray", K::kTextureCubeArray, E::kTexel, 0, 4, true, false},
    {"RWTexture1D", K::kRWTexture1D, E::kRequiredTexel, 1, 1, false, true},
    {"RWTexture1DArray", K::kRWTexture1DArray, E::kRequiredTexel, 1, 2, true, true},
    {"RWTexture2D", K::kRWTexture2D, E::kRequiredTexel, 1, 2, false, true},
    {"RWTexture2DArray", K::kRWTexture2DArray, E::kRequiredTexel, 1, 3, true, true},
    {"RWTexture3D", K::kRWTexture3D, E::kRequiredTexel, 1, 3, false, true},
    {"SamplerState", K::kSampler, E::kNone, 3, 0, false, false},
    {"SamplerComparisonState", K::kSamplerComparison, E::kNone, 3, 0, false, false},
    {"RaytracingAccelerationStructure", K::kAccelerationStructure, E::kNone, 0, 0, false, false},
    {"RayQuery", K::kRayQuery, E::kNone, 0, 0, false, false},
    {"Texture2DMS", K::kTexture2DMS, E::kRequiredTexel, 0, 2, false, false},
    {"Texture2DMSArray", K::kTexture2DMSArray, E::kRequiredTexel, 0, 3, true, false},
    {"RWTexture2DMS", K::kRWTexture2DMS, E::kRequiredTexel, 1, 2, false, true},
    {"RWTexture2DMSArray", K::kRWTexture2DMSArray, E::kRequiredTexel, 1, 3, true, true},
    {"AppendStructuredBuffer", K::kAppendStructuredBuffer, E::kStruct, 1, 0, false, true},
    {"ConsumeStructuredBuffer", K::kConsumeStructuredBuffer, E::kStruct, 1, 0, false, true},
};

constexpr std::string_view kOrdered = "RasterizerOrdered";

struct Unsupported {
  std::string_view name;
  std::string_view reason;
  bool is_stage = true;
};

constexpr Unsupported kUnsupported[] = {
    {"FeedbackTexture2D", "sampler feedback", false},
    {"FeedbackTexture2DArray", "sampler feedback", false},
    {"InputPatch", "hull and domain shaders"},
    {"OutputPatch", "hull and domain shaders"},
    {"DispatchNodeInputRecord", "work graphs"},
    {"RWDispatchNodeInputRecord", "work graphs"},
    {"GroupNodeInputRecords", "work graphs"},
    {"RWGroupNodeInputRecords", "work graphs"},
    {"ThreadNodeInputRecord", "work graphs"},
    {"RWThreadNodeInputRecord", "work graphs"},
    {"EmptyNodeInput", "work graphs"},
    {"NodeOutput", "work graphs"},
    {"NodeOutputArray", "work graphs"},
    {"EmptyNodeOutput", "work graphs"},
    {"EmptyNodeOutputArray", "work graphs"},
    {"ThreadNodeOutputRecords", "work graphs"},
    {"GroupNodeOutputRecords", "work graphs"},
};

}  // namespace

const ResourceTraits& traits_of(ir::ResourceKind kind) {
  return kTraits[static_cast<size_t>(kind)];
}

std::string_view resource_name(ir::ResourceKind kind) {
  return traits_of(kind).name;
}

bool is_ordered_view(std::string_view name) {
  return name.starts_with(kOrdered);
}

const ResourceTraits* find_resource(std::string_view name) {
  if (name == "sampler" || name == "sampler2D" || name == "SamplerState") {
    return &traits_of(K::kSampler);
  }
  if (name == "texture" || name == "texture2D") return &traits_of(K::kTexture2D);
  // They are written like the others; only the order of pixels differs.
  const bool ordered = is_ordered_view(name);
  if (ordered) name.remove_prefix(kOrdered.size());
  for (const ResourceTraits& traits : kTraits) {
    if (ordered ? traits.name.starts_with("RW") && traits.name.substr(2) == name
                : traits.name == name) {
      return &traits;
    }
  }
  return nullptr;
}

std::string_view unsupported_type(std::string_view name) {
  for (const Unsupported& entry : kUnsupported) {
    if (entry.name == name) return entry.reason;
  }
  return {};
}

bool is_of_other_stage(std::string_view name) {
  return std::any_of(std::begin(kUnsupported), std::end(kUnsupported),
                     [&](const Unsupported& one) { return one.name == name && one.is_stage; });
}

uint32_t stream_corners(std::string_view name) {
  return name == "PointStream" ? 1 : name == "LineStream" ? 2 : name == "TriangleStream" ? 3 : 0;
}

const BuiltinConstant kBuiltinConstants[] = {
    {"RAYQUERY_FLAG_NONE", 0},
    {"RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS", 0x01},
    {"RAY_FLAG_NONE", 0},
    {"RAY_FLAG_FORCE_OPAQUE", 0x01},
    {"RAY_FLAG_FORCE_NON_OPAQUE", 0x02},
    {"RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH", 0x04},
    {"RAY_FLAG_SKIP_CLOSEST_HIT_SHADER", 0x08},
    {"RAY_FLAG_CULL_BACK_FACING_TRIANGLES", 0x10},
    {"RAY_FLAG_CULL_FRONT_FACING_TRIANGLES", 0x20},
    {"RAY_FLAG_CULL_OPAQUE", 0x40},
    {"RAY_FLAG_CULL_NON_OPAQUE", 0x80},
    {"RAY_FLAG_SKIP_TRIANGLES", 0x100},
    {"RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES", 0x200},
    {"HIT_KIND_TRIANGLE_FRONT_FACE", 0xFE},
    {"HIT_KIND_TRIANGLE_BACK_FACE", 0xFF},
    {"CANDIDATE_NON_OPAQUE_TRIANGLE", 0},
    {"CANDIDATE_PROCEDURAL_PRIMITIVE", 1},
    {"COMMITTED_NOTHING", 0},
    {"COMMITTED_TRIANGLE_HIT", 1},
    {"COMMITTED_PROCEDURAL_PRIMITIVE_HIT", 2},
    {"STATE_OBJECT_FLAGS_ALLOW_LOCAL_DEPENDENCIES_ON_EXTERNAL_DEFINITONS", 0x1},
    {"STATE_OBJECT_FLAGS_ALLOW_LOCAL_DEPENDENCIES_ON_EXTERNAL_DEFINITIONS", 0x1},
    {"STATE_OBJECT_FLAG_ALLOW_LOCAL_DEPENDENCIES_ON_EXTERNAL_DEFINITIONS", 0x1},
    {"STATE_OBJECT_FLAGS_ALLOW_EXTERNAL_DEPENDENCIES_ON_LOCAL_DEFINITIONS", 0x2},
    {"STATE_OBJECT_FLAG_ALLOW_EXTERNAL_DEPENDENCIES_ON_LOCAL_DEFINITIONS", 0x2},
    {"STATE_OBJECT_FLAG_ALLOW_STATE_OBJECT_ADDITIONS", 0x4},
    {"RAYTRACING_PIPELINE_FLAG_NONE", 0x0},
    {"RAYTRACING_PIPELINE_FLAG_SKIP_TRIANGLES", 0x100},
    {"RAYTRACING_PIPELINE_FLAG_SKIP_PROCEDURAL_PRIMITIVES", 0x200},
    {"RAYTRACING_PIPELINE_FLAG_ALLOW_OPACITY_MICROMAPS", 0x400, 9},
    {"RAY_FLAG_FORCE_OMM_2_STATE", 0x400, 9},
    {"UAV_MEMORY", kUavMemory, 8},
    {"GROUP_SHARED_MEMORY", kGroupSharedMemory, 8},
    {"NODE_INPUT_MEMORY", 0x4, 8},
    {"NODE_OUTPUT_MEMORY", 0x8, 8},
    {"ALL_MEMORY", 0xF, 8},
    {"GROUP_SYNC", kGroupSyncSemantic, 8},
    {"GROUP_SCOPE", kGroupScope, 8},
    {"DEVICE_SCOPE", kDeviceScope, 8},
    {"REORDER_SCOPE", kReorderScope, 9},
    {"RAYTRACING_PIPELINE_FLAG_ALLOW_CLUSTERED_GEOMETRY", 0x800, 10},
    {"RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY", 0x02, 10},
    {"CLUSTER_ID_INVALID", 0xFFFFFFFF, 10},
};
const size_t kBuiltinConstantCount = std::size(kBuiltinConstants);

}  // namespace kaamos::hlsl
