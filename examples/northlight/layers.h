// SPDX-License-Identifier: MIT
// Which layers of a frame are read and written: --layers.
#pragma once

#include <rtapi/result.h>

#include <string>
#include <vector>

#include "effects/measure/run/frame_result.h"
#include "options.h"

namespace northlight {

// What is wrong with a name in --layers; empty: some frame has such a layer, or it is "all" or
// "none".
std::string check_layer_name(const std::string& name);

// The layers of a frame that are written.
class WrittenLayers {
 public:
  // Those of --layers, else those of effects that are named; with --reference, of all effects.
  // Errors: KA3046 a layer that this frame does not have, with those that it has.
  static rtapi::Result<WrittenLayers> choose(const Options& options,
                                             const kaamos::effects::FrameRenderer& renderer);

  const std::vector<std::string>& names() const { return names_; }
  // Whether a layer of FrameResult is written; those that --reference asks for always are.
  bool has(const std::string& layer) const;
  // What has to be read of the frame for them.
  LayerChoice reads() const;

 private:
  std::vector<std::string> names_;
};

}  // namespace northlight
