// SPDX-License-Identifier: MIT
#include "d3d12/com/private_data.h"

namespace kaamos::d3d12 {

HRESULT PrivateData::get(REFGUID guid, UINT* size, void* data) const {
  if (size == nullptr) return E_INVALIDARG;
  std::lock_guard lock(mutex_);
  const auto found = items_.find(guid);
  if (found == items_.end()) {
    *size = 0;
    return DXGI_ERROR_NOT_FOUND;
  }
  const Item& item = found->second;
  const UINT needed = item.object ? sizeof(IUnknown*) : static_cast<UINT>(item.bytes.size());
  const UINT room = *size;
  *size = needed;
  if (data == nullptr) return S_OK;
  if (room < needed) return DXGI_ERROR_MORE_DATA;
  if (item.object) {
    IUnknown* object = item.object.Get();
    object->AddRef();
    std::memcpy(data, &object, sizeof(object));
  } else {
    std::memcpy(data, item.bytes.data(), needed);
  }
  return S_OK;
}

HRESULT PrivateData::set(REFGUID guid, UINT size, const void* data) {
  Item item;
  if (data != nullptr) {
    const auto* bytes = static_cast<const std::byte*>(data);
    item.bytes.assign(bytes, bytes + size);
  }
  decltype(items_)::node_type dropped;  // released without the lock: it may ask its owner
  std::lock_guard lock(mutex_);
  if (data == nullptr) {
    dropped = items_.extract(guid);
    return !dropped.empty() ? S_OK : S_FALSE;
  }
  std::swap(items_[guid], item);
  return S_OK;
}

HRESULT PrivateData::set(REFGUID guid, const IUnknown* object) {
  if (object == nullptr) return set(guid, 0, nullptr);
  Item item;
  item.object =
      const_cast<IUnknown*>(object);  // NOLINT: the call's parameter is const, a reference is taken
  std::lock_guard lock(mutex_);
  std::swap(items_[guid], item);
  return S_OK;
}

std::string PrivateData::name() const {
  std::lock_guard lock(mutex_);
  if (const auto wide = items_.find(WKPDID_D3DDebugObjectNameW); wide != items_.end()) {
    const std::vector<std::byte>& bytes = wide->second.bytes;
    std::wstring text(bytes.size() / sizeof(wchar_t), L'\0');
    std::memcpy(text.data(), bytes.data(), text.size() * sizeof(wchar_t));
    return to_utf8(std::wstring_view(text).substr(0, text.find(L'\0')));
  }
  const auto narrow = items_.find(WKPDID_D3DDebugObjectName);
  if (narrow == items_.end()) return {};
  const std::vector<std::byte>& bytes = narrow->second.bytes;
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return text.substr(0, text.find('\0'));  // programs count the zero, or not
}

}  // namespace kaamos::d3d12
