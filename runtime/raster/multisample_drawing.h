// SPDX-License-Identifier: MIT
//
// Draws a tile of targets with several samples: coverage, depth and stencil of each sample by
// itself, as if the triangle were moved so that the sample is the pixel's middle; then the pixels
// that any sample leaves are shaded.
#pragma once

#include <mutex>

#include "runtime/raster/multisample_shader.h"
#include "runtime/raster/observer.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

class MultisampleDrawing {
 public:
  MultisampleDrawing(const TileJob& job, TileScratch& scratch, ShaderThread& thread)
      : job_(job), all_(*scratch.multisampled), shader_(job, scratch, thread) {}

  void run() {
    const uint32_t samples = job_.targets->samples;
    // A task before this one may have been left in the middle.
    all_.covered = {};
    all_.quad_count = 0;
    for (uint32_t s = 0; s < samples; ++s) begin(all_.samples[s], s);
    const Surface& depth = job_.targets->depth;
    bool loaded = depth.cleared;
    bool written = depth.cleared;
    bool stencil_loaded = false;
    bool stencil_written = false;
    for (uint32_t i = 0; i < job_.run_count; ++i) {
      const TileJob::Run& run = job_.runs[i];
      const DrawPlan& plan = job_.plans[run.batch->plan];
      if (plan.depth != DepthKind::kNone && !loaded) {
        each_sample(
            [&](auto& one) { one.depth.load(one.plane.depth, job_.x, job_.y, job_.slice); });
        loaded = true;
      }
      written = written || plan.early_write || plan.late_write;
      if (plan.stencil != nullptr && !stencil_loaded) {
        each_sample(
            [&](auto& one) { one.stencil.load(one.plane.depth, job_.x, job_.y, job_.slice); });
        stencil_loaded = true;
      }
      stencil_written = stencil_written || (plan.stencil != nullptr && plan.stencil->writes);
      for (const PlannedTarget& target : plan.targets) {
        each_sample([&](auto& one) { one.colors.load(target.slot, kAllBands); });
      }
      draw(run, plan);
      if (job_.observation != nullptr) note(job_.observation, run.batch->draw);
    }
    each_sample([&](auto& one) {
      const Surface& plane = one.plane.depth;
      if (written) one.depth.store(plane, job_.x, job_.y, job_.slice);
      // After depth, whose words may hold stencil as it was loaded.
      if (stencil_written) one.stencil.store(plane, job_.x, job_.y, job_.slice);
      one.colors.store();
    });
  }

 private:
  static constexpr uint32_t kAllBands = (1u << kTileSize / TileColors::kBandRows) - 1;

  template <class F>
  void each_sample(const F& f) {
    for (uint32_t s = 0; s < job_.targets->samples; ++s) f(all_.samples[s]);
  }

  void begin(MultisampleScratch::Sample& sample, uint32_t s) {
    sample.plane = *job_.targets;
    const auto move = [s](Surface& surface) {
      if (surface.texels != nullptr) surface.texels += s * surface.sample_pitch;
    };
    for (Surface& surface : sample.plane.color) move(surface);
    move(sample.plane.depth);
    sample.colors.begin(sample.plane, job_.x, job_.y, job_.slice);
    if (sample.plane.depth.cleared) sample.depth.fill(sample.plane.depth.value[0]);
  }

  void draw(const TileJob::Run& run, const DrawPlan& plan) {
    if (plan.has_pixel) shader_.begin_batch(*run.batch, plan);
    const bool stencil = plan.early_test && plan.stencil != nullptr;
    switch (plan.early_test ? plan.depth : DepthKind::kNone) {
      case DepthKind::kFloat32:
        return stencil ? draw_as<DepthKind::kFloat32, true>(run, plan)
                       : draw_as<DepthKind::kFloat32, false>(run, plan);
      case DepthKind::kUnorm16:
        return draw_as<DepthKind::kUnorm16, false>(run, plan);
      case DepthKind::kUnorm24:
        return stencil ? draw_as<DepthKind::kUnorm24, true>(run, plan)
                       : draw_as<DepthKind::kUnorm24, false>(run, plan);
      default:
        return stencil ? draw_as<DepthKind::kNone, true>(run, plan)
                       : draw_as<DepthKind::kNone, false>(run, plan);
    }
  }

  // The sums of what has been drawn since the last call.
  void note(Observation* observation, uint32_t draw) {
    runtime::DrawCounts counts;
    counts.shaded = shader_.shaded() - noted_shaded_;
    counts.written = shader_.written() + untouched_ - noted_written_;
    noted_shaded_ += counts.shaded;
    noted_written_ += counts.written;
    const std::lock_guard lock(observation->mutex);
    observation->draws[draw].counts.add(counts);
  }

