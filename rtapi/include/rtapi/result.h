// SPDX-License-Identifier: MIT
//
// How calls report failure: a Result<T> or a Status, never an exception out of the library.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace rtapi {

// The HRESULT family a D3D12 program would have seen.
enum class ErrorCode : uint32_t {
  kInvalidArgument,  // E_INVALIDARG
  kInvalidCall,      // DXGI_ERROR_INVALID_CALL
  kOutOfMemory,      // E_OUTOFMEMORY
  kUnsupported,      // DXGI_ERROR_UNSUPPORTED
  kNotFound,         // DXGI_ERROR_NOT_FOUND
  kDeviceRemoved,    // DXGI_ERROR_DEVICE_REMOVED
  kFailed,           // E_FAIL
};

// The number of an error or a message, KA0712 for 712. Numbers are stable; rtapi/ERRORS.md lists
// them with their meaning and their cure. Compare numbers, never texts.
struct ErrorId {
  uint16_t number = 0;

  // "KA0712"
  std::string text() const {
    std::string digits = std::to_string(number);
    return "KA" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
  }
  bool operator==(const ErrorId&) const = default;
};

// What went wrong. `message` begins with the id and says what, where, the actual and the allowed
// value, and what to do, e.g. "KA0712 vertex buffer misaligned: ...".
struct Error {
  ErrorId id;
  ErrorCode code = ErrorCode::kFailed;
  std::string message;
};

// Thrown by value() only, inside the caller's own code.
class ResultError : public std::runtime_error {
 public:
  explicit ResultError(Error error) : std::runtime_error(error.message), error_(std::move(error)) {}
  const Error& error() const { return error_; }

 private:
  Error error_;
};

// A T or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Precondition of the next five: ok().
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }

  // Precondition: !ok().
  const Error& error() const { return *std::get_if<1>(&state_); }

  // The value; throws ResultError if there is none. For programs whose only answer to an error is
  // to print it and stop.
  T& value() & {
    if (!ok()) throw ResultError(error());
    return **this;
  }
  T value() && {
    if (!ok()) throw ResultError(error());
    return std::move(**this);
  }

 private:
  std::variant<T, Error> state_;
};

// Success, or an Error.
class Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}  // NOLINT: implicit

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return *error_; }  // precondition: !ok()
  void value() const {                            // throws ResultError unless ok()
    if (error_) throw ResultError(*error_);
  }

 private:
  std::optional<Error> error_;
};

}  // namespace rtapi
