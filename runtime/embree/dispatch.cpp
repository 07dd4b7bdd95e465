// SPDX-License-Identifier: MIT
#include "runtime/embree/dispatch.h"

#include <algorithm>

#include "runtime/backend/backend.h"
#include "runtime/backend/errors.h"
#include "runtime/backend/printing.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/parallel.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/services.h"
#include "runtime/errors/text.h"
#include "runtime/shader/float_mode.h"
#include "runtime/shader/texture/format_codec.h"

namespace kaamos::embree {
namespace {

// 16 x 16 cells keep the rays of a tile close together; flat grids get tiles with the same number
// of cells.
constexpr uint32_t kTileEdge = 16;
constexpr uint32_t kTileCells = kTileEdge * kTileEdge;

struct Grid {
  uint32_t size[3];
  uint32_t tile[3];
  uint32_t tiles[3];

  Grid(uint32_t width, uint32_t height, uint32_t depth) : size{width, height, depth} {
    tile[0] = std::min(width, height < kTileEdge ? kTileCells / std::max(height, 1u) : kTileEdge);
    tile[1] = std::min(height, kTileCells / std::max(tile[0], 1u));
    tile[2] = std::min(depth, kTileCells / std::max(tile[0] * tile[1], 1u));
    for (int i = 0; i < 3; ++i) {
      tiles[i] = size[i] == 0 ? 0 : (size[i] - 1) / std::max(tile[i], 1u) + 1;
    }
  }
  uint64_t tile_count() const { return uint64_t{tiles[0]} * tiles[1] * tiles[2]; }
};

struct Tile {
  Worker* worker;
  const Grid* grid;
  const ShaderRecord* record;
  uint32_t first[3];
  uint32_t last[3];  // one past
};

// Prefetches the texels of a row of invocations while the row above it runs: the rows of a tile are
// too short for the processor to predict them. Saves 3 % of frame/trace-shade.
void fetch_row(const std::vector<Picture>& pictures, const Tile& tile, uint32_t y) {
  constexpr uint64_t kLine = 64;
  for (const Picture& picture : pictures) {
    const uint8_t* row = picture.texels + uint64_t{y} * picture.row_pitch;
    const uint8_t* end = row + uint64_t{tile.last[0]} * picture.texel_bytes;
    for (const uint8_t* at = row + uint64_t{tile.first[0]} * picture.texel_bytes; at < end;
         at += kLine) {
      __builtin_prefetch(at);
    }
  }
}

void run_tile(void* argument) {
  const Tile& tile = *static_cast<const Tile*>(argument);
  const Shader& shader = tile.record->target->shader;
  Worker& worker = *tile.worker;
  const RunningShader running(worker, shader);
  const auto entry = shader.as<shader::RayGenerationFn>();
  const shader::RayGenerationRowFn row = shader.linked->code->row;
  shader::Invocation invocation;
  invocation.dispatch = &worker.dispatch->abi;
  invocation.slots = shader.slots;
  invocation.local_arguments = tile.record->local_arguments();
  invocation.backend = &worker;
  invocation.bound = worker.bound[shader.number];
  worker.index = invocation.index;
  for (uint32_t z = tile.first[2]; z < tile.last[2]; ++z) {
    invocation.index[2] = z;
    for (uint32_t y = tile.first[1]; y < tile.last[1]; ++y) {
      invocation.index[1] = y;
      if (y + 1 < tile.last[1]) fetch_row(worker.dispatch->pictures, tile, y + 1);
      if (row != nullptr) {
        invocation.index[0] = tile.first[0];
        row(invocation, tile.last[0] - tile.first[0]);
        continue;
      }
      for (uint32_t x = tile.first[0]; x < tile.last[0]; ++x) {
        invocation.index[0] = x;
        entry(invocation);
      }
    }
  }
  worker.index = nullptr;
}

void run_tiles(RunningDispatch& dispatch, const Grid& grid, const ShaderRecord& record,
               uint64_t begin, uint64_t end) {
  const shader::FloatMode float_mode;
  Worker worker;
  begin_worker(dispatch, worker);
  for (uint64_t i = begin; i < end && !dispatch.ends(); ++i) {
    Tile tile = {&worker, &grid, &record, {}, {}};
    const uint64_t position[3] = {i % grid.tiles[0], i / grid.tiles[0] % grid.tiles[1],
                                  i / grid.tiles[0] / grid.tiles[1]};
    for (int axis = 0; axis < 3; ++axis) {
      tile.first[axis] = static_cast<uint32_t>(position[axis]) * grid.tile[axis];
      tile.last[axis] = std::min(grid.size[axis], tile.first[axis] + grid.tile[axis]);
    }
    if (!run_guarded(worker, run_tile, &tile)) record_removal(worker);
  }
  end_worker(worker);
}

// The only record of the ray generation table: no stride, no index. [DXR: Shader tables]
ShaderRecord ray_generation_record(const RaytracingPipeline& pipeline,
                                   const rtapi::GpuVirtualAddressRange& range,
                                   RecordProblems* problems) {
  const RecordTable table(range.StartAddress, std::max<uint64_t>(range.SizeInBytes, 32), 0,
                          RecordKind::kRayGeneration, pipeline.lookup(), problems);
  return table.at(0);
}

RecordTable table_of(const RaytracingPipeline& pipeline,
                     const rtapi::GpuVirtualAddressRangeAndStride& range, RecordKind kind,
                     RecordProblems* problems) {
  return RecordTable(range.StartAddress, range.SizeInBytes, range.StrideInBytes, kind,
                     pipeline.lookup(), problems);
}

void warn_of_records(const char* name, runtime::RecordKind kind, const RecordTable& table,
                     const RecordProblems& problems, const char* label, CountedOutcome& result) {
  const auto which = static_cast<size_t>(kind);
  result.missing.past_the_end[which] = problems.out_of_bounds != RecordProblems::kNone;
  result.missing.unknown[which] = problems.unknown != RecordProblems::kNone;
  const std::string where = std::string(" (") + label + ").";
  if (const uint64_t index = problems.out_of_bounds; index != RecordProblems::kNone) {
    result.warnings.push_back({runtime::Id::kRecordOutOfBounds,
                               std::string(name) + " table: record " + std::to_string(index) +
                                   " was reached, but the table has " +
                                   std::to_string(table.count()) + "; nothing ran for it" + where +
                                   " Do SizeInBytes, StrideInBytes and the index terms agree?"});
  }
  if (const uint64_t index = problems.unknown; index != RecordProblems::kNone) {
    result.warnings.push_back(
        {runtime::Id::kRecordUnknown,
         std::string(name) + " table: record " + std::to_string(index) +
             " holds no identifier of this kind from this pipeline; nothing ran for it" + where +
             " Was it written, and with an identifier of this state object?"});
  }
}

// Looks up what every shader of the pipeline has bound.
void bind_shaders(const RaytracingPipeline& pipeline, RunningDispatch& dispatch) {
  size_t count = 0;
  for (const auto* shader : pipeline.shaders()) count += shader->slots.size();
  dispatch.bound_resources.resize(count);
  shader::BoundResource* place = dispatch.bound_resources.data();
  shader::Invocation invocation;
  invocation.dispatch = &dispatch.abi;
  for (const auto* shader : pipeline.shaders()) {
    const shader::ExportDesc& code = *shader->code;
    dispatch.bound.push_back(place);
    invocation.slots = shader->slots.data();
    if ((code.flags & shader::kExportReadsBound) != 0) {
      shader::bind(invocation, code.bindings, code.binding_count, place);
    }
    place += shader->slots.size();
  }
}

// Finds them among everything that the shaders have bound.
void find_pictures(RunningDispatch& dispatch) {
  const uint32_t* size = dispatch.abi.dimensions;
  for (const shader::BoundResource& bound : dispatch.bound_resources) {
    if (bound.direct_format == 0 || bound.width != size[0] || bound.height != size[1]) continue;
    const bool is_known =
        std::any_of(dispatch.pictures.begin(), dispatch.pictures.end(),
                    [&](const Picture& picture) { return picture.texels == bound.texels; });
    if (is_known) continue;
    dispatch.pictures.push_back(
        {bound.texels, bound.row_pitch, shader::format_codec(bound.direct_format).bytes});
  }
}

struct RecordRead {
  const RaytracingPipeline* pipeline;
  const rtapi::GpuVirtualAddressRange* range;
  RecordProblems* problems;
  ShaderRecord record;
};

}  // namespace

void begin_dispatch(const DispatchEnvironment& environment, const runtime::RootBindings& state,
                    RunningDispatch& dispatch) {
  dispatch.memory = environment.memory;
  if (environment.context != nullptr) dispatch.stopped = environment.context->stopped;
  if (environment.context != nullptr && environment.context->reporter != nullptr) {
    dispatch.context = environment.context;
    dispatch.ranges = environment.context->addresses->ranges();
    dispatch.abi.ranges_begin = dispatch.ranges.data();
    dispatch.abi.ranges_end = dispatch.ranges.data() + dispatch.ranges.size();
  }
  shader::DispatchConstants& abi = dispatch.abi;
  abi.services = &services();
  abi.root_arguments = state.root_arguments->bytes.data();
  abi.backend = &dispatch;
  abi.direct_texels = true;
  const auto range = [](const std::shared_ptr<runtime::BackendBuffer>& heap,
                        const shader::Descriptor*& begin, const shader::Descriptor*& end) {
    if (heap == nullptr) return;
    begin = reinterpret_cast<const shader::Descriptor*>(heap->host());
    end = begin + heap->size_bytes() / sizeof(shader::Descriptor);
  };
  range(state.view_heap, abi.view_heap_begin, abi.view_heap_end);
  range(state.sampler_heap, abi.sampler_heap_begin, abi.sampler_heap_end);
  abi.prints = runtime::view_of_prints(state);
}

CountedOutcome end_dispatch(RunningDispatch& dispatch) {
  CountedOutcome result;
  const std::lock_guard lock(dispatch.mutex);
  result.counters = dispatch.counters;
  result.reached = std::move(dispatch.reached);
  if (const uint64_t address = dispatch.unknown_structure; address != 0) {
    result.warnings.push_back(
        {runtime::Id::kNoTopLevel, "there is no top level at address " + errors::hex(address) +
                                       "; the rays missed (" + dispatch.label +
                                       "). Was one built, and not overwritten or freed?"});
  }
  if (dispatch.far_rays.count != 0) {
    result.warnings.push_back(
        {runtime::Id::kRayOutOfRange, dispatch.far_rays.message(dispatch.label)});
  }
  const RecordTable one_record;
  const auto warn = [&](const char* name, runtime::RecordKind kind, const RecordTable& table,
                        const RecordProblems& problems) {
    warn_of_records(name, kind, table, problems, dispatch.label, result);
  };
  warn("hit group", runtime::RecordKind::kHitGroup, dispatch.hit_table, dispatch.hit_problems);
  warn("miss", runtime::RecordKind::kMiss, dispatch.miss_table, dispatch.miss_problems);
  warn("callable", runtime::RecordKind::kCallable, dispatch.callable_table,
       dispatch.callable_problems);
  warn("ray generation", runtime::RecordKind::kRayGeneration, one_record,
       dispatch.ray_generation_problems);
  if (dispatch.removed) {
    result.status =
        runtime::make_error(runtime::removal_id(dispatch.removal.reason), dispatch.removal.text);
  }
  return result;
}

void begin_worker(RunningDispatch& dispatch, Worker& worker) {
  dispatch.begun.load(std::memory_order_acquire);
  worker.dispatch = &dispatch;
  worker.bound = dispatch.bound.data();
  worker.stack_left = dispatch.stack_bytes;
}

void end_worker(Worker& worker) {
  const std::lock_guard lock(worker.dispatch->mutex);
  worker.dispatch->counters.add(worker.counters);
  worker.dispatch->far_rays.add(worker.far_rays);
}

CountedOutcome dispatch_rays(const DispatchEnvironment& environment,
                             const runtime::DispatchRaysCommand& command,
                             const std::string& label) {
  const auto& pipeline = static_cast<const RaytracingPipeline&>(*command.pipeline);
  const rtapi::DispatchRaysDesc& desc = command.desc;
  RunningDispatch dispatch;
  begin_dispatch(environment, command.state, dispatch);
  dispatch.tables = &desc;
  dispatch.abi.dimensions[0] = desc.Width;
  dispatch.abi.dimensions[1] = desc.Height;
  dispatch.abi.dimensions[2] = desc.Depth;
  dispatch.hit_table =
      table_of(pipeline, desc.HitGroupTable, RecordKind::kHitGroup, &dispatch.hit_problems);
  dispatch.miss_table =
      table_of(pipeline, desc.MissShaderTable, RecordKind::kMiss, &dispatch.miss_problems);
  dispatch.callable_table = table_of(pipeline, desc.CallableShaderTable, RecordKind::kCallable,
                                     &dispatch.callable_problems);
  dispatch.max_recursion_depth = pipeline.linked().max_recursion_depth;
  dispatch.abi.max_recursion_depth = dispatch.max_recursion_depth;
  dispatch.pipeline_flags = runtime::ray_flags_of(pipeline.linked().flags);
  if (command.pipeline_stack_bytes != 0) dispatch.stack_bytes = command.pipeline_stack_bytes;
  dispatch.label = label.c_str();

  // The tables may be anywhere, so even the first read of one is guarded.
  RecordRead read = {&pipeline,
                     &desc.RayGenerationShaderRecord,
                     &dispatch.ray_generation_problems,
                     {&kNothing, nullptr}};
  Worker worker;
  worker.dispatch = &dispatch;
  const auto read_record = [](void* argument) {
    auto& r = *static_cast<RecordRead*>(argument);
    r.record = ray_generation_record(*r.pipeline, *r.range, r.problems);
  };
  if (!run_guarded(worker, read_record, &read)) record_removal(worker);
  const Grid grid(desc.Width, desc.Height, desc.Depth);
  // A NULL ray generation shader runs nothing.
  if (!read.record.target->shader.runs() || grid.tile_count() == 0) {
    return end_dispatch(dispatch);
  }
  bind_shaders(pipeline, dispatch);
  find_pictures(dispatch);
  dispatch.begun.store(true, std::memory_order_release);
  parallel_ranges(*environment.arena, grid.tile_count(), [&](uint64_t begin, uint64_t end) {
    run_tiles(dispatch, grid, read.record, begin, end);
  });
  return end_dispatch(dispatch);
}

}  // namespace kaamos::embree
