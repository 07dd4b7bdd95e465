// SPDX-License-Identifier: MIT
/// @file
/// The layers that can be read of a frame, by name.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "effects/northlight/effect_stage.h"
#include "effects/northlight/filter_stage.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/light_stage.h"

namespace kaamos::effects {

/// A picture of a frame and what its numbers are.
struct FrameLayer {
  std::string name;               ///< "normal", "ao_denoised"
  rtapi::Texture picture;         ///< as the passes wrote it
  float scale = 1;                ///< makes a sum the mean of its samples
  bool is_encoded_color = false;  ///< as EncodeColor stores it [effects/shaders/encoding.hlsli]
};

/// The layer of a signal that is denoised.
std::string denoised_layer(const std::string& signal);
/// The names of all layers that frames of these effects can have.
std::vector<std::string> possible_layers(const std::vector<Effect>& effects);
/// The names of those that find_layers finds, as the settings and the scene alone tell them.
std::vector<std::string> layer_names(const FrameContext& context);
/// The G-buffer, and each effect's signals, raw and denoised.
std::vector<FrameLayer> find_layers(const FrameContext& context, const LightStage& lights,
                                    const EffectStage& effects, const FilterStage& filters);
/// Turns the numbers of its picture into those of the layer.
void decode_layer(const FrameLayer& layer, FloatImage& image);

}  // namespace kaamos::effects
