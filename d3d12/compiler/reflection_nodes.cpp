// SPDX-License-Identifier: MIT
#include "d3d12/compiler/reflection_nodes.h"

#include <algorithm>
#include <cstring>

namespace kaamos::d3d12 {

namespace {

D3D_SHADER_VARIABLE_TYPE variable_type(rtapi::ShaderScalarType type) {
  switch (type) {
    case rtapi::ShaderScalarType::kBool:
      return D3D_SVT_BOOL;
    case rtapi::ShaderScalarType::kInt16:
      return D3D_SVT_INT16;
    case rtapi::ShaderScalarType::kUint16:
      return D3D_SVT_UINT16;
    case rtapi::ShaderScalarType::kInt32:
      return D3D_SVT_INT;
    case rtapi::ShaderScalarType::kUint32:
      return D3D_SVT_UINT;
    case rtapi::ShaderScalarType::kInt64:
      return D3D_SVT_INT64;
    case rtapi::ShaderScalarType::kUint64:
      return D3D_SVT_UINT64;
    case rtapi::ShaderScalarType::kFloat16:
      return D3D_SVT_FLOAT16;
    case rtapi::ShaderScalarType::kFloat32:
      return D3D_SVT_FLOAT;
    case rtapi::ShaderScalarType::kFloat64:
      return D3D_SVT_DOUBLE;
  }
  return D3D_SVT_FLOAT;
}

D3D_SHADER_VARIABLE_CLASS variable_class(const rtapi::ShaderTypeInfo& type) {
  if (type.IsStruct) return D3D_SVC_STRUCT;
  if (type.IsMatrix) return type.IsRowMajor ? D3D_SVC_MATRIX_ROWS : D3D_SVC_MATRIX_COLUMNS;
  return type.IsVector ? D3D_SVC_VECTOR : D3D_SVC_SCALAR;
}

// Returns the number of elements in all dimensions, or 0 for what is no array.
UINT element_count(const rtapi::ShaderTypeInfo& type) {
  if (type.Elements.empty()) return 0;
  UINT count = 1;
  for (const uint32_t elements : type.Elements) count *= elements;
  return count;
}

UINT component_count(const rtapi::ShaderTypeInfo& type) {
  if (!type.IsStruct) return type.Rows * type.Columns;
  UINT count = 0;
  for (const rtapi::ShaderVariableInfo& member : type.Members) {
    count += component_count(member.Type) * std::max(element_count(member.Type), 1u);
  }
  return count;
}

bool is_equal(LPCSTR a, const std::string& b) {
  return a != nullptr && a == b;
}

D3D_SHADER_INPUT_TYPE input_type(const rtapi::ShaderBindingInfo& binding) {
  using T = rtapi::ShaderResourceType;
  switch (binding.Type) {
    case T::kConstantBuffer:
      return D3D_SIT_CBUFFER;
    case T::kTextureBuffer:
      return D3D_SIT_TBUFFER;
    case T::kSampler:
    case T::kComparisonSampler:
      return D3D_SIT_SAMPLER;
    case T::kByteAddressBuffer:
      return binding.IsWritable ? D3D_SIT_UAV_RWBYTEADDRESS : D3D_SIT_BYTEADDRESS;
    case T::kStructuredBuffer:
      return binding.IsWritable ? D3D_SIT_UAV_RWSTRUCTURED : D3D_SIT_STRUCTURED;
    case T::kAccelerationStructure:
      return D3D_SIT_RTACCELERATIONSTRUCTURE;
    default:
      return binding.IsWritable ? D3D_SIT_UAV_RWTYPED : D3D_SIT_TEXTURE;
  }
}

D3D_SRV_DIMENSION dimension(rtapi::ShaderResourceType type) {
  using T = rtapi::ShaderResourceType;
  switch (type) {
    case T::kTextureBuffer:
    case T::kByteAddressBuffer:
    case T::kStructuredBuffer:
    case T::kBuffer:
      return D3D_SRV_DIMENSION_BUFFER;
    case T::kTexture1D:
      return D3D_SRV_DIMENSION_TEXTURE1D;
    case T::kTexture1DArray:
      return D3D_SRV_DIMENSION_TEXTURE1DARRAY;
    case T::kTexture2D:
      return D3D_SRV_DIMENSION_TEXTURE2D;
    case T::kTexture2DArray:
      return D3D_SRV_DIMENSION_TEXTURE2DARRAY;
    case T::kTexture3D:
      return D3D_SRV_DIMENSION_TEXTURE3D;
    case T::kTextureCube:
      return D3D_SRV_DIMENSION_TEXTURECUBE;
    case T::kTextureCubeArray:
      return D3D_SRV_DIMENSION_TEXTURECUBEARRAY;
    case T::kTexture2DMS:
      return D3D_SRV_DIMENSION_TEXTURE2DMS;
    case T::kTexture2DMSArray:
      return D3D_SRV_DIMENSION_TEXTURE2DMSARRAY;
    default:
      return D3D_SRV_DIMENSION_UNKNOWN;
  }
}

D3D_RESOURCE_RETURN_TYPE return_type(rtapi::ShaderScalarType type) {
  switch (type) {
    case rtapi::ShaderScalarType::kInt16:
    case rtapi::ShaderScalarType::kInt32:
    case rtapi::ShaderScalarType::kInt64:
      return D3D_RETURN_TYPE_SINT;
    case rtapi::ShaderScalarType::kUint16:
    case rtapi::ShaderScalarType::kUint32:
    case rtapi::ShaderScalarType::kUint64:
    case rtapi::ShaderScalarType::kBool:
      return D3D_RETURN_TYPE_UINT;
    case rtapi::ShaderScalarType::kFloat64:
      return D3D_RETURN_TYPE_DOUBLE;
    default:
      return D3D_RETURN_TYPE_FLOAT;
  }
}

D3D12_SHADER_INPUT_BIND_DESC bind_desc(const rtapi::ShaderBindingInfo& binding, UINT id) {
  using T = rtapi::ShaderResourceType;
  D3D12_SHADER_INPUT_BIND_DESC desc = {};
  desc.Name = binding.Name.c_str();
  desc.Type = input_type(binding);
  desc.BindPoint = binding.Register;
  desc.BindCount = binding.Count == 0xFFFFFFFFu ? 0 : binding.Count;
  desc.Space = binding.Space;
  desc.uID = id;
  desc.Dimension = dimension(binding.Type);
  if (binding.IsCBuffer) desc.uFlags = D3D_SIF_USERPACKED;
  if (binding.Type == T::kComparisonSampler) desc.uFlags = D3D_SIF_COMPARISON_SAMPLER;
  if (desc.Type == D3D_SIT_TEXTURE || desc.Type == D3D_SIT_UAV_RWTYPED) {
    desc.ReturnType = return_type(binding.Element.Scalar);
    desc.uFlags = (binding.Element.Columns - 1) * D3D_SIF_TEXTURE_COMPONENT_0;
    const bool is_multisampled =
        binding.Type == T::kTexture2DMS || binding.Type == T::kTexture2DMSArray;
    desc.NumSamples = is_multisampled ? 0 : 0xFFFFFFFFu;
  } else if (binding.Type == T::kStructuredBuffer) {
    desc.ReturnType = D3D_RETURN_TYPE_MIXED;
    desc.NumSamples = binding.SizeInBytes;  // the stride, as D3D's reflection has it
  } else if (binding.Type == T::kByteAddressBuffer) {
    desc.ReturnType = D3D_RETURN_TYPE_MIXED;
  }
  return desc;
}

ReflectedType& no_type() {
  static ReflectedType type;
  return type;
}

}  // namespace

ReflectedType::ReflectedType(const rtapi::ShaderTypeInfo& type, UINT offset_bytes)
    : is_valid_(true), name_(type.Name) {
  desc_.Class = variable_class(type);
  desc_.Type = type.IsStruct ? D3D_SVT_VOID : variable_type(type.Scalar);
  desc_.Rows = type.IsStruct ? 1 : type.Rows;
  desc_.Columns = type.IsStruct ? component_count(type) : type.Columns;
  desc_.Elements = element_count(type);
  desc_.Members = static_cast<UINT>(type.Members.size());
  desc_.Offset = offset_bytes;
  for (const rtapi::ShaderVariableInfo& member : type.Members) {
    member_names_.push_back(member.Name);
    members_.push_back(std::make_unique<ReflectedType>(member.Type, member.OffsetInBytes));
  }
}

HRESULT ReflectedType::GetDesc(D3D12_SHADER_TYPE_DESC* desc) {
  if (desc == nullptr) return E_POINTER;
  if (!is_valid_) return E_FAIL;
  *desc = desc_;
  desc->Name = name_.c_str();
  return S_OK;
}

ID3D12ShaderReflectionType* ReflectedType::GetMemberTypeByIndex(UINT index) {
  return index < members_.size() ? members_[index].get() : &no_type();
}

ID3D12ShaderReflectionType* ReflectedType::GetMemberTypeByName(LPCSTR name) {
  for (size_t i = 0; i < members_.size(); ++i) {
    if (is_equal(name, member_names_[i])) return members_[i].get();
  }
  return &no_type();
}

LPCSTR ReflectedType::GetMemberTypeName(UINT index) {
  return index < members_.size() ? member_names_[index].c_str() : nullptr;
}

HRESULT ReflectedType::IsEqual(ID3D12ShaderReflectionType* type) {
  if (!is_valid_) return E_FAIL;
  return type == this ? S_OK : S_FALSE;
}

ID3D12ShaderReflectionType* ReflectedType::GetSubType() {
  return &no_type();
}

ID3D12ShaderReflectionType* ReflectedType::GetBaseClass() {
  return GetMemberTypeByName("base");
}

ID3D12ShaderReflectionType* ReflectedType::GetInterfaceByIndex(UINT) {
  return &no_type();
}

HRESULT ReflectedType::IsOfType(ID3D12ShaderReflectionType* type) {
  return IsEqual(type);
}

HRESULT ReflectedType::ImplementsInterface(ID3D12ShaderReflectionType*) {
  return is_valid_ ? S_FALSE : E_FAIL;
}

ReflectedVariable::ReflectedVariable(const rtapi::ShaderVariableInfo& variable,
                                     ID3D12ShaderReflectionConstantBuffer* buffer)
    : name_(variable.Name), type_(variable.Type, 0), buffer_(buffer) {
  desc_.StartOffset = variable.OffsetInBytes;
  desc_.Size = variable.SizeInBytes;
  desc_.uFlags = D3D_SVF_USED;
  desc_.StartTexture = desc_.StartSampler = 0xFFFFFFFFu;
}

HRESULT ReflectedVariable::GetDesc(D3D12_SHADER_VARIABLE_DESC* desc) {
  if (desc == nullptr) return E_POINTER;
  if (buffer_ == nullptr) return E_FAIL;
  *desc = desc_;
  desc->Name = name_.c_str();
  return S_OK;
}

ID3D12ShaderReflectionConstantBuffer* ReflectedVariable::GetBuffer() {
  return buffer_ != nullptr ? buffer_ : no_buffer();
}

UINT ReflectedVariable::GetInterfaceSlot(UINT) {
  return 0xFFFFFFFFu;
}

ReflectedBuffer::ReflectedBuffer(const rtapi::ShaderBindingInfo& binding) : name_(binding.Name) {
  using T = rtapi::ShaderResourceType;
  const bool is_texture_buffer = binding.Type == T::kTextureBuffer;
  const bool has_rows = is_texture_buffer || binding.Type == T::kConstantBuffer;
  desc_.Type = is_texture_buffer ? D3D_CT_TBUFFER
               : has_rows        ? D3D_CT_CBUFFER
                                 : D3D_CT_RESOURCE_BIND_INFO;
  desc_.Size = has_rows ? (binding.SizeInBytes + 15) / 16 * 16 : binding.SizeInBytes;
  if (binding.IsCBuffer) {
    for (const rtapi::ShaderVariableInfo& member : binding.Element.Members) {
      variables_.push_back(std::make_unique<ReflectedVariable>(member, this));
    }
  } else {
    // ConstantBuffer<T> has one variable of its own name, and so has TextureBuffer<T>; a structured
    // buffer has "$Element".
    variables_.push_back(std::make_unique<ReflectedVariable>(
        rtapi::ShaderVariableInfo{has_rows ? binding.Name : "$Element", 0, binding.SizeInBytes,
                                  binding.Element},
        this));
  }
  desc_.Variables = static_cast<UINT>(variables_.size());
}

HRESULT ReflectedBuffer::GetDesc(D3D12_SHADER_BUFFER_DESC* desc) {
  if (desc == nullptr) return E_POINTER;
  if (variables_.empty()) return E_FAIL;
  *desc = desc_;
  desc->Name = name_.c_str();
  return S_OK;
}

ID3D12ShaderReflectionVariable* ReflectedBuffer::GetVariableByIndex(UINT index) {
  return index < variables_.size() ? variables_[index].get() : no_variable();
}

ID3D12ShaderReflectionVariable* ReflectedBuffer::find(LPCSTR name) {
  for (const auto& variable : variables_) {
    if (is_equal(name, variable->name())) return variable.get();
  }
  return nullptr;
}

ID3D12ShaderReflectionVariable* ReflectedBuffer::GetVariableByName(LPCSTR name) {
  ID3D12ShaderReflectionVariable* found = find(name);
  return found != nullptr ? found : no_variable();
}

ID3D12ShaderReflectionConstantBuffer* no_buffer() {
  static ReflectedBuffer buffer;
  return &buffer;
}

ID3D12ShaderReflectionVariable* no_variable() {
  static ReflectedVariable variable;
  return &variable;
}

ReflectedResources::ReflectedResources(const rtapi::ShaderReflection& reflection,
                                       const std::vector<uint32_t>& bindings) {
  for (const char register_class : {'b', 's', 't', 'u'}) {
    UINT id = 0;
    for (const uint32_t index : bindings) {
      const rtapi::ShaderBindingInfo& binding = reflection.Bindings[index];
      if (binding.RegisterClass != register_class) continue;
      bindings_.push_back(bind_desc(binding, id++));
      if (binding.Type == rtapi::ShaderResourceType::kConstantBuffer ||
          binding.Type == rtapi::ShaderResourceType::kTextureBuffer ||
          binding.Type == rtapi::ShaderResourceType::kStructuredBuffer) {
        buffers_.push_back(std::make_unique<ReflectedBuffer>(binding));
      }
    }
  }
}

ID3D12ShaderReflectionConstantBuffer* ReflectedResources::buffer(UINT index) {
  return index < buffers_.size() ? buffers_[index].get() : no_buffer();
}

ID3D12ShaderReflectionConstantBuffer* ReflectedResources::buffer(LPCSTR name) {
  for (const auto& buffer : buffers_) {
    if (is_equal(name, buffer->name())) return buffer.get();
  }
  return no_buffer();
}

HRESULT ReflectedResources::binding(UINT index, D3D12_SHADER_INPUT_BIND_DESC* desc) const {
  if (desc == nullptr) return E_POINTER;
  if (index >= bindings_.size()) return E_INVALIDARG;
  *desc = bindings_[index];
  return S_OK;
}

HRESULT ReflectedResources::binding(LPCSTR name, D3D12_SHADER_INPUT_BIND_DESC* desc) const {
  if (name == nullptr || desc == nullptr) return E_POINTER;
  for (const D3D12_SHADER_INPUT_BIND_DESC& binding : bindings_) {
    if (std::strcmp(binding.Name, name) != 0) continue;
    *desc = binding;
    return S_OK;
  }
  return HRESULT_FROM_WIN32(ERROR_NOT_FOUND);
}

ID3D12ShaderReflectionVariable* ReflectedResources::variable(LPCSTR name) {
  for (const auto& buffer : buffers_) {
    if (auto* found = buffer->find(name)) return found;
  }
  return no_variable();
}

}  // namespace kaamos::d3d12
