// SPDX-License-Identifier: MIT
/// @file
/// Describes the numbers of antialiasing and enlarging.
#pragma once

#include "effects/composition/enlarge/enlarge.h"
#include "effects/composition/taa/taa.h"
#include "effects/engine/setting.h"

namespace kaamos::effects {

/// TaaConstants.
SettingTable<TaaConstants> taa_settings();
/// EnlargeConstants.
SettingTable<EnlargeConstants> enlarge_settings();

}  // namespace kaamos::effects
