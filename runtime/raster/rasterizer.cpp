// SPDX-License-Identifier: MIT
#include "runtime/raster/rasterizer.h"

#include <algorithm>

#include "kaamos/shader/cpu_level.h"
#include "runtime/raster/clear.h"
#include "runtime/raster/front_end.h"
#include "runtime/raster/multisample_scratch.h"
#include "runtime/raster/observer.h"
#include "runtime/raster/tile.h"

namespace kaamos::raster {
namespace {

// Objects that tasks borrow. One that a task does not give back, because the task was left in the
// middle, is free again from the next pass on.
template <class T>
class Pool {
 public:
  T* take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) {
      all_.push_back(std::make_unique<T>());
      return all_.back().get();
    }
    T* object = free_.back();
    free_.pop_back();
    return object;
  }
  void give_back(T* object) {
    const std::lock_guard lock(mutex_);
    free_.push_back(object);
  }
  void give_back_all() {
    free_.clear();
    for (const auto& object : all_) free_.push_back(object.get());
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> all_;
  std::vector<T*> free_;
};

struct Extent {
  uint32_t width = kMaxTargetSize;
  uint32_t height = kMaxTargetSize;
  uint32_t slices = 0;
};

// Returns the extent that all targets have in common.
Extent common_extent(const Targets& targets) {
  Extent extent;
  const auto add = [&](const Surface& surface) {
    if (surface.texels == nullptr) return;
    extent.width = std::min(extent.width, surface.width);
    extent.height = std::min(extent.height, surface.height);
    extent.slices = extent.slices == 0 ? surface.slices : std::min(extent.slices, surface.slices);
  };
  for (const Surface& surface : targets.color) add(surface);
  add(targets.depth);
  extent.slices = std::max(extent.slices, 1u);
  return extent;
}

DrawTile draw_tile_function([[maybe_unused]] const RasterizerOptions& options) {
#ifdef KAAMOS_RASTER_AVX2
  if (!options.any_processor && shader::cpu_level() == shader::CpuLevel::kAvx2)
    return draw_tile_avx2;
#endif
  return draw_tile_baseline;
}

}  // namespace

// The state that stays from pass to pass.
struct Rasterizer::Memory {
  RasterizerOptions options;
  DrawTile draw_tile = nullptr;
  std::vector<std::unique_ptr<Batch>> batches;
  Pool<FrontEnd> front_ends;
  Pool<TileScratch> tiles;
  Pool<TileObserver> observers;
};

struct Rasterizer::Pass {
  Memory& memory;
  Targets targets;
  std::span<const Draw> draws;
  Workers& workers;
  Extent extent;
  TileGrid grid;
  Observation* observation;
  std::vector<DrawPlan> plans = {};
  std::vector<uint32_t> plan_of_draw = {};
  std::vector<PrimitiveRange> ranges = {};  // a batch each
  std::vector<TileJob::Run> runs = {};
  std::vector<TileJob> jobs = {};
  bool clears = false;  // the tiles that are drawn next

  void make_plans() {
    for (const Draw& draw : draws) {
      if (plans.empty() || plans.back().linked != draw.linked || plans.back().state != draw.state) {
        plans.push_back(plan_draw(draw, targets, extent.width, extent.height, extent.slices));
        plans.back().observed = observation != nullptr;
        plans.back().has_shading = plans.back().has_pixel || observation != nullptr;
        plans.back().keeps_culled = observation != nullptr && observation->log != nullptr;
      }
      plan_of_draw.push_back(static_cast<uint32_t>(plans.size() - 1));
    }
  }

  // What a geometry shader makes of a primitive, at most.
  static uint32_t most_of_each(const runtime::LinkedGraphics& linked) {
    if (!linked.has_geometry()) return 1;
    const shader::GeometryShape& shape = linked.geometry_desc().shape;
    return shape.most_vertices * shape.instances;
  }

  // Ranges wait until their batches would fill the memory, and are then drawn.
  void run() {
    uint64_t waiting = 0;
    for (uint32_t number = 0; number < draws.size(); ++number) {
      const DrawPlan& plan = plans[plan_of_draw[number]];
      if (plan.draws_nothing) continue;
      const uint32_t each = most_of_each(*plan.linked);
      RangeCursor cursor(draws[number], number,
                         std::max(memory.options.batch_triangles / each, 1u));
      PrimitiveRange range;
      while (cursor.next(range)) {
        constexpr uint64_t kBytesOfTriangle =
            sizeof(Triangle) + sizeof(TriangleShading) + 3 * sizeof(TileRun);
        const uint64_t bytes = uint64_t{range.count} * each *
                               (kBytesOfTriangle + plan.row_columns.size() * sizeof(uint32_t));
        if (!ranges.empty() && waiting + bytes > memory.options.batch_bytes) {
          flush();
          waiting = 0;
        }
        ranges.push_back(range);
        waiting += bytes;
      }
    }
    flush();
    // Clear the targets that no tile has written.
    each_cleared([](Surface& surface) { write_cleared(surface); });
  }

  template <class F>
  void each_cleared(const F& f) {
    for (Surface& surface : targets.color) {
      if (surface.cleared) f(surface);
    }
    if (targets.depth.cleared) f(targets.depth);
  }

  // Tiles write the clears of what they cover wholly.
  void prepare_clears() {
    clears = false;
    each_cleared([&](Surface& surface) {
      if (surface.width == extent.width && surface.height == extent.height &&
          surface.slices == extent.slices) {
        clears = true;
      } else {
        write_cleared(surface);
      }
    });
  }

