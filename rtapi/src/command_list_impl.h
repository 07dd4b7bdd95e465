// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/command_list.h>

#include "rtapi/src/device_impl.h"
#include "runtime/backend/commands.h"

namespace rtapi::detail {

using CommandVector = std::vector<runtime::Command>;

struct StateObjectImpl;
struct PipelineStateImpl;

struct CommandListImpl {
  std::shared_ptr<DeviceImpl> device;
  bool open = true;
  std::vector<Error> errors;
  // Shared with queues, so that a list may be reset while its work is still waiting for a fence.
  std::shared_ptr<CommandVector> commands = std::make_shared<CommandVector>();

  // Set on the list
  DescriptorHeap view_heap;
  DescriptorHeap sampler_heap;
  RootSignature root_signature;
  std::shared_ptr<runtime::RootArguments> arguments = std::make_shared<runtime::RootArguments>();
  PipelineState compute_pipeline;  // at most one of the two
  StateObject raytracing_pipeline;
  uint32_t open_events = 0;

  // Keeps the error; D3D12 reports it through Close.
  void Fail(Error error) { errors.push_back(std::move(error)); }
  // False, with an error kept, unless recording is possible.
  bool CheckOpen(const char* call);
  // Ready to be written: no recorded dispatch shares it.
  runtime::RootArguments& WritableArguments();
  void ClearArgument(uint32_t offset_bytes, uint32_t size_bytes);
  runtime::DispatchState Snapshot();
  // The pipeline that is set and fits the root signature that is set; null with an error kept.
  const StateObjectImpl* RaysPipeline(const char* call);
  const PipelineStateImpl* ComputePipeline(const char* call);

  // In place: gcc 12 takes the members of a temporary variant for uninitialised at -O3.
  template <class T>
  void Record(T command) {
    commands->emplace_back(std::in_place_type<T>, std::move(command));
  }
};

// The checks of acceleration_structure.cpp, host side only.
Status CheckBuildInputs(const DeviceImpl& device,
                        const BuildRaytracingAccelerationStructureInputs& inputs);
// The geometry descs of checked bottom-level inputs, whatever their layout.
std::vector<RaytracingGeometryDesc> CopyGeometryDescs(
    const BuildRaytracingAccelerationStructureInputs& inputs);
// Addresses: alignment, liveness and extent.
Status CheckBuildAddresses(const DeviceImpl& device,
                           const BuildRaytracingAccelerationStructureDesc& desc,
                           const std::vector<RaytracingGeometryDesc>& geometries);
Status CheckPostbuildInfo(const DeviceImpl& device,
                          const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
                          size_t count);
// 256-aligned, inside a buffer that was created for acceleration structures.
Status CheckStructureAddress(const DeviceImpl& device, GpuVirtualAddress address,
                             std::string_view what);
// 256-aligned, `bytes` inside a plain buffer, which a shader may write if `written`.
Status CheckStructureBytes(const DeviceImpl& device, GpuVirtualAddress address, uint64_t bytes,
                           bool written, std::string_view what);

}  // namespace rtapi::detail
