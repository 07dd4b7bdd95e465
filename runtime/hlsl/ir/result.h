// SPDX-License-Identifier: MIT
//
// How functions of the compiler return what can fail.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace kaamos::hlsl {

// Why there is no result: what, which, and what to do.
struct Failure {
  std::string text;
};

// A T, or why there is none. Test it as a condition, then use `*result` or error().
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}            // NOLINT: implicit
  Result(Failure failure) : state_(std::move(failure)) {}  // NOLINT: implicit

  explicit operator bool() const { return state_.index() == 0; }

  // Precondition: there is a value.
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }

  // "" where there is a value.
  std::string error() const {
    const Failure* failure = std::get_if<1>(&state_);
    return failure != nullptr ? failure->text : std::string();
  }

 private:
  std::variant<T, Failure> state_;
};

}  // namespace kaamos::hlsl
