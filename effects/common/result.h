// SPDX-License-Identifier: MIT
// Success, a value, or an error text. The effects library lets no exception out and never prints;
// the caller decides what to do with the text.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace kaamos::effects {

/// Outcome of an operation without a value. An empty text is success.
class [[nodiscard]] Status {
 public:
  Status() = default;
  /// `text` says what failed, where, actual against allowed, and what to do. Never empty.
  static Status failure(std::string text) {
    assert(!text.empty());
    Status status;
    status.error_ = std::move(text);
    return status;
  }
  bool ok() const { return error_.empty(); }
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

/// A value or an error text.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status failed) : status_(std::move(failed)) { assert(!status_.ok()); }

  bool ok() const { return value_.has_value(); }
  const std::string& error() const { return status_.error(); }
  /// Only when ok().
  T& value() {
    assert(ok());
    return *value_;
  }
  const T& value() const {
    assert(ok());
    return *value_;
  }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace kaamos::effects
