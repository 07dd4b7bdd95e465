// SPDX-License-Identifier: MIT
//
// Every error that rtapi reports: one id, one row. The ids are stable; messages begin with them.
#pragma once

#include <cstdint>
#include <span>
#include <sstream>
#include <string>

#include <rtapi/result.h>

namespace rtapi::detail {

// The number in KAnnnn.
enum class Id : uint16_t {
#define KAAMOS_RTAPI_ERROR(number, name, code, title, rule, cure) name = number,
#define KAAMOS_RTAPI_WARNING(number, name, title, rule, cure) name = number,
#include "rtapi/src/errors/errors.inc"
#undef KAAMOS_RTAPI_WARNING
#undef KAAMOS_RTAPI_ERROR
};

constexpr ErrorId PublicId(Id id) {
  return ErrorId{static_cast<uint16_t>(id)};
}

struct ErrorEntry {
  Id id;
  ErrorCode code;
  const char* title;   // what a message says after the id
  const char* source;  // the rule: a conformance item or a D3D12 topic
  const char* cure;
};

// Sorted by id.
std::span<const ErrorEntry> ErrorTable();

template <class... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

std::string Quoted(std::string_view name);  // "\"name\""
std::string Hex(uint64_t value);            // "0x1f"

// "KA0504 <title>: <detail>"
Error MakeError(Id id, const std::string& detail);

template <class... Parts>
Error MakeError(Id id, const Parts&... parts) {
  return MakeError(id, Text(parts...));
}

}  // namespace rtapi::detail
