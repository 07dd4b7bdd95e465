// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/checked_access.h"

#include <algorithm>

#include "runtime/hlsl/ir/layout.h"

namespace kaamos::hlsl {

using namespace ir;

Access access_of(const Type* type, Layout layout, bool row_major) {
  // Natural alignment applies in constant buffers too: the 16-byte rows are up to the compiler.
  const uint32_t natural = extent_of(type, Layout::kStructured, row_major).alignment;
  return {static_cast<uint32_t>(extent_of(type, layout, row_major).size),
          std::min(std::max(natural, 1u), 4u)};
}

namespace {

void mix(uint32_t& hash, uint32_t value) {
  for (int byte = 0; byte < 4; ++byte) hash = (hash ^ (value >> (byte * 8) & 0xFF)) * 16777619u;
}

// A vector is hashed as its scalars, so that float3 + float and float4 have the same bytes and
// type.
void mix(uint32_t& hash, const Type* type) {
  switch (type->kind) {
    case TypeKind::kScalar:
    case TypeKind::kVector:
    case TypeKind::kMatrix: {
      const uint32_t count = uint32_t{type->rows} * type->columns;
      for (uint32_t i = 0; i < count; ++i) mix(hash, static_cast<uint32_t>(type->scalar));
      return;
    }
    case TypeKind::kArray:
      for (uint32_t i = 0; i < type->count; ++i) mix(hash, type->element);
      return;
    case TypeKind::kStruct:
      for (const Field& field : type->structure->fields) mix(hash, field.type);
      return;
    default:
      mix(hash, 0x100u + static_cast<uint32_t>(type->resource));
  }
}

}  // namespace

uint32_t type_hash(const Type* type) {
  uint32_t hash = 2166136261u;
  mix(hash, type);
  return hash;
}

ResourceClass class_of(ResourceKind kind) {
  using shader::DescriptorAccess;
  using shader::DescriptorKind;
  switch (kind) {
    case ResourceKind::kConstantBuffer:
      return {DescriptorKind::kConstantBuffer, DescriptorAccess::kOther};
    case ResourceKind::kByteAddressBuffer:
      return {DescriptorKind::kRawBuffer, DescriptorAccess::kShaderResource};
    case ResourceKind::kRWByteAddressBuffer:
      return {DescriptorKind::kRawBuffer, DescriptorAccess::kUnorderedAccess};
    case ResourceKind::kStructuredBuffer:
      return {DescriptorKind::kStructuredBuffer, DescriptorAccess::kShaderResource};
    case ResourceKind::kRWStructuredBuffer:
      return {DescriptorKind::kStructuredBuffer, DescriptorAccess::kUnorderedAccess};
    case ResourceKind::kTextureBuffer:
    case ResourceKind::kBuffer:
      return {DescriptorKind::kTypedBuffer, DescriptorAccess::kShaderResource};
    case ResourceKind::kRWBuffer:
      return {DescriptorKind::kTypedBuffer, DescriptorAccess::kUnorderedAccess};
    case ResourceKind::kRWTexture2DMS:
    case ResourceKind::kRWTexture2DMSArray:
    case ResourceKind::kRWTexture1D:
    case ResourceKind::kRWTexture1DArray:
    case ResourceKind::kRWTexture2D:
    case ResourceKind::kRWTexture2DArray:
    case ResourceKind::kRWTexture3D:
      return {DescriptorKind::kTexture, DescriptorAccess::kUnorderedAccess};
    case ResourceKind::kSampler:
    case ResourceKind::kSamplerComparison:
      return {DescriptorKind::kSampler, DescriptorAccess::kOther};
    case ResourceKind::kAccelerationStructure:
      return {DescriptorKind::kAccelerationStructure, DescriptorAccess::kOther};
    case ResourceKind::kRayQuery:
      return {};
    default:
      return {DescriptorKind::kTexture, DescriptorAccess::kShaderResource};
  }
}

QueryNeed need_of(const Expr& value) {
  const bool committed = value.index == 1;
  const uint32_t triangle = committed ? 1 : 0;  // COMMITTED_TRIANGLE_HIT, NON_OPAQUE_TRIANGLE
  switch (value.query_value) {
    case QueryValue::kRayFlags:
    case QueryValue::kRayTMin:
    case QueryValue::kWorldRayOrigin:
    case QueryValue::kWorldRayDirection:
    case QueryValue::kPositionTable:  // whoever reads the positions looks
      return {};
    case QueryValue::kType:  // COMMITTED_NOTHING is a valid answer
      return {!committed};
    case QueryValue::kRayT:  // TMax if there is no hit
      return committed ? QueryNeed{} : QueryNeed{true, triangle};
    case QueryValue::kBarycentrics:
    case QueryValue::kFrontFace:
      return {true, triangle};
    case QueryValue::kProceduralNonOpaque:
      return {true, 1};
    default:
      return {true};
  }
}

}  // namespace kaamos::hlsl
