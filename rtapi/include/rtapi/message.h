// SPDX-License-Identifier: MIT
/// @file
/// The messages that a device gives without being asked, see DeviceDesc::OnMessage.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/result.h>

namespace rtapi {

/// The severity of a message.
enum class MessageSeverity : uint32_t { kInfo, kWarning, kError };

/// The message that DeviceDesc::OnMessage is given.
struct Message {
  MessageSeverity Severity = MessageSeverity::kError;  ///< how grave it is
  ErrorId Id;                                          ///< KA0715 is number 715
  std::string Text;                                    ///< begins with the id
};

}  // namespace rtapi
