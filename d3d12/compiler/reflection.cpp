// SPDX-License-Identifier: MIT
#include "d3d12/compiler/reflection.h"

#include <algorithm>
#include <cctype>
#include <memory>

#include "d3d12/com/object.h"
#include "d3d12/com/report.h"
#include "d3d12/compiler/reflection_nodes.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

namespace {

constexpr char kCreator[] = "Kaamos";

// The interface and the reporter that generated entries expect of their base.
class ShaderReflectionBase : public ReflectionBase<ID3D12ShaderReflection> {
 public:
  static constexpr InterfaceId kInterfaces[] = {
      {{0x5a58797d, 0xa72c, 0x478d, {0x8b, 0xa2, 0xef, 0xc6, 0xb0, 0xef, 0xe8, 0x8e}},
       "ID3D12ShaderReflection"}};

 protected:
  virtual Reporter& reporter() const = 0;
};
class LibraryReflectionBase : public ReflectionBase<ID3D12LibraryReflection> {
 public:
  static constexpr InterfaceId kInterfaces[] = {
      {{0x8e349d19, 0x54db, 0x4a56, {0x9d, 0xc9, 0x11, 0x9d, 0x87, 0xbd, 0xb8, 0x04}},
       "ID3D12LibraryReflection"}};

 protected:
  virtual Reporter& reporter() const = 0;
};

// D3D12_SHADER_VERSION_TYPE in the upper half, then major and minor version.
UINT version_of(rtapi::ShaderStage stage, const std::string& target) {
  const UINT minor = target.back() == 'x' ? 8 : static_cast<UINT>(target.back() - '0');
  return static_cast<UINT>(stage) << 16 | 6u << 4 | minor;
}

D3D_NAME system_value(const std::string& semantic) {
  struct Name {
    const char* semantic;
    D3D_NAME name;
  };
  constexpr Name kNames[] = {{"sv_position", D3D_NAME_POSITION},
                             {"sv_clipdistance", D3D_NAME_CLIP_DISTANCE},
                             {"sv_culldistance", D3D_NAME_CULL_DISTANCE},
                             {"sv_rendertargetarrayindex", D3D_NAME_RENDER_TARGET_ARRAY_INDEX},
                             {"sv_viewportarrayindex", D3D_NAME_VIEWPORT_ARRAY_INDEX},
                             {"sv_vertexid", D3D_NAME_VERTEX_ID},
                             {"sv_primitiveid", D3D_NAME_PRIMITIVE_ID},
                             {"sv_instanceid", D3D_NAME_INSTANCE_ID},
                             {"sv_isfrontface", D3D_NAME_IS_FRONT_FACE},
                             {"sv_barycentrics", D3D_NAME_BARYCENTRICS},
                             {"sv_target", D3D_NAME_TARGET},
                             {"sv_depth", D3D_NAME_DEPTH},
                             {"sv_depthgreaterequal", D3D_NAME_DEPTH_GREATER_EQUAL},
                             {"sv_depthlessequal", D3D_NAME_DEPTH_LESS_EQUAL}};
  std::string lower = semantic;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Name& name : kNames) {
    if (lower == name.semantic) return name.name;
  }
  return D3D_NAME_UNDEFINED;
}

HRESULT describe(const std::vector<rtapi::ShaderSignatureElement>& elements, UINT index,
                 bool is_input, D3D12_SIGNATURE_PARAMETER_DESC* desc) {
  if (desc == nullptr) return E_POINTER;
  if (index >= elements.size()) return E_INVALIDARG;
  const rtapi::ShaderSignatureElement& element = elements[index];
  *desc = {};
  desc->SemanticName = element.Semantic.c_str();
  desc->SemanticIndex = element.SemanticIndex;
  desc->SystemValueType = system_value(element.Semantic);
  // Each has a register of its own; depth has none.
  desc->Register = desc->SystemValueType == D3D_NAME_DEPTH ? 0xFFFFFFFFu : index;
  desc->ComponentType =
      element.Type == rtapi::ShaderScalarType::kFloat32 ? D3D_REGISTER_COMPONENT_FLOAT32
      : element.Type == rtapi::ShaderScalarType::kInt32 ? D3D_REGISTER_COMPONENT_SINT32
                                                        : D3D_REGISTER_COMPONENT_UINT32;
  desc->Mask = static_cast<BYTE>((1u << element.Components) - 1);
  desc->ReadWriteMask = is_input ? desc->Mask : BYTE{0};
  return S_OK;
}

