// SPDX-License-Identifier: MIT
/// @file
/// Pictures of what a frame is made from, as the talk and the deck show them: numbers per pixel,
/// and colours for them.
#pragma once

#include <rtapi/rtapi.h>

#include <functional>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/image/image.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::effects {

/// Requirements that a frame must meet for a view.
struct ViewNeeds {
  bool whole_frame = false;  ///< FrameSettings::whole_frame: lists of lights
  bool volume = false;       ///< an effect that reads the volume of indirect light
  bool memory = false;       ///< a signal whose denoiser keeps something from frame to frame
};

/// Numbers of a view in colours.
struct ViewPicture {
  ByteImage image;     ///< 3 channels
  std::string legend;  ///< what the colours stand for, in a few words
};

/// A row of views().
struct View {
  std::string name;                   ///< on the command line: "hit-uv"
  std::string about;                  ///< what one sees, in a few words
  std::vector<std::string> channels;  ///< names of its four numbers, as the shaders tell them
  /// Effects whose frame has what it needs. Any other that has it will do.
  std::vector<std::string> effects = {};
  ViewNeeds needs = {};  ///< what it looks at
  /// Looks at the renderer's last frame: 4 channels. `signal`: of ViewNeeds::memory, by its name;
  /// empty: the first one.
  std::function<rtapi::Result<FloatImage>(FrameRenderer&, const std::string& signal)> numbers;
  /// Colours for its numbers. `frame`: what the frame looks like, 3 channels.
  std::function<ViewPicture(const FloatImage& numbers, const ByteImage& frame, float exposure)>
      show;
};

/// All of them, in the order of --help.
const std::vector<View>& views();
/// "hit-uv, hit-albedo, ...".
std::string view_names();
/// The view of a name.
/// @errors KA3080 there is none.
Result<const View*> find_view(const std::string& name);

/// Signals of a renderer's frames whose denoiser keeps something from frame to frame.
std::vector<std::string> remembered_signals(const FrameRenderer& renderer);
/// Checks whether the renderer's frames have what a view looks at; it need not have rendered one.
/// @errors KA3081 they lack it; KA3082 `signal` is not among remembered_signals.
Status check_view(const View& view, const FrameRenderer& renderer, const std::string& signal);
/// View::numbers of the renderer's last frame.
/// @errors those of check_view and of the device.
rtapi::Result<FloatImage> look_at(const View& view, FrameRenderer& renderer,
                                  const std::string& signal = {});

}  // namespace kaamos::effects
