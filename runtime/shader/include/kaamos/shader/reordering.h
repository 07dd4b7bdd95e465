// SPDX-License-Identifier: MIT
//
// What MaybeReorderThread of a hit object asks for in checked libraries: Services::record_constant
// at this offset, which is none of a record, looks the object's record up and notes one that its
// table does not have. [DXR: MaybeReorderThread]
#pragma once

#include <cstdint>

namespace kaamos::shader {

inline constexpr uint32_t kReorderedRecord = 0xFFFFFFFFu;

}  // namespace kaamos::shader
