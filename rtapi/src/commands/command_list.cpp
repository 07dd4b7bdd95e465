// SPDX-License-Identifier: MIT
//
// State and dispatches of command lists. Root arguments, draws, acceleration structures and copies
// are in files of their own.
#include <rtapi/command_list.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/pipelines/pipeline_state_impl.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "runtime/backend/dispatch_checks.h"

namespace rtapi {

namespace detail {

namespace {

// Tells whether D3D12's runtimes drop or ignore such a call, and Close() says nothing of it.
bool is_dropped(ErrorId id) {
  const uint32_t number = id.number;
  const auto between = [number](uint32_t first, uint32_t last) {
    return number >= first && number <= last;
  };
  return between(700, 719) || number == 731 || between(740, 743) || number == 745 ||
         between(802, 805) || between(807, 816) || number == 822 || number == 824;
}

}  // namespace

void CommandListImpl::fail(Error error) {
  if (device->desc.InvalidCalls == InvalidCalls::kDropCall && is_dropped(error.id)) {
    return device->report(MessageSeverity::kError, error);
  }
  errors.push_back(std::move(error));
}

bool CommandListImpl::check_open(const char* call) {
  if (open) return true;
  fail(make_error(Id::kListNotOpen, call, " on a closed command list; call Reset first"));
  return false;
}

void CommandListImpl::use(const char* call, GpuVirtualAddress address, std::string role) {
  MemoryUse use = use_of(*device, address, std::move(role));
  if (use.address == 0) return;
  use.call = call;
  use.command = commands->size();
  uses->push_back(std::move(use));
}

runtime::RootBindings CommandListImpl::snapshot(const char* call, const RootState& root) {
  for (const auto& [parameter, view] : root.views) {
    MemoryUse& use = uses->emplace_back(view);
    use.call = call;
    use.command = commands->size();
  }
  runtime::RootBindings state;
  state.root_arguments = root.arguments;
  if (view_heap) state.view_heap = view_heap.impl()->memory;
  if (sampler_heap) state.sampler_heap = sampler_heap.impl()->memory;
  state.prints = device->prints();
  state.root_signature = root.signature;
  if (const auto& signature = root.signature.impl()) {
    state.argument_offsets = {signature, &signature->offsets};
  }
  state.set_parameters = root.set_parameters;
  state.forgotten_parameters = root.forgotten_parameters;
  return state;
}

const StateObjectImpl* CommandListImpl::rays_pipeline(const char* call) {
  if (!raytracing_pipeline) {
    fail(make_error(Id::kPipelineNotSet, call,
                    " without a ray tracing pipeline; call SetPipelineState1 first"));
    return nullptr;
  }
  const StateObjectImpl& pipeline = *raytracing_pipeline.impl();
  // At least one ray generation shader must match the root signature that is set. Which of them
  // runs is known only on the GPU: its identifier is in GPU memory.
  const auto& globals = pipeline.global_root_signatures;
  const bool fits =
      globals.empty() || std::any_of(globals.begin(), globals.end(), [&](const RootSignature& g) {
        return !g || same_definition(g, compute.signature);
      });
  if (fits) return &pipeline;
  fail(
      make_error(Id::kPipelineRootSignature, call, ": ",
                 compute.signature
                     ? "the compute root signature does not match any ray generation shader of the "
                       "pipeline"
                     : "no compute root signature is set",
                 "; call SetComputeRootSignature with the state object's global root signature"));
  return nullptr;
}

namespace {

// Returns the pipeline that is set if it is of the kind and has the root signature; else null.
const PipelineStateImpl* fit_pipeline(CommandListImpl& list, const char* call, bool graphics) {
  const char* const kind = graphics ? "graphics" : "compute";
  const PipelineStateImpl* pipeline = list.pipeline_state.impl().get();
  if (!pipeline || (pipeline->graphics != nullptr) != graphics) {
    list.fail(make_error(Id::kPipelineNotSet, call, " without a ", kind,
                         " pipeline; call SetPipelineState first"));
    return nullptr;
  }
  const RootSignature& set = graphics ? list.graphics.signature : list.compute.signature;
  if (same_definition(pipeline->root_signature, set)) return pipeline;
  list.fail(make_error(
      Id::kPipelineRootSignature, call, ": ",
      set ? concat("the ", kind, " root signature is not that of pipeline ")
          : concat("no ", kind, " root signature is set, but one is needed by pipeline "),
      in_quotes(pipeline->name)));
  // Drivers go by the pipeline's registers, if the arguments lie in the same way.
  const bool goes_on = list.device->desc.InvalidCalls == InvalidCalls::kDropCall &&
                       same_arguments(pipeline->root_signature, set);
  return goes_on ? pipeline : nullptr;
}

}  // namespace

const PipelineStateImpl* CommandListImpl::compute_pipeline(const char* call) {
  return fit_pipeline(*this, call, false);
}
const PipelineStateImpl* CommandListImpl::graphics_pipeline(const char* call) {
  return fit_pipeline(*this, call, true);
}

namespace {

// Turns a rule that the host's arguments break into its error.
Status check_rules(const runtime::DispatchProblem& problem) {
  switch (problem.fault) {
    case runtime::DispatchFault::kNone:
      return {};
    case runtime::DispatchFault::kTableLayout:
      return make_error(Id::kShaderTableLayout, problem.text);
    case runtime::DispatchFault::kTableMemory:
      return make_error(Id::kShaderTableMemory, problem.text);
    case runtime::DispatchFault::kTooLarge:
      break;
  }
  return make_error(Id::kDispatchTooLarge, problem.text);
}

}  // namespace

}  // namespace detail

using namespace detail;

namespace {
const std::vector<Error> kNoErrors;
}

Status CommandList::Reset() {
  if (!impl_) return make_error(Id::kNullHandle, "Reset on an empty command list handle");
  if (Status s = impl_->device->removed(); !s.ok()) return s;
  CommandListImpl fresh;
  fresh.device = impl_->device;
  *impl_ = std::move(fresh);
  return {};
}

void CommandList::ClearState(const PipelineState& pipeline) {
  if (!impl_ || !impl_->check_open("ClearState")) return;
  impl_->view_heap = {};
  impl_->sampler_heap = {};
  impl_->compute = {};
  impl_->graphics = {};
  impl_->pipeline_state = {};
  impl_->raytracing_pipeline = {};
  impl_->draw_state = std::make_shared<runtime::DrawState>();
  impl_->target_uses.clear();
  impl_->input_uses.clear();
  if (impl_->predicated) SetPredication({}, 0, PredicationOp::kEqualZero);
  if (pipeline) SetPipelineState(pipeline);
}

Status CommandList::Close() {
  if (!impl_) return make_error(Id::kNullHandle, "Close on an empty command list handle");
  if (!impl_->open) return make_error(Id::kListNotOpen, "Close on a closed command list");
  if (impl_->open_events > 0) {
    impl_->fail(
        make_error(Id::kEvents, impl_->open_events, " calls of BeginEvent have no EndEvent"));
  }
  if (!impl_->open_queries.empty()) {
    const auto& query = impl_->open_queries.front();
    impl_->fail(make_error(Id::kQuery, "query ", query.index, " of ",
                           named("query heap", query.heap.GetDesc().Name),
                           " was begun and not ended; call EndQuery for it before Close"));
  }
  impl_->open = false;
  if (impl_->errors.empty()) return {};
  return impl_->errors.front();
}

const std::vector<Error>& CommandList::GetErrors() const {
  return impl_ ? impl_->errors : kNoErrors;
}
bool CommandList::is_open() const {
  return impl_ && impl_->open;
}

void CommandList::SetDescriptorHeaps(std::span<const DescriptorHeap> heaps) {
  if (!impl_ || !impl_->check_open("SetDescriptorHeaps")) return;
  DescriptorHeap views, samplers;
  for (const DescriptorHeap& heap : heaps) {
    if (Status s = CheckHandle(impl_->device, heap, "SetDescriptorHeaps: a heap"); !s.ok()) {
      return impl_->fail(s.error());
    }
    const DescriptorHeapDesc& desc = heap.GetDesc();
    if (!HasAny(desc.Flags, DescriptorHeapFlags::kShaderVisible)) {
      return impl_->fail(make_error(Id::kSetHeaps, named("descriptor heap", desc.Name),
                                    " was created without kShaderVisible"));
    }
    DescriptorHeap& slot = desc.Type == DescriptorHeapType::kSampler ? samplers : views;
    if (slot) {
      return impl_->fail(
          make_error(Id::kSetHeaps, named("descriptor heap", desc.Name),
                     " is the second heap of its type; only one of each type can be set"));
    }
    slot = heap;
  }
  impl_->view_heap = views;
  impl_->sampler_heap = samplers;
}

void CommandList::SetPipelineState(const PipelineState& pipeline) {
  if (!impl_ || !impl_->check_open("SetPipelineState")) return;
  if (Status s = CheckHandle(impl_->device, pipeline, "SetPipelineState: the pipeline"); !s.ok()) {
    return impl_->fail(s.error());
  }
  impl_->pipeline_state = pipeline;
  impl_->raytracing_pipeline = {};
}

void CommandList::SetPipelineState1(const StateObject& pipeline) {
  if (!impl_ || !impl_->check_open("SetPipelineState1")) return;
  if (Status s = CheckHandle(impl_->device, pipeline, "SetPipelineState1: the state object");
      !s.ok()) {
    return impl_->fail(s.error());
  }
  if (pipeline.GetType() != StateObjectType::kRaytracingPipeline) {
    return impl_->fail(make_error(Id::kPipelineNotSet,
                                  "SetPipelineState1 takes a ray tracing pipeline, but this is a "
                                  "collection"));
  }
  impl_->raytracing_pipeline = pipeline;
  impl_->pipeline_state = {};
}

void CommandList::DispatchRays(const DispatchRaysDesc& desc) {
  if (!impl_ || !impl_->check_open("DispatchRays")) return;
  const StateObjectImpl* pipeline = impl_->rays_pipeline("DispatchRays");
  if (!pipeline) return;
  if (Status s = check_rules(runtime::check_dispatch_rays(impl_->device->addresses, desc));
      !s.ok()) {
    return impl_->fail(s.error());
  }
  const std::pair<const char*, GpuVirtualAddressRangeAndStride> tables[] = {
      {"RayGenerationShaderRecord",
       {desc.RayGenerationShaderRecord.StartAddress, desc.RayGenerationShaderRecord.SizeInBytes,
        0}},
      {"MissShaderTable", desc.MissShaderTable},
      {"HitGroupTable", desc.HitGroupTable},
      {"CallableShaderTable", desc.CallableShaderTable}};
  for (const auto& [name, table] : tables) {
    if (table.SizeInBytes != 0) impl_->use("DispatchRays", table.StartAddress, name);
  }
  impl_->record(runtime::DispatchRaysCommand{pipeline->pipeline,
                                             impl_->snapshot("DispatchRays", impl_->compute), desc,
                                             pipeline->stack_bytes.load(), pipeline->linked});
}

void CommandList::Dispatch(uint32_t x, uint32_t y, uint32_t z) {
  if (!impl_ || !impl_->check_open("Dispatch")) return;
  const PipelineStateImpl* pipeline = impl_->compute_pipeline("Dispatch");
  if (!pipeline) return;
  runtime::DispatchCommand command;
  command.groups[0] = x;
  command.groups[1] = y;
  command.groups[2] = z;
  if (Status s = check_rules(runtime::check_dispatch(command.groups)); !s.ok()) {
    return impl_->fail(s.error());
  }
  command.pipeline = pipeline->pipeline;
  command.linked = pipeline->linked;
  command.state = impl_->snapshot("Dispatch", impl_->compute);
  impl_->record(std::move(command));
}

void CommandList::BeginEvent(std::string name) {
  if (!impl_ || !impl_->check_open("BeginEvent")) return;
  ++impl_->open_events;
  impl_->record(runtime::EventCommand{true, std::move(name)});
}

void CommandList::EndEvent() {
  if (!impl_ || !impl_->check_open("EndEvent")) return;
  if (impl_->open_events == 0) {
    return impl_->fail(make_error(Id::kEvents, "EndEvent without BeginEvent"));
  }
  --impl_->open_events;
  impl_->record(runtime::EventCommand{false, {}});
}

Result<CommandList> Device::CreateCommandList() const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateCommandList on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  auto list = std::make_shared<CommandListImpl>();
  list->device = impl_;
  return CommandList(std::move(list));
}

}  // namespace rtapi
