// SPDX-License-Identifier: MIT
//
// The identifier by which a device recognizes serialized acceleration structures that it can read.
// All backends share the format, so they share the identifier.
// [runtime/structures/serialized_structure.h]
#pragma once

#include <cstring>

#include <rtapi/raytracing.h>

namespace kaamos::runtime {

// Must go up with every change of the format.
inline constexpr uint32_t kSerializedVersion = 3;

inline rtapi::SerializedDataDriverMatchingIdentifier serialized_identifier() {
  rtapi::SerializedDataDriverMatchingIdentifier identifier;
  identifier.DriverOpaqueGUID = {
      0x7D4E1B52, 0x09C6, 0x4F3A, {0xA1, 0x5C, 0x4B, 0x41, 0x41, 0x4D, 0x4F, 0x53}};
  std::memcpy(identifier.DriverOpaqueVersioningData, &kSerializedVersion,
              sizeof(kSerializedVersion));
  return identifier;
}

// [DXR: CheckDriverMatchingIdentifier]
inline rtapi::DriverMatchingIdentifierStatus check_identifier(
    rtapi::SerializedDataType type,
    const rtapi::SerializedDataDriverMatchingIdentifier& identifier) {
  using Status = rtapi::DriverMatchingIdentifierStatus;
  const auto own = serialized_identifier();
  if (type != rtapi::SerializedDataType::kRaytracingAccelerationStructure) {
    return Status::kUnsupportedType;
  }
  if (identifier.DriverOpaqueGUID != own.DriverOpaqueGUID) return Status::kUnrecognized;
  const bool same =
      std::memcmp(identifier.DriverOpaqueVersioningData, own.DriverOpaqueVersioningData,
                  sizeof(own.DriverOpaqueVersioningData)) == 0;
  return same ? Status::kCompatibleWithDevice : Status::kIncompatibleVersion;
}

}  // namespace kaamos::runtime
