// SPDX-License-Identifier: MIT
/// @file
/// Devices: the factory of everything else.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <rtapi/command_list.h>
#include <rtapi/command_queue.h>
#include <rtapi/command_signature.h>
#include <rtapi/descriptor.h>
#include <rtapi/device_level.h>
#include <rtapi/message.h>
#include <rtapi/pipeline_state.h>
#include <rtapi/query.h>
#include <rtapi/raytracing.h>
#include <rtapi/resource.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>
#include <rtapi/rtas_operations.h>
#include <rtapi/state_object.h>

namespace rtapi {

namespace detail {
struct DeviceImpl;
}

/// A device that this build can make.
struct DeviceInfo {
  std::string Backend;           ///< "embree" or "vulkan", for DeviceDesc::Backend
  std::string Name = {};         ///< "Intel Xeon ..., Embree 3.13.5"
  std::string Description;       ///< one line for people
  uint32_t HardwareThreads = 0;  ///< of this machine
};

/// Speed against exactness of ray-primitive tests on the CPU. Measured in
/// tests/numerics/PRECISION.md. [DXR: Watertightness; Fixed function ray-triangle intersection
/// specification]
enum class TraversalPrecision : uint32_t {
  kFast,  ///< Embree's default; a rare ray slips through an edge that two triangles share
  /// No gaps between triangles in practice. What any-hit shaders and the candidates of RayQuery see
  /// keeps the rules of kExact, one triangle at a shared edge: in bottom levels that are not all
  /// opaque, and in others where an instance or a ray has FORCE_NON_OPAQUE.
  kRobust,
  kExact  ///< DXR's watertightness rules, one hit per shared edge; not on Vulkan (KA0991)
};

/// Describes a device for CreateDevice.
struct DeviceDesc {
  std::string Backend = "embree";  ///< one of EnumerateDevices (KA0901)
  /// 0 to 4096 (KA0914); 0: all threads of the machine. Results do not depend on it. Vulkan ignores
  /// it.
  uint32_t Threads = 0;
  TraversalPrecision Precision = TraversalPrecision::kRobust;  ///< of rays against triangles
  /// What the device has; it refuses what a higher tier brought. At most kHighestRaytracingTier
  /// (KA0914).
  RaytracingTier Tier = kHighestRaytracingTier;
  /// Libraries that were compiled for a higher one are refused (KA0544). At most
  /// kExperimentalShaderModel, and at least what the tier needs: 6.3 for 1.0, 6.5 for 1.1, 6.9 for
  /// 1.2 (KA0914).
  rtapi::ShaderModel ShaderModel = kHighestShaderModel;
  /// EXPERIMENTAL: ExecuteIndirectRTASOperations of partitioned top levels, clusters and bottom
  /// levels of clusters. Needs tier 1.1 and shader model 6.10 (KA0914).
  /// [DXR 2.0: ClustersAndPTLASSupported]
  bool IndirectRtasOperations = false;
  /// Lanes of a wave in compute shaders on the CPU: 4, 8, 16 or 32 (KA0914); 0: 8. Vulkan ignores
  /// it: there the driver decides. In ray shaders each thread is a wave of its own.
  /// [HLSL: WaveGetLaneCount]
  uint32_t WaveLanes = 0;
  bool CollectStatistics = false;  ///< counts rays; costs some speed on Vulkan
  /// What a call that breaks a rule of recording does to its list.
  rtapi::InvalidCalls InvalidCalls = rtapi::InvalidCalls::kFailList;
  /// Checked mode: says through OnMessage (ids KA0400-0499, rtapi/ERRORS.md) what plain DXR leaves
  /// undefined: records outside a table or of another state object, missing barriers, structures
  /// that were overwritten, reads outside a root descriptor's buffer. Execution goes on. Slower.
  bool Checked = false;
  /// The only thread whose printf and errorf are told, by DispatchRaysIndex, SV_DispatchThreadID,
  /// (x, y, 0) of a pixel or (vertex, instance, 0); none: all threads'. $KAAMOS_PRINT_THREAD
  /// ("12,7,0") takes its place where it is none.
  std::optional<std::array<uint32_t, 3>> PrintThread = std::nullopt;
  /// Called on any thread for what cannot be returned to a caller: errors met while a list
  /// executes, why the device was removed, warnings, and what shaders print (KA0845, KA0846). Must
  /// not call into the library. Without it, what shaders print goes to stderr.
  std::function<void(const Message&)> OnMessage = {};
};

/// Counts of what ran since the device was made, see Device::GetStatistics.
struct RaytracingStatistics {
  uint64_t TraceRayCalls = 0;   ///< without RayQuery
  uint64_t VisibilityRays = 0;  ///< of them: first hit ends the search, no closest-hit shader
  uint64_t Hits = 0;            ///< rays with a committed hit
  uint64_t Misses = 0;          ///< rays without one
  /// The number of times that shaders of a stage ran.
  ///@{
  uint64_t AnyHitInvocations = 0;
  uint64_t IntersectionInvocations = 0;
  uint64_t ClosestHitInvocations = 0;
  uint64_t MissInvocations = 0;
  uint64_t CallableInvocations = 0;
  ///@}
};

/// Every device of every backend of this build, the default first; empty if the build has no
/// backend. Devices that the machine lacks (no Vulkan driver with ray tracing) are not listed.
std::vector<DeviceInfo> EnumerateDevices();

class Device;
/// Makes a device. Several may live at once; their objects do not mix (KA0903).
/// [D3D12: D3D12CreateDevice]
/// @errors KA0900 the build has no backend; KA0901 unknown backend, and the message lists the known
/// ones; KA0914 Precision, Tier, ShaderModel, Threads or WaveLanes
/// out of range, or a tier without the shader model that it needs. Embree: KA0992 it cannot be
/// started. Vulkan: KA0950 no device with ray tracing pipelines, KA0951 validation layers absent,
/// KA0952 a call failed, KA0953 no device of that name, KA0991 precision kExact.
Result<Device> CreateDevice(const DeviceDesc& desc = {});

/// The factory of everything else. A copyable handle, thread-safe; whatever it made keeps it alive.
/// Calls on an empty handle return KA0904, as do calls that are given an empty handle; objects of
/// one device must not be used with another: KA0903.
///
/// An error met while a list executes removes the device, as in D3D12. From then on the calls that
/// make objects or submit work return the reason (its id, with the code kDeviceRemoved), and so
/// does GetDeviceRemovedReason. OnMessage is told once. [D3D12: ID3D12Device5]
class Device {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same device.
  ///@{
  Device() = default;
  explicit Device(std::shared_ptr<detail::DeviceImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Device&) const = default;
  ///@}

