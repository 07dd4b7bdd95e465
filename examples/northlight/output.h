// SPDX-License-Identifier: MIT
// The files of a finished frame.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/staged_files.h"
#include "layers.h"
#include "options.h"

namespace northlight {

// Writes frame.png, frame.exr, a PNG for each of the layers and stats.json into options.out. Either
// writes all of them or touches none; returns an error text, empty on success.
std::string write_results(const Options& options, const kaamos::effects::Scene& scene,
                          const kaamos::effects::FrameRenderer& renderer, const FrameResult& result,
                          const WrittenLayers& written);
// Adds the same to `files`, which may hold others; `sequence` becomes a part of stats.json.
std::string add_results(const Options& options, const kaamos::effects::Scene& scene,
                        const kaamos::effects::FrameRenderer& renderer, const FrameResult& result,
                        const WrittenLayers& written, const nlohmann::ordered_json& sequence,
                        StagedFiles& files);
// The picture in frame.png.
kaamos::effects::ByteImage frame_picture(const kaamos::effects::FloatImage& radiance,
                                         float exposure);

// Names these files.
std::string describe_files(const Options& options, const kaamos::effects::FrameRenderer& renderer,
                           const WrittenLayers& written);
// Each layer's value at a pixel, one per line.
std::string describe_pixel(const FrameResult& result, std::uint32_t x, std::uint32_t y);

// One line for each device of each backend; its first word is the value for --backend.
std::string list_devices();

// The table printed at the end.
std::string describe(const kaamos::effects::FrameRenderer& renderer, const FrameResult& result);

// Says how drawn surfaces differ from what rays see, and what both took; empty where rays found
// them.
std::string describe_primary(const FrameResult& result);

}  // namespace northlight
