// SPDX-License-Identifier: MIT
// A renderer as the command line wants it, and what of its frame goes into files and tables.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/measure/run/options.h"
#include "effects/northlight/frame_renderer.h"
#include "effects/northlight/level_mismatch.h"

namespace kaamos::measure {

using effects::is_done;
using effects::Outcome;
using effects::Progress;

// One of --view.
struct ViewResult {
  std::string name;
  std::vector<std::string> channels;  // of `numbers`
  effects::FloatImage numbers;
  effects::ByteImage picture;
  std::string legend;  // what its colours stand for
};

// A frame with opacity micromaps against the same without.
struct MicromapSavings {
  std::uint64_t calls = 0, calls_without = 0;  // of any-hit shaders
  double ms = 0, ms_without = 0;               // of the passes that trace rays
  std::uint64_t other_pixels = 0;              // whose radiance is not the same
};

struct FrameResult {
  std::map<std::string, effects::FloatImage> layers;  // "ao", "normal", ...
  effects::FloatImage radiance;                       // RGBA, linear
  std::vector<effects::PassStatistics> passes;
  std::vector<std::string> left_out;                  // effects and parts left out, and why
  std::optional<effects::PrimaryComparison> primary;  // of surfaces that were drawn
  std::optional<effects::LevelMismatch> levels;       // where rays see others than draws
  std::optional<MicromapSavings> micromaps;           // of opacity micromaps
  std::vector<ViewResult> views;                      // of --view
};

rtapi::Result<rtapi::Device> create_device(const Options& options, const Say& message);
// On a device of its own. `scene` must stay as it is.
rtapi::Result<std::unique_ptr<effects::FrameRenderer>> create_renderer(const Options& options,
                                                                       const effects::Scene& scene,
                                                                       const Say& message);

// Returns whether a layer is read. Empty: all are.
using LayerChoice = std::function<bool(const std::string& layer)>;

// The last frame: its radiance, and these layers.
rtapi::Result<FrameResult> read_frame(effects::FrameRenderer& renderer,
                                      const LayerChoice& reads = {});
// Renders a frame and reads it.
rtapi::Result<Outcome> render_frame(effects::FrameRenderer& renderer, const Progress& progress,
                                    FrameResult& result, const LayerChoice& reads = {});

// Renders the frame without its opacity micromaps, and sets result.micromaps.
rtapi::Result<Outcome> compare_micromaps(const Options& options, const effects::Scene& scene,
                                         const Progress& progress, FrameResult& result);

}  // namespace kaamos::measure
