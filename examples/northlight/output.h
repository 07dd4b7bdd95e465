// SPDX-License-Identifier: MIT
// The files of a finished frame.
#pragma once

#include <cstdint>
#include <string>

#include "effects/scene/scene.h"
#include "options.h"
#include "renderer.h"

namespace northlight {

// Makes the folder and sees that files can be written there, before hours of rendering. The error
// text is empty on success.
std::string prepare_folder(const std::string& folder);

// Writes frame.png, frame.exr, a PNG for each layer and stats.json into options.out. Either all of
// them are written or none is touched; the error text is empty on success.
std::string write_results(const Options& options, const kaamos::effects::Scene& scene,
                          const Renderer& renderer, const FrameResult& result);

// What each layer holds at a pixel, a line for each.
std::string describe_pixel(const FrameResult& result, std::uint32_t x, std::uint32_t y);

// One line for each device of each backend; --backend takes the first word.
std::string list_devices();

// The table that a person sees at the end.
std::string describe(const Renderer& renderer, const FrameResult& result);

}  // namespace northlight
