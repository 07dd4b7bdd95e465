// SPDX-License-Identifier: MIT
// IDxcBlob and its kinds: bytes, and texts of an encoding.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <wrl/client.h>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

/// Bytes, or a text with its terminating zero, which is an IDxcBlobUtf8.
class DxcBlob final : public ComObject<IDxcBlobUtf8Entries> {
 public:
  /// A copy. Without a code page they are bytes.
  DxcBlob(const void* bytes, size_t size, std::optional<uint32_t> code_page);
  /// Memory of `owner`, or of the caller, who keeps it.
  DxcBlob(const void* bytes, size_t size, std::optional<uint32_t> code_page, IUnknown* owner);
  explicit DxcBlob(std::string_view text);

  LPVOID STDMETHODCALLTYPE GetBufferPointer() override;
  SIZE_T STDMETHODCALLTYPE GetBufferSize() override { return size_; }
  HRESULT STDMETHODCALLTYPE GetEncoding(BOOL* known, UINT32* code_page) override;
  LPCSTR STDMETHODCALLTYPE GetStringPointer() override;
  SIZE_T STDMETHODCALLTYPE GetStringLength() override;

  /// UTF-8 of what it holds.
  std::string text();

 protected:
  bool offers(REFIID riid) const override;

 private:
  std::vector<std::byte> copy_;
  Microsoft::WRL::ComPtr<IUnknown> owner_;
  const void* bytes_ = nullptr;
  size_t size_ = 0;
  std::optional<uint32_t> code_page_;
  bool is_text_ = false;  // UTF-8 that ends with a zero
};

class DxcWideBlob final : public ComObject<IDxcBlobWideEntries> {
 public:
  explicit DxcWideBlob(std::wstring text) : text_(std::move(text)) {}

  LPVOID STDMETHODCALLTYPE GetBufferPointer() override { return text_.data(); }
  SIZE_T STDMETHODCALLTYPE GetBufferSize() override { return (text_.size() + 1) * sizeof(wchar_t); }
  HRESULT STDMETHODCALLTYPE GetEncoding(BOOL* known, UINT32* code_page) override;
  LPCWSTR STDMETHODCALLTYPE GetStringPointer() override { return text_.c_str(); }
  SIZE_T STDMETHODCALLTYPE GetStringLength() override { return text_.size(); }

 private:
  std::wstring text_;
};

/// UTF-8 of any blob's bytes, by its encoding if it is an IDxcBlobEncoding.
std::string text_of_blob(IDxcBlob* blob);

}  // namespace kaamos::d3d12
