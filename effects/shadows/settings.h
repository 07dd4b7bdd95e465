// SPDX-License-Identifier: MIT
/// @file
/// Describes the constants of shadows' techniques.
#pragma once

#include "effects/engine/setting.h"
#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/edge_shadow/edge_shadow.h"
#include "effects/shadows/filtered_shadow_map/filtered_shadow_map.h"
#include "effects/shadows/glass_shadow/glass_shadow.h"
#include "effects/shadows/glass_shadow/glass_shadow_map.h"
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"
#include "effects/shadows/lamp_shadow/lamp_shadow.h"
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

/// Those of a map that count for a technique of the sun's shadow.
///@{
SettingTable<ShadowMapConstants> shadow_map_settings(ShadowMapMethod method);
SettingTable<HybridShadowConstants> hybrid_shadow_settings();
SettingTable<EdgeShadowConstants> edge_shadow_settings();
SettingTable<GlassShadowMapConstants> glass_shadow_map_settings();
SettingTable<FilteredShadowMapConstants> filtered_shadow_map_settings(
    FilteredShadowMapMethod method);
///@}

/// By the name of the constants' struct.
///@{
SettingTable<ContactShadowConstants> contact_shadow_settings();
SettingTable<GlassShadowConstants> glass_shadow_settings();
SettingTable<LampShadowConstants> lamp_shadow_settings(LampShadow method);
SettingTable<ScreenSpaceShadowConstants> screen_space_shadow_settings();
SettingTable<AdaptiveShadowConstants> adaptive_shadow_settings();
///@}

}  // namespace kaamos::effects
