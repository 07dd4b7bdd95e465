// SPDX-License-Identifier: MIT
#include "runtime/embree/draw.h"

#include <utility>

#include "runtime/embree/texture.h"

namespace kaamos::embree {
namespace {

// The list holds the buffer while it executes, and the view was checked when it was recorded.
std::span<const uint8_t> bytes_of(uint64_t address, uint64_t size_bytes) {
  if (address == 0) return {};
  return {reinterpret_cast<const uint8_t*>(address), size_bytes};
}

raster::Draw resolve(const runtime::DrawCommand& command) {
  raster::Draw draw;
  draw.linked = command.linked.get();
  draw.state = command.state.get();
  draw.indexed = command.indexed;
  draw.arguments = command.arguments;
  for (const runtime::LinkedElement& element : command.linked->elements) {
    const rtapi::VertexBufferView& view = command.state->vertex_buffers[element.slot];
    draw.vertex_buffers[element.slot] = bytes_of(view.BufferLocation, view.SizeInBytes);
  }
  const rtapi::IndexBufferView& indices = command.state->index_buffer;
  draw.indices = bytes_of(indices.BufferLocation, indices.SizeInBytes);
  return draw;
}

}  // namespace

raster::Surface surface_of(const runtime::TargetView& view) {
  raster::Surface surface;
  if (view.texture == nullptr) return surface;
  const TextureMemory& memory = static_cast<const Texture&>(*view.texture).stored();
  const TextureMemory::Subresource first = memory.subresource(view.mip, view.first_slice);
  surface.texels = first.first;
  surface.row_pitch = first.row_pitch;
  surface.slice_pitch = memory.array_pitch();
  surface.width = view.width;
  surface.height = view.height;
  surface.slices = view.slice_count;
  surface.format = view.format;
  surface.read_only = view.read_only_depth;
  return surface;
}

CountedOutcome DrawPass::draw(const runtime::DrawCommand& command, const std::string& label) {
  CountedOutcome outcome;
  if (!running_.empty() && (running_.size() == kMostDraws ||
                            running_.front().command.state->targets != command.state->targets)) {
    outcome = flush();
    if (!outcome.status) return outcome;
  }
  RunningDraw& running = running_.emplace_back();
  running.command = command;
  running.label = label;
  begin_draw(environment_, running);
  draws_.push_back(resolve(running.command));
  return outcome;
}

CountedOutcome DrawPass::flush() {
  CountedOutcome outcome;
  if (running_.empty()) return outcome;
  const runtime::DrawTargets& views = running_.front().command.state->targets;
  raster::Targets targets;
  for (uint32_t i = 0; i < views.color_count; ++i) targets.color[i] = surface_of(views.color[i]);
  targets.depth = surface_of(views.depth);
  DrawWorkers workers(environment_, running_);
  rasterizer_.draw(targets, draws_, workers);
  for (RunningDraw& draw : running_) {
    CountedOutcome one = end_dispatch(draw.dispatch);
    outcome.counters.add(one.counters);
    outcome.reached.insert(outcome.reached.end(), one.reached.begin(), one.reached.end());
    for (auto& warning : one.warnings) outcome.warnings.push_back(std::move(warning));
    if (outcome.status && !one.status) outcome.status = std::move(one.status);
  }
  running_.clear();
  draws_.clear();
  return outcome;
}

}  // namespace kaamos::embree
