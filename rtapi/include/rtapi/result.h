// SPDX-License-Identifier: MIT
/// @file
/// Calls report failure by a `Result<T>` or a Status. No exception leaves the library.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace rtapi {

/// The family of an error: the HRESULT that a D3D12 program would have seen.
enum class ErrorCode : uint32_t {
  kInvalidArgument,  ///< E_INVALIDARG
  kInvalidCall,      ///< DXGI_ERROR_INVALID_CALL
  kOutOfMemory,      ///< E_OUTOFMEMORY
  kUnsupported,      ///< DXGI_ERROR_UNSUPPORTED
  kNotFound,         ///< DXGI_ERROR_NOT_FOUND
  kDeviceRemoved,    ///< DXGI_ERROR_DEVICE_REMOVED
  kFailed,           ///< E_FAIL
};

/// The number of an error or a message, KA0712 for 712. Numbers are stable: one keeps its meaning
/// in later versions. rtapi/ERRORS.md lists them with their meaning and their cure, and
/// <rtapi/error_ids.h> has names for them. Compare ids, never texts.
struct ErrorId {
  uint16_t number = 0;  ///< 0 is no id

  /// The id as messages begin with it: "KA0712".
  std::string text() const {
    std::string digits = std::to_string(number);
    return "KA" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
  }
  /// True if the numbers are equal.
  bool operator==(const ErrorId&) const = default;
};

/// Describes what went wrong. Programs branch on the id or the code; the message is for people.
struct Error {
  ErrorId id;                           ///< which error it is
  ErrorCode code = ErrorCode::kFailed;  ///< the family of the id
  /// Begins with the id and says what, where, the actual and the allowed value, and what to do,
  /// e.g. "KA0712 vertex buffer misaligned: ...".
  std::string message;
};

/// The exception that value() throws, in the caller's own code; the library throws nothing else.
class ResultError : public std::runtime_error {
 public:
  /// what() is the error's message.
  explicit ResultError(Error error) : std::runtime_error(error.message), error_(std::move(error)) {}
  /// The error that the call had returned.
  const Error& error() const { return error_; }

 private:
  Error error_;
};

/// A T or an Error. Test it by ok() or as a condition, then use `*result` or error(); or call
/// value() where a program can only print the error and stop.
template <class T>
class [[nodiscard]] Result {
 public:
  /// A success with a value, or a failure with an error. Implicit, so that functions return either.
  ///@{
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit
  ///@}

  /// True if there is a value, false if there is an error.
  ///@{
  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  ///@}

  /// The value. Precondition: ok(), which is not checked.
  ///@{
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  ///@}

  /// The error. Precondition: !ok(), which is not checked.
  const Error& error() const { return *std::get_if<1>(&state_); }

  /// The value; throws ResultError if there is none. For programs whose only answer to an error is
  /// to print it and stop.
  ///@{
  T& value() & {
    if (!ok()) throw ResultError(error());
    return **this;
  }
  const T& value() const& {
    if (!ok()) throw ResultError(error());
    return **this;
  }
  T value() && {
    if (!ok()) throw ResultError(error());
    return std::move(**this);
  }
  ///@}

 private:
  std::variant<T, Error> state_;
};

/// Success, or an Error: the Result of a call that returns nothing.
class Status {
 public:
  /// Success.
  Status() = default;
  /// Failure. Implicit, so that functions return an Error as it is.
  Status(Error error) : error_(std::move(error)) {}  // NOLINT: implicit

  /// True on success.
  ///@{
  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  ///@}
  /// The error. Precondition: !ok(), which is not checked.
  const Error& error() const { return *error_; }
  /// Does nothing on success; throws ResultError otherwise.
  void value() const {
    if (error_) throw ResultError(*error_);
  }

 private:
  std::optional<Error> error_;
};

}  // namespace rtapi
