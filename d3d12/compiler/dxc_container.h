// SPDX-License-Identifier: MIT
// IDxcContainerReflection, IDxcContainerBuilder and IDxcValidator: what looks at containers.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include <wrl/client.h>

#include "d3d12/com/object.h"
#include "d3d12/container/container.h"

namespace kaamos::d3d12 {

/// A program looks for part DXIL in order to reflect it: part KAAM answers to that name too.
class DxcContainerReflection final : public ComObject<IDxcContainerReflectionEntries> {
 public:
  HRESULT STDMETHODCALLTYPE Load(IDxcBlob* container) override;
  HRESULT STDMETHODCALLTYPE GetPartCount(UINT32* count) override;
  HRESULT STDMETHODCALLTYPE GetPartKind(UINT32 index, UINT32* kind) override;
  HRESULT STDMETHODCALLTYPE GetPartContent(UINT32 index, IDxcBlob** content) override;
  HRESULT STDMETHODCALLTYPE FindFirstPartKind(UINT32 kind, UINT32* index) override;
  HRESULT STDMETHODCALLTYPE GetPartReflection(UINT32 index, REFIID riid, void** object) override;

 private:
  Microsoft::WRL::ComPtr<IDxcBlob> container_;
  std::vector<Part> parts_;
};

class DxcContainerBuilder final : public ComObject<IDxcContainerBuilderEntries> {
 public:
  HRESULT STDMETHODCALLTYPE Load(IDxcBlob* container) override;
  HRESULT STDMETHODCALLTYPE AddPart(UINT32 fourcc, IDxcBlob* source) override;
  HRESULT STDMETHODCALLTYPE RemovePart(UINT32 fourcc) override;
  HRESULT STDMETHODCALLTYPE SerializeContainer(IDxcOperationResult** result) override;

 private:
  struct OwnedPart {
    uint32_t fourcc;
    std::vector<std::byte> bytes;
  };
  std::vector<OwnedPart> parts_;
};

/// A container is valid if it is whole and holds a source that can be read.
class DxcValidator final : public ComObject<IDxcValidatorEntries, IDxcVersionInfoEntries> {
 public:
  HRESULT STDMETHODCALLTYPE Validate(IDxcBlob* shader, UINT32 flags,
                                     IDxcOperationResult** result) override;
  HRESULT STDMETHODCALLTYPE GetVersion(UINT32* major, UINT32* minor) override;
  HRESULT STDMETHODCALLTYPE GetFlags(UINT32* flags) override;
};

}  // namespace kaamos::d3d12
