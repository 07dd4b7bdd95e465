// SPDX-License-Identifier: MIT
#include "rtapi/src/errors/error_table.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <iterator>

namespace rtapi::detail {

namespace {

constexpr ErrorEntry kTable[] = {
#define KAAMOS_RTAPI_ERROR(number, name, code, title, rule, cure) \
  {Id::name, ErrorCode::code, title, rule, cure},
#define KAAMOS_RTAPI_WARNING(number, name, title, rule, cure) \
  {Id::name, ErrorCode::kFailed, title, rule, cure},
#include "rtapi/src/errors/errors.inc"
#undef KAAMOS_RTAPI_WARNING
#undef KAAMOS_RTAPI_ERROR
};

}  // namespace

std::span<const ErrorEntry> ErrorTable() {
  return kTable;
}

std::string Quoted(std::string_view name) {
  return "\"" + std::string(name) + "\"";
}

std::string Hex(uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llx", static_cast<unsigned long long>(value));
  return text;
}

Error MakeError(Id id, const std::string& detail) {
  const auto* entry =
      std::lower_bound(std::begin(kTable), std::end(kTable), id,
                       [](const ErrorEntry& e, Id wanted) { return e.id < wanted; });
  assert(entry != std::end(kTable) && entry->id == id);
  const ErrorId number = PublicId(id);
  return {number, entry->code, Text(number.text(), " ", entry->title, ": ", detail)};
}

}  // namespace rtapi::detail
