// SPDX-License-Identifier: MIT
/// @file
/// Describes the numbers of the denoisers.
#pragma once

#include "effects/denoise/denoise.h"
#include "effects/engine/setting.h"

namespace kaamos::effects {

/// A new method brings its own defaults along. [default_denoise]
SettingTable<DenoiseDesc> denoise_settings();
/// DenoiseDesc::visibility, which denoise_settings leaves out.
SettingTable<VisibilityConstants> visibility_settings();

}  // namespace kaamos::effects
