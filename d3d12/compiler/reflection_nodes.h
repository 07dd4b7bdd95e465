// SPDX-License-Identifier: MIT
// The parts of a reflection, which live as long as it: types, variables, buffers, bindings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <rtapi/shader_reflection.h>

#include "d3d12/compiler/reflection_base.h"

namespace kaamos::d3d12 {

// As in D3D12, a look-up never gives null: what is not there is a node whose calls fail. A node
// made without arguments is one.

class ReflectedType final : public ReflectionBase<ID3D12ShaderReflectionType> {
 public:
  ReflectedType() = default;
  ReflectedType(const rtapi::ShaderTypeInfo& type, UINT offset_bytes);

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_SHADER_TYPE_DESC* desc) override;
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetMemberTypeByIndex(UINT index) override;
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetMemberTypeByName(LPCSTR name) override;
  LPCSTR STDMETHODCALLTYPE GetMemberTypeName(UINT index) override;
  HRESULT STDMETHODCALLTYPE IsEqual(ID3D12ShaderReflectionType* type) override;
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetSubType() override;
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetBaseClass() override;
  UINT STDMETHODCALLTYPE GetNumInterfaces() override { return 0; }
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetInterfaceByIndex(UINT index) override;
  HRESULT STDMETHODCALLTYPE IsOfType(ID3D12ShaderReflectionType* type) override;
  HRESULT STDMETHODCALLTYPE ImplementsInterface(ID3D12ShaderReflectionType* base) override;

 private:
  bool is_valid_ = false;
  std::string name_;
  D3D12_SHADER_TYPE_DESC desc_ = {};
  std::vector<std::string> member_names_;
  std::vector<std::unique_ptr<ReflectedType>> members_;
};

class ReflectedVariable final : public ReflectionBase<ID3D12ShaderReflectionVariable> {
 public:
  ReflectedVariable() = default;
  ReflectedVariable(const rtapi::ShaderVariableInfo& variable,
                    ID3D12ShaderReflectionConstantBuffer* buffer);

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_SHADER_VARIABLE_DESC* desc) override;
  ID3D12ShaderReflectionType* STDMETHODCALLTYPE GetType() override { return &type_; }
  ID3D12ShaderReflectionConstantBuffer* STDMETHODCALLTYPE GetBuffer() override;
  UINT STDMETHODCALLTYPE GetInterfaceSlot(UINT index) override;

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  D3D12_SHADER_VARIABLE_DESC desc_ = {};
  ReflectedType type_;
  ID3D12ShaderReflectionConstantBuffer* buffer_ = nullptr;  // null: not valid
};

/// A constant buffer, or the element of a structured buffer.
class ReflectedBuffer final : public ReflectionBase<ID3D12ShaderReflectionConstantBuffer> {
 public:
  ReflectedBuffer() = default;
  explicit ReflectedBuffer(const rtapi::ShaderBindingInfo& binding);

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_SHADER_BUFFER_DESC* desc) override;
  ID3D12ShaderReflectionVariable* STDMETHODCALLTYPE GetVariableByIndex(UINT index) override;
  ID3D12ShaderReflectionVariable* STDMETHODCALLTYPE GetVariableByName(LPCSTR name) override;

  const std::string& name() const { return name_; }
  /// Null if there is none.
  ID3D12ShaderReflectionVariable* find(LPCSTR name);

 private:
  std::string name_;
  D3D12_SHADER_BUFFER_DESC desc_ = {};
  std::vector<std::unique_ptr<ReflectedVariable>> variables_;
};

ID3D12ShaderReflectionConstantBuffer* no_buffer();
ID3D12ShaderReflectionVariable* no_variable();

/// The resources that a shader or function reaches, in DXC's order: constant buffers, samplers,
/// shader resource views, unordered access views.
class ReflectedResources {
 public:
  ReflectedResources(const rtapi::ShaderReflection& reflection,
                     const std::vector<uint32_t>& bindings);

  UINT buffer_count() const { return static_cast<UINT>(buffers_.size()); }
  UINT binding_count() const { return static_cast<UINT>(bindings_.size()); }
  ID3D12ShaderReflectionConstantBuffer* buffer(UINT index);
  ID3D12ShaderReflectionConstantBuffer* buffer(LPCSTR name);
  HRESULT binding(UINT index, D3D12_SHADER_INPUT_BIND_DESC* desc) const;
  HRESULT binding(LPCSTR name, D3D12_SHADER_INPUT_BIND_DESC* desc) const;
  ID3D12ShaderReflectionVariable* variable(LPCSTR name);

 private:
  std::vector<std::unique_ptr<ReflectedBuffer>> buffers_;
  std::vector<D3D12_SHADER_INPUT_BIND_DESC> bindings_;
};

}  // namespace kaamos::d3d12
