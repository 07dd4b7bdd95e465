// SPDX-License-Identifier: MIT
// The scenes made by code, by the names that programs accept.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "effects/scene/scene.h"

namespace kaamos::effects {

struct BuiltInScene {
  const char* name;
  Scene (*make)();
};

std::span<const BuiltInScene> built_in_scenes();
/// Null where no scene has the name.
const BuiltInScene* find_built_in_scene(std::string_view name);
/// "lounge, glass-stack, ...", for help and errors.
std::string built_in_scene_names();

}  // namespace kaamos::effects
