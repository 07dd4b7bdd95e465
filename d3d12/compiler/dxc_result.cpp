// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_result.h"

#include "d3d12/compiler/dxc_blob.h"

namespace kaamos::d3d12 {

void DxcResult::add(DXC_OUT_KIND kind, IUnknown* object, std::wstring name) {
  Output& output = outputs_.emplace_back();
  output.kind = kind;
  output.object.Attach(object);
  output.name = std::move(name);
}

void DxcResult::add_messages(std::string_view text) {
  add(DXC_OUT_ERRORS, static_cast<IDxcBlobUtf8*>(new DxcBlob(text)));
}

const DxcResult::Output* DxcResult::find(DXC_OUT_KIND kind) const {
  for (const Output& output : outputs_) {
    if (output.kind == kind) return &output;
  }
  return nullptr;
}

HRESULT DxcResult::GetStatus(HRESULT* status) {
  if (status == nullptr) return E_POINTER;
  *status = status_;
  return S_OK;
}

HRESULT DxcResult::GetResult(IDxcBlob** result) {
  if (result == nullptr) return E_POINTER;
  *result = nullptr;
  const Output* output = find(primary_);
  if (output == nullptr) return S_OK;
  return output->object->QueryInterface(__uuidof(IDxcBlob), reinterpret_cast<void**>(result));
}

HRESULT DxcResult::GetErrorBuffer(IDxcBlobEncoding** errors) {
  if (errors == nullptr) return E_POINTER;
  *errors = nullptr;
  const Output* output = find(DXC_OUT_ERRORS);
  if (output == nullptr) return S_OK;
  return output->object->QueryInterface(__uuidof(IDxcBlobEncoding),
                                        reinterpret_cast<void**>(errors));
}

BOOL DxcResult::HasOutput(DXC_OUT_KIND kind) {
  return find(kind) != nullptr ? TRUE : FALSE;
}

HRESULT DxcResult::GetOutput(DXC_OUT_KIND kind, REFIID riid, void** object, IDxcBlobWide** name) {
  if (object != nullptr) *object = nullptr;
  if (name != nullptr) *name = nullptr;
  const Output* output = find(kind);
  if (output == nullptr) return E_INVALIDARG;
  if (object != nullptr) {
    const HRESULT result = output->object->QueryInterface(riid, object);
    if (FAILED(result)) return result;
  }
  if (name != nullptr && !output->name.empty()) *name = new DxcWideBlob(output->name);
  return S_OK;
}

UINT32 DxcResult::GetNumOutputs() {
  return static_cast<UINT32>(outputs_.size());
}

DXC_OUT_KIND DxcResult::GetOutputByIndex(UINT32 index) {
  return index < outputs_.size() ? outputs_[index].kind : DXC_OUT_NONE;
}

}  // namespace kaamos::d3d12
