// SPDX-License-Identifier: MIT
//
// Renders a whole frame through the effects' libraries and reads back every picture, for tests to
// compare.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/image/image.h"
#include "effects/assets/scene/scene.h"
#include "effects/denoise/denoise.h"
#include "effects/glass/transparent/transparent.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"

namespace kaamos::test {

enum RigEffect : std::uint32_t {
  kRigAo = 1,
  kRigSun = 2,
  kRigLocal = 4,    // main lighting; with kRigContact, all but the two strongest lights
  kRigContact = 8,  // needs kRigLocal
  kRigIndirect = 16,
  kRigReflections = 32,
  kRigGlass = 64,
  kRigAll = 127,
};

struct RigOptions {
  std::string backend = "embree";
  std::uint32_t effects = kRigAll;
  std::uint32_t width = 48;
  std::uint32_t height = 27;
  std::uint32_t samples = 4;  // for every effect except glass
  std::uint32_t seed = 1;
  std::uint32_t threads = 0;
  std::uint32_t rows = 0;  // rows per dispatch; 0: all
  float ao_radius = 2.0f;  // metres
  effects::ContactShadowConstants contact;
  effects::IndirectConstants indirect;
  effects::ReflectionConstants reflection;
  effects::TransparentConstants glass;
  float cell = 1.0f;  // cell size of the volume in metres
  std::uint32_t bake_samples = 4;
  std::optional<effects::IndirectVolume> volume;  // used instead of baking one
  effects::DenoiseMethod denoise = effects::DenoiseMethod::kSvgf;
};

// Pictures by name: ids, view_z, normal, position, motion, radiance; for each rendered effect ao,
// sun, contact, indirect, reflection (means over the samples), NAME_denoised, direct, local, glass,
// transmittance; and the fourth channels of the colours among them: indirect_length,
// reflection_length, glass_depth, glass_layers.
using Pictures = std::map<std::string, effects::FloatImage>;

// Renders one frame. Throws rtapi::ResultError.
Pictures render(const effects::Scene& scene, const RigOptions& options);

// Renders frames of one geometry with the camera at rest. Each frame takes lights, sun and sky from
// its own scene and everything else from the first one.
std::vector<Pictures> render_frames(std::span<const effects::Scene> scenes,
                                    const RigOptions& options);

}  // namespace kaamos::test
