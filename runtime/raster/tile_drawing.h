// SPDX-License-Identifier: MIT
//
// Draws a tile: the triangles of its runs, one after another. kObserved: tells the observer of
// TileScratch.
#pragma once

#include "runtime/raster/quad_shader.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

template <bool kObserved>
class TileDrawing {
 public:
  TileDrawing(const TileJob& job, TileScratch& scratch, ShaderThread& thread)
      : job_(job), scratch_(scratch), quads_(job, scratch, thread) {}

  void run() {
    scratch_.queue.count = 0;
    scratch_.colors.begin(*job_.targets, job_.x, job_.y, job_.slice);
    if constexpr (kObserved) scratch_.observer->begin_tile(job_, scratch_.colors);
    const Surface& depth = job_.targets->depth;
    bool loaded = depth.cleared;
    bool written = depth.cleared;
    bool stencil_loaded = false;
    bool stencil_written = false;
    if (depth.cleared) scratch_.depth.fill(depth.value[0]);
    for (uint32_t i = 0; i < job_.run_count; ++i) {
      const TileJob::Run& run = job_.runs[i];
      if (i + 1 < job_.run_count) prefetch(job_.runs[i + 1], 0, kAhead);
      const DrawPlan& plan = job_.plans[run.batch->plan];
      if (plan.depth != DepthKind::kNone && !loaded) {
        scratch_.depth.load(depth, job_.x, job_.y, job_.slice);
        loaded = true;
      }
      written = written || plan.early_write || plan.late_write;
      if (plan.stencil != nullptr && !stencil_loaded) {
        scratch_.stencil.load(depth, job_.x, job_.y, job_.slice);
        stencil_loaded = true;
      }
      stencil_written = stencil_written || (plan.stencil != nullptr && plan.stencil->writes);
      draw(run, plan);
    }
    if (written) scratch_.depth.store(depth, job_.x, job_.y, job_.slice);
    // After depth, whose words may hold stencil as it was loaded.
    if (stencil_written) scratch_.stencil.store(depth, job_.x, job_.y, job_.slice);
    scratch_.colors.store();
    if constexpr (kObserved) scratch_.observer->end_tile();
  }

 private:
  void draw(const TileJob::Run& run, const DrawPlan& plan) {
    if (plan.has_pixel) quads_.begin_batch(*run.batch, plan);
    if constexpr (kObserved) scratch_.observer->begin_batch(*run.batch, plan);
    if (plan.early_test && plan.stencil != nullptr) return draw_stencil(run, plan);
    switch (plan.early_test ? plan.depth : DepthKind::kNone) {
      case DepthKind::kFloat32:
        return draw_float32(run, plan);
      case DepthKind::kUnorm16:
        return draw_as<DepthKind::kUnorm16>(run, plan);
      case DepthKind::kUnorm24:
        return draw_as<DepthKind::kUnorm24>(run, plan);
      default:
        return draw_as<DepthKind::kNone>(run, plan);
    }
  }

  // The usual comparisons in versions of their own.
  void draw_float32(const TileJob::Run& run, const DrawPlan& plan) {
    constexpr DepthKind kKind = DepthKind::kFloat32;
    switch (plan.depth_func) {
      case kPassLess:
        return draw_as<kKind, kPassLess>(run, plan);
      case kPassLess | kPassEqual:
        return draw_as<kKind, kPassLess | kPassEqual>(run, plan);
      case kPassGreater:
        return draw_as<kKind, kPassGreater>(run, plan);
      case kPassGreater | kPassEqual:
        return draw_as<kKind, kPassGreater | kPassEqual>(run, plan);
      default:
        return draw_as<kKind>(run, plan);
    }
  }

