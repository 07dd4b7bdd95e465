// SPDX-License-Identifier: MIT
//
// HLSL's resource types, by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

enum class ElementRule : uint8_t {
  kNone,           // takes no argument: SamplerState
  kStruct,         // any type without resources: StructuredBuffer<T>
  kTexel,          // scalar or vector of up to four: Texture2D<T>, float4 if none is given
  kRequiredTexel,  // the same, but it must be written: RWTexture2D<T>
};

struct ResourceTraits {
  std::string_view name;
  ir::ResourceKind kind;
  ElementRule element;
  uint8_t register_class;  // 0 t, 1 u, 2 b, 3 s
  uint8_t coordinates;     // in a location: Texture2DArray has 3; 0: no texture or typed buffer
  bool is_array;
  bool is_writable;
};

const ResourceTraits& traits_of(ir::ResourceKind kind);
std::string_view resource_name(ir::ResourceKind kind);
// Returns whether a type of that name is a RasterizerOrdered view, whose traits are those of its RW
// twin.
bool is_ordered_view(std::string_view name);
// Also knows older spellings such as `sampler`. Null if the name is not a resource type.
const ResourceTraits* find_resource(std::string_view name);
// Why a type that HLSL has is not supported, as text to print. Empty if there is no such type.
std::string_view unsupported_type(std::string_view name);
// Whether it is not supported because its stage is not.
bool is_of_other_stage(std::string_view name);

// A struct in rows of 16 bytes, whose members are read by their names.
inline bool has_members(ir::ResourceKind kind) {
  return kind == ir::ResourceKind::kConstantBuffer || kind == ir::ResourceKind::kTextureBuffer;
}
inline bool is_texture(ir::ResourceKind kind) {
  return kind >= ir::ResourceKind::kTexture1D && kind <= ir::ResourceKind::kRWTexture3D;
}
inline bool is_sampled_texture(ir::ResourceKind kind) {
  return kind >= ir::ResourceKind::kTexture1D && kind <= ir::ResourceKind::kTextureCubeArray;
}
inline bool is_multisampled(ir::ResourceKind kind) {
  return kind >= ir::ResourceKind::kTexture2DMS && kind <= ir::ResourceKind::kRWTexture2DMSArray;
}
inline bool is_typed(ir::ResourceKind kind) {
  return is_texture(kind) || kind == ir::ResourceKind::kBuffer ||
         kind == ir::ResourceKind::kRWBuffer;
}
inline bool is_structured(ir::ResourceKind kind) {
  return kind == ir::ResourceKind::kStructuredBuffer ||
         kind == ir::ResourceKind::kRWStructuredBuffer;
}
inline bool has_elements(ir::ResourceKind kind) {
  return is_structured(kind) || kind == ir::ResourceKind::kAppendStructuredBuffer ||
         kind == ir::ResourceKind::kConsumeStructuredBuffer;
}
inline bool is_raw(ir::ResourceKind kind) {
  return kind == ir::ResourceKind::kByteAddressBuffer ||
         kind == ir::ResourceKind::kRWByteAddressBuffer;
}
inline bool is_sampler(ir::ResourceKind kind) {
  return kind == ir::ResourceKind::kSampler || kind == ir::ResourceKind::kSamplerComparison;
}

// The corners of a stream's primitives, for PointStream, LineStream and TriangleStream; 0 for
// others.
uint32_t stream_corners(std::string_view name);

// MEMORY_TYPE_FLAG and BARRIER_SEMANTIC_FLAG. [HLSL: Barrier]
enum BarrierArgument : uint32_t {
  kUavMemory = 0x1,
  kGroupSharedMemory = 0x2,
  kGroupSyncSemantic = 0x1,
  kGroupScope = 0x2,
  kDeviceScope = 0x4,
  kReorderScope = 0x8,
};

// Global constants that every library sees: RAY_FLAG_FORCE_OPAQUE, HIT_KIND_TRIANGLE_BACK_FACE ..
// [DXR: Ray flags, Hit kinds]
struct BuiltinConstant {
  std::string_view name;
  uint32_t value;
  uint32_t minor = 0;  // the shader model that has it
};
extern const BuiltinConstant kBuiltinConstants[];
extern const size_t kBuiltinConstantCount;

}  // namespace kaamos::hlsl
