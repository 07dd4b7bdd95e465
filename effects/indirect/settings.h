// SPDX-License-Identifier: MIT
/// @file
/// Describes the constants of indirect light's techniques.
#pragma once

#include "effects/engine/setting.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/occluded_volume.h"

namespace kaamos::effects {

/// By the name of the constants' struct.
///@{
SettingTable<IndirectConstants> indirect_settings();
SettingTable<OccludedVolumeSettings> occluded_volume_settings();
///@}

}  // namespace kaamos::effects
