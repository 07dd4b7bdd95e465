// SPDX-License-Identifier: MIT
#include "runtime/raster/multisample_drawing.h"
#include "runtime/raster/tile_drawing.h"

#ifndef __AVX2__
#error "tile_avx2.cpp needs KAAMOS_SHADER_AVX2_OPTIONS"
#endif

namespace kaamos::raster {

void draw_tile_avx2(const TileJob& job, TileScratch& scratch, ShaderThread& thread) {
  if (job.targets->samples > 1) {
    return KAAMOS_RASTER_LEVEL::MultisampleDrawing(job, scratch, thread).run();
  }
  KAAMOS_RASTER_LEVEL::TileDrawing<false>(job, scratch, thread).run();
}

}  // namespace kaamos::raster
