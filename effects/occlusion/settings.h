// SPDX-License-Identifier: MIT
/// @file
/// Describes the constants of ambient occlusion's techniques.
#pragma once

#include "effects/engine/setting.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/occlusion/baked_ao/baked_ao.h"
#include "effects/occlusion/screen_space_ao/line_sweep_ao.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"

namespace kaamos::effects {

/// By the name of the constants' struct.
///@{
SettingTable<CrytekConstants> crytek_settings();
SettingTable<HemisphereConstants> hemisphere_settings();
SettingTable<HbaoConstants> hbao_settings();
SettingTable<GtaoConstants> gtao_settings();
SettingTable<LineSweepSettings> line_sweep_settings();
SettingTable<UniformOcclusionConstants> uniform_occlusion_settings();
SettingTable<BakedAoConstants> baked_ao_settings();
///@}

}  // namespace kaamos::effects