  // Tests the blocks of one sample of a triangle.
  template <DepthKind kKind, bool kStencil>
  struct Blocks {
    MultisampleScratch& all;
    uint32_t number;
    const DrawPlan& plan;
    const DepthTest<kKind>& test;
    const Triangle& triangle;
    uint64_t& untouched;
    DepthPlane plane;
    Doubles8 z_of_row;

    void row(int32_t block_y) {
      if constexpr (kKind != DepthKind::kNone) z_of_row = plane.at_row(block_y);
    }
    void block(int32_t block_x, int32_t block_y, const lanes& covered) {
      MultisampleScratch::Sample& sample = all.samples[number];
      const auto quad =
          static_cast<uint32_t>(block_y) * kQuadsPerRow + static_cast<uint32_t>(block_x) * 2;
      lanes pass = covered;
      const uint32_t active = bits_of(covered);
      uint8_t* const stencil = sample.stencil.bytes + quad * 4;
      uint32_t passed_stencil = active;
      if constexpr (kStencil) {
        passed_stencil = StencilTest(*plan.stencil, triangle).run(stencil, active);
        pass = lanes_of(passed_stencil);
      }
      if constexpr (kKind != DepthKind::kNone) {
        const Floats8 z = plane.at_block(z_of_row, block_x, block_y);
        pass = test.run(sample.depth.words + quad * 4, z, pass, plan.early_write);
      }
      const uint32_t passed = bits_of(pass);
      if constexpr (kStencil) {
        StencilTest(*plan.stencil, triangle).update(stencil, active, passed_stencil, passed);
      }
      if (!plan.has_pixel) {
        untouched += static_cast<uint64_t>(std::popcount(passed));
        return;
      }
      put(quad, active & 0xF, passed & 0xF);
      put(quad + 1, active >> 4, passed >> 4);
    }
    void put(uint32_t quad, uint32_t active, uint32_t passed) {
      if (active == 0) return;
      if (all.covered[quad] == 0) {
        all.quads[all.quad_count++] = static_cast<uint16_t>(quad);
        all.passed[quad] = 0;
      }
      all.covered[quad] |= active << 4 * number;
      all.passed[quad] |= passed << 4 * number;
    }
  };

  template <DepthKind kKind, bool kStencil>
  void draw_as(const TileJob::Run& run, const DrawPlan& plan) {
    const auto x = static_cast<int32_t>(job_.x);
    const auto y = static_cast<int32_t>(job_.y);
    const auto positions = sample_positions(plan.samples);
    for (uint32_t i = run.first; i < run.first + run.count; ++i) {
      const Triangle& triangle = run.batch->triangles[i];
      if ((triangle.flags & kCulled) != 0) continue;
      const ViewportState& viewport = plan.viewports[triangle.flags >> kViewportShift];
      const DepthTest<kKind> test(plan.depth_func, viewport.depth_low, viewport.depth_high);
      for (uint32_t s = 0; s < plan.samples; ++s) {
        if ((plan.sample_mask >> s & 1) == 0) continue;
        Triangle moved = triangle;
        // A line has all samples of its pixels.
        if ((triangle.flags & kLine) == 0) {
          for (int32_t& vertex : moved.x) vertex -= positions[s].x - kPixelCenter;
          for (int32_t& vertex : moved.y) vertex -= positions[s].y - kPixelCenter;
        }
        Coverage coverage;
        if (!coverage.begin(moved, viewport.rect, x, y)) continue;
        Blocks<kKind, kStencil> blocks{all_, s, plan, test, moved, untouched_, {}, {}};
        if constexpr (kKind != DepthKind::kNone) blocks.plane.begin(moved, x, y);
        coverage.each_block(blocks);
      }
      if (all_.quad_count == 0) continue;
      // Whatever the order of samples found them in.
      std::sort(all_.quads.begin(), all_.quads.begin() + all_.quad_count);
      shader_.begin_triangle(triangle, run.batch->shading[run.batch->numbers[i]]);
      shader_.run();
      for (uint32_t q = 0; q < all_.quad_count; ++q) all_.covered[all_.quads[q]] = 0;
      all_.quad_count = 0;
    }
  }

  const TileJob& job_;
  MultisampleScratch& all_;
  MultisampleShader shader_;
  uint64_t untouched_ = 0;  // samples that passed the tests and have no pixel shader
  uint64_t noted_shaded_ = 0;
  uint64_t noted_written_ = 0;
};

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL
