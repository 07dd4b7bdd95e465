// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <rtapi/command_signature.h>

#include "rtapi/src/device/device_impl.h"
#include "runtime/backend/commands.h"

namespace rtapi::detail {

struct CommandSignatureImpl {
  std::shared_ptr<DeviceImpl> device;
  CommandSignatureDesc desc;
  RootSignature root_signature;  // empty: no argument sets a root argument
  std::shared_ptr<const runtime::IndirectLayout> layout;
};

}  // namespace rtapi::detail
