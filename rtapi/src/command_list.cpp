// SPDX-License-Identifier: MIT
//
// State and dispatches of command lists. Acceleration structures and copies are in files of their
// own.
#include <rtapi/command_list.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/command_list_impl.h"
#include "rtapi/src/pipeline_state_impl.h"
#include "rtapi/src/root_signature_impl.h"
#include "rtapi/src/state_object_impl.h"
#include "runtime/backend/dispatch_checks.h"

namespace rtapi {

namespace detail {

bool CommandListImpl::CheckOpen(const char* call) {
  if (open) return true;
  Fail(MakeError(Id::kListNotOpen, call, " on a closed command list; call Reset first"));
  return false;
}

runtime::RootArguments& CommandListImpl::WritableArguments() {
  if (arguments.use_count() > 1) arguments = std::make_shared<runtime::RootArguments>(*arguments);
  return *arguments;
}

void CommandListImpl::ClearArgument(uint32_t offset_bytes, uint32_t size_bytes) {
  if (uint64_t{offset_bytes} + size_bytes > runtime::kRootArgumentBytes) return;
  std::memset(WritableArguments().bytes.data() + offset_bytes, 0, size_bytes);
}

void CommandListImpl::Use(const char* call, GpuVirtualAddress address, std::string role) {
  MemoryUse use = UseOf(*device, address, std::move(role));
  if (use.address == 0) return;
  use.call = call;
  use.command = commands->size();
  uses->push_back(std::move(use));
}

runtime::RootBindings CommandListImpl::Snapshot(const char* call) {
  for (const auto& [parameter, view] : root_views) {
    MemoryUse& use = uses->emplace_back(view);
    use.call = call;
    use.command = commands->size();
  }
  runtime::RootBindings state;
  state.root_arguments = arguments;
  if (view_heap) state.view_heap = view_heap.impl()->memory;
  if (sampler_heap) state.sampler_heap = sampler_heap.impl()->memory;
  state.root_signature = root_signature;
  return state;
}

const StateObjectImpl* CommandListImpl::RaysPipeline(const char* call) {
  if (!raytracing_pipeline) {
    Fail(MakeError(Id::kPipelineNotSet, call,
                   " without a ray tracing pipeline; call SetPipelineState1 first"));
    return nullptr;
  }
  const StateObjectImpl& pipeline = *raytracing_pipeline.impl();
  // At least one ray generation shader must match the root signature that is set. Which of them
  // runs is known only on the GPU: its identifier is in GPU memory.
  const auto& globals = pipeline.global_root_signatures;
  const bool fits =
      globals.empty() || std::any_of(globals.begin(), globals.end(), [&](const RootSignature& g) {
        return !g || SameDefinition(g, root_signature);
      });
  if (fits) return &pipeline;
  Fail(MakeError(Id::kPipelineRootSignature, call, ": ",
                 root_signature
                     ? "the compute root signature does not match any ray generation shader of the "
                       "pipeline"
                     : "no compute root signature is set",
                 "; call SetComputeRootSignature with the state object's global root signature"));
  return nullptr;
}

const PipelineStateImpl* CommandListImpl::ComputePipeline(const char* call) {
  if (!compute_pipeline) {
    Fail(MakeError(Id::kPipelineNotSet, call,
                   " without a compute pipeline; call SetPipelineState first"));
    return nullptr;
  }
  const PipelineStateImpl& pipeline = *compute_pipeline.impl();
  if (SameDefinition(pipeline.root_signature, root_signature)) return &pipeline;
  Fail(MakeError(Id::kPipelineRootSignature, call, ": ",
                 root_signature
                     ? "the compute root signature is not that of pipeline "
                     : "no compute root signature is set, but one is needed by pipeline ",
                 Quoted(pipeline.name)));
  return nullptr;
}

namespace {

// Returns the parameter if it exists and has the type that the call sets, else null.
const RootParameter* FindParameter(CommandListImpl& list, const char* call, uint32_t index,
                                   RootParameterType type) {
  if (!list.CheckOpen(call)) return nullptr;
  if (!list.root_signature) {
    list.Fail(MakeError(Id::kRootSignatureNotSet, call, ": call SetComputeRootSignature first"));
    return nullptr;
  }
  const auto& parameters = list.root_signature.GetDesc().Parameters;
  if (index >= parameters.size()) {
    list.Fail(MakeError(Id::kRootParameterMismatch, call, ": parameter ", index,
                        " does not exist; the root signature has ", parameters.size(),
                        " parameters"));
    return nullptr;
  }
  if (parameters[index].ParameterType != type) {
    list.Fail(MakeError(Id::kRootParameterMismatch, call, ": parameter ", index, " is of type ",
                        static_cast<uint32_t>(parameters[index].ParameterType),
                        ", but this call sets one of type ", static_cast<uint32_t>(type)));
    return nullptr;
  }
  return &parameters[index];
}

void WriteArgument(CommandListImpl& list, uint32_t parameter, uint32_t extra_bytes,
                   const void* value, size_t bytes) {
  const size_t offset = list.root_signature.GetArgumentOffset(parameter) + extra_bytes;
  if (offset + bytes > runtime::kRootArgumentBytes) return;  // 64 DWORDs always fit
  std::memcpy(list.WritableArguments().bytes.data() + offset, value, bytes);
}

void SetRootView(CommandListImpl* list, const char* call, uint32_t index, RootParameterType type,
                 GpuVirtualAddress address) {
  if (!list || !FindParameter(*list, call, index, type)) return;
  const uint32_t alignment = type == RootParameterType::kCbv ? 256 : 4;
  // Address 0 is a null descriptor: an acceleration structure that every ray misses.
  if (address % alignment != 0 || (address != 0 && !list->device->addresses.find(address))) {
    list->Fail(MakeError(Id::kRootDescriptorAddress, call, ": parameter ", index, " is ",
                         list->device->DescribeAddress(address),
                         "; it must lie in a live buffer, at a multiple of ", alignment));
    return;
  }
  WriteArgument(*list, index, 0, &address, sizeof address);
  list->root_views.erase(index);
  if (address != 0) {
    list->root_views[index] = UseOf(*list->device, address, Text("root parameter ", index));
  }
}

// Turns a rule that the host's arguments break into its error.
Status CheckRules(const runtime::DispatchProblem& problem) {
  switch (problem.fault) {
    case runtime::DispatchFault::kNone:
      return {};
    case runtime::DispatchFault::kTableLayout:
      return MakeError(Id::kShaderTableLayout, problem.text);
    case runtime::DispatchFault::kTableMemory:
      return MakeError(Id::kShaderTableMemory, problem.text);
    case runtime::DispatchFault::kTooLarge:
      break;
  }
  return MakeError(Id::kDispatchTooLarge, problem.text);
}

}  // namespace

}  // namespace detail

using namespace detail;

namespace {
const std::vector<Error> kNoErrors;
}

Status CommandList::Reset() {
  if (!impl_) return MakeError(Id::kNullHandle, "Reset on an empty command list handle");
  if (Status s = impl_->device->removed(); !s.ok()) return s;
  CommandListImpl fresh;
  fresh.device = impl_->device;
  *impl_ = std::move(fresh);
  return {};
}

Status CommandList::Close() {
  if (!impl_) return MakeError(Id::kNullHandle, "Close on an empty command list handle");
  if (!impl_->open) return MakeError(Id::kListNotOpen, "Close on a closed command list");
  if (impl_->open_events > 0) {
    impl_->Fail(
        MakeError(Id::kEvents, impl_->open_events, " calls of BeginEvent have no EndEvent"));
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
  if (!impl_ || !impl_->CheckOpen("SetDescriptorHeaps")) return;
  DescriptorHeap views, samplers;
  for (const DescriptorHeap& heap : heaps) {
    if (Status s = CheckHandle(impl_->device, heap, "SetDescriptorHeaps: a heap"); !s.ok()) {
      return impl_->Fail(s.error());
    }
    const DescriptorHeapDesc& desc = heap.GetDesc();
    if (!HasAny(desc.Flags, DescriptorHeapFlags::kShaderVisible)) {
      return impl_->Fail(MakeError(Id::kSetHeaps, Named("descriptor heap", desc.Name),
                                   " was created without kShaderVisible"));
    }
    DescriptorHeap& slot = desc.Type == DescriptorHeapType::kSampler ? samplers : views;
    if (slot) {
      return impl_->Fail(
          MakeError(Id::kSetHeaps, Named("descriptor heap", desc.Name),
                    " is the second heap of its type; only one of each type can be set"));
    }
    slot = heap;
  }
  impl_->view_heap = views;
  impl_->sampler_heap = samplers;
}

void CommandList::SetComputeRootSignature(const RootSignature& signature) {
  if (!impl_ || !impl_->CheckOpen("SetComputeRootSignature")) return;
  if (Status s = CheckHandle(impl_->device, signature, "SetComputeRootSignature: the signature");
      !s.ok()) {
    return impl_->Fail(s.error());
  }
  if (signature.is_local()) {
    return impl_->Fail(
        MakeError(Id::kRootSignatureKind,
                  "SetComputeRootSignature takes a global root signature, but this one "
                  "is local; local arguments belong in shader records"));
  }
  if (impl_->root_signature && SameDefinition(impl_->root_signature, signature)) return;
  impl_->root_signature = signature;
  impl_->arguments = std::make_shared<runtime::RootArguments>();
  impl_->root_views.clear();
}

void CommandList::SetComputeRoot32BitConstant(uint32_t parameter, uint32_t value,
                                              uint32_t dest_offset) {
  SetComputeRoot32BitConstants(parameter, 1, &value, dest_offset);
}

void CommandList::SetComputeRoot32BitConstants(uint32_t parameter, uint32_t count,
                                               const void* values, uint32_t dest_offset) {
  if (!impl_) return;
  const auto* p = FindParameter(*impl_, "SetComputeRoot32BitConstants", parameter,
                                RootParameterType::k32BitConstants);
  if (!p) return;
  const uint32_t total = p->Constants.Num32BitValues;
  if (dest_offset > total || count > total - dest_offset) {
    return impl_->Fail(MakeError(Id::kRootConstantsRange, "SetComputeRoot32BitConstants: values ",
                                 dest_offset, "..", uint64_t{dest_offset} + count, " of parameter ",
                                 parameter, ", which has only ", total));
  }
  if (count != 0 && !values) {
    return impl_->Fail(MakeError(Id::kRootConstantsRange,
                                 "SetComputeRoot32BitConstants: the pointer to the values of "
                                 "parameter ",
                                 parameter, " is null"));
  }
  if (count == 0) return;
  WriteArgument(*impl_, parameter, dest_offset * 4, values, size_t{count} * 4);
}

void CommandList::SetComputeRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address) {
  SetRootView(impl_.get(), "SetComputeRootConstantBufferView", parameter, RootParameterType::kCbv,
              address);
}
void CommandList::SetComputeRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address) {
  SetRootView(impl_.get(), "SetComputeRootShaderResourceView", parameter, RootParameterType::kSrv,
              address);
}
void CommandList::SetComputeRootUnorderedAccessView(uint32_t parameter, GpuVirtualAddress address) {
  SetRootView(impl_.get(), "SetComputeRootUnorderedAccessView", parameter, RootParameterType::kUav,
              address);
}

