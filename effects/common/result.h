// SPDX-License-Identifier: MIT
/// @file
/// Success, a value, or an error text. The effects library lets no exception out and never prints;
/// the caller decides what to do with the text.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

/// Northlight's effects on rtapi: scenes, pictures, passes. Start at Scene and Frame.
namespace kaamos::effects {

/// Outcome of an operation without a value. An empty text is success.
class [[nodiscard]] Status {
 public:
  /// Success.
  Status() = default;
  /// `text` says what failed, where, actual against allowed, and what to do. Never empty.
  static Status failure(std::string text) {
    assert(!text.empty());
    Status status;
    status.error_ = std::move(text);
    return status;
  }
  /// True on success.
  bool ok() const { return error_.empty(); }
  /// The text; empty on success.
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

/// A value or an error text.
template <class T>
class [[nodiscard]] Result {
 public:
  /// Success with a value. Implicit, so that functions return either.
  Result(T value) : value_(std::move(value)) {}
  /// Failure with the text of `failed`, which must be one.
  Result(Status failed) : status_(std::move(failed)) { assert(!status_.ok()); }

  /// True if there is a value.
  bool ok() const { return value_.has_value(); }
  /// The text; empty if there is a value.
  const std::string& error() const { return status_.error(); }
  /// The value. Precondition: ok(), which is asserted.
  ///@{
  T& value() {
    assert(ok());
    return *value_;
  }
  const T& value() const {
    assert(ok());
    return *value_;
  }
  ///@}

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace kaamos::effects
