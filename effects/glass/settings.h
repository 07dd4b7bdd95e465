// SPDX-License-Identifier: MIT
/// @file
/// Describes the constants of glass.
#pragma once

#include "effects/engine/setting.h"
#include "effects/glass/drawn_glass/drawn_glass.h"
#include "effects/glass/transparent/transparent.h"

namespace kaamos::effects {

/// By the name of the constants' struct.
///@{
SettingTable<TransparentConstants> transparent_settings();
SettingTable<DrawnGlassConstants> drawn_glass_settings();
///@}

}  // namespace kaamos::effects
