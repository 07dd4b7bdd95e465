// SPDX-License-Identifier: MIT
#include "runtime/backend/commands.h"

namespace kaamos::runtime {
namespace {

struct NameOf {
  const char* operator()(const DispatchRaysCommand&) const { return "DispatchRays"; }
  const char* operator()(const DispatchCommand&) const { return "Dispatch"; }
  const char* operator()(const ExecuteIndirectCommand&) const { return "ExecuteIndirect"; }
  const char* operator()(const BuildCommand&) const {
    return "BuildRaytracingAccelerationStructure";
  }
  const char* operator()(const EmitPostbuildInfoCommand&) const {
    return "EmitRaytracingAccelerationStructurePostbuildInfo";
  }
  const char* operator()(const CopyAccelerationStructureCommand&) const {
    return "CopyRaytracingAccelerationStructure";
  }
  const char* operator()(const RtasOperationsCommand&) const {
    return "ExecuteIndirectRTASOperations";
  }
  const char* operator()(const CopyBufferCommand& copy) const {
    return copy.immediate ? "WriteBufferImmediate" : "CopyBufferRegion";
  }
  const char* operator()(const CopyTextureCommand&) const { return "CopyTextureRegion"; }
  const char* operator()(const ResolveCommand&) const { return "ResolveSubresource"; }
  const char* operator()(const ClearUavCommand&) const { return "ClearUnorderedAccessView"; }
  const char* operator()(const BarrierCommand& command) const {
    return command.kind == BarrierCommand::Kind::kAccess ? "Barrier" : "ResourceBarrier";
  }
  const char* operator()(const DrawCommand& draw) const {
    return draw.indexed ? "DrawIndexedInstanced" : "DrawInstanced";
  }
  const char* operator()(const ClearTargetCommand& clear) const {
    return clear.depth_stencil ? "ClearDepthStencilView" : "ClearRenderTargetView";
  }
  const char* operator()(const BeginQueryCommand&) const { return "BeginQuery"; }
  const char* operator()(const EndQueryCommand&) const { return "EndQuery"; }
  const char* operator()(const TimestampCommand&) const { return "EndQuery"; }
  const char* operator()(const ResolveQueriesCommand&) const { return "ResolveQueryData"; }
  const char* operator()(const PredicationCommand&) const { return "SetPredication"; }
  const char* operator()(const EventCommand& event) const {
    return event.begin ? "BeginEvent" : "EndEvent";
  }
};

}  // namespace

const char* command_name(const Command& command) {
  return std::visit(NameOf(), command);
}

}  // namespace kaamos::runtime
