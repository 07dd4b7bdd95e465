// SPDX-License-Identifier: MIT
//
// Fills targets. [D3D11.3: 5.2.3; RAS-133 to RAS-136]
#pragma once

#include "runtime/backend/draw_commands.h"
#include "runtime/raster/draw.h"

namespace kaamos::raster {

// Writes the colour, or the depth and stencil that the command names, to every slice of the
// surface: everywhere or in the command's rectangles.
void clear(const Surface& surface, const runtime::ClearTargetCommand& command);

// Leaves the clear to a pass that draws to the surface: Surface::cleared. False if it cannot be
// left to one, and nothing has happened.
bool set_cleared(Surface& surface, const runtime::ClearTargetCommand& command);
// Writes what set_cleared() left out.
void write_cleared(Surface& surface);

}  // namespace kaamos::raster
