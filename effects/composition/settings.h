// SPDX-License-Identifier: MIT
/// @file
/// Describes the numbers of antialiasing.
#pragma once

#include "effects/composition/taa/taa.h"
#include "effects/engine/setting.h"

namespace kaamos::effects {

/// TaaConstants.
SettingTable<TaaConstants> taa_settings();

}  // namespace kaamos::effects
