// SPDX-License-Identifier: MIT
// A swap chain needs two things of a window: its size, and that it counts frames.
#pragma once

#include <windows.h>

#include <optional>

namespace kaamos::d3d12 {

/// The size of a window's content in pixels; none if the handle is not a valid window.
std::optional<SIZE> window_size(HWND window);

/// Counts a frame that was presented to this window. After KAAMOS_FRAMES of them (default 3) the
/// window gets WM_CLOSE, as if its user had closed it. A handle that names no window is ignored.
void count_frame(HWND window);

/// KAAMOS_FRAMES, a whole number ≥ 1; 3 if it is not set. Anything else is KA4042 and counts as 3.
int frame_limit();

}  // namespace kaamos::d3d12
