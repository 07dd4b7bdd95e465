// SPDX-License-Identifier: MIT
// COM objects: identity, reference counts, and which interfaces an object has.
#pragma once

#include <atomic>
#include <utility>

#include <directx/d3d12.h>
#include <directx/dxcore_interface.h>
#include <dxcapi.h>
#include <dxgi1_6.h>
#include <dxgidebug.h>
#include <kaamos_adapter.h>

#include "d3d12/com/report.h"
#include "d3d12/generated/d3d12_entries.h"

namespace kaamos::d3d12 {

inline constexpr GUID kIUnknown = {0, 0, 0, {0xC0, 0, 0, 0, 0, 0, 0, 0x46}};

/// An object with the interfaces of all of `Entries`, generated classes or classes that derive from
/// them. It is born with one reference. Any version of an interface leads to the object, and all of
/// them to the same IUnknown. [COM: QueryInterface rules]
template <class First, class... Rest>
class ComObject : public First, public Rest... {
 public:
  ComObject() = default;
  template <class... Arguments>
  explicit ComObject(std::in_place_t, Arguments&&... arguments)
      : First(std::forward<Arguments>(arguments)...) {}
  ComObject(const ComObject&) = delete;
  ComObject& operator=(const ComObject&) = delete;

  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID riid, void** object) override {
    if (object == nullptr) return E_POINTER;
    void* found = nullptr;
    if (riid == kIUnknown) {
      found = static_cast<IUnknown*>(static_cast<First*>(this));
    } else if (offers(riid)) {
      found = find<First>(riid);
      ((found = found != nullptr ? found : find<Rest>(riid)), ...);
    }
    *object = found;
    if (found == nullptr) return E_NOINTERFACE;
    AddRef();
    return S_OK;
  }

  /// An object that this library holds gets references again after its last one.
  ULONG STDMETHODCALLTYPE AddRef() override {
    const ULONG before = references_.fetch_add(1, std::memory_order_relaxed);
    if (before == 0) retain();
    return before + 1;
  }

  ULONG STDMETHODCALLTYPE Release() override {
    const ULONG left = references_.fetch_sub(1, std::memory_order_acq_rel) - 1;
    if (left == 0) let_go();
    return left;
  }

  /// What this library's own objects hold does not count as a reference: programs compare what
  /// AddRef and Release return.
  ///@{
  void retain() { holds_.fetch_add(1, std::memory_order_relaxed); }
  void let_go() {
    if (holds_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
  }
  ///@}

 protected:
  virtual ~ComObject() = default;
  ULONG references() const { return references_.load(std::memory_order_relaxed); }
  /// False hides an interface: that of the debug layer where it is off.
  virtual bool offers(REFIID) const { return true; }

  /// The reporter that gets the object's messages; those of a device and of its objects to that
  /// device's.
  Reporter& reporter() const override { return process_reporter(); }
  /// As the reporter's.
  ///@{
  void report(D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) const {
    reporter().report(severity, error);
  }
  HRESULT fail(const rtapi::Error& error) const { return reporter().fail(error); }
  HRESULT fail(ErrorId id, const std::string& detail) const { return reporter().fail(id, detail); }
  HRESULT check(const rtapi::Status& status) const { return reporter().check(status); }
  ///@}

 private:
  // Versions derive from each other, so that the newest one serves for all.
  template <class Entries>
  void* find(REFIID riid) {
    for (const InterfaceId& id : Entries::kInterfaces) {
      if (riid == id.guid) return static_cast<Entries*>(this);
    }
    return nullptr;
  }

  std::atomic<ULONG> references_{1};
  std::atomic<ULONG> holds_{1};  // one of them for all references
};

/// Keeps an object of this library alive without a reference, see ComObject::retain.
template <class Object>
class Held {
 public:
  Held() = default;
  explicit Held(Object* object) : object_(object) {
    if (object_ != nullptr) object_->retain();
  }
  Held(const Held& other) : Held(other.object_) {}
  Held& operator=(Held other) {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Held() {
    if (object_ != nullptr) object_->let_go();
  }
  explicit operator bool() const { return object_ != nullptr; }
  Object* operator->() const { return object_; }

 private:
  Object* object_ = nullptr;
};

/// Hands a new object to the caller as the interface asked for. The object is freed if it does not
/// have that interface, or if the caller only asked whether it could be made (S_FALSE).
template <class Object>
HRESULT hand_out(Object* made, REFIID riid, void** object) {
  HRESULT result = S_FALSE;
  if (object != nullptr) result = made->QueryInterface(riid, object);
  made->Release();
  return result;
}

}  // namespace kaamos::d3d12
