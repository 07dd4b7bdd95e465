// SPDX-License-Identifier: MIT
/// @file
/// Describes the constants of reflections' techniques.
#pragma once

#include "effects/engine/setting.h"
#include "effects/reflections/blurred/blurred_reflections.h"
#include "effects/reflections/environment_map/environment_map.h"
#include "effects/reflections/hybrid/hybrid_reflections.h"
#include "effects/reflections/planar/planar_reflections.h"
#include "effects/reflections/screen_space/screen_mask.h"
#include "effects/reflections/screen_space/screen_reflections.h"
#include "effects/reflections/stochastic/stochastic_reflections.h"
#include "effects/reflections/tiled/tiled_reflections.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::effects {

/// By the name of the constants' struct.
///@{
SettingTable<ReflectionConstants> reflection_settings();
SettingTable<ScreenReflectionConstants> screen_reflection_settings();
SettingTable<ScreenMaskConstants> screen_mask_settings();
SettingTable<StochasticConstants> stochastic_settings();
SettingTable<BlurredConstants> blurred_settings();
SettingTable<HybridConstants> hybrid_settings();
SettingTable<TiledConstants> tiled_settings();
SettingTable<PlanarConstants> planar_settings();
SettingTable<EnvironmentConstants> environment_settings();
///@}

}  // namespace kaamos::effects
