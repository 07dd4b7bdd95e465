// SPDX-License-Identifier: MIT
//
// Every error and warning of the backends and of what they share: one id, one row of errors.inc.
#pragma once

#include <cstdint>
#include <string>

#include <kaamos/shader/abi.h>
#include <rtapi/message.h>
#include <rtapi/result.h>

#include "runtime/errors/message_table.h"

namespace kaamos::runtime {

// The number in KAnnnn.
enum class Id : uint16_t {
#define KAAMOS_MESSAGE(number, name, ...) name = number,
#include "runtime/backend/errors.inc"
#undef KAAMOS_MESSAGE
};

using errors::public_id;

// "KA0790 title: detail". `detail` says what, where, the actual and the allowed value, what to do.
rtapi::Error make_error(Id id, const std::string& detail);

inline constexpr char kMultisampledUse[] = "it used a RWTexture2DMS or RWTexture2DMSArray";
// Returns the id for the reason that ended a dispatch.
Id removal_id(shader::RemovalReason reason);
// With a code that the row cannot know.
rtapi::Error make_error(Id id, rtapi::ErrorCode code, const std::string& detail);
// The same text for Context::message.
rtapi::Message make_message(Id id, const std::string& detail);

}  // namespace kaamos::runtime