  /// Describes the device. Valid as long as the device lives; empty for an empty handle.
  const DeviceInfo& GetInfo() const;
  /// Returns the desc that the device was created with. Valid as long as the device lives; a
  /// default desc for an empty handle.
  const DeviceDesc& GetDesc() const;
  /// Ok while the device works, else why it was removed.
  /// [D3D12: ID3D12Device::GetDeviceRemovedReason]
  /// @errors KA0904 empty handle; the id of what removed the device, with the code kDeviceRemoved:
  /// KA0789-0796, KA0890-0898, KA0917, KA0950-0963, KA0990.
  Status GetDeviceRemovedReason() const;
  /// Removes the device, from any thread: with KA0917 as the reason, unless it was removed before.
  /// Work that executes ends early, and what it wrote is incomplete: Embree starts no more tiles,
  /// thread groups or other commands; Vulkan submits no more, and what the driver has goes on.
  /// [D3D12: ID3D12Device5::RemoveDevice]
  /// @errors KA0904 empty handle.
  Status RemoveDevice() const;
  /// Counts since the device was made or ResetStatistics was called, over all queues. Vulkan counts
  /// only with DeviceDesc::CollectStatistics, Embree always. On Vulkan a miss for which no shader
  /// ran counts as a hit. All zero for an empty handle.
  RaytracingStatistics GetStatistics() const;
  /// Sets all counts to zero.
  void ResetStatistics();

  // Resources

