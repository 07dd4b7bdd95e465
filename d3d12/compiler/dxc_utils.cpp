// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_utils.h"

#include "d3d12/com/report.h"
#include "d3d12/com/text.h"
#include "d3d12/compiler/dxc_blob.h"
#include "d3d12/compiler/dxc_compiler.h"
#include "d3d12/compiler/reflection.h"
#include "d3d12/container/container.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

HRESULT DxcUtils::CreateBlobFromBlob(IDxcBlob* blob, UINT32 offset, UINT32 length,
                                     IDxcBlob** result) {
  if (blob == nullptr || result == nullptr) return E_POINTER;
  *result = nullptr;
  const size_t size = blob->GetBufferSize();
  if (offset > size || length > size - offset) {
    return fail(ErrorId::kCompiler, "CreateBlobFromBlob: bytes " + std::to_string(offset) + " to " +
                                        std::to_string(uint64_t{offset} + length) +
                                        " of a blob of " + std::to_string(size) + " bytes.");
  }
  const auto* bytes = static_cast<const std::byte*>(blob->GetBufferPointer());
  *result = new DxcBlob(bytes + offset, length, std::nullopt, blob);
  return S_OK;
}

HRESULT DxcUtils::CreateBlobFromPinned(LPCVOID data, UINT32 size, UINT32 code_page,
                                       IDxcBlobEncoding** blob) {
  if (blob == nullptr || (data == nullptr && size != 0)) return E_POINTER;
  *blob = new DxcBlob(data, size, code_page, nullptr);
  return S_OK;
}

HRESULT DxcUtils::MoveToBlob(LPCVOID data, IMalloc* allocator, UINT32 size, UINT32 code_page,
                             IDxcBlobEncoding** blob) {
  const HRESULT result = CreateBlob(data, size, code_page, blob);
  if (SUCCEEDED(result) && allocator != nullptr) {
    allocator->Free(const_cast<void*>(data));  // NOLINT: the memory was the caller's to give away
  }
  return result;
}

HRESULT DxcUtils::CreateBlob(LPCVOID data, UINT32 size, UINT32 code_page, IDxcBlobEncoding** blob) {
  if (blob == nullptr || (data == nullptr && size != 0)) return E_POINTER;
  *blob = new DxcBlob(data, size, code_page);
  return S_OK;
}

HRESULT DxcUtils::LoadFile(LPCWSTR name, UINT32* code_page, IDxcBlobEncoding** blob) {
  return load_file(name, code_page, blob);
}

HRESULT DxcUtils::CreateDefaultIncludeHandler(IDxcIncludeHandler** handler) {
  if (handler == nullptr) return E_POINTER;
  *handler = new DxcDefaultIncludeHandler();
  return S_OK;
}

HRESULT DxcUtils::GetBlobAsUtf8(IDxcBlob* blob, IDxcBlobUtf8** text) {
  if (blob == nullptr || text == nullptr) return E_POINTER;
  *text = new DxcBlob(text_of_blob(blob));
  return S_OK;
}

HRESULT DxcUtils::GetBlobAsWide(IDxcBlob* blob, IDxcBlobWide** text) {
  if (blob == nullptr || text == nullptr) return E_POINTER;
  *text = new DxcWideBlob(to_wide(text_of_blob(blob)));
  return S_OK;
}

HRESULT DxcUtils::GetDxilContainerPart(const DxcBuffer* shader, UINT32 kind, void** data,
                                       UINT32* size) {
  if (shader == nullptr || data == nullptr || size == nullptr) return E_POINTER;
  *data = nullptr;
  *size = 0;
  const auto parts = read_container(shader->Ptr, shader->Size);
  if (!parts) return fail(parts.error());
  for (const Part& part : *parts) {
    if (!is_part(part, kind)) continue;
    *data = const_cast<std::byte*>(part.bytes.data());  // NOLINT: the interface has no const
    *size = static_cast<UINT32>(part.bytes.size());
    return S_OK;
  }
  return HRESULT_FROM_WIN32(ERROR_NOT_FOUND);
}

