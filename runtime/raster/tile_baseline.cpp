// SPDX-License-Identifier: MIT
#include "runtime/raster/multisample_drawing.h"
#include "runtime/raster/tile_drawing.h"

namespace kaamos::raster {

void draw_tile_baseline(const TileJob& job, TileScratch& scratch, ShaderThread& thread) {
  if (job.targets->samples > 1) {
    return KAAMOS_RASTER_LEVEL::MultisampleDrawing(job, scratch, thread).run();
  }
  KAAMOS_RASTER_LEVEL::TileDrawing<false>(job, scratch, thread).run();
}

}  // namespace kaamos::raster