  /// Makes a buffer of zeros. [D3D12: CreateCommittedResource]
  /// @errors KA0904 empty handle; KA0905 size; KA0906 heap, flags or state; KA0907 the state
  /// kRaytracingAccelerationStructure without what it needs, KA0545 on a device without ray
  /// tracing; KA0990 no memory; on Vulkan KA0956 over a limit of the device; the reason if the
  /// device is removed.
  Result<Buffer> CreateBuffer(const BufferDesc& desc) const;
  /// Makes a texture of zeros on the default heap. [D3D12: CreateCommittedResource]
  /// @errors KA0904 empty handle; KA0907 a state for buffers; KA0908 dimension, size or mip levels;
  /// KA0570 and KA0571 unordered access to, or one dimension of, a block-compressed format; KA0909
  /// format or flags; KA0990 no memory; on Vulkan KA0960 the device has no such textures; the
  /// reason if the device is removed.
  Result<Texture> CreateTexture(const TextureDesc& desc) const;
  /// Quality levels of targets in `format` with `count` samples: 1, the standard pattern, or 0 if
  /// there are no such targets. [D3D12: D3D12_FEATURE_DATA_MULTISAMPLE_QUALITY_LEVELS]
  uint32_t GetMultisampleQualityLevels(Format format, uint32_t count) const;
  /// Finds where `count` subresources of such a texture, from `first_subresource` on, lie in a
  /// buffer that CopyTextureRegion reads or writes. The first is placed at `base_offset_bytes`
  /// as it is, the others behind it, at multiples of 512 from there. Appends to each vector that is
  /// not null one element for each subresource: the footprint, its rows per slice, the bytes of a
  /// row without padding. For a block-compressed format rows are rows of blocks, and footprints are
  /// whole blocks. Returns the bytes from `base_offset_bytes` to the end of the last row. Needs no
  /// device. [D3D12: GetCopyableFootprints]
  /// @errors KA0817 more subresources than there are; KA0570, KA0571, KA0907-0909 as of
  /// CreateTexture.
  Result<uint64_t> GetCopyableFootprints(const TextureDesc& desc, uint32_t first_subresource,
                                         uint32_t count, uint64_t base_offset_bytes,
                                         std::vector<PlacedSubresourceFootprint>* layouts,
                                         std::vector<uint32_t>* row_counts = nullptr,
                                         std::vector<uint64_t>* row_bytes = nullptr) const;

  // Descriptors

