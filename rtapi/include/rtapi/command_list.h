// SPDX-License-Identifier: MIT
//
// Recording commands. Nothing executes while it is recorded; structures in host memory are copied
// at once, GPU memory is read when the list executes. [DXR: Command list methods]
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/command_signature.h>
#include <rtapi/descriptor.h>
#include <rtapi/pipeline_state.h>
#include <rtapi/raytracing.h>
#include <rtapi/resource.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>
#include <rtapi/state_object.h>

namespace rtapi {

namespace detail {
struct CommandListImpl;
}

// A compute command list; open when created. Calls return nothing: a call that breaks a rule is not
// recorded, its error is kept, and Close() returns the first of them. One thread at a time.
class CommandList {
 public:
  CommandList() = default;
  explicit CommandList(std::shared_ptr<detail::CommandListImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandList&) const = default;

  // Drops commands and errors, forgets all state, opens the list.
  Status Reset();
  // Ends recording. The first error of the calls since Reset, if any: the list cannot be executed.
  Status Close();
  // All errors since Reset, in order.
  const std::vector<Error>& GetErrors() const;
  bool is_open() const;

  void ResourceBarrier(std::span<const rtapi::ResourceBarrier> barriers);
  void ResourceBarrier(const rtapi::ResourceBarrier& barrier) {
    ResourceBarrier(std::span<const rtapi::ResourceBarrier>(&barrier, 1));
  }

  // At most one of each type, shader-visible. Replaces both.
  void SetDescriptorHeaps(std::span<const DescriptorHeap> heaps);
  void SetDescriptorHeaps(std::initializer_list<DescriptorHeap> heaps) {
    SetDescriptorHeaps(std::span<const DescriptorHeap>(heaps.begin(), heaps.size()));
  }

  // The compute root signature is the global root signature of DispatchRays. Setting another one
  // makes all root arguments undefined (here: zero).
  void SetComputeRootSignature(const RootSignature& root_signature);
  void SetComputeRoot32BitConstant(uint32_t parameter, uint32_t value, uint32_t dest_offset_dwords);
  void SetComputeRoot32BitConstants(uint32_t parameter, uint32_t count, const void* values,
                                    uint32_t dest_offset_dwords);
  // All of `value`; its size is a multiple of 4.
  template <class T>
  void SetComputeRoot32BitConstants(uint32_t parameter, const T& value) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    SetComputeRoot32BitConstants(parameter, sizeof(T) / 4, &value, 0);
  }
  void SetComputeRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address);
  void SetComputeRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address);
  void SetComputeRootUnorderedAccessView(uint32_t parameter, GpuVirtualAddress address);
  void SetComputeRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base);

  void SetPipelineState(const PipelineState& pipeline);
  void SetPipelineState1(const StateObject& pipeline);
  void DispatchRays(const DispatchRaysDesc& desc);
  void Dispatch(uint32_t groups_x, uint32_t groups_y, uint32_t groups_z);
  // Up to `max_command_count` dispatches whose arguments stand in `argument_buffer` when the list
  // executes; fewer if the uint32_t in `count_buffer` is smaller. Offsets are multiples of 4;
  // max_command_count commands lie inside the buffer. The pipeline and all other root arguments are
  // those of the list; what the signature sets is 0 afterwards. Bad arguments (a table outside
  // every buffer, more than 2^30 threads) remove the device: KA0898. [D3D12: Indirect drawing]
  void ExecuteIndirect(const CommandSignature& signature, uint32_t max_command_count,
                       const Buffer& argument_buffer, uint64_t argument_buffer_offset_bytes,
                       const Buffer& count_buffer = {}, uint64_t count_buffer_offset_bytes = 0);

  void BuildRaytracingAccelerationStructure(
      const BuildRaytracingAccelerationStructureDesc& desc,
      std::span<const RaytracingAccelerationStructurePostbuildInfoDesc> postbuild_infos = {});
  void EmitRaytracingAccelerationStructurePostbuildInfo(
      const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
      std::span<const GpuVirtualAddress> sources);
  void CopyRaytracingAccelerationStructure(GpuVirtualAddress dest, GpuVirtualAddress source,
                                           RaytracingAccelerationStructureCopyMode mode);

  void CopyBufferRegion(const Buffer& dest, uint64_t dest_offset_bytes, const Buffer& source,
                        uint64_t source_offset_bytes, uint64_t size_bytes);
  void CopyTextureRegion(const TextureCopyLocation& dest, uint32_t x, uint32_t y, uint32_t z,
                         const TextureCopyLocation& source, const Box* source_box = nullptr);
  void CopyResource(const Resource& dest, const Resource& source);

  // The two handles name the same view: one in the shader-visible heap that is set, one in a heap
  // that the host can read. [D3D12: ClearUnorderedAccessViewUint]
  void ClearUnorderedAccessViewUint(GpuDescriptorHandle gpu_handle, CpuDescriptorHandle cpu_handle,
                                    const Resource& resource, const uint32_t values[4]);
  void ClearUnorderedAccessViewFloat(GpuDescriptorHandle gpu_handle, CpuDescriptorHandle cpu_handle,
                                     const Resource& resource, const float values[4]);

  // Marks a span of commands with a name, for messages.
  void BeginEvent(std::string name);
  void EndEvent();

  const std::shared_ptr<detail::CommandListImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandListImpl> impl_;
};

}  // namespace rtapi
