// SPDX-License-Identifier: MIT
// Options that set several described settings at once, or by another unit.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options.h"

namespace northlight {

// What was given; nothing else is changed.
struct Shorthands {
  std::optional<float> ao_radius;
  std::string radius;              // its text
  std::optional<float> sun_angle;  // the whole disk, degrees
  std::optional<std::uint32_t> denoise_passes;
  std::vector<std::string> half_resolution;
  bool rotate_pixels = false;
  std::vector<std::string> bake_lights;
  std::string texture_lod;
  std::string sun_at_hits;
  bool curvature_roughness = false;
  std::optional<std::uint32_t> opacity_micromaps;
  std::optional<std::uint32_t> glass_layers;
};

void add_shorthands(CLI::App& app, Options& options, Shorthands& words);
void apply_shorthands(const Shorthands& words, Options& options);
// --denoise-passes, once the denoiser is known.
void apply_passes(const Shorthands& words, Options& options);

}  // namespace northlight