  /// Makes a heap of null descriptors. [D3D12: CreateDescriptorHeap]
  /// @errors KA0904 empty handle; KA0620 number of descriptors; KA0621 type or flags; KA0990 no
  /// memory; the reason if the device is removed.
  Result<DescriptorHeap> CreateDescriptorHeap(const DescriptorHeapDesc& desc) const;
  /// Bytes between two descriptors: kDescriptorHandleIncrementSize for every type.
  /// [D3D12: GetDescriptorHandleIncrementSize]
  uint32_t GetDescriptorHandleIncrementSize(DescriptorHeapType) const {
    return kDescriptorHandleIncrementSize;
  }
  /// Writes a view of a buffer, a texture or an acceleration structure into slot `dest` of a living
  /// CBV/SRV/UAV heap. An empty resource makes a null descriptor, except for acceleration
  /// structures, whose resource is always empty and whose address is in the desc. The view does not
  /// keep the resource alive. [D3D12: CreateShaderResourceView; DXR: Additional SRV type]
  /// @errors KA0904 empty device; KA0903 resource of another device; KA0622 `dest` is no such slot;
  /// KA0623 dimension; KA0624 elements outside of the buffer; KA0625 stride or offset; KA0626
  /// format or component mapping; KA0629, KA0545 acceleration structure; KA0630 mips or slices; on
  /// Vulkan KA0956 too many views, KA0961 no such view.
  Status CreateShaderResourceView(const Resource& resource, const ShaderResourceViewDesc& desc,
                                  CpuDescriptorHandle dest) const;
  /// A view of the whole texture, with its own format and dimension. Several elements make an array
  /// view; 6 elements do not make it a cube.
  /// @errors as of the overload with a desc: KA0622, KA0626 (typeless formats), KA0903, KA0904.
  Status CreateShaderResourceView(const Texture& texture, CpuDescriptorHandle dest) const;
  /// Writes a view that shaders can write to into slot `dest` of a living CBV/SRV/UAV heap. An
  /// empty resource makes a null descriptor. The view does not keep the resource alive.
  /// [D3D12: CreateUnorderedAccessView]
  /// @errors KA0904 empty device; KA0903 resource of another device; KA0622 `dest` is no such slot;
  /// KA0623 dimension; KA0624 elements outside of the buffer; KA0625 stride, offset or counter;
  /// KA0626 format; KA0570 a block-compressed texture; KA0627 the resource was created without
  /// kAllowUnorderedAccess; KA0630 mips or slices; on Vulkan KA0956 too many views, KA0961 no such
  /// view.
  Status CreateUnorderedAccessView(const Resource& resource, const UnorderedAccessViewDesc& desc,
                                   CpuDescriptorHandle dest) const;
  /// The same of a structured buffer with a counter, for HLSL's IncrementCounter, Append and
  /// Consume: 4 bytes at desc.Buffer.CounterOffsetInBytes of `counter`, which must live and may be
  /// the viewed buffer itself. Shaders and copies may write it. [D3D12: CreateUnorderedAccessView]
  /// @errors as of the overload without one; KA0634 the counter.
  Status CreateUnorderedAccessView(const Resource& resource, const Buffer& counter,
                                   const UnorderedAccessViewDesc& desc,
                                   CpuDescriptorHandle dest) const;
  /// A view of mip 0 of the whole texture, with its own format and dimension.
  /// @errors as of the overload with a desc: KA0570, KA0622, KA0626, KA0627, KA0903, KA0904.
  Status CreateUnorderedAccessView(const Texture& texture, CpuDescriptorHandle dest) const;
  /// Writes a view of a constant buffer, or a null view for address 0, into slot `dest` of a living
  /// CBV/SRV/UAV heap. [D3D12: CreateConstantBufferView]
  /// @errors KA0904 empty device; KA0622 `dest` is no such slot; KA0628 alignment, size, or bytes
  /// that are not all in one live buffer.
  Status CreateConstantBufferView(const ConstantBufferViewDesc& desc,
                                  CpuDescriptorHandle dest) const;
  /// Writes a view of a texture that draws write colours to into slot `dest` of a living RTV heap.
  /// An empty texture makes a null descriptor, which drops what is drawn. The view does not keep
  /// the texture alive. [D3D12: CreateRenderTargetView]
  /// @errors KA0904 empty device; KA0903 texture of another device; KA0731 `dest` is no such slot;
  /// KA0730 dimension, format, mip, slices, or a texture without kAllowRenderTarget; KA0726 the
  /// backend cannot draw to the format.
  Status CreateRenderTargetView(const Texture& texture, const RenderTargetViewDesc& desc,
                                CpuDescriptorHandle dest) const;
  /// A view of mip 0 of the whole texture, with its own format.
  /// @errors as of the overload with a desc: KA0726, KA0730, KA0731, KA0903, KA0904.
  Status CreateRenderTargetView(const Texture& texture, CpuDescriptorHandle dest) const;
  /// The same for depth, in a DSV heap. [D3D12: CreateDepthStencilView]
  /// @errors KA0904 empty device; KA0903 texture of another device; KA0731 `dest` is no such slot;
  /// KA0730 dimension, flags, format, mip, slices, or a texture without kAllowDepthStencil; KA0726
  /// the backend has no such depth buffers.
  Status CreateDepthStencilView(const Texture& texture, const DepthStencilViewDesc& desc,
                                CpuDescriptorHandle dest) const;
  /// A view of mip 0 of the whole texture, with its depth format.
  /// @errors as of the overload with a desc: KA0726, KA0730, KA0731, KA0903, KA0904.
  Status CreateDepthStencilView(const Texture& texture, CpuDescriptorHandle dest) const;
  /// Writes a sampler into slot `dest` of a living sampler heap. [D3D12: CreateSampler]
  /// @errors KA0904 empty device; KA0622 `dest` is no such slot; KA0631 a member out of its range;
  /// on Vulkan KA0956 too many samplers, KA0962 the device has no such sampler.
  Status CreateSampler(const SamplerDesc& desc, CpuDescriptorHandle dest) const;
  /// Copies `count` descriptors from slots at `source` to slots at `dest`; the ranges may overlap.
  /// Both are in living heaps of this type, and the source is not shader-visible, as D3D12's host
  /// cannot read such heaps. [D3D12: CopyDescriptorsSimple]
  /// @errors KA0904 empty device; KA0622 a handle in no living heap; KA0632 another type, a
  /// shader-visible source, or slots past the end of a heap.
  Status CopyDescriptorsSimple(uint32_t count, CpuDescriptorHandle dest, CpuDescriptorHandle source,
                               DescriptorHeapType type) const;

