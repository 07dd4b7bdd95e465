// SPDX-License-Identifier: MIT
#include "runtime/raster/tile_drawing.h"

namespace kaamos::raster {

void draw_tile_avx2(const TileJob& job, TileScratch& scratch, ShaderThread& thread) {
  KAAMOS_RASTER_LEVEL::TileDrawing(job, scratch, thread).run();
}

}  // namespace kaamos::raster
