// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/command_list.h>

#include "rtapi/src/commands/memory_use.h"
#include "rtapi/src/commands/root_state.h"
#include "rtapi/src/device/device_impl.h"
#include "runtime/backend/commands.h"

namespace rtapi::detail {

using CommandVector = std::vector<runtime::Command>;

struct StateObjectImpl;
struct PipelineStateImpl;

// In CommandListImpl::input_uses.
inline constexpr uint32_t kIndexBufferSlot = kIAVertexInputResourceSlotCount;

struct CommandListImpl {
  std::shared_ptr<DeviceImpl> device;
  bool open = true;
  std::vector<Error> errors;
  // Shared with queues, so that a list can be reset while its work still waits for a fence.
  std::shared_ptr<CommandVector> commands = std::make_shared<CommandVector>();
  std::shared_ptr<MemoryUses> uses = std::make_shared<MemoryUses>();  // of all commands

  // State that the application sets.
  DescriptorHeap view_heap;
  DescriptorHeap sampler_heap;
  RootState compute;  // of dispatches of both kinds
  RootState graphics;
  PipelineState pipeline_state;  // compute or graphics; at most one of the two is set
  StateObject raytracing_pipeline;
  std::shared_ptr<runtime::DrawState> draw_state = std::make_shared<runtime::DrawState>();
  // The resources that draws refer to and no draw has used yet: targets, and buffers by slot, where
  // the index buffer has the slot behind those of vertices. They are looked up when they are set,
  // since their memory may be freed, and taken again, before the draw.
  std::vector<MemoryUse> target_uses;
  std::map<uint32_t, MemoryUse> input_uses;
  uint32_t open_events = 0;
  // Queries that have been begun and not ended.
  struct OpenQuery {
    QueryHeap heap;
    QueryType type;
    uint32_t index;
  };
  std::vector<OpenQuery> open_queries;
  bool predicated = false;  // a predicate is set

  // Keeps the error, which Close() reports as in D3D12, or reports it and goes on, see
  // InvalidCalls.
  void fail(Error error);
  // Returns whether recording is possible; if not, keeps an error.
  bool check_open(const char* call);
  // For the next command that is recorded, and what it uses of memory.
  runtime::RootBindings snapshot(const char* call, const RootState& root);
  // Returns state that no recorded draw shares, so that it can be written.
  runtime::DrawState& writable_draw_state();
  void set_stencil_references(uint32_t front, uint32_t back);
  // The next command uses the memory at an address; one that is in no live buffer is ignored.
  void use(const char* call, GpuVirtualAddress address, std::string role);
  // Returns the pipeline if one is set and fits the root signature; else null, with an error kept.
  const StateObjectImpl* rays_pipeline(const char* call);
  const PipelineStateImpl* compute_pipeline(const char* call);
  const PipelineStateImpl* graphics_pipeline(const char* call);
  // The same for a draw, which needs a topology, too, and uses buffers and targets.
  const PipelineStateImpl* draw_pipeline(const char* call, bool indexed);

  // Built in place, because gcc 12 at -O3 warns that members of a temporary variant are
  // uninitialised.
  template <class T>
  void record(T command) {
    commands->emplace_back(std::in_place_type<T>, std::move(command));
  }
};

}  // namespace rtapi::detail