  // Pipelines

  /// Checks a description and makes a root signature of it. [D3D12: CreateRootSignature]
  /// @errors KA0904 empty handle; KA0600, KA0601 too large; KA0602 flags; KA0603 visibility; KA0604
  /// a register bound twice; KA0605 a parameter's type or register space; KA0606 samplers among
  /// views; KA0607 a range; KA0609 no constants; KA0610 a static sampler; on Vulkan KA0956, KA0962.
  Result<RootSignature> CreateRootSignature(const RootSignatureDesc& desc) const;
  /// The same of HLSL's root signature language, see ParseRootSignature.
  /// @errors KA0608 the text; else as of the overload with a desc: KA0600-0610, KA0904.
  Result<RootSignature> CreateRootSignature(std::string_view hlsl_text) const;
  /// The same of a root signature in a compiled library: the GlobalRootSignature or
  /// LocalRootSignature subobject of that name, or the [RootSignature] of the entry point of that
  /// name. Without a name, the library's only global one.
  /// [D3D12: CreateRootSignature, CreateRootSignatureFromSubobjectInLibrary]
  /// @errors KA0633 there is none, there are several, or its text cannot be used; KA0904.
  Result<RootSignature> CreateRootSignature(const ShaderLibrary& library,
                                            std::string_view name = {}) const;
  /// Makes a collection or a ray tracing pipeline. All rules that the description alone can break
  /// are checked here: exports, hit groups, associations, configs, and that root signatures feed
  /// every resource of every shader. What the description holds is copied; the result keeps its
  /// libraries and root signatures alive. Backends compile pipelines in this call.
  /// [DXR: CreateStateObject; Subobject association behavior; Raytracing pipeline state object]
  /// @errors KA0904 an empty handle, KA0903 an object of another device. Subobjects: KA0500-0502,
  /// KA0519-0521, KA0536, KA0538, KA0539. Exports: KA0503-0506. Associations: KA0507-0510, KA0515.
  /// Configs: KA0511-0514. Hit groups: KA0516-0518, KA0524. Sizes: KA0522, KA0523. Collections:
  /// KA0525, KA0526. Root signatures: KA0527-0531, KA0543. Device: KA0542, KA0544,
  /// KA0545. Functions without a body:
  /// KA0560 none defines it, KA0561 another signature, KA0562 a collection's flags, KA0563 no
  /// source, KA0564 what the compiler says of the libraries together. On Vulkan: KA0952, KA0954 a
  /// library without SPIR-V, KA0956, KA0963 RayQuery that the device lacks. The reason if the
  /// device is removed.
  Result<StateObject> CreateStateObject(const StateObjectDesc& desc) const;
  /// Makes a pipeline of a parent and more exports. The addition is a pipeline that is valid by
  /// itself and refers to nothing of the parent; both have kAllowStateObjectAdditions, and their
  /// configs are equal. Identifiers of the parent stay valid in the result. The parent may be in
  /// use meanwhile, and may be dropped afterwards; its stack size is taken over. Needs tier 1.1.
  /// [DXR: AddToStateObject]
  /// @errors KA0533 not allowed: tier, collection or flags; KA0534 configs differ; KA0535 an export
  /// of the parent's name; and every error of CreateStateObject, for the addition and for the
  /// whole.
  Result<StateObject> AddToStateObject(const StateObjectDesc& addition,
                                       const StateObject& parent) const;
  /// Makes a compute pipeline. [D3D12: CreateComputePipelineState]
  /// @errors KA0904 an empty handle; KA0903 a root signature of another device; KA0528, KA0529 the
  /// root signature does not feed a resource; KA0536 a local root signature; KA0537 no such shader,
  /// several where EntryPoint is empty, or its thread group (up to 1024 x 1024 x 64, 1024 in all);
  /// KA0542 RayQuery on a device of tier 1.0; KA0544 a library of a higher shader model; KA0550
  /// [WaveSize] that the device's waves do not have; on Vulkan KA0551 no subgroup operations,
  /// KA0952, KA0954, KA0956, KA0963; the reason if the device is removed.
  Result<PipelineState> CreateComputePipelineState(const ComputePipelineStateDesc& desc) const;
  /// Makes a graphics pipeline. Stages are linked by semantics: elements of the layout to inputs of
  /// the vertex shader, its outputs to inputs of the pixel shader.
  /// [D3D12: CreateGraphicsPipelineState]
  /// @errors KA0904 an empty handle; KA0903 a root signature of another device; KA0536 a local root
  /// signature; KA0528, KA0529, KA0543 it does not feed a resource; KA0542 RayQuery on a device of
  /// tier 1.0; KA0544 a library of a higher shader model; KA0720-KA0727 the description; on Vulkan
  /// KA0551 no subgroup operations in pixel shaders, KA0952, KA0954, KA0956, KA0963; the reason if
  /// the device is removed. Warning: KA0728.
  Result<PipelineState> CreateGraphicsPipelineState(const GraphicsPipelineStateDesc& desc) const;
  /// Makes a command signature for ExecuteIndirect. `root_signature` is a global one; it is needed
  /// if an argument sets a root argument, and ignored otherwise.
  /// [D3D12: CreateCommandSignature; DXR: D3D12_COMMAND_SIGNATURE_DESC]
  /// @errors KA0904 empty handle; KA0903 a root signature of another device; KA0536 a local one;
  /// KA0540 an argument or the stride; KA0541 kDispatchRays on a device below tier 1.1; the reason
  /// if the device is removed.
  Result<CommandSignature> CreateCommandSignature(const CommandSignatureDesc& desc,
                                                  const RootSignature& root_signature = {}) const;

