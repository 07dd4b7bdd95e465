// SPDX-License-Identifier: MIT
/// @file
/// Files of settings: JSON, an object for each topic of described_settings.h with a member for each
/// setting.
#pragma once

#include <string>

#include "effects/northlight/described_settings.h"

namespace kaamos::effects {

/// All settings with their values. Infinity is the string "inf".
std::string write_settings(const FrameSettings& frame, const SettingsOfEffects& chosen,
                           const std::vector<Effect>& effects = northlight_effects());

/// Takes over those that the text has; others stay. `where`: the file's name, for messages. On an
/// error nothing is changed.
/// @errors KA3049 no JSON object; a topic or setting that is unknown, with the nearest one there
/// is; a value of another type or out of range.
rtapi::Status read_settings(const std::string& text, const std::string& where, FrameSettings& frame,
                            SettingsOfEffects& chosen,
                            const std::vector<Effect>& effects = northlight_effects());

/// Sets one of `settings` by its full name ("gtao-slices") to a value as command lines have it.
/// @errors KA3049 there is none of that name, with the nearest one there is; another value than
/// those allowed.
rtapi::Status set_setting(const std::vector<DescribedSetting>& settings, const std::string& name,
                          const std::string& value, FrameSettings& frame,
                          SettingsOfEffects& chosen);

}  // namespace kaamos::effects