void CommandList::SetComputeRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base) {
  if (!impl_) return;
  const auto* p = FindParameter(*impl_, "SetComputeRootDescriptorTable", parameter,
                                RootParameterType::kDescriptorTable);
  if (!p) return;
  const bool samplers =
      p->DescriptorTable.Ranges.front().RangeType == DescriptorRangeType::kSampler;
  const DescriptorHeap& heap = samplers ? impl_->sampler_heap : impl_->view_heap;
  const uint64_t start = heap.GetGPUDescriptorHandleForHeapStart().ptr;
  const uint64_t offset = base.ptr - start;
  const bool inside = heap && base.ptr >= start && offset % kDescriptorHandleIncrementSize == 0 &&
                      offset / kDescriptorHandleIncrementSize < heap.GetDesc().NumDescriptors;
  if (!inside) {
    return impl_->Fail(MakeError(
        Id::kDescriptorTableHandle, "SetComputeRootDescriptorTable: handle ", Hex(base.ptr),
        " for parameter ", parameter, " is not in the ", samplers ? "sampler" : "CBV/SRV/UAV",
        " heap that is set", heap ? "" : "; call SetDescriptorHeaps first"));
  }
  WriteArgument(*impl_, parameter, 0, &base.ptr, sizeof base.ptr);
}