// All bindings of one shader.
class ReflectedShader final : public ComObject<ShaderReflectionBase> {
 public:
  ReflectedShader(rtapi::ShaderReflection reflection, const std::string& target)
      : reflection_(std::move(reflection)),
        entry_(reflection_.Entries.front()),
        target_(target),
        resources_(reflection_, entry_.Bindings) {}

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_SHADER_DESC* desc) override {
    if (desc == nullptr) return E_POINTER;
    *desc = {};
    desc->Version = version_of(entry_.Export.Stage, target_);
    desc->Creator = kCreator;
    desc->ConstantBuffers = resources_.buffer_count();
    desc->BoundResources = resources_.binding_count();
    desc->InputParameters = static_cast<UINT>(entry_.Inputs.size());
    desc->OutputParameters = static_cast<UINT>(entry_.Outputs.size());
    return S_OK;
  }
  ID3D12ShaderReflectionConstantBuffer* STDMETHODCALLTYPE
  GetConstantBufferByIndex(UINT index) override {
    return resources_.buffer(index);
  }
  ID3D12ShaderReflectionConstantBuffer* STDMETHODCALLTYPE
  GetConstantBufferByName(LPCSTR name) override {
    return resources_.buffer(name);
  }
  HRESULT STDMETHODCALLTYPE GetResourceBindingDesc(UINT index,
                                                   D3D12_SHADER_INPUT_BIND_DESC* desc) override {
    return resources_.binding(index, desc);
  }
  HRESULT STDMETHODCALLTYPE GetInputParameterDesc(UINT index,
                                                  D3D12_SIGNATURE_PARAMETER_DESC* desc) override {
    return describe(entry_.Inputs, index, true, desc);
  }
  HRESULT STDMETHODCALLTYPE GetOutputParameterDesc(UINT index,
                                                   D3D12_SIGNATURE_PARAMETER_DESC* desc) override {
    return describe(entry_.Outputs, index, false, desc);
  }
  HRESULT STDMETHODCALLTYPE
  GetPatchConstantParameterDesc(UINT, D3D12_SIGNATURE_PARAMETER_DESC*) override {
    return E_INVALIDARG;  // hull and domain shaders alone have any
  }
  ID3D12ShaderReflectionVariable* STDMETHODCALLTYPE GetVariableByName(LPCSTR name) override {
    return resources_.variable(name);
  }
  HRESULT STDMETHODCALLTYPE
  GetResourceBindingDescByName(LPCSTR name, D3D12_SHADER_INPUT_BIND_DESC* desc) override {
    return resources_.binding(name, desc);
  }
  // There are no instructions to count.
  UINT STDMETHODCALLTYPE GetMovInstructionCount() override { return 0; }
  UINT STDMETHODCALLTYPE GetMovcInstructionCount() override { return 0; }
  UINT STDMETHODCALLTYPE GetConversionInstructionCount() override { return 0; }
  UINT STDMETHODCALLTYPE GetBitwiseInstructionCount() override { return 0; }
  D3D_PRIMITIVE STDMETHODCALLTYPE GetGSInputPrimitive() override { return D3D_PRIMITIVE_UNDEFINED; }
  BOOL STDMETHODCALLTYPE IsSampleFrequencyShader() override { return FALSE; }
  UINT STDMETHODCALLTYPE GetNumInterfaceSlots() override { return 0; }
  HRESULT STDMETHODCALLTYPE GetMinFeatureLevel(enum D3D_FEATURE_LEVEL* level) override {
    if (level == nullptr) return E_POINTER;
    *level = D3D_FEATURE_LEVEL_12_0;
    return S_OK;
  }
  UINT STDMETHODCALLTYPE GetThreadGroupSize(UINT* x, UINT* y, UINT* z) override {
    const uint32_t* size = entry_.Export.ThreadGroup;
    if (x != nullptr) *x = size[0];
    if (y != nullptr) *y = size[1];
    if (z != nullptr) *z = size[2];
    return size[0] * size[1] * size[2];
  }
  UINT64 STDMETHODCALLTYPE GetRequiresFlags() override { return 0; }

 private:
  const rtapi::ShaderReflection reflection_;
  const rtapi::ShaderEntryInfo& entry_;
  const std::string target_;
  ReflectedResources resources_;
};

