// SPDX-License-Identifier: MIT
#include "runtime/embree/draw.h"

#include <algorithm>
#include <utility>

#include "runtime/backend/backend.h"
#include "runtime/embree/texture.h"
#include "runtime/raster/clear.h"

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

runtime::WorkCounts work_of(const runtime::DrawCounts& draw) {
  runtime::WorkCounts counts;
  counts.samples = draw.written;
  rtapi::QueryDataPipelineStatistics& statistics = counts.statistics;
  statistics.IAPrimitives = draw.assembled;
  statistics.VSInvocations = draw.vertices;
  statistics.GSInvocations = draw.geometry_calls;
  statistics.GSPrimitives = draw.geometry_calls != 0 ? draw.triangles : 0;
  statistics.CInvocations = draw.triangles;
  statistics.CPrimitives = draw.triangles - draw.not_a_triangle - draw.outside;
  statistics.PSInvocations = draw.shaded;
  return counts;
}

}  // namespace

raster::Surface surface_of(const runtime::TargetView& view) {
  raster::Surface surface;
  if (view.texture == nullptr) return surface;
  const TextureMemory& memory = static_cast<const Texture&>(*view.texture).stored();
  const uint32_t element = view.is_volume ? 0 : view.first_slice;
  const TextureMemory::Subresource first = memory.subresource(view.mip, element);
  surface.texels = first.first;
  surface.row_pitch = first.row_pitch;
  surface.slice_pitch = view.is_volume ? first.slice_pitch : memory.array_pitch();
  if (view.is_volume) surface.texels += view.first_slice * first.slice_pitch;
  surface.width = view.width;
  surface.height = view.height;
  surface.slices = view.slice_count;
  surface.samples = memory.samples();
  surface.sample_pitch = memory.sample_pitch();
  surface.format = view.format;
  surface.read_only = view.read_only_depth;
  surface.read_only_stencil = view.read_only_stencil;
  return surface;
}

CountedOutcome DrawPass::draw(const runtime::DrawCommand& command, const std::string& label) {
  CountedOutcome outcome;
  if (!running_.empty() && (running_.size() == kMostDraws ||
                            running_.front().command.state->targets != command.state->targets ||
                            running_.front().command.linked->samples != command.linked->samples)) {
    outcome = flush();
    if (!outcome.status) return outcome;
  }
  if (running_.empty()) begin_pass(command.state->targets, command.linked->samples);
  RunningDraw& running = running_.emplace_back();
  running.command = command;
  running.label = label;
  if (observation_ != nullptr) running.number = observation_->next_draw++;
  begin_draw(environment_, running);
  draws_.push_back(resolve(running.command));
  draws_.back().counted = counts_work_;
  return outcome;
}

CountedOutcome DrawPass::clear(const runtime::ClearTargetCommand& command) {
  CountedOutcome outcome;
  if (!running_.empty()) outcome = flush();
  const auto same_texture = [&](const auto& other) {
    return other.view.texture == command.view.texture;
  };
  if (std::any_of(clears_.begin(), clears_.end(), same_texture)) clear_now();
  clears_.push_back(command);
  return outcome;
}

void DrawPass::clear_now() {
  for (const auto& command : clears_) raster::clear(surface_of(command.view), command);
  clears_.clear();
}

void DrawPass::begin_pass(const runtime::DrawTargets& views, uint32_t samples) {
  targets_ = {};
  targets_.samples = samples;
  for (uint32_t i = 0; i < views.color_count; ++i) targets_.color[i] = surface_of(views.color[i]);
  targets_.depth = surface_of(views.depth);
  const auto take = [&](const runtime::ClearTargetCommand& command) {
    if (command.depth_stencil) {
      return command.view == views.depth && raster::set_cleared(targets_.depth, command);
    }
    for (uint32_t i = 0; i < views.color_count; ++i) {
      if (command.view == views.color[i]) return raster::set_cleared(targets_.color[i], command);
    }
    return false;
  };
  std::erase_if(clears_, take);
  clear_now();
}

void DrawPass::begin_observation(raster::Observation& noted) {
  noted.draws = std::vector<raster::Observation::OfDraw>(running_.size());
  if (observation_ == nullptr) return;
  runtime::DrawObservation& all = *observation_;
  uint32_t width = 0;
  uint32_t height = 0;
  const auto take = [&](const runtime::TargetView& view) {
    if (view.texture == nullptr) return;
    width = width == 0 ? view.width : std::min(width, view.width);
    height = height == 0 ? view.height : std::min(height, view.height);
  };
  const runtime::DrawTargets& views = running_.front().command.state->targets;
  for (uint32_t i = 0; i < views.color_count; ++i) take(views.color[i]);
  take(views.depth);
  for (size_t i = 0; i < running_.size(); ++i) {
    const uint32_t number = running_[i].number;
    noted.draws[i].number = number;
    if (number < all.first_draw || number - all.first_draw >= all.draw_count) continue;
    if (all.width == 0 && width != 0) {
      all.width = width;
      all.height = height;
      all.map.width = width;
      all.map.height = height;
      if (all.counts_pixels) all.map.pixels.resize(size_t{width} * height);
    }
    noted.draws[i].noted = width != 0 && width == all.width && height == all.height;
    ++(noted.draws[i].noted ? all.noted : all.left_out);
    if (noted.draws[i].noted && all.logs_pixel) {
      all.logged[number] = {running_[i].command.linked, running_[i].label};
    }
  }
  if (all.counts_pixels) noted.map = &all.map;
  if (all.logs_pixel) noted.log = &all.log;
}

void DrawPass::end_observation(const raster::Observation& noted) {
  for (size_t i = 0; counts_work_ && i < running_.size(); ++i) {
    counted_.add(work_of(noted.draws[i].counts));
  }
  if (environment_.context->observer == nullptr) return;
  for (size_t i = 0; i < running_.size(); ++i) {
    environment_.context->observer->drawn(running_[i].command, noted.draws[i].counts);
  }
}

CountedOutcome DrawPass::flush() {
  CountedOutcome outcome;
  clear_now();
  if (running_.empty()) return outcome;
  DrawWorkers workers(environment_, running_);
  raster::Observation noted;
  const bool observed =
      observation_ != nullptr || environment_.context->observer != nullptr || counts_work_;
  if (observed) begin_observation(noted);
  rasterizer_.draw(targets_, draws_, workers, observed ? &noted : nullptr);
  if (observed) end_observation(noted);
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
