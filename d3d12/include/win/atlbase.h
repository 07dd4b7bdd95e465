// SPDX-License-Identifier: MIT
// ATL's pointers to COM objects. [MSVC: CComPtr Class, CComQIPtr Class]
#pragma once

#include <combaseapi.h>
#include <windows.h>

#ifndef ATLASSERT
#include <cassert>
#define ATLASSERT(condition) assert(condition)
#endif

namespace ATL {

/// Holds a reference to a COM object, or null.
template <class T>
class CComPtr {
 public:
  CComPtr() noexcept = default;
  CComPtr(std::nullptr_t) noexcept {}        // NOLINT: implicit, as ATL's
  CComPtr(T* object) noexcept : p(object) {  // NOLINT: implicit, as ATL's
    if (p != nullptr) p->AddRef();
  }
  CComPtr(const CComPtr& other) noexcept : CComPtr(other.p) {}
  CComPtr(CComPtr&& other) noexcept : p(other.Detach()) {}
  ~CComPtr() { Release(); }

  T* operator=(T* object) noexcept {
    CComPtr(object).Swap(*this);
    return p;
  }
  T* operator=(const CComPtr& other) noexcept { return *this = other.p; }
  T* operator=(CComPtr&& other) noexcept {
    CComPtr(static_cast<CComPtr&&>(other)).Swap(*this);
    return p;
  }
  /// Asks an object of another interface; null if it has no T.
  template <class U>
  T* operator=(const CComPtr<U>& other) noexcept {
    CComPtr asked;
    if (other.p != nullptr)
      other.p->QueryInterface(__uuidof(T), reinterpret_cast<void**>(&asked.p));
    asked.Swap(*this);
    return p;
  }

  operator T*() const noexcept { return p; }  // NOLINT: implicit, as ATL's
  T& operator*() const { return *p; }
  T* operator->() const noexcept {
    ATLASSERT(p != nullptr);
    return p;
  }
  /// For calls that return an object: the pointer is null before.
  T** operator&() noexcept {
    ATLASSERT(p == nullptr);
    return &p;
  }
  bool operator!() const noexcept { return p == nullptr; }

  void Release() noexcept {
    T* object = p;
    p = nullptr;
    if (object != nullptr) object->Release();
  }
  /// Takes a reference over from the caller.
  void Attach(T* object) noexcept {
    Release();
    p = object;
  }
  /// Gives the reference to the caller.
  T* Detach() noexcept {
    T* object = p;
    p = nullptr;
    return object;
  }
  HRESULT CopyTo(T** object) const noexcept {
    if (object == nullptr) return E_POINTER;
    *object = p;
    if (p != nullptr) p->AddRef();
    return S_OK;
  }
  template <class U>
  HRESULT QueryInterface(U** object) const noexcept {
    if (object == nullptr) return E_POINTER;
    return p->QueryInterface(__uuidof(U), reinterpret_cast<void**>(object));
  }
  bool IsEqualObject(IUnknown* other) const noexcept {
    CComPtr<IUnknown> mine, theirs;
    if (p != nullptr) QueryInterface(&mine);
    if (other != nullptr)
      other->QueryInterface(__uuidof(IUnknown), reinterpret_cast<void**>(&theirs));
    return mine.p == theirs.p;
  }
  void Swap(CComPtr& other) noexcept {
    T* object = p;
    p = other.p;
    other.p = object;
  }

  T* p = nullptr;
};

/// The same, and asks objects of other interfaces for T.
template <class T>
class CComQIPtr : public CComPtr<T> {
 public:
  using CComPtr<T>::CComPtr;
  using CComPtr<T>::operator=;
  CComQIPtr() noexcept = default;
  CComQIPtr(IUnknown* object) noexcept {  // NOLINT: implicit, as ATL's
    if (object != nullptr) object->QueryInterface(__uuidof(T), reinterpret_cast<void**>(&this->p));
  }
};

}  // namespace ATL

#ifndef _ATL_NO_AUTOMATIC_NAMESPACE
using namespace ATL;
#endif
