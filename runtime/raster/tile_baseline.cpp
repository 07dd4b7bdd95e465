// SPDX-License-Identifier: MIT
#include "runtime/raster/tile_drawing.h"

namespace kaamos::raster {

void draw_tile_baseline(const TileJob& job, TileScratch& scratch, ShaderThread& thread) {
  KAAMOS_RASTER_LEVEL::TileDrawing<false>(job, scratch, thread).run();
}

}  // namespace kaamos::raster
