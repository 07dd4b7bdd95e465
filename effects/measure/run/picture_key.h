// SPDX-License-Identifier: MIT
// Keys of what is kept in files: made from the settings themselves, so that a new one cannot be
// forgotten.
#pragma once

#include <string>

#include "effects/assets/common/checksum.h"
#include "effects/assets/scene/scene.h"
#include "effects/measure/run/options.h"

namespace kaamos::measure {

// Adds all that an effect's picture depends on besides its frame.
void add_settings(effects::Checksum& checksum, const effects::EffectSettings& settings);

// Names a picture of the frame that the options describe by all that it depends on: the scene
// itself, the frame's settings, those of every effect, the device and, since it holds the shaders,
// the program. 16 hexadecimal digits.
std::string picture_key(const Options& options, const effects::Scene& scene);
// Names a volume of indirect light in the same way. The backends share it: they differ by rounding.
std::string volume_key(const Options& options, const effects::Scene& scene);

// The digits of a checksum.
std::string as_key(const effects::Checksum& checksum);

}  // namespace kaamos::measure
