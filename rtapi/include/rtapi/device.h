// SPDX-License-Identifier: MIT
//
// Devices: the factory of everything else.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/command_list.h>
#include <rtapi/command_queue.h>
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
struct DeviceImpl;
}

struct DeviceInfo {
  std::string Backend;      // "embree"
  std::string Name = {};    // "Intel Xeon ..., Embree 3.13.5"
  std::string Description;  // one line for people
  uint32_t HardwareThreads = 0;
};

// Speed against exactness of ray-primitive tests on the CPU: fast (Embree's default), robust
// (no gaps between triangles in practice), exact (DXR's watertightness rules, one hit per shared
// edge). Measured in the project's README.
enum class TraversalPrecision : uint32_t { kFast, kRobust, kExact };

enum class MessageSeverity : uint32_t { kInfo, kWarning, kError };

struct Message {
  MessageSeverity Severity = MessageSeverity::kError;
  ErrorId Id;        // KA0715 is number 715
  std::string Text;  // begins with the id
};

struct DeviceDesc {
  std::string Backend = "embree";
  uint32_t Threads = 0;  // 0: all of them; results do not depend on it
  TraversalPrecision Precision = TraversalPrecision::kRobust;
  RaytracingTier Tier = RaytracingTier::kTier1_1;  // 1.0 refuses what 1.1 brought
  bool CollectStatistics = false;                  // counts rays; costs some speed
  // Checked mode: says through OnMessage (ids KA0400-0499, rtapi/ERRORS.md) what plain DXR leaves
  // undefined: records outside a table or of another state object, missing barriers, structures
  // that were overwritten, reads outside a root descriptor's buffer. Execution goes on. Slower.
  bool Checked = false;
  // Called on any thread for what cannot be returned to a caller: errors met while a list executes,
  // why the device was removed. Must not call into the library.
  std::function<void(const Message&)> OnMessage = {};
};

// What ran since the device was made, with DeviceDesc::CollectStatistics.
struct RaytracingStatistics {
  uint64_t TraceRayCalls = 0;
  uint64_t VisibilityRays = 0;  // of them: first hit ends the search, no closest-hit shader
  uint64_t Hits = 0;            // committed
  uint64_t Misses = 0;
  uint64_t AnyHitInvocations = 0;
  uint64_t IntersectionInvocations = 0;
  uint64_t ClosestHitInvocations = 0;
  uint64_t MissInvocations = 0;
  uint64_t CallableInvocations = 0;
};

// Every device of every backend of this build; the first is the default.
std::vector<DeviceInfo> EnumerateDevices();

class Device;
// Errors: KA0901 unknown backend (the message lists the known ones), the backend's own.
Result<Device> CreateDevice(const DeviceDesc& desc = {});

// A copyable handle, thread-safe. Objects of one device must not be used with another: KA0903.
class Device {
 public:
  Device() = default;
  explicit Device(std::shared_ptr<detail::DeviceImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Device&) const = default;

  const DeviceInfo& GetInfo() const;
  const DeviceDesc& GetDesc() const;
  // Ok while the device works, else why it was removed. Once removed, every call that needs it
  // returns that error.
  Status GetDeviceRemovedReason() const;
  RaytracingStatistics GetStatistics() const;
  void ResetStatistics();

  // Resources
  Result<Buffer> CreateBuffer(const BufferDesc& desc) const;
  Result<Texture> CreateTexture(const TextureDesc& desc) const;
  // Where subresources lie in a buffer that CopyTextureRegion reads or writes. Footprints start at
  // `base_offset_bytes`; returns the bytes in all. Pointers may be null.
  Result<uint64_t> GetCopyableFootprints(const TextureDesc& desc, uint32_t first_subresource,
                                         uint32_t count, uint64_t base_offset_bytes,
                                         std::vector<PlacedSubresourceFootprint>* layouts,
                                         std::vector<uint32_t>* row_counts = nullptr,
                                         std::vector<uint64_t>* row_bytes = nullptr) const;

  // Descriptors. The handle names a slot of a living heap of the right type.
  Result<DescriptorHeap> CreateDescriptorHeap(const DescriptorHeapDesc& desc) const;
  uint32_t GetDescriptorHandleIncrementSize(DescriptorHeapType) const {
    return kDescriptorHandleIncrementSize;
  }
  // An empty resource makes a null descriptor, except for acceleration structures, whose resource
  // is always empty. [DXR: Additional SRV type]
  Status CreateShaderResourceView(const Resource& resource, const ShaderResourceViewDesc& desc,
                                  CpuDescriptorHandle dest) const;
  // The whole texture, as it is; 6 elements do not make it a cube.
  Status CreateShaderResourceView(const Texture& texture, CpuDescriptorHandle dest) const;
  Status CreateUnorderedAccessView(const Resource& resource, const UnorderedAccessViewDesc& desc,
                                   CpuDescriptorHandle dest) const;
  Status CreateUnorderedAccessView(const Texture& texture, CpuDescriptorHandle dest) const;
  Status CreateConstantBufferView(const ConstantBufferViewDesc& desc,
                                  CpuDescriptorHandle dest) const;
  Status CreateSampler(const SamplerDesc& desc, CpuDescriptorHandle dest) const;
  Status CopyDescriptorsSimple(uint32_t count, CpuDescriptorHandle dest, CpuDescriptorHandle source,
                               DescriptorHeapType type) const;

  // Pipelines
  Result<RootSignature> CreateRootSignature(const RootSignatureDesc& desc) const;
  Result<RootSignature> CreateRootSignature(std::string_view hlsl_text) const;
  Result<StateObject> CreateStateObject(const StateObjectDesc& desc) const;
  Result<StateObject> AddToStateObject(const StateObjectDesc& addition,
                                       const StateObject& parent) const;
  Result<PipelineState> CreateComputePipelineState(const ComputePipelineStateDesc& desc) const;
  // `root_signature`: needed if an argument sets a root argument, else ignored. Errors: KA0540 an
  // argument or the stride, KA0541 kDispatchRays on a device of tier 1.0.
  Result<CommandSignature> CreateCommandSignature(const CommandSignatureDesc& desc,
                                                  const RootSignature& root_signature = {}) const;

  // Sizes that suffice for this build and for every smaller one alike. Geometry descs are read,
  // GPU memory is not: addresses are only tested for 0.
  Result<RaytracingAccelerationStructurePrebuildInfo>
  GetRaytracingAccelerationStructurePrebuildInfo(
      const BuildRaytracingAccelerationStructureInputs& inputs) const;

  // Whether CopyRaytracingAccelerationStructure(kDeserialize) takes data with this identifier,
  // which its header begins with. An empty handle recognizes none.
  DriverMatchingIdentifierStatus CheckDriverMatchingIdentifier(
      SerializedDataType type, const SerializedDataDriverMatchingIdentifier& identifier) const;

  // Work
  Result<CommandList> CreateCommandList() const;
  Result<CommandQueue> CreateCommandQueue() const;
  Result<Fence> CreateFence(uint64_t initial_value = 0) const;

  const std::shared_ptr<detail::DeviceImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::DeviceImpl> impl_;
};

}  // namespace rtapi
