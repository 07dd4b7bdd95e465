// SPDX-License-Identifier: MIT
/// @file
/// The scenes made by code, by the names that programs accept.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// A scene made by code.
struct BuiltInScene {
  const char* name;  ///< what programs take: "lounge"
  Scene (*make)();   ///< makes it; the result passes validate()
};

/// All of them, in the order of their names in help. Valid for the whole run.
std::span<const BuiltInScene> built_in_scenes();
/// Some of them in other sizes, with other lights, or made otherwise: found by their names too.
std::span<const BuiltInScene> scene_variants();
/// Null where no scene and no variant has the name.
const BuiltInScene* find_built_in_scene(std::string_view name);
/// "lounge, glass-stack, ...", for help and errors.
std::string built_in_scene_names();

}  // namespace kaamos::effects
