// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_blob.h"

#include "d3d12/compiler/dxc_text.h"

namespace kaamos::d3d12 {

DxcBlob::DxcBlob(const void* bytes, size_t size, std::optional<uint32_t> code_page)
    : size_(size), code_page_(code_page) {
  const auto* first = static_cast<const std::byte*>(bytes);
  if (size != 0) copy_.assign(first, first + size);
  bytes_ = copy_.data();
  is_text_ = code_page == DXC_CP_UTF8 && size != 0 && copy_.back() == std::byte{0};
}

DxcBlob::DxcBlob(const void* bytes, size_t size, std::optional<uint32_t> code_page, IUnknown* owner)
    : owner_(owner), bytes_(bytes), size_(size), code_page_(code_page) {}

DxcBlob::DxcBlob(std::string_view text) : size_(text.size() + 1), code_page_(DXC_CP_UTF8) {
  const std::string ended(text);
  const auto* first = reinterpret_cast<const std::byte*>(ended.c_str());
  copy_.assign(first, first + size_);
  bytes_ = copy_.data();
  is_text_ = true;
}

LPVOID DxcBlob::GetBufferPointer() {
  return const_cast<void*>(bytes_);  // NOLINT: the interface has no const
}

HRESULT DxcBlob::GetEncoding(BOOL* known, UINT32* code_page) {
  if (known == nullptr || code_page == nullptr) return E_POINTER;
  *known = code_page_ && *code_page_ != DXC_CP_ACP ? TRUE : FALSE;
  *code_page = code_page_.value_or(DXC_CP_ACP);
  return S_OK;
}

LPCSTR DxcBlob::GetStringPointer() {
  return static_cast<const char*>(bytes_);
}

SIZE_T DxcBlob::GetStringLength() {
  return size_ == 0 ? 0 : size_ - 1;
}

bool DxcBlob::offers(REFIID riid) const {
  if (riid == __uuidof(IDxcBlobUtf8)) return is_text_;
  return riid != __uuidof(IDxcBlobEncoding) || code_page_.has_value();
}

std::string DxcBlob::text() {
  return decode_text(bytes_, size_, code_page_.value_or(DXC_CP_ACP));
}

HRESULT DxcWideBlob::GetEncoding(BOOL* known, UINT32* code_page) {
  if (known == nullptr || code_page == nullptr) return E_POINTER;
  *known = TRUE;
  *code_page = DXC_CP_WIDE;
  return S_OK;
}

std::string text_of_blob(IDxcBlob* blob) {
  Microsoft::WRL::ComPtr<IDxcBlobEncoding> encoding;
  BOOL is_known = FALSE;
  UINT32 code_page = DXC_CP_ACP;
  if (SUCCEEDED(blob->QueryInterface(__uuidof(IDxcBlobEncoding),
                                     reinterpret_cast<void**>(encoding.GetAddressOf())))) {
    encoding->GetEncoding(&is_known, &code_page);
  }
  return decode_text(blob->GetBufferPointer(), blob->GetBufferSize(),
                     is_known != FALSE ? code_page : DXC_CP_ACP);
}

}  // namespace kaamos::d3d12
