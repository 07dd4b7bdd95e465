// SPDX-License-Identifier: MIT
//
// A whole frame through the effects' libraries, every picture of it read back: what tests compare.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "effects/contact_shadow/contact_shadow.h"
#include "effects/denoise/denoise.h"
#include "effects/image/image.h"
#include "effects/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect_diffuse/volume.h"
#include "effects/reflections/reflections.h"
#include "effects/scene/scene.h"
#include "effects/transparent/transparent.h"

namespace kaamos::test {

enum RigEffect : std::uint32_t {
  kRigAo = 1,
  kRigSun = 2,
  kRigLocal = 4,    // main lighting; with kRigContact all but the strongest two lights
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
  std::uint32_t samples = 4;  // of every effect but glass
  std::uint32_t seed = 1;
  std::uint32_t threads = 0;
  std::uint32_t rows = 0;  // of a dispatch; 0: all
  float ao_radius = 2.0f;  // metres
  effects::ContactShadowConstants contact;
  effects::IndirectConstants indirect;
  effects::ReflectionConstants reflection;
  effects::TransparentConstants glass;
  float cell = 1.0f;  // metres, of the volume
  std::uint32_t bake_samples = 4;
  std::optional<effects::IndirectVolume> volume;  // instead of one that is baked
  effects::DenoiseMethod denoise = effects::DenoiseMethod::kSvgf;
};

// By name: ids, view_z, normal, position, motion, radiance; of the effects that were rendered ao,
// sun, contact, indirect, reflection (means over the samples), NAME_denoised, direct, local, glass,
// transmittance, and what those that are colours hold beside them: indirect_length,
// reflection_length, glass_depth, glass_layers.
using Pictures = std::map<std::string, effects::FloatImage>;

// One frame. Throws rtapi::ResultError.
Pictures render(const effects::Scene& scene, const RigOptions& options);

// Frames of one geometry, the camera at rest: each takes lights, sun and sky of its own scene, all
// else of the first one.
std::vector<Pictures> render_frames(std::span<const effects::Scene> scenes,
                                    const RigOptions& options);

}  // namespace kaamos::test
