// SPDX-License-Identifier: MIT
//
// Describes addresses, heap slots and descriptors in words.
#pragma once

#include <string>

#include <rtapi/table_description.h>

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

AddressDescription describe_where(const DeviceImpl& device, GpuVirtualAddress address);
DescriptorDescription describe_descriptor(const DeviceImpl& device,
                                          const shader::Descriptor& descriptor);

// For example "buffer \"x\" + 64 (416 bytes)", "address 0", "address 0x10 (in no live buffer)".
std::string ToText(const AddressDescription& address);
std::string ToText(const DescriptorDescription& descriptor);

}  // namespace rtapi::detail
