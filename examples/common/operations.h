// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: operations on clusters, recorded with all their memory.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/rtas_operations.h>
#include <rtapi/upload.h>

#include <string>
#include <vector>

namespace example {

// An operation's memory and results.
struct Batch {
  rtapi::Buffer results;    // what it makes
  rtapi::Buffer addresses;  // where each of them is, uint64_t
  rtapi::Buffer scratch;
  rtapi::Buffer arguments;

  // The address of its one result, which implicit destinations put first.
  rtapi::GpuVirtualAddress Only() const { return results.GetGPUVirtualAddress(); }
};

inline rtapi::Buffer WritableBuffer(const rtapi::Device& device, uint64_t bytes,
                                    rtapi::ResourceStates state, const std::string& name) {
  return device
      .CreateBuffer({.SizeInBytes = bytes,
                     .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess,
                     .InitialState = state,
                     .Name = name})
      .value();
}

// Records an operation whose `count` arguments are in a buffer. What comes after it in the list may
// use its results.
inline Batch Record(const rtapi::Device& device, rtapi::CommandList& list,
                    const rtapi::RtasOperationInputs& inputs, const rtapi::Buffer& arguments,
                    uint32_t count) {
  using rtapi::ResourceBarrier;
  using rtapi::ResourceStates;
  const rtapi::RtasOperationPrebuildInfo sizes = device.GetRTASOperationPrebuildInfo(inputs);
  Batch batch;
  batch.results = WritableBuffer(device, sizes.ResultDataMaxSizeInBytes,
                                 ResourceStates::kRaytracingAccelerationStructure, "results");
  batch.addresses = WritableBuffer(device, count * sizeof(uint64_t),
                                   ResourceStates::kUnorderedAccess, "addresses of results");
  batch.scratch = WritableBuffer(device, sizes.ScratchDataSizeInBytes,
                                 ResourceStates::kUnorderedAccess, "scratch");
  batch.arguments = arguments;
  rtapi::RtasBatchedOperationData data;
  data.BatchResultData = batch.results.GetGPUVirtualAddress();
  data.BatchScratchData = batch.scratch.GetGPUVirtualAddress();
  data.ResultAddressArray = {batch.addresses.GetGPUVirtualAddress(), 0};
  data.IndirectArgumentArray = {batch.arguments.GetGPUVirtualAddress(), 0};
  const rtapi::RtasOperationDesc operation = {.pInputs = &inputs, .pBatchedOperationData = &data};
  list.ExecuteIndirectRTASOperations({&operation, 1});
  list.ResourceBarrier(ResourceBarrier::Uav(batch.results));
  list.ResourceBarrier(ResourceBarrier::Transition(
      batch.addresses, ResourceStates::kUnorderedAccess, ResourceStates::kNonPixelShaderResource));
  return batch;
}
// With arguments of the host.
template <class Args>
Batch Record(const rtapi::Device& device, rtapi::CommandList& list,
             const rtapi::RtasOperationInputs& inputs, const std::vector<Args>& arguments) {
  return Record(device, list, inputs,
                rtapi::CreateUploadBuffer(device, arguments, "arguments").value(),
                static_cast<uint32_t>(arguments.size()));
}

}  // namespace example
