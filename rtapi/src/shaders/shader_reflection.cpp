// SPDX-License-Identifier: MIT
#include "rtapi/src/shaders/shader_reflection.h"

#include "runtime/hlsl/ir/builtin_types.h"
#include "runtime/hlsl/ir/layout.h"

namespace rtapi::detail {
namespace {

namespace ir = kaamos::hlsl::ir;
namespace shader = kaamos::shader;

ShaderScalarType scalar_of(ir::Scalar scalar) {
  switch (scalar) {
    case ir::Scalar::kBool:
      return ShaderScalarType::kBool;
    case ir::Scalar::kInt16:
      return ShaderScalarType::kInt16;
    case ir::Scalar::kUint16:
      return ShaderScalarType::kUint16;
    case ir::Scalar::kInt32:
      return ShaderScalarType::kInt32;
    case ir::Scalar::kUint32:
      return ShaderScalarType::kUint32;
    case ir::Scalar::kInt64:
      return ShaderScalarType::kInt64;
    case ir::Scalar::kUint64:
      return ShaderScalarType::kUint64;
    case ir::Scalar::kFloat16:
      return ShaderScalarType::kFloat16;
    case ir::Scalar::kFloat32:
      return ShaderScalarType::kFloat32;
    case ir::Scalar::kFloat64:
      return ShaderScalarType::kFloat64;
    default:  // Only plain ones get here.
      break;
  }
  return ShaderScalarType::kFloat32;
}

const char* name_of(ShaderScalarType type) {
  constexpr const char* kNames[] = {"bool",    "int16_t",  "uint16_t",  "int",   "uint",
                                    "int64_t", "uint64_t", "float16_t", "float", "double"};
  return kNames[static_cast<uint32_t>(type)];
}

ShaderTypeInfo describe(const ir::Type* type, ir::Layout layout, bool row_major);

std::vector<ShaderVariableInfo> members_of(const ir::Struct& structure, ir::Layout layout) {
  std::vector<ShaderVariableInfo> out;
  const std::vector<uint32_t> offsets = ir::field_offsets(structure, layout);
  for (size_t i = 0; i < structure.fields.size(); ++i) {
    const ir::Field& field = structure.fields[i];
    const auto size = ir::extent_of(field.type, layout, field.row_major).size;
    out.push_back({field.name, offsets[i], static_cast<uint32_t>(size),
                   describe(field.type, layout, field.row_major)});
  }
  return out;
}

ShaderTypeInfo describe(const ir::Type* type, ir::Layout layout, bool row_major) {
  ShaderTypeInfo out;
  for (; type->kind == ir::TypeKind::kArray; type = type->element) {
    out.Elements.push_back(type->count);
  }
  if (type->kind == ir::TypeKind::kStruct) {
    out.Name = type->structure->name;
    out.IsStruct = true;
    out.Members = members_of(*type->structure, layout);
    return out;
  }
  out.Scalar = scalar_of(type->scalar);
  out.Name = name_of(out.Scalar);
  out.Columns = type->columns;
  out.IsVector = type->kind == ir::TypeKind::kVector;
  out.IsMatrix = type->kind == ir::TypeKind::kMatrix;
  if (out.IsMatrix) {
    out.Rows = type->rows;
    out.IsRowMajor = row_major;
    out.Name += std::to_string(out.Rows) + "x";
  }
  if (out.IsMatrix || out.IsVector) out.Name += std::to_string(out.Columns);
  return out;
}

ShaderResourceType resource_of(ir::ResourceKind kind) {
  using K = ir::ResourceKind;
  using T = ShaderResourceType;
  switch (kind) {
    case K::kConstantBuffer:
      return T::kConstantBuffer;
    case K::kTextureBuffer:
      return T::kTextureBuffer;
    case K::kByteAddressBuffer:
    case K::kRWByteAddressBuffer:
      return T::kByteAddressBuffer;
    case K::kStructuredBuffer:
    case K::kRWStructuredBuffer:
    case K::kAppendStructuredBuffer:
    case K::kConsumeStructuredBuffer:
      return T::kStructuredBuffer;
    case K::kBuffer:
    case K::kRWBuffer:
      return T::kBuffer;
    case K::kTexture1D:
    case K::kRWTexture1D:
      return T::kTexture1D;
    case K::kTexture1DArray:
    case K::kRWTexture1DArray:
      return T::kTexture1DArray;
    case K::kTexture2D:
    case K::kRWTexture2D:
      return T::kTexture2D;
    case K::kTexture2DArray:
    case K::kRWTexture2DArray:
      return T::kTexture2DArray;
    case K::kTexture3D:
    case K::kRWTexture3D:
      return T::kTexture3D;
    case K::kTextureCube:
      return T::kTextureCube;
    case K::kTextureCubeArray:
      return T::kTextureCubeArray;
    case K::kTexture2DMS:
    case K::kRWTexture2DMS:
      return T::kTexture2DMS;
    case K::kTexture2DMSArray:
    case K::kRWTexture2DMSArray:
      return T::kTexture2DMSArray;
    case K::kSampler:
      return T::kSampler;
    case K::kSamplerComparison:
      return T::kComparisonSampler;
    case K::kAccelerationStructure:
    case K::kRayQuery:  // no binding
      return T::kAccelerationStructure;
  }
  return T::kConstantBuffer;
}

// A `cbuffer` or `tbuffer` has a structure of its own, which has its name.
bool is_cbuffer(const ir::Binding& binding) {
  if (!kaamos::hlsl::has_members(binding.type->resource)) return false;
  const std::string& name = binding.type->element->structure->name;
  const size_t colon = name.rfind(':');
  return name.substr(colon == std::string::npos ? 0 : colon + 1) == binding.name;
}

ShaderBindingInfo describe(const ir::Binding& binding) {
  ShaderBindingInfo out;
  out.Name = binding.name;
  out.Type = resource_of(binding.type->resource);
  out.IsWritable = binding.register_class == 1;
  out.RegisterClass = "tubs"[binding.register_class & 3];
  out.Register = binding.register_index;
  out.Space = binding.space;
  out.Count = binding.count;
  out.SizeInBytes = binding.size_bytes;
  out.IsCBuffer = is_cbuffer(binding);
  if (binding.type->element != nullptr) {
    const bool has_rows = kaamos::hlsl::has_members(binding.type->resource);
    out.Element = describe(binding.type->element,
                           has_rows ? ir::Layout::kConstantBuffer : ir::Layout::kStructured, false);
  }
  return out;
}

ShaderStage stage_of(uint32_t stage) {
  switch (stage) {
    case ir::kStageRayGeneration:
      return ShaderStage::kRayGeneration;
    case ir::kStageIntersection:
      return ShaderStage::kIntersection;
    case ir::kStageAnyHit:
      return ShaderStage::kAnyHit;
    case ir::kStageClosestHit:
      return ShaderStage::kClosestHit;
    case ir::kStageMiss:
      return ShaderStage::kMiss;
    case ir::kStageCallable:
      return ShaderStage::kCallable;
    case ir::kStageCompute:
      return ShaderStage::kCompute;
    case ir::kStageVertex:
      return ShaderStage::kVertex;
    case ir::kStageGeometry:
      return ShaderStage::kGeometry;
    case ir::kStagePixel:
      return ShaderStage::kPixel;
    default:
      return ShaderStage::kLibrary;
  }
}

std::vector<ShaderSignatureElement> describe(const std::vector<ir::SignatureElement>& elements) {
  std::vector<ShaderSignatureElement> out;
  for (const ir::SignatureElement& element : elements) {
    if (element.is_implied) continue;
    const ShaderScalarType type =
        element.type == shader::ColumnType::kFloat ? ShaderScalarType::kFloat32
        : element.type == shader::ColumnType::kInt ? ShaderScalarType::kInt32
                                                   : ShaderScalarType::kUint32;
    out.push_back({element.semantic, element.semantic_index, type, element.components});
  }
  return out;
}

ShaderEntryInfo describe(const ir::EntryPoint& entry, const ir::Module& module) {
  ShaderEntryInfo out;
  out.Export.Name = entry.name;
  out.Export.MangledName = entry.function->mangled;
  out.Export.Stage = stage_of(entry.stage);
  out.Export.PayloadSizeInBytes = entry.payload_bytes;
  out.Export.AttributeSizeInBytes = entry.attribute_bytes;
  if (entry.stage == ir::kStageCompute) {
    for (int i = 0; i < 3; ++i) out.Export.ThreadGroup[i] = entry.thread_group[i];
  }
  out.Bindings = entry.bindings;
  for (const uint32_t index : entry.bindings) {
    out.Export.Resources.push_back(module.bindings[index].name);
  }
  out.Inputs = describe(entry.inputs);
  out.Outputs = describe(entry.outputs);
  out.RootSignature = entry.root_signature.value_or("");
  return out;
}

}  // namespace

ShaderReflection reflect(const ir::Module& module) {
  ShaderReflection out;
  for (const ir::EntryPoint& entry : module.entry_points) {
    out.Entries.push_back(describe(entry, module));
  }
  for (const ir::EntryPoint& entry : module.unlinked_entry_points) {
    out.Entries.push_back(describe(entry, module));
  }
  for (const ir::LibraryFunction& function : module.library_functions) {
    ShaderEntryInfo& entry = out.Entries.emplace_back();
    entry.Export.Name = function.name;
    entry.Export.MangledName = function.mangled;
  }
  for (const ir::Binding& binding : module.bindings) out.Bindings.push_back(describe(binding));
  return out;
}

}  // namespace rtapi::detail
