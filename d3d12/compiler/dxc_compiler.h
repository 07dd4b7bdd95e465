// SPDX-License-Identifier: MIT
// IDxcCompiler, IDxcCompiler2 and IDxcCompiler3, and what reads the disk for them.
#pragma once

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

class DxcCompiler final
    : public ComObject<IDxcCompilerEntries, IDxcCompiler3Entries, IDxcVersionInfoEntries> {
 public:
  // IDxcCompiler
  HRESULT STDMETHODCALLTYPE Compile(IDxcBlob* source, LPCWSTR name, LPCWSTR entry, LPCWSTR profile,
                                    LPCWSTR* arguments, UINT32 argument_count,
                                    const DxcDefine* defines, UINT32 define_count,
                                    IDxcIncludeHandler* includes,
                                    IDxcOperationResult** result) override;
  HRESULT STDMETHODCALLTYPE Preprocess(IDxcBlob* source, LPCWSTR name, LPCWSTR* arguments,
                                       UINT32 argument_count, const DxcDefine* defines,
                                       UINT32 define_count, IDxcIncludeHandler* includes,
                                       IDxcOperationResult** result) override;
  HRESULT STDMETHODCALLTYPE Disassemble(IDxcBlob* source, IDxcBlobEncoding** text) override;
  // IDxcCompiler2
  HRESULT STDMETHODCALLTYPE CompileWithDebug(IDxcBlob* source, LPCWSTR name, LPCWSTR entry,
                                             LPCWSTR profile, LPCWSTR* arguments,
                                             UINT32 argument_count, const DxcDefine* defines,
                                             UINT32 define_count, IDxcIncludeHandler* includes,
                                             IDxcOperationResult** result, LPWSTR* debug_name,
                                             IDxcBlob** debug) override;
  // IDxcCompiler3
  HRESULT STDMETHODCALLTYPE Compile(const DxcBuffer* source, LPCWSTR* arguments,
                                    UINT32 argument_count, IDxcIncludeHandler* includes,
                                    REFIID riid, LPVOID* result) override;
  HRESULT STDMETHODCALLTYPE Disassemble(const DxcBuffer* object, REFIID riid,
                                        LPVOID* result) override;
  // IDxcVersionInfo
  HRESULT STDMETHODCALLTYPE GetVersion(UINT32* major, UINT32* minor) override;
  HRESULT STDMETHODCALLTYPE GetFlags(UINT32* flags) override;
};

/// An interface that only DxcDefaultIncludeHandler answers, by which it is recognised.
inline constexpr GUID kDefaultIncludeHandler = {
    0x6B61616D, 0x6F73, 0x4469, {0x88, 0x1A, 0x01, 0x7C, 0x5E, 0x30, 0x92, 0xD4}};

/// Reads files. DxcCompiler recognises it and reads the disk itself, without regard to case.
class DxcDefaultIncludeHandler final : public ComObject<IDxcIncludeHandlerEntries> {
 public:
  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID riid, void** object) override {
    return ComObject::QueryInterface(riid == kDefaultIncludeHandler ? kIUnknown : riid, object);
  }
  HRESULT STDMETHODCALLTYPE LoadSource(LPCWSTR name, IDxcBlob** source) override;
};

/// A file's bytes as a blob of that code page; none: by its byte order mark.
HRESULT load_file(LPCWSTR name, const UINT32* code_page, IDxcBlobEncoding** blob);

}  // namespace kaamos::d3d12