HRESULT DxcUtils::CreateReflection(const DxcBuffer* data, REFIID riid, void** reflection) {
  if (data == nullptr) return E_POINTER;
  return create_reflection(data->Ptr, data->Size, riid, reflection);
}

HRESULT DxcUtils::BuildArguments(LPCWSTR name, LPCWSTR entry, LPCWSTR profile, LPCWSTR* arguments,
                                 UINT32 argument_count, const DxcDefine* defines,
                                 UINT32 define_count, IDxcCompilerArgs** result) {
  if (profile == nullptr || result == nullptr) return E_POINTER;
  auto* made = new DxcCompilerArgs();
  if (name != nullptr && *name != L'\0') made->add(name);
  if (entry != nullptr && *entry != L'\0') {
    made->add(L"-E");
    made->add(entry);
  }
  made->add(L"-T");
  made->add(profile);
  made->AddArguments(arguments, argument_count);
  made->AddDefines(defines, define_count);
  *result = made;
  return S_OK;
}

HRESULT DxcUtils::CreateBlobFromFile(LPCWSTR name, UINT32* code_page, IDxcBlobEncoding** blob) {
  return load_file(name, code_page, blob);
}

HRESULT DxcUtils::CreateBlobWithEncodingFromPinned(LPCVOID text, UINT32 size, UINT32 code_page,
                                                   IDxcBlobEncoding** blob) {
  return CreateBlobFromPinned(text, size, code_page, blob);
}

HRESULT DxcUtils::CreateBlobWithEncodingOnHeapCopy(LPCVOID text, UINT32 size, UINT32 code_page,
                                                   IDxcBlobEncoding** blob) {
  return CreateBlob(text, size, code_page, blob);
}

HRESULT DxcUtils::CreateBlobWithEncodingOnMalloc(LPCVOID text, IMalloc* allocator, UINT32 size,
                                                 UINT32 code_page, IDxcBlobEncoding** blob) {
  return MoveToBlob(text, allocator, size, code_page, blob);
}

HRESULT DxcUtils::CreateIncludeHandler(IDxcIncludeHandler** handler) {
  return CreateDefaultIncludeHandler(handler);
}

HRESULT DxcUtils::GetBlobAsUtf8(IDxcBlob* blob, IDxcBlobEncoding** text) {
  if (blob == nullptr || text == nullptr) return E_POINTER;
  *text = new DxcBlob(text_of_blob(blob));
  return S_OK;
}

HRESULT DxcUtils::GetBlobAsWide(IDxcBlob* blob, IDxcBlobEncoding** text) {
  if (blob == nullptr || text == nullptr) return E_POINTER;
  *text = new DxcWideBlob(to_wide(text_of_blob(blob)));
  return S_OK;
}

LPCWSTR* DxcCompilerArgs::GetArguments() {
  pointers_.clear();
  for (const std::wstring& word : words_) pointers_.push_back(word.c_str());
  return pointers_.data();
}

HRESULT DxcCompilerArgs::AddArguments(LPCWSTR* arguments, UINT32 count) {
  if (arguments == nullptr && count != 0) return E_POINTER;
  for (UINT32 i = 0; i < count; ++i) add(arguments[i]);
  return S_OK;
}

HRESULT DxcCompilerArgs::AddArgumentsUTF8(LPCSTR* arguments, UINT32 count) {
  if (arguments == nullptr && count != 0) return E_POINTER;
  for (UINT32 i = 0; i < count; ++i) add(to_wide(arguments[i]));
  return S_OK;
}

HRESULT DxcCompilerArgs::AddDefines(const DxcDefine* defines, UINT32 count) {
  if (defines == nullptr && count != 0) return E_POINTER;
  for (UINT32 i = 0; i < count; ++i) {
    add(L"-D");
    add(defines[i].Value != nullptr ? std::wstring(defines[i].Name) + L"=" + defines[i].Value
                                    : std::wstring(defines[i].Name));
  }
  return S_OK;
}

}  // namespace kaamos::d3d12