void CommandList::SetPipelineState(const PipelineState& pipeline) {
  if (!impl_ || !impl_->CheckOpen("SetPipelineState")) return;
  if (Status s = CheckHandle(impl_->device, pipeline, "SetPipelineState: the pipeline"); !s.ok()) {
    return impl_->Fail(s.error());
  }
  impl_->compute_pipeline = pipeline;
  impl_->raytracing_pipeline = {};
}

void CommandList::SetPipelineState1(const StateObject& pipeline) {
  if (!impl_ || !impl_->CheckOpen("SetPipelineState1")) return;
  if (Status s = CheckHandle(impl_->device, pipeline, "SetPipelineState1: the state object");
      !s.ok()) {
    return impl_->Fail(s.error());
  }
  if (pipeline.GetType() != StateObjectType::kRaytracingPipeline) {
    return impl_->Fail(MakeError(Id::kPipelineNotSet,
                                 "SetPipelineState1 takes a ray tracing pipeline, but this is a "
                                 "collection"));
  }
  impl_->raytracing_pipeline = pipeline;
  impl_->compute_pipeline = {};
}

void CommandList::DispatchRays(const DispatchRaysDesc& desc) {
  if (!impl_ || !impl_->CheckOpen("DispatchRays")) return;
  const StateObjectImpl* pipeline = impl_->RaysPipeline("DispatchRays");
  if (!pipeline) return;
  if (Status s = CheckRules(runtime::check_dispatch_rays(impl_->device->addresses, desc));
      !s.ok()) {
    return impl_->Fail(s.error());
  }
  const std::pair<const char*, GpuVirtualAddressRangeAndStride> tables[] = {
      {"RayGenerationShaderRecord",
       {desc.RayGenerationShaderRecord.StartAddress, desc.RayGenerationShaderRecord.SizeInBytes,
        0}},
      {"MissShaderTable", desc.MissShaderTable},
      {"HitGroupTable", desc.HitGroupTable},
      {"CallableShaderTable", desc.CallableShaderTable}};
  for (const auto& [name, table] : tables) {
    if (table.SizeInBytes != 0) impl_->Use("DispatchRays", table.StartAddress, name);
  }
  impl_->Record(runtime::DispatchRaysCommand{pipeline->pipeline, impl_->Snapshot("DispatchRays"),
                                             desc, pipeline->stack_bytes.load(), pipeline->linked});
}

