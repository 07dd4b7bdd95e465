// SPDX-License-Identifier: MIT
// Renders frames one after the other: a camera on a path, figures in motion, histories of denoisers
// and antialiasing carried over.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/image/flicker.h"
#include "effects/assets/scene/camera_path.h"
#include "effects/geometry/structures/structures.h"
#include "effects/measure/run/frame_result.h"
#include "layers.h"
#include "output.h"

namespace northlight {

struct SequenceFrame {
  double ms = 0;
  std::vector<kaamos::effects::PassStatistics> passes;
  std::optional<kaamos::effects::StructureStatistics> structures;  // empty if nothing moves
  bool cut = false;
};

// The change of a picture beyond its motion, before and after a filter.
struct FlickerLine {
  std::string name;
  kaamos::effects::TemporalChange raw;
  std::optional<kaamos::effects::TemporalChange> filtered;
};

struct SequenceResult {
  std::string path;  // of the camera
  std::vector<SequenceFrame> frames;
  std::vector<FlickerLine> flicker;
  FrameResult last;       // with its layers
  WrittenLayers written;  // of the last frame
};

// Renders options.frames frames and adds frame_0000.png ... to `files` without publishing them.
// `scene` is the renderer's; lights that move (light_forest.h) move in it. Errors: those of the
// path, of WrittenLayers::choose, of rendering, and of files.
rtapi::Result<Outcome> render_sequence(kaamos::effects::FrameRenderer& renderer,
                                       kaamos::effects::Scene& scene, const Options& options,
                                       const Progress& progress, StagedFiles& files,
                                       SequenceResult& out);

// Adds what a still writes, for the last frame; stats.json gets a table with a row for each frame.
// Returns an error text, empty on success.
std::string add_results(const Options& options, const kaamos::effects::Scene& scene,
                        const kaamos::effects::FrameRenderer& renderer,
                        const SequenceResult& sequence, StagedFiles& files);

// The tables printed at the end: passes, structures, flicker.
std::string describe(const kaamos::effects::FrameRenderer& renderer,
                     const SequenceResult& sequence);

// Removes frames that a longer sequence left in the folder after the last frame of this one.
void remove_later_frames(const std::string& folder, std::uint32_t count);

}  // namespace northlight