class ReflectedFunction final : public ReflectionBase<ID3D12FunctionReflection> {
 public:
  ReflectedFunction() = default;  // one that is not there
  ReflectedFunction(const rtapi::ShaderReflection& reflection, const rtapi::ShaderEntryInfo& entry,
                    const std::string& target)
      : entry_(&entry),
        version_(version_of(entry.Export.Stage, target)),
        resources_(std::make_unique<ReflectedResources>(reflection, entry.Bindings)) {}

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_FUNCTION_DESC* desc) override {
    if (desc == nullptr) return E_POINTER;
    if (entry_ == nullptr) return E_FAIL;
    *desc = {};
    desc->Version = version_;
    desc->Creator = kCreator;
    desc->ConstantBuffers = resources_->buffer_count();
    desc->BoundResources = resources_->binding_count();
    desc->MinFeatureLevel = D3D_FEATURE_LEVEL_12_0;
    desc->Name = entry_->Export.MangledName.c_str();
    return S_OK;
  }
  ID3D12ShaderReflectionConstantBuffer* STDMETHODCALLTYPE
  GetConstantBufferByIndex(UINT index) override {
    return resources_ != nullptr ? resources_->buffer(index) : no_buffer();
  }
  ID3D12ShaderReflectionConstantBuffer* STDMETHODCALLTYPE
  GetConstantBufferByName(LPCSTR name) override {
    return resources_ != nullptr ? resources_->buffer(name) : no_buffer();
  }
  HRESULT STDMETHODCALLTYPE GetResourceBindingDesc(UINT index,
                                                   D3D12_SHADER_INPUT_BIND_DESC* desc) override {
    return resources_ != nullptr ? resources_->binding(index, desc) : E_FAIL;
  }
  ID3D12ShaderReflectionVariable* STDMETHODCALLTYPE GetVariableByName(LPCSTR name) override {
    return resources_ != nullptr ? resources_->variable(name) : no_variable();
  }
  HRESULT STDMETHODCALLTYPE
  GetResourceBindingDescByName(LPCSTR name, D3D12_SHADER_INPUT_BIND_DESC* desc) override {
    return resources_ != nullptr ? resources_->binding(name, desc) : E_FAIL;
  }
  // As with DXC, whose functions have no parameters here either.
  ID3D12FunctionParameterReflection* STDMETHODCALLTYPE GetFunctionParameter(INT) override {
    return nullptr;
  }

 private:
  const rtapi::ShaderEntryInfo* entry_ = nullptr;
  UINT version_ = 0;
  std::unique_ptr<ReflectedResources> resources_;
};

class ReflectedLibrary final : public ComObject<LibraryReflectionBase> {
 public:
  ReflectedLibrary(rtapi::ShaderReflection reflection, const std::string& target)
      : reflection_(std::move(reflection)) {
    for (const rtapi::ShaderEntryInfo& entry : reflection_.Entries) {
      functions_.push_back(std::make_unique<ReflectedFunction>(reflection_, entry, target));
    }
  }

  HRESULT STDMETHODCALLTYPE GetDesc(D3D12_LIBRARY_DESC* desc) override {
    if (desc == nullptr) return E_POINTER;
    *desc = {kCreator, 0, static_cast<UINT>(functions_.size())};
    return S_OK;
  }
  ID3D12FunctionReflection* STDMETHODCALLTYPE GetFunctionByIndex(INT index) override {
    static ReflectedFunction none;
    const bool is_there = index >= 0 && static_cast<size_t>(index) < functions_.size();
    return is_there ? functions_[static_cast<size_t>(index)].get() : &none;
  }

 private:
  const rtapi::ShaderReflection reflection_;
  std::vector<std::unique_ptr<ReflectedFunction>> functions_;
};

}  // namespace

HRESULT create_reflection(const void* bytes, size_t size, REFIID riid, void** reflection) {
  if (reflection == nullptr) return E_POINTER;
  *reflection = nullptr;
  auto source = source_of_container(bytes, size);
  if (!source) return process_reporter().fail(source.error());
  rtapi::ShaderCompileOptions options = compile_options(*std::move(source));
  options.CheckOnly = true;
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  if (!compiled.Status.ok()) return process_reporter().fail(compiled.Status.error());
  if (options.Target.starts_with("lib")) {
    return hand_out(new ReflectedLibrary(compiled.Reflection, options.Target), riid, reflection);
  }
  if (compiled.Reflection.Entries.empty()) return E_FAIL;
  return hand_out(new ReflectedShader(compiled.Reflection, options.Target), riid, reflection);
}

}  // namespace kaamos::d3d12
