// SPDX-License-Identifier: MIT
//
// The common part of the tables of messages. A layer's table is an .inc file of rows, each
//   KAAMOS_MESSAGE(number, name, severity, code, title, rule, cure)
// sorted by number. Including it with
//   #define KAAMOS_MESSAGE(number, name, ...) name = number,
// inside an enumeration gives the layer's ids, and with KAAMOS_MESSAGE_ROW inside an array of
// MessageRow its table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include <rtapi/message.h>
#include <rtapi/result.h>

namespace kaamos::errors {

struct MessageRow {
  uint16_t number;  // in KAnnnn
  rtapi::MessageSeverity severity;
  rtapi::ErrorCode code;  // of an rtapi::Error; kFailed where the layer makes none of it
  const char* title;      // what a message says after the id
  const char* rule;       // items of the conformance list, or whose rule it is; "" without
  const char* cure;
};

#define KAAMOS_MESSAGE_ROW(number, name, severity, code, title, rule, cure) \
  {number, rtapi::MessageSeverity::severity, rtapi::ErrorCode::code, title, rule, cure},

// Sorted by number.
using MessageTable = std::span<const MessageRow>;

// The number of a layer's id.
template <class Id>
constexpr rtapi::ErrorId public_id(Id id) {
  static_assert(std::is_enum_v<Id>);
  return {static_cast<uint16_t>(id)};
}

// Null if the table has no such id.
const MessageRow* find_row(MessageTable table, rtapi::ErrorId id);
// Precondition: the table has the id.
const MessageRow& row_of(MessageTable table, rtapi::ErrorId id);

// Returns the beginning of a message of the row: "KA0504 title: ".
std::string head_of(const MessageRow& row);

// "KA0504 title: detail". `detail` says what, where, the actual and the allowed value, what to do.
rtapi::Error make_error(MessageTable table, rtapi::ErrorId id, const std::string& detail);
// The same text as a message of the row's severity.
rtapi::Message make_message(MessageTable table, rtapi::ErrorId id, const std::string& detail);

}  // namespace kaamos::errors
