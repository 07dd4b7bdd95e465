// SPDX-License-Identifier: MIT
//
// Draws a tile: the triangles of its runs, one after another.
#pragma once

#include "runtime/raster/quad_shader.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

class TileDrawing {
 public:
  TileDrawing(const TileJob& job, TileScratch& scratch, ShaderThread& thread)
      : job_(job), scratch_(scratch), quads_(job, scratch, thread) {}

  void run() {
    scratch_.queue.count = 0;
    bool loaded = false;
    bool written = false;
    for (uint32_t i = 0; i < job_.run_count; ++i) {
      const TileJob::Run& run = job_.runs[i];
      const DrawPlan& plan = job_.plans[run.batch->plan];
      if (plan.depth != DepthKind::kNone && !loaded) {
        scratch_.depth.load(job_.targets->depth, job_.x, job_.y, job_.slice);
        loaded = true;
      }
      written = written || plan.early_write || plan.late_write;
      draw(run, plan);
    }
    if (written) scratch_.depth.store(job_.targets->depth, job_.x, job_.y, job_.slice);
  }

 private:
  void draw(const TileJob::Run& run, const DrawPlan& plan) {
    if (plan.has_pixel) quads_.begin_batch(*run.batch, plan);
    switch (plan.early_test ? plan.depth : DepthKind::kNone) {
      case DepthKind::kFloat32:
        return draw_as<DepthKind::kFloat32>(run, plan);
      case DepthKind::kUnorm16:
        return draw_as<DepthKind::kUnorm16>(run, plan);
      case DepthKind::kUnorm24:
        return draw_as<DepthKind::kUnorm24>(run, plan);
      default:
        return draw_as<DepthKind::kNone>(run, plan);
    }
  }

  template <DepthKind kKind>
  void draw_as(const TileJob::Run& run, const DrawPlan& plan) {
    if (plan.has_pixel) {
      draw_triangles<kKind, true>(run, plan);
    } else {
      draw_triangles<kKind, false>(run, plan);
    }
  }

  template <DepthKind kKind, bool kShades>
  void draw_triangles(const TileJob::Run& run, const DrawPlan& plan) {
    const uint32_t* order = run.batch->order.data() + run.first;
    const auto x = static_cast<int32_t>(job_.x);
    const auto y = static_cast<int32_t>(job_.y);
    for (uint32_t i = 0; i < run.count; ++i) {
      const Triangle& triangle = run.batch->triangles[order[i]];
      const ViewportState& viewport = plan.viewports[triangle.flags >> kViewportShift];
      Coverage coverage;
      if (!coverage.begin(triangle, viewport.rect, x, y)) continue;
      DepthPlane plane;
      if (kKind != DepthKind::kNone || plan.needs_z) plane.begin(triangle, x, y);
      const DepthTest<kKind> test(plan.depth_func, viewport.depth_low, viewport.depth_high);
      if constexpr (kShades) quads_.begin_triangle(triangle);
      coverage.each_block([&](int32_t block_x, int32_t block_y, const lanes& covered) {
        const auto quad =
            static_cast<uint32_t>(block_y) * kQuadsPerRow + static_cast<uint32_t>(block_x) * 2;
        lanes pass = covered;
        Floats8 z{};
        if (kKind != DepthKind::kNone || (kShades && plan.needs_z)) {
          z = plane.at_block(block_x, block_y);
        }
        if constexpr (kKind != DepthKind::kNone) {
          pass = test.run(scratch_.depth.words + quad * 4, z, covered, plan.early_write);
        }
        if constexpr (kShades) put(quad, bits_of(pass), z, plan.needs_z);
      });
      if constexpr (kShades) quads_.flush();
    }
  }

  KAAMOS_INLINE void put(uint32_t quad, uint32_t bits, const Floats8& z, bool keeps_z) {
    if (bits == 0) return;
    QuadQueue& queue = scratch_.queue;
    if (queue.count + 2 > QuadQueue::kCapacity) quads_.flush();
    float values[8];
    store(values, z);
    for (uint32_t i = 0; i < 2; ++i) {
      const uint32_t covered = bits >> 4 * i & 0xF;
      if (covered == 0) continue;
      queue.quad[queue.count] = static_cast<uint16_t>(quad + i);
      queue.covered[queue.count] = static_cast<uint8_t>(covered);
      if (keeps_z) __builtin_memcpy(queue.z + queue.count * 4, values + 4 * i, 16);
      ++queue.count;
    }
  }

  const TileJob& job_;
  TileScratch& scratch_;
  QuadShader quads_;
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
