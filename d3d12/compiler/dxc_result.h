// SPDX-License-Identifier: MIT
// IDxcResult: what came of a call of the compiler.
#pragma once

#include <string>
#include <vector>

#include <wrl/client.h>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

class DxcResult final : public ComObject<IDxcResultEntries> {
 public:
  DxcResult(HRESULT status, DXC_OUT_KIND primary) : status_(status), primary_(primary) {}

  /// Adds an output, whose reference it takes over.
  void add(DXC_OUT_KIND kind, IUnknown* object, std::wstring name = {});
  /// The messages: an output, even if there are none.
  void add_messages(std::string_view text);

  HRESULT STDMETHODCALLTYPE GetStatus(HRESULT* status) override;
  HRESULT STDMETHODCALLTYPE GetResult(IDxcBlob** result) override;
  HRESULT STDMETHODCALLTYPE GetErrorBuffer(IDxcBlobEncoding** errors) override;
  BOOL STDMETHODCALLTYPE HasOutput(DXC_OUT_KIND kind) override;
  HRESULT STDMETHODCALLTYPE GetOutput(DXC_OUT_KIND kind, REFIID riid, void** object,
                                      IDxcBlobWide** name) override;
  UINT32 STDMETHODCALLTYPE GetNumOutputs() override;
  DXC_OUT_KIND STDMETHODCALLTYPE GetOutputByIndex(UINT32 index) override;
  DXC_OUT_KIND STDMETHODCALLTYPE PrimaryOutput() override { return primary_; }

 private:
  struct Output {
    DXC_OUT_KIND kind;
    Microsoft::WRL::ComPtr<IUnknown> object;
    std::wstring name;
  };
  const Output* find(DXC_OUT_KIND kind) const;

  HRESULT status_;
  DXC_OUT_KIND primary_;
  std::vector<Output> outputs_;
};

}  // namespace kaamos::d3d12