void CommandList::Dispatch(uint32_t x, uint32_t y, uint32_t z) {
  if (!impl_ || !impl_->CheckOpen("Dispatch")) return;
  const PipelineStateImpl* pipeline = impl_->ComputePipeline("Dispatch");
  if (!pipeline) return;
  runtime::DispatchCommand command;
  command.groups[0] = x;
  command.groups[1] = y;
  command.groups[2] = z;
  if (Status s = CheckRules(runtime::check_dispatch(command.groups)); !s.ok()) {
    return impl_->Fail(s.error());
  }
  command.pipeline = pipeline->pipeline;
  command.linked = pipeline->linked;
  command.state = impl_->Snapshot("Dispatch");
  impl_->Record(std::move(command));
}

void CommandList::BeginEvent(std::string name) {
  if (!impl_ || !impl_->CheckOpen("BeginEvent")) return;
  ++impl_->open_events;
  impl_->Record(runtime::EventCommand{true, std::move(name)});
}

void CommandList::EndEvent() {
  if (!impl_ || !impl_->CheckOpen("EndEvent")) return;
  if (impl_->open_events == 0) {
    return impl_->Fail(MakeError(Id::kEvents, "EndEvent without BeginEvent"));
  }
  --impl_->open_events;
  impl_->Record(runtime::EventCommand{false, {}});
}

Result<CommandList> Device::CreateCommandList() const {
  if (!impl_) return MakeError(Id::kNullHandle, "CreateCommandList on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  auto list = std::make_shared<CommandListImpl>();
  list->device = impl_;
  return CommandList(std::move(list));
}

}  // namespace rtapi
