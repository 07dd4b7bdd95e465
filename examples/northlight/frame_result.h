// SPDX-License-Identifier: MIT
// A renderer as the command line wants it, and what of its frame goes into files and tables.
#pragma once

#include <rtapi/rtapi.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/northlight/frame_renderer.h"
#include "options.h"

namespace northlight {

using kaamos::effects::is_done;
using kaamos::effects::Outcome;
using kaamos::effects::Progress;

// What a person is told, a line each.
using Say = std::function<void(const std::string& text)>;

// One of --view.
struct ViewResult {
  std::string name;
  std::vector<std::string> channels;  // of `numbers`
  kaamos::effects::FloatImage numbers;
  kaamos::effects::ByteImage picture;
  std::string legend;  // what its colours stand for
};

struct FrameResult {
  std::map<std::string, kaamos::effects::FloatImage> layers;  // "ao", "normal", ...
  kaamos::effects::FloatImage radiance;                       // RGBA, linear
  std::vector<kaamos::effects::PassStatistics> passes;
  std::vector<std::string> left_out;                          // effects and parts left out, and why
  std::optional<kaamos::effects::PrimaryComparison> primary;  // of surfaces that were drawn
  std::vector<ViewResult> views;                              // of --view
};

rtapi::Result<rtapi::Device> create_device(const Options& options, const Say& message);
// On a device of its own. `scene` must stay as it is.
rtapi::Result<std::unique_ptr<kaamos::effects::FrameRenderer>> create_renderer(
    const Options& options, const kaamos::effects::Scene& scene, const Say& message);

// All of the last frame.
rtapi::Result<FrameResult> read_frame(kaamos::effects::FrameRenderer& renderer);
// Renders a frame and reads it.
rtapi::Result<Outcome> render_frame(kaamos::effects::FrameRenderer& renderer,
                                    const Progress& progress, FrameResult& result);

}  // namespace northlight
