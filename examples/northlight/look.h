// SPDX-License-Identifier: MIT
// --view: pictures of what the renderer's last frame is made from.
#pragma once

#include "effects/measure/run/frame_result.h"
#include "options.h"

namespace northlight {

// Checks that the renderer's frames will have what the views look at. Errors: those of check_view.
rtapi::Status check_views(const Options& options, const kaamos::effects::FrameRenderer& renderer);
// Adds the views of the renderer's last frame to `result`.
rtapi::Status add_views(const Options& options, kaamos::effects::FrameRenderer& renderer,
                        FrameResult& result);
// Says what their colours stand for, a line each.
std::string describe_views(const FrameResult& result);

}  // namespace northlight
