// SPDX-License-Identifier: MIT
//
// Every error and warning of the backends and of what they share: one id, one row of errors.inc.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <kaamos/shader/abi.h>
#include <rtapi/device.h>
#include <rtapi/result.h>

namespace kaamos::runtime {

// The number in KAnnnn.
enum class Id : uint16_t {
#define KAAMOS_RUNTIME_MESSAGE(number, name, severity, code, title, rule, cure) name = number,
#include "runtime/backend/errors.inc"
#undef KAAMOS_RUNTIME_MESSAGE
};

constexpr rtapi::ErrorId public_id(Id id) {
  return rtapi::ErrorId{static_cast<uint16_t>(id)};
}

struct MessageEntry {
  Id id;
  rtapi::MessageSeverity severity;
  rtapi::ErrorCode code;  // of errors
  const char* title;      // what a message says after the id
  const char* rule;       // items of the conformance list; "" where DXR has no rule for it
  const char* cure;
};
// Sorted by id.
std::span<const MessageEntry> message_table();

// "KA0790 title: detail". `detail` says what, where, the actual and the allowed value, what to do.
rtapi::Error make_error(Id id, const std::string& detail);
// "0x1000": how messages write an address.
std::string hexadecimal(uint64_t address);

inline constexpr char kMultisampledUse[] = "it used a Texture2DMS or RWTexture2DMS";
// Returns the id for the reason that ended a dispatch.
Id removal_id(shader::RemovalReason reason);
// With a code that the row cannot know.
rtapi::Error make_error(Id id, rtapi::ErrorCode code, const std::string& detail);
// The same text for Context::message.
rtapi::Message make_message(Id id, const std::string& detail);

}  // namespace kaamos::runtime
