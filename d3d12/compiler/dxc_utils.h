// SPDX-License-Identifier: MIT
// IDxcUtils, IDxcLibrary and IDxcCompilerArgs.
#pragma once

#include <string>
#include <vector>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

class DxcUtils final : public ComObject<IDxcUtilsEntries, IDxcLibraryEntries> {
 public:
  // Both interfaces
  HRESULT STDMETHODCALLTYPE CreateBlobFromBlob(IDxcBlob* blob, UINT32 offset, UINT32 length,
                                               IDxcBlob** result) override;
  // IDxcUtils
  HRESULT STDMETHODCALLTYPE CreateBlobFromPinned(LPCVOID data, UINT32 size, UINT32 code_page,
                                                 IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE MoveToBlob(LPCVOID data, IMalloc* allocator, UINT32 size,
                                       UINT32 code_page, IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateBlob(LPCVOID data, UINT32 size, UINT32 code_page,
                                       IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE LoadFile(LPCWSTR name, UINT32* code_page,
                                     IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateDefaultIncludeHandler(IDxcIncludeHandler** handler) override;
  HRESULT STDMETHODCALLTYPE GetBlobAsUtf8(IDxcBlob* blob, IDxcBlobUtf8** text) override;
  HRESULT STDMETHODCALLTYPE GetBlobAsWide(IDxcBlob* blob, IDxcBlobWide** text) override;
  HRESULT STDMETHODCALLTYPE GetDxilContainerPart(const DxcBuffer* shader, UINT32 kind, void** data,
                                                 UINT32* size) override;
  HRESULT STDMETHODCALLTYPE CreateReflection(const DxcBuffer* data, REFIID riid,
                                             void** reflection) override;
  HRESULT STDMETHODCALLTYPE BuildArguments(LPCWSTR name, LPCWSTR entry, LPCWSTR profile,
                                           LPCWSTR* arguments, UINT32 argument_count,
                                           const DxcDefine* defines, UINT32 define_count,
                                           IDxcCompilerArgs** result) override;
  // IDxcLibrary
  HRESULT STDMETHODCALLTYPE SetMalloc(IMalloc*) override { return S_OK; }
  HRESULT STDMETHODCALLTYPE CreateBlobFromFile(LPCWSTR name, UINT32* code_page,
                                               IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingFromPinned(LPCVOID text, UINT32 size,
                                                             UINT32 code_page,
                                                             IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingOnHeapCopy(LPCVOID text, UINT32 size,
                                                             UINT32 code_page,
                                                             IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingOnMalloc(LPCVOID text, IMalloc* allocator,
                                                           UINT32 size, UINT32 code_page,
                                                           IDxcBlobEncoding** blob) override;
  HRESULT STDMETHODCALLTYPE CreateIncludeHandler(IDxcIncludeHandler** handler) override;
  HRESULT STDMETHODCALLTYPE GetBlobAsUtf8(IDxcBlob* blob, IDxcBlobEncoding** text) override;
  HRESULT STDMETHODCALLTYPE GetBlobAsWide(IDxcBlob* blob, IDxcBlobEncoding** text) override;
};

class DxcCompilerArgs final : public ComObject<IDxcCompilerArgsEntries> {
 public:
  LPCWSTR* STDMETHODCALLTYPE GetArguments() override;
  UINT32 STDMETHODCALLTYPE GetCount() override { return static_cast<UINT32>(words_.size()); }
  HRESULT STDMETHODCALLTYPE AddArguments(LPCWSTR* arguments, UINT32 count) override;
  HRESULT STDMETHODCALLTYPE AddArgumentsUTF8(LPCSTR* arguments, UINT32 count) override;
  HRESULT STDMETHODCALLTYPE AddDefines(const DxcDefine* defines, UINT32 count) override;
  void add(std::wstring word) { words_.push_back(std::move(word)); }

 private:
  std::vector<std::wstring> words_;
  std::vector<LPCWSTR> pointers_;  // as GetArguments gave them last
};

}  // namespace kaamos::d3d12
