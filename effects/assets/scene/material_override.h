// SPDX-License-Identifier: MIT
/// @file
/// Overrides materials of a file, for example because the glass of many scenes carries no alpha.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// The values of one material that are replaced.
struct MaterialOverride {
  std::string name;                                   ///< of the material
  std::vector<std::pair<std::string, float>> values;  ///< by key, in the order they were given
};

/// Reads NAME:KEY=VALUE[,KEY=VALUE...], as in "Glass:alpha=0.3,roughness=0". A name may hold
/// colons: the last one counts. Keys: alpha, roughness, metallic, red, green, blue (0..1), emission
/// (0 or more, of all colours), two_sided (0 or 1).
/// @errors KA3023 a missing part, an unknown key (the known ones are listed), a value that is no
/// number or out of range.
Result<MaterialOverride> parse_material_override(const std::string& text);

/// Glass is told from the rest by its instance: pieces of glass in meshes that have others, too,
/// become instances of their own.
void separate_glass(Scene& scene);

/// Replaces them in every material of that name. Alpha below 1 makes glass: the pieces of meshes
/// with that material become instances of their own, which rays tell apart; alpha 1 makes it
/// opaque.
/// @errors KA3023 no material has the name; those there are are listed.
Status override_material(Scene& scene, const MaterialOverride& change);

}  // namespace kaamos::effects