  /// Makes a heap of queries for CommandList::BeginQuery and EndQuery. [D3D12: CreateQueryHeap]
  /// @errors KA0904 an empty handle; KA0744 the description; on Vulkan KA0952, KA0958 the device
  /// has no queries of this type; KA0990 no memory; the reason if the device is removed.
  Result<QueryHeap> CreateQueryHeap(const QueryHeapDesc& desc) const;

  // Acceleration structures

  /// Bytes that suffice for this build and for every one with the same flags and formats and with
  /// equal or smaller counts. Geometry descs are read, GPU memory is not, and addresses are not
  /// looked at: any number does while buffers do not exist yet, and indices are counted without an
  /// index buffer. [DXR: GetRaytracingAccelerationStructurePrebuildInfo]
  /// @errors KA0904 empty handle; KA0700 types, layout or flags; KA0701 build flags; KA0702 mixed
  /// geometry; KA0703 vertex format; KA0704 index format; KA0705, KA0708 stride; KA0709
  /// more than 2^24 geometries or instances, or 2^29 primitives; KA0710 null pointers; KA0545 the
  /// device has no ray tracing.
  Result<RaytracingAccelerationStructurePrebuildInfo>
  GetRaytracingAccelerationStructurePrebuildInfo(
      const BuildRaytracingAccelerationStructureInputs& inputs) const;

  /// EXPERIMENTAL. Bytes that suffice for this operation and for every one with equal or smaller
  /// maxima. Zeros on a device without these operations, and for inputs that are invalid; the
  /// reason goes to OnMessage as a warning. [DXR 2.0: GetRTASOperationPrebuildInfo]
  /// @errors as messages: KA0549 the device does not have them; KA0748 the inputs.
  RtasOperationPrebuildInfo GetRTASOperationPrebuildInfo(const RtasOperationInputs& inputs) const;

  /// Tells whether CopyRaytracingAccelerationStructure(kDeserialize) takes data with this
  /// identifier, which is the start of its header. An empty handle recognizes none. Never fails.
  /// [DXR: CheckDriverMatchingIdentifier]
  DriverMatchingIdentifierStatus CheckDriverMatchingIdentifier(
      SerializedDataType type, const SerializedDataDriverMatchingIdentifier& identifier) const;

  // Work

  /// Makes a command list, which is open. [D3D12: CreateCommandList]
  /// @errors KA0904 empty handle; the reason if the device is removed.
  Result<CommandList> CreateCommandList() const;
  /// Makes a queue. [D3D12: CreateCommandQueue]
  /// @errors KA0904 empty handle; the reason if the device is removed.
  Result<CommandQueue> CreateCommandQueue() const;
  /// Makes a fence. [D3D12: CreateFence]
  /// @errors KA0904 empty handle.
  Result<Fence> CreateFence(uint64_t initial_value = 0) const;

  /// For the library itself.
  const std::shared_ptr<detail::DeviceImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::DeviceImpl> impl_;
};

}  // namespace rtapi
