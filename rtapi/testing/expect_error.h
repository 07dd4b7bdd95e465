// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include <rtapi/result.h>

namespace rtapi::testing {

inline std::string IdOf(const Status& s) {
  return s.ok() ? "ok" : s.error().id.text();
}
template <class T>
std::string IdOf(const Result<T>& r) {
  return r.ok() ? "ok" : r.error().id.text();
}
inline std::string MessageOf(const Status& s) {
  return s.ok() ? "ok" : s.error().message;
}
template <class T>
std::string MessageOf(const Result<T>& r) {
  return r.ok() ? "ok" : r.error().message;
}

}  // namespace rtapi::testing

// Expects this id, a message that begins with it, and every further text in the message.
#define EXPECT_ERROR(expression, expected_id, ...)                                          \
  do {                                                                                      \
    const auto& result_of_call = (expression);                                              \
    EXPECT_EQ(::rtapi::testing::IdOf(result_of_call), expected_id)                          \
        << ::rtapi::testing::MessageOf(result_of_call);                                     \
    for (const std::string& part :                                                          \
         std::initializer_list<std::string>{expected_id, ##__VA_ARGS__}) {                  \
      EXPECT_THAT(::rtapi::testing::MessageOf(result_of_call), ::testing::HasSubstr(part)); \
    }                                                                                       \
  } while (false)
#define EXPECT_OK(expression)                                     \
  do {                                                            \
    const auto& result_of_call = (expression);                    \
    EXPECT_EQ(::rtapi::testing::MessageOf(result_of_call), "ok"); \
  } while (false)
