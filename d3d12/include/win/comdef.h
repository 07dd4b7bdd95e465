// SPDX-License-Identifier: MIT
// _com_error, an HRESULT as an exception; _com_ptr_t, a pointer that throws it. [MSVC: comdef.h]
#pragma once

#include <combaseapi.h>
#include <kaamos_text.h>
#include <winbase.h>
#include <string>
#include <utility>

class _com_error {
 public:
  _com_error(HRESULT result) noexcept : result_(result) {}  // NOLINT: implicit, as MSVC's
  HRESULT Error() const noexcept { return result_; }
  /// "0x80004005", or the code's name.
  const TCHAR* ErrorMessage() const {
    if (text_.empty()) {
      TCHAR text[256] = {};
      const DWORD length =
          FormatMessage(FORMAT_MESSAGE_FROM_SYSTEM, nullptr, (DWORD)result_, 0, text, 256, nullptr);
      text_.assign(text, length);
    }
    return text_.c_str();
  }

 private:
  HRESULT result_;
  mutable std::basic_string<TCHAR> text_;
};

[[noreturn]] inline void _com_raise_error(HRESULT result) {
  throw _com_error(result);
}

/// The interface and the id of a _com_ptr_t.
template <class Interface>
struct kaamos_com_interface {
  typedef Interface InterfaceType;
  static const IID& GetIID() { return __uuidof(Interface); }
};

/// Holds a reference to a COM object, or null. An object of another interface is asked for this
/// one; null where it has none, as in MSVC, whose other failures throw _com_error.
template <class Id>
class _com_ptr_t {
 public:
  typedef typename Id::InterfaceType Interface;

  static const IID& GetIID() { return Id::GetIID(); }

  _com_ptr_t() noexcept = default;
  _com_ptr_t(std::nullptr_t) noexcept {}  // NOLINT: implicit, as MSVC's
  /// Null for 0 and false; _com_error of E_POINTER for other numbers, as MSVC's.
  _com_ptr_t(int null) {  // NOLINT: implicit, as MSVC's
    if (null != 0) _com_raise_error(E_POINTER);
  }
  _com_ptr_t(Interface* object) : object_(object) {  // NOLINT: implicit, as MSVC's
    if (object_ != nullptr) object_->AddRef();
  }
  _com_ptr_t(Interface* object, bool add_reference) : object_(object) {
    if (add_reference && object_ != nullptr) object_->AddRef();
  }
  _com_ptr_t(const _com_ptr_t& other) : _com_ptr_t(other.object_) {}
  _com_ptr_t(_com_ptr_t&& other) noexcept : object_(other.Detach()) {}
  template <class Other>
  _com_ptr_t(const _com_ptr_t<Other>& other) {  // NOLINT: implicit, as MSVC's
    ask(other.GetInterfacePtr());
  }
  ~_com_ptr_t() { reset(); }

  _com_ptr_t& operator=(_com_ptr_t other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }

  operator Interface*() const noexcept { return object_; }  // NOLINT: implicit, as MSVC's
  Interface& operator*() const {
    require();
    return *object_;
  }
  Interface* operator->() const {
    require();
    return object_;
  }
  /// For calls that return an object: what was held is released.
  Interface** operator&() noexcept {
    reset();
    return &object_;
  }
  bool operator!() const noexcept { return object_ == nullptr; }
  explicit operator bool() const noexcept { return object_ != nullptr; }

  Interface* GetInterfacePtr() const noexcept { return object_; }
  Interface*& GetInterfacePtr() noexcept { return object_; }
  /// Takes a reference over from the caller.
  void Attach(Interface* object) noexcept {
    reset();
    object_ = object;
  }
  void Attach(Interface* object, bool add_reference) { *this = _com_ptr_t(object, add_reference); }
  /// Gives the reference to the caller.
  Interface* Detach() noexcept { return std::exchange(object_, nullptr); }
  void AddRef() {
    require();
    object_->AddRef();
  }
  void Release() {
    require();
    reset();
  }
  template <class Other>
  HRESULT QueryInterface(const IID& id, Other*& other) {
    return object_ == nullptr ? E_POINTER
                              : object_->QueryInterface(id, reinterpret_cast<void**>(&other));
  }
  template <class Other>
  HRESULT QueryInterface(const IID& id, Other** other) {
    return QueryInterface(id, *other);
  }

 private:
  void reset() noexcept {
    if (Interface* object = Detach()) object->Release();
  }
  void require() const {
    if (object_ == nullptr) _com_raise_error(E_POINTER);
  }
  void ask(IUnknown* object) {
    if (object == nullptr) return;
    const HRESULT result = object->QueryInterface(GetIID(), reinterpret_cast<void**>(&object_));
    if (FAILED(result) && result != E_NOINTERFACE) _com_raise_error(result);
  }

  Interface* object_ = nullptr;
};

#define _COM_SMARTPTR _com_ptr_t
/// InterfacePtr, a _com_ptr_t of Interface.
#define _COM_SMARTPTR_TYPEDEF(Interface, id) \
  typedef _com_ptr_t<kaamos_com_interface<Interface>> Interface##Ptr