  void flush() {
    if (ranges.empty()) return;
    prepare_clears();
    while (memory.batches.size() < ranges.size()) {
      memory.batches.push_back(std::make_unique<Batch>());
    }
    make_batches();
    make_jobs();
    draw_tiles();
    each_cleared([](Surface& surface) { surface.cleared = false; });
    ranges.clear();
  }

  // A task makes several batches if they are small.
  void make_batches() {
    std::vector<size_t> firsts;
    uint32_t triangles = 0;
    for (size_t i = 0; i < ranges.size(); ++i) {
      if (firsts.empty() || triangles + ranges[i].count > memory.options.batch_triangles) {
        firsts.push_back(i);
        triangles = 0;
      }
      triangles += ranges[i].count;
    }
    const auto tasks = static_cast<uint32_t>(firsts.size());
    firsts.push_back(ranges.size());
    workers.run(tasks, [&](uint32_t task, ShaderThread& thread) {
      FrontEnd* front_end = memory.front_ends.take();
      for (size_t i = firsts[task]; i < firsts[task + 1]; ++i) {
        const uint32_t draw = ranges[i].draw;
        Batch& batch = *memory.batches[i];
        batch.plan = plan_of_draw[draw];
        front_end->run(ranges[i], draws[draw], plans[batch.plan], grid, thread, batch);
      }
      memory.front_ends.give_back(front_end);
    });
    if (observation == nullptr) return;
    for (size_t i = 0; i < ranges.size(); ++i) {
      const Batch& batch = *memory.batches[i];
      observation->draws[batch.draw].counts.add(batch.counts);
    }
  }

  void make_jobs() {
    struct Tile {
      uint32_t runs = 0;
      uint32_t first = 0;
      uint64_t triangles = 0;
    };
    std::vector<Tile> tiles(grid.count());
    for (size_t i = 0; i < ranges.size(); ++i) {
      for (const TileRun& run : memory.batches[i]->runs) {
        ++tiles[run.tile].runs;
        tiles[run.tile].triangles += run.count;
      }
    }
    std::vector<uint32_t> used;
    uint32_t count = 0;
    for (uint32_t tile = 0; tile < tiles.size(); ++tile) {
      if (tiles[tile].runs == 0 && !clears) continue;
      used.push_back(tile);
      tiles[tile].first = count;
      count += tiles[tile].runs;
    }
    runs.resize(count);
    std::vector<uint32_t> filled(grid.count());
    for (size_t i = 0; i < ranges.size(); ++i) {
      const Batch& batch = *memory.batches[i];
      for (const TileRun& run : batch.runs) {
        runs[tiles[run.tile].first + filled[run.tile]++] = {&batch, run.first, run.count};
      }
    }
    // The largest first, so that threads end together.
    std::stable_sort(used.begin(), used.end(), [&](uint32_t a, uint32_t b) {
      return tiles[a].triangles > tiles[b].triangles;
    });
    jobs.clear();
    for (const uint32_t tile : used) {
      const uint32_t in_slice = tile % (grid.columns * grid.rows);
      TileJob job;
      job.targets = &targets;
      job.plans = plans.data();
      job.runs = runs.data() + tiles[tile].first;
      job.run_count = tiles[tile].runs;
      job.x = in_slice % grid.columns * kTileSize;
      job.y = in_slice / grid.columns * kTileSize;
      job.slice = tile / (grid.columns * grid.rows);
      job.width = extent.width;
      job.height = extent.height;
      job.observation = observation;
      jobs.push_back(job);
    }
  }

  void draw_tiles() {
    workers.run(static_cast<uint32_t>(jobs.size()), [&](uint32_t task, ShaderThread& thread) {
      TileScratch* scratch = memory.tiles.take();
      if (targets.samples > 1 && scratch->multisampled == nullptr) {
        scratch->multisampled = std::make_shared<MultisampleScratch>();
      }
      // Tiles with several samples note sums themselves, and no pixels one by one.
      if (observation == nullptr || targets.samples > 1) {
        memory.draw_tile(jobs[task], *scratch, thread);
      } else {
        scratch->observer = memory.observers.take();
        draw_tile_observed(jobs[task], *scratch, thread);
        memory.observers.give_back(scratch->observer);
        scratch->observer = nullptr;
      }
      memory.tiles.give_back(scratch);
    });
  }
};

Rasterizer::Rasterizer(const RasterizerOptions& options) : memory_(std::make_unique<Memory>()) {
  memory_->options = options;
  memory_->draw_tile = draw_tile_function(options);
}
Rasterizer::~Rasterizer() = default;

void Rasterizer::draw(const Targets& targets, std::span<const Draw> draws, Workers& workers,
                      Observation* observation) {
  const Extent extent = common_extent(targets);
  memory_->front_ends.give_back_all();
  memory_->tiles.give_back_all();
  memory_->observers.give_back_all();
  const auto tiles = [](uint32_t size) {
    return (size + uint32_t{kTileSize} - 1) / uint32_t{kTileSize};
  };
  Pass pass{*memory_,   targets, draws,
            workers,    extent,  {tiles(extent.width), tiles(extent.height), extent.slices},
            observation};
  pass.make_plans();
  pass.run();
}

}  // namespace kaamos::raster
