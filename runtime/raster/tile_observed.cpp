// SPDX-License-Identifier: MIT
#include "runtime/raster/observer.h"
#include "runtime/raster/tile_drawing.h"

namespace kaamos::raster {

void draw_tile_observed(const TileJob& job, TileScratch& scratch, ShaderThread& thread) {
  KAAMOS_RASTER_LEVEL::TileDrawing<true>(job, scratch, thread).run();
}

}  // namespace kaamos::raster