  // Formats with stencil, with or without a depth test.
  void draw_stencil(const TileJob::Run& run, const DrawPlan& plan) {
    switch (plan.depth) {
      case DepthKind::kFloat32:
        return draw_as<DepthKind::kFloat32, kAnyFunc, true>(run, plan);
      case DepthKind::kUnorm24:
        return draw_as<DepthKind::kUnorm24, kAnyFunc, true>(run, plan);
      default:
        return draw_as<DepthKind::kNone, kAnyFunc, true>(run, plan);
    }
  }

  template <DepthKind kKind, uint32_t kFunc = kAnyFunc, bool kStencil = false>
  void draw_as(const TileJob::Run& run, const DrawPlan& plan) {
    if (plan.has_pixel) {
      draw_triangles<kKind, kFunc, kStencil, true>(run, plan);
    } else {
      draw_triangles<kKind, kFunc, kStencil, false>(run, plan);
    }
  }

  // Draws the blocks of one triangle.
  template <DepthKind kKind, uint32_t kFunc, bool kStencil, bool kShades>
  struct Blocks {
    TileDrawing& tile;
    const DrawPlan& plan;
    const DepthTest<kKind, kFunc>& test;
    const Triangle& triangle;
    DepthPlane plane;
    Doubles8 z_of_row;
    const bool needs_z = kKind != DepthKind::kNone || (kShades && plan.needs_z);

    KAAMOS_INLINE void row(int32_t block_y) {
      if (needs_z) z_of_row = plane.at_row(block_y);
    }
    KAAMOS_INLINE void block(int32_t block_x, int32_t block_y, const lanes& covered) {
      const auto quad =
          static_cast<uint32_t>(block_y) * kQuadsPerRow + static_cast<uint32_t>(block_x) * 2;
      lanes pass = covered;
      Floats8 z{};
      if (needs_z) z = plane.at_block(z_of_row, block_x, block_y);
      uint32_t stored[8];
      if constexpr (kObserved) __builtin_memcpy(stored, tile.scratch_.depth.words + quad * 4, 32);
      uint8_t* const stencil = tile.scratch_.stencil.bytes + quad * 4;
      uint8_t stored_stencil[8];
      uint32_t active = 0;
      uint32_t passed_stencil = 0;
      if constexpr (kStencil) {
        __builtin_memcpy(stored_stencil, stencil, 8);
        active = bits_of(covered);
        passed_stencil = StencilTest(*plan.stencil, triangle).run(stencil, active);
        pass = lanes_of(passed_stencil);
      }
      if constexpr (kKind != DepthKind::kNone) {
        pass = test.run(tile.scratch_.depth.words + quad * 4, z, pass, plan.early_write);
      }
      if constexpr (kStencil) {
        StencilTest(*plan.stencil, triangle).update(stencil, active, passed_stencil, bits_of(pass));
      }
      if constexpr (kObserved) {
        float values[8];
        store(values, z);
        tile.scratch_.observer->block(
            triangle, {quad, bits_of(covered), bits_of(pass), needs_z ? values : nullptr,
                       kKind != DepthKind::kNone ? stored : nullptr,
                       kStencil ? stored_stencil : nullptr, active & ~passed_stencil});
      }
      if constexpr (kShades) tile.put(quad, bits_of(pass), z, plan.needs_z);
    }
  };

  // Blocks of a triangle that is only logged.
  struct CulledBlocks {
    TileObserver& observer;
    const Triangle& triangle;

    void row(int32_t) {}
    void block(int32_t block_x, int32_t block_y, const lanes& covered) {
      const auto quad =
          static_cast<uint32_t>(block_y) * kQuadsPerRow + static_cast<uint32_t>(block_x) * 2;
      observer.block(triangle, {quad, bits_of(covered), 0, nullptr, nullptr, nullptr, 0});
    }
  };

