// SPDX-License-Identifier: MIT
//
// Tells what a texture's declaration says about the views that fit it.
#pragma once

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::ir {

// 0 float (normalized formats, too), 1 signed, 2 unsigned: the 32-bit type that a texel holds.
inline uint32_t number_class(Scalar scalar) {
  switch (scalar) {
    case Scalar::kFloat16:
    case Scalar::kFloat32:
    case Scalar::kFloat64:
      return 0;
    case Scalar::kInt16:
    case Scalar::kInt32:
    case Scalar::kInt64:
      return 1;
    default:
      return 2;
  }
}

// shader::texture_shape() of a resource type; 0 if it is no texture.
inline uint32_t texture_shape(const Type& resource) {
  uint32_t dimension = 0;  // D3D12_SRV_DIMENSION
  switch (resource.resource) {
    case ResourceKind::kTexture1D:
    case ResourceKind::kRWTexture1D:
      dimension = 2;
      break;
    case ResourceKind::kTexture1DArray:
    case ResourceKind::kRWTexture1DArray:
      dimension = 3;
      break;
    case ResourceKind::kTexture2D:
    case ResourceKind::kRWTexture2D:
      dimension = 4;
      break;
    case ResourceKind::kTexture2DArray:
    case ResourceKind::kRWTexture2DArray:
      dimension = 5;
      break;
    case ResourceKind::kTexture2DMS:
      dimension = 6;
      break;
    case ResourceKind::kTexture2DMSArray:
      dimension = 7;
      break;
    case ResourceKind::kTexture3D:
    case ResourceKind::kRWTexture3D:
      dimension = 8;
      break;
    case ResourceKind::kTextureCube:
      dimension = 9;
      break;
    case ResourceKind::kTextureCubeArray:
      dimension = 10;
      break;
    default:
      return 0;
  }
  const Type* texel = resource.element;
  return dimension | number_class(texel != nullptr ? texel->scalar : Scalar::kFloat32) << 8;
}

}  // namespace kaamos::hlsl::ir
