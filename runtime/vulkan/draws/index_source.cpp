// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/index_source.h"

#include <cstring>

#include "runtime/backend/linked_graphics.h"

namespace kaamos::vulkan {
namespace {

using Cut = rtapi::IndexBufferStripCutValue;

bool is_small(const runtime::DrawCommand& command) {
  return command.state->index_buffer.Format == rtapi::Format::kR16Uint;
}

uint32_t bytes_of_index(const runtime::DrawCommand& command) {
  return is_small(command) ? 2 : 4;
}

uint64_t indices_in_view(const runtime::DrawCommand& command) {
  const rtapi::IndexBufferView& view = command.state->index_buffer;
  return view.BufferLocation == 0 ? 0 : view.SizeInBytes / bytes_of_index(command);
}

// Returns whether an index of the draw may end a strip. The cut value is compared as it is, so that
// 0xFFFFFFFF never does with indices of 16 bits. [RAS-05, RAS-06]
bool cuts(const runtime::DrawCommand& command) {
  const Cut cut = command.linked->strip_cut;
  if (!runtime::is_strip(command.state->topology)) return false;
  return cut == Cut::k0xFFFF || (cut == Cut::k0xFFFFFFFF && !is_small(command));
}

bool cuts_in_the_middle(const runtime::DrawCommand& command) {
  return cuts(command) && command.linked->strip_cut == Cut::k0xFFFF && !is_small(command);
}

bool reads_beyond(const runtime::DrawCommand& command) {
  const uint64_t end =
      uint64_t{command.arguments.StartIndexLocation} + command.arguments.IndexCountPerInstance;
  return end > indices_in_view(command);
}

}  // namespace

rtapi::Result<const GpuBuffer*> IndexMemory::get(Gpu& gpu, uint64_t size_bytes) {
  auto made = gpu.create_buffer(size_bytes, "indices of a draw", InitialContents::kAny);
  if (!made) return made.error();
  buffers_.push_back(std::move(*made));
  return buffers_.back().get();
}

bool needs_rewriting(const runtime::DrawCommand& command) {
  return command.indexed && (reads_beyond(command) || cuts_in_the_middle(command));
}

rtapi::Result<IndexSource> index_source(Gpu& gpu, const Memory& memory,
                                        const runtime::DrawCommand& command,
                                        IndexMemory& rewritten) {
  const rtapi::IndexBufferView& view = command.state->index_buffer;
  IndexSource source;
  source.type = is_small(command) ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32;
  source.restarts = cuts(command);
  source.first = command.arguments.StartIndexLocation;
  const GpuBuffer* buffer = memory.find(view.BufferLocation);
  const uint64_t offset = buffer == nullptr ? 0 : view.BufferLocation - buffer->address();
  if (!needs_rewriting(command)) {
    source.buffer = buffer->handle();
    source.offset = buffer->offset() + offset;
    return source;
  }
  const uint32_t bytes = bytes_of_index(command);
  const uint64_t count = command.arguments.IndexCountPerInstance;
  auto made = rewritten.get(gpu, count * bytes);
  if (!made) return made.error();
  const uint64_t there = indices_in_view(command);
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t place = source.first + i;
    uint32_t index = 0;
    if (place < there) std::memcpy(&index, buffer->host() + offset + place * bytes, bytes);
    if (cuts_in_the_middle(command) && index == 0xFFFF) index = UINT32_MAX;
    std::memcpy((*made)->host() + i * bytes, &index, bytes);
  }
  source.buffer = (*made)->handle();
  source.offset = (*made)->offset();
  source.first = 0;
  return source;
}

}  // namespace kaamos::vulkan