  template <DepthKind kKind, uint32_t kFunc, bool kStencil, bool kShades>
  void draw_triangles(const TileJob::Run& run, const DrawPlan& plan) {
    const Triangle* triangles = run.batch->triangles.data() + run.first;
    const auto x = static_cast<int32_t>(job_.x);
    const auto y = static_cast<int32_t>(job_.y);
    uint32_t number = 0;  // of the viewport
    const auto test_of = [&] {
      const ViewportState& viewport = plan.viewports[number];
      return DepthTest<kKind, kFunc>(plan.depth_func, viewport.depth_low, viewport.depth_high);
    };
    DepthTest<kKind, kFunc> test = test_of();
    for (uint32_t i = 0; i < run.count; ++i) {
      const Triangle& triangle = triangles[i];
      prefetch(run, i + kAhead, i + kAhead + 1);
      if constexpr (kShades) prefetch_rows(run, i + kAhead / 2, plan);
      if (triangle.flags >> kViewportShift != number) {
        number = triangle.flags >> kViewportShift;
        test = test_of();
      }
      Coverage coverage;
      if (!coverage.begin(triangle, plan.viewports[number].rect, x, y)) continue;
      if constexpr (kObserved) {
        scratch_.observer->begin_triangle(run.batch->shading[run.batch->numbers[run.first + i]]);
        if ((triangle.flags & kCulled) != 0) {
          CulledBlocks culled{*scratch_.observer, triangle};
          coverage.each_block(culled);
          continue;
        }
      }
      Blocks<kKind, kFunc, kStencil, kShades> blocks{*this, plan, test, triangle, {}, {}};
      if (blocks.needs_z) blocks.plane.begin(triangle, x, y);
      if constexpr (kShades) {
        reach(triangle, plan);
        quads_.begin_triangle(triangle, run.batch->shading[run.batch->numbers[run.first + i]]);
      }
      coverage.each_block(blocks);
      if constexpr (kShades) quads_.flush();
    }
  }

  // Triangles come from far away: batches wrote them for all tiles.
  static constexpr uint32_t kAhead = 8;
  KAAMOS_INLINE static void prefetch(const TileJob::Run& run, uint32_t first, uint32_t end) {
    if (end > run.count) end = run.count;
    const Batch& batch = *run.batch;
    for (uint32_t i = first; i < end; ++i) {
      __builtin_prefetch(&batch.triangles[run.first + i]);
      if (batch.numbers.size() == 0) continue;
      __builtin_prefetch(&batch.shading[batch.numbers[run.first + i]]);
    }
  }
  KAAMOS_INLINE static void prefetch_rows(const TileJob::Run& run, uint32_t i,
                                          const DrawPlan& plan) {
    if (i >= run.count) return;
    const Batch& batch = *run.batch;
    const TriangleShading& shading = batch.shading[batch.numbers[run.first + i]];
    const size_t words = plan.row_columns.size();
    for (const uint32_t vertex : shading.vertex) {
      __builtin_prefetch(batch.rows.data() + vertex * words);
    }
  }

  // Fetches the colours that a triangle is the first to reach.
  KAAMOS_INLINE void reach(const Triangle& triangle, const DrawPlan& plan) {
    if (reached_by_ != &plan) {
      reached_by_ = &plan;
      reached_ = 0;
    }
    constexpr int32_t kBand = TileColors::kBandRows;
    constexpr int32_t kBands = kTileSize / kBand;
    const auto top = static_cast<int32_t>(job_.y);
    const int32_t first = triangle.box.top > top ? (triangle.box.top - top) / kBand : 0;
    const int32_t last = triangle.box.bottom < top + kTileSize
                             ? (triangle.box.bottom - 1 - top) / kBand
                             : kBands - 1;
    const uint32_t bands = ((2u << last) - 1) & ~((1u << first) - 1) & ~reached_;
    if (bands != 0) load_bands(plan, bands);
  }
  void load_bands(const DrawPlan& plan, uint32_t bands) {
    reached_ |= bands;
    for (const PlannedTarget& target : plan.targets) scratch_.colors.load(target.slot, bands);
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
  const DrawPlan* reached_by_ = nullptr;
  uint32_t reached_ = 0;  // bands of TileColors that are there for it
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
