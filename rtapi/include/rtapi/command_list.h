// SPDX-License-Identifier: MIT
/// @file
/// Recording commands. Nothing executes while it is recorded; structures in host memory are copied
/// at once, GPU memory is read when the list executes. [DXR: Command list methods]
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/barrier.h>
#include <rtapi/command_signature.h>
#include <rtapi/descriptor.h>
#include <rtapi/graphics_pipeline.h>
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
struct CommandListImpl;
}

/// What becomes of a list if one of its calls breaks a rule. The call is not recorded either way,
/// but for what drivers do with kDropCall: a vertex buffer view that reaches past its buffer is cut
/// there, the address of a root descriptor of another type is set, and a pipeline runs under
/// another root signature if the parameters' types and sizes are those of its own, whose registers
/// count.
enum class InvalidCalls : uint32_t {
  kFailList = 0,  ///< Close() returns the error, and the list cannot be executed
  /// As D3D12's runtimes do without their debug layer: calls that they drop or ignore are told to
  /// DeviceDesc::OnMessage as errors, and the rest of the list executes. These are KA0731,
  /// KA0740-0743, KA0802-0805, KA0807-0816, KA0822 and KA0824, those of acceleration structure
  /// builds and copies (KA0700-0719) and of queries (KA0745). All others fail the list, as there:
  /// arguments of copies, empty handles, what is not supported. A list that is executed open
  /// removes the device with KA0823. [D3D12: ID3D12GraphicsCommandList::Close]
  kDropCall = 1,
};

/// The way a value of WriteBufferImmediate is ordered. Every one is a plain write in order here.
/// [D3D12: D3D12_WRITEBUFFERIMMEDIATE_MODE]
enum class WriteBufferImmediateMode : uint32_t { kDefault = 0, kMarkerIn = 1, kMarkerOut = 2 };

/// One 32-bit value of WriteBufferImmediate. [D3D12: D3D12_WRITEBUFFERIMMEDIATE_PARAMETER]
struct WriteBufferImmediateParameter {
  GpuVirtualAddress Dest = 0;  ///< a multiple of 4, in a buffer of the default or readback heap
  uint32_t Value = 0;          ///< what is written
};

/// A command list for every kind of work; open when created. A copyable handle, for one thread at a
/// time.
///
/// Calls that record return nothing, as in D3D12: a call that breaks a rule is not recorded, its
/// error is kept, and Close() returns the first of them; DeviceDesc::InvalidCalls makes some drop.
/// The errors listed below are those. On a closed list every call is KA0800; on an empty handle it
/// does nothing, but for Reset and Close.
///
/// Errors that only execution can find remove the device, for all commands with KA0990 (no memory)
/// and on Vulkan KA0952, KA0955 (device lost), KA0956 (over a limit) and KA0959 (validation
/// layers); each call says what else. Warnings come through DeviceDesc::OnMessage, and work goes
/// on. [D3D12: ID3D12GraphicsCommandList4]
class CommandList {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same list.
  ///@{
  CommandList() = default;
  explicit CommandList(std::shared_ptr<detail::CommandListImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const CommandList&) const = default;
  ///@}

  /// Drops commands and errors, forgets all state and opens the list, in whatever state it is. Work
  /// that was submitted goes on: the queue keeps its commands.
  /// [D3D12: ID3D12GraphicsCommandList::Reset]
  /// @errors KA0904 empty handle; what Device::GetDeviceRemovedReason says.
  Status Reset();
  /// Ends recording. [D3D12: ID3D12GraphicsCommandList::Close]
  /// @errors KA0904 empty handle; KA0800 the list is closed already; else the first error of the
  /// calls since Reset, KA0824 for a BeginEvent without its EndEvent: the list cannot be executed.
  Status Close();
  /// All errors since Reset, in order. Valid until the next call on the list.
  const std::vector<Error>& GetErrors() const;
  /// Tells whether commands can be recorded; false for an empty handle.
  bool is_open() const;

  /// Unsets all state as a Reset does, but keeps what was recorded, and sets a pipeline if one is
  /// given. [D3D12: ClearState]
  /// @errors KA0800; KA0903 a pipeline of another device.
  void ClearState(const PipelineState& pipeline = {});

  /// Orders what comes before and after, and says what resources are used for next. Each barrier of
  /// the span is taken or refused by itself. Builds, and traces of what they built, need UAV
  /// barriers between them; checked mode reports barriers that are missing (KA0450-0452).
  /// [D3D12: ResourceBarrier; DXR: Synchronizing acceleration structure memory writes/reads]
  /// @errors KA0800; KA0802 type, states that are equal, an upload or readback buffer, or a
  /// subresource that does not exist; KA0803 a transition of an acceleration structure buffer;
  /// KA0903 a resource of another device; KA0904 an empty resource in a transition.
  void ResourceBarrier(std::span<const rtapi::ResourceBarrier> barriers);
  /// @overload
  void ResourceBarrier(const rtapi::ResourceBarrier& barrier) {
    ResourceBarrier(std::span<const rtapi::ResourceBarrier>(&barrier, 1));
  }
  /// @overload
  void ResourceBarrier(std::initializer_list<rtapi::ResourceBarrier> barriers) {
    ResourceBarrier(std::span<const rtapi::ResourceBarrier>(barriers.begin(), barriers.size()));
  }

  /// Enhanced barriers, which say apart what is done first, what waits, and which accesses memory
  /// must be visible to; those of textures change layouts. Each barrier of the span is taken or
  /// refused by itself. The first half of a split barrier does nothing. Checked mode reports uses
  /// that no barrier allows, and layouts that are not there (KA0450-0452).
  /// [D3D12: ID3D12GraphicsCommandList7::Barrier]
  /// @errors KA0800; KA0858 bits or layouts that are not defined or do not go together, an access
  /// that the resource does not allow, a range that is not there; KA0903 a resource of another
  /// device; KA0904 an empty resource.
  ///@{
  void Barrier(std::span<const GlobalBarrier> barriers);
  void Barrier(std::span<const BufferBarrier> barriers);
  void Barrier(std::span<const TextureBarrier> barriers);
  void Barrier(const GlobalBarrier& barrier) { Barrier(std::span(&barrier, 1)); }
  void Barrier(const BufferBarrier& barrier) { Barrier(std::span(&barrier, 1)); }
  void Barrier(const TextureBarrier& barrier) { Barrier(std::span(&barrier, 1)); }
  ///@}

  /// Sets the heaps that descriptor tables and HLSL's descriptor heaps read: at most one of each
  /// type, shader-visible. Replaces both; a type that is not given has none afterwards.
  /// [D3D12: SetDescriptorHeaps; DXR: Resource binding]
  /// @errors KA0800; KA0804 a heap that shaders cannot see, or the second of its type; KA0903 a
  /// heap of another device; KA0904 an empty handle.
  void SetDescriptorHeaps(std::span<const DescriptorHeap> heaps);
  /// @overload
  void SetDescriptorHeaps(std::initializer_list<DescriptorHeap> heaps) {
    SetDescriptorHeaps(std::span<const DescriptorHeap>(heaps.begin(), heaps.size()));
  }

  /// Sets the root signature of Dispatch and the global one of DispatchRays. One of the same
  /// definition keeps all root arguments. One of another makes them undefined in D3D12 and zero
  /// here (with InvalidCalls::kDropCall those of the same index and type stay, as in drivers);
  /// checked mode tells of shaders that read them. [DXR: Local root signatures vs global root
  /// signatures]
  /// @errors KA0800; KA0536 a local root signature; KA0903 of another device; KA0904 empty handle.
  void SetComputeRootSignature(const RootSignature& root_signature);
  /// Sets one constant of a parameter: 32-bit value number `dest_offset_dwords`, from 0.
  /// [D3D12: SetComputeRoot32BitConstant]
  /// @errors as of SetComputeRoot32BitConstants: KA0800, KA0805, KA0807, KA0808.
  void SetComputeRoot32BitConstant(uint32_t parameter, uint32_t value, uint32_t dest_offset_dwords);
  /// Sets `count` 32-bit constants of a parameter from value number `dest_offset_dwords` on.
  /// `values` are copied in this call; the other constants stay as they are.
  /// [D3D12: SetComputeRoot32BitConstants]
  /// @errors KA0800; KA0805 no root signature is set; KA0807 no such parameter, or it has another
  /// type; KA0808 values past the end of the parameter, or a null pointer.
  void SetComputeRoot32BitConstants(uint32_t parameter, uint32_t count, const void* values,
                                    uint32_t dest_offset_dwords);
  /// Sets the first constants of a parameter to the bytes of `value`; its size is a multiple of 4.
  /// @errors as of the overload with a pointer: KA0800, KA0805, KA0807, KA0808.
  template <class T>
  void SetComputeRoot32BitConstants(uint32_t parameter, const T& value) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    SetComputeRoot32BitConstants(parameter, sizeof(T) / 4, &value, 0);
  }
  /// Sets a root CBV to an address, a multiple of 256 in a live buffer. 0: a null view, which reads
  /// zeros. The buffer must live until the work has completed; only its start is checked here, and
  /// checked mode reports reads past its end (KA0417). [D3D12: SetComputeRootConstantBufferView]
  /// @errors KA0800; KA0805 no root signature is set; KA0807 no such parameter, or it has another
  /// type; KA0809 a misaligned address, or one in no live buffer.
  void SetComputeRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address);
  /// Sets a root SRV to an address, a multiple of 4 in a live buffer: that of a raw or structured
  /// buffer's first byte, or of an acceleration structure. 0: a null view, which reads zeros, or a
  /// structure that every ray misses. Lifetime and checks as of SetComputeRootConstantBufferView.
  /// [D3D12: SetComputeRootShaderResourceView; DXR: RaytracingAccelerationStructure]
  /// @errors KA0800; KA0805 no root signature is set; KA0807 no such parameter, or it has another
  /// type; KA0809 a misaligned address, or one in no live buffer.
  void SetComputeRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address);
  /// Sets a root UAV to an address, a multiple of 4 in a live buffer. 0: a null view, which drops
  /// writes. Lifetime and checks as of SetComputeRootConstantBufferView.
  /// [D3D12: SetComputeRootUnorderedAccessView]
  /// @errors KA0800; KA0805 no root signature is set; KA0807 no such parameter, or it has another
  /// type; KA0809 a misaligned address, or one in no live buffer.
  void SetComputeRootUnorderedAccessView(uint32_t parameter, GpuVirtualAddress address);
  /// Sets a descriptor table to start at a slot of the heap of its type that is set now. The
  /// descriptors are read when the list executes. [D3D12: SetComputeRootDescriptorTable]
  /// @errors KA0800; KA0805 no root signature is set; KA0807 no such parameter, or it has another
  /// type; KA0810 the handle is in no heap of this type that is set.
  void SetComputeRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base);

  /// Root arguments of draws. They are separate from those of dispatches: setting one does not
  /// touch the other. Otherwise as the calls with Compute in their names, with their errors.
  /// [D3D12: SetGraphicsRootSignature, SetGraphicsRoot...]
  /// @errors KA0800; KA0536, KA0903, KA0904 the root signature; KA0805, KA0807-KA0810 an argument.
  ///@{
  void SetGraphicsRootSignature(const RootSignature& root_signature);
  void SetGraphicsRoot32BitConstant(uint32_t parameter, uint32_t value,
                                    uint32_t dest_offset_dwords);
  void SetGraphicsRoot32BitConstants(uint32_t parameter, uint32_t count, const void* values,
                                     uint32_t dest_offset_dwords);
  template <class T>
  void SetGraphicsRoot32BitConstants(uint32_t parameter, const T& value) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    SetGraphicsRoot32BitConstants(parameter, sizeof(T) / 4, &value, 0);
  }
  void SetGraphicsRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address);
  void SetGraphicsRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address);
  void SetGraphicsRootUnorderedAccessView(uint32_t parameter, GpuVirtualAddress address);
  void SetGraphicsRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base);
  ///@}

  /// Sets the pipeline of Dispatch or of draws, and unsets the other and that of DispatchRays. All
  /// other state stays.
  /// [D3D12: SetPipelineState]
  /// @errors KA0800; KA0903 a pipeline of another device; KA0904 empty handle.
  void SetPipelineState(const PipelineState& pipeline);
  /// Sets the pipeline of DispatchRays, and unsets those of Dispatch and draws. All other state
  /// stays.
  /// [DXR: SetPipelineState1]
  /// @errors KA0800; KA0811 a collection; KA0903 a state object of another device; KA0904 empty
  /// handle.
  void SetPipelineState1(const StateObject& pipeline);
  /// Runs the ray generation shader of one record for each cell of a Width x Height x Depth grid,
  /// in no particular order; nothing where one of the three is 0. The desc is copied; tables, heaps
  /// and whatever addresses name are read when the list executes, and must live until then. Root
  /// arguments and the stack size are those of now. A record that is NULL, past its table or none
  /// of this pipeline's runs nothing. [DXR: DispatchRays, D3D12_DISPATCH_RAYS_DESC]
  /// @errors KA0800; KA0811 no ray tracing pipeline is set; KA0812 the root signature that is set
  /// is that of none of its ray generation shaders; KA0813 a table's or record's alignment, stride
  /// or size; KA0814 more than 2^30 threads; KA0815 a table that is not all in one live buffer.
  /// When it executes: KA0890 TraceRay past the recursion limit, KA0891 stack used up, KA0892 a
  /// fault in shader code, KA0893 a shader asked for it, KA0897 an interpreted shader's limit of
  /// steps. Warnings: KA0888 rays that Embree cannot take, since a coordinate in the world or in an
  /// instance's space is past 1.8e18, KA0894 no top level at an address that rays were traced
  /// against, KA0895 a record past its table, KA0896 a record without an identifier of the
  /// pipeline. Checked mode: KA0400-0499.
  void DispatchRays(const DispatchRaysDesc& desc);
  /// Runs the compute shader for groups_x x groups_y x groups_z thread groups; nothing where one of
  /// the three is 0. Heaps and whatever addresses name are read when the list executes, and must
  /// live until then. Root arguments are those of now. [D3D12: Dispatch]
  /// @errors KA0800; KA0811 no compute pipeline is set; KA0812 the root signature that is set is
  /// not the pipeline's; KA0814 more than 65535 groups in a dimension. When it executes: KA0892,
  /// KA0893, KA0897 as of DispatchRays. Checked mode: KA0400-0499.
  void Dispatch(uint32_t groups_x, uint32_t groups_y, uint32_t groups_z);
  // Draws

  /// Sets how the vertices of draws form triangles. [D3D12: IASetPrimitiveTopology]
  /// @errors KA0800; KA0721 points, lines and patches; KA0740 a number that is no topology.
  void IASetPrimitiveTopology(PrimitiveTopology topology);
  /// Sets vertex buffers of slots start_slot, start_slot + 1, ... The views are copied; the buffers
  /// must live until the list has executed. Each element reads zeros where its bytes are not all in
  /// the view, and missing components are (0, 0, 0, 1). [D3D12: IASetVertexBuffers]
  /// @errors KA0800; KA0741 a slot above 31, a stride above 2048, or an address in no live buffer.
  void IASetVertexBuffers(uint32_t start_slot, std::span<const VertexBufferView> views);
  /// Sets one vertex buffer.
  /// @errors KA0800; KA0741 as of the overload with several.
  void IASetVertexBuffers(uint32_t slot, const VertexBufferView& view) {
    IASetVertexBuffers(slot, std::span<const VertexBufferView>(&view, 1));
  }
  /// Sets the index buffer, which must live until the list has executed; null: none, and every
  /// index is 0. [D3D12: IASetIndexBuffer]
  /// @errors KA0800; KA0741 the format, the alignment, or an address in no live buffer.
  void IASetIndexBuffer(const IndexBufferView* view);
  /// Sets all viewports; those that are not given are empty. At first all are. Draws use number 0,
  /// or that which the vertex shader writes to SV_ViewportArrayIndex. [D3D12: RSSetViewports]
  /// @errors KA0800; KA0742 more than 16, or numbers that are not finite or out of their range.
  void RSSetViewports(std::span<const Viewport> viewports);
  /// Sets one viewport.
  /// @errors KA0800; KA0742 as of the overload with several.
  void RSSetViewports(const Viewport& viewport) {
    RSSetViewports(std::span<const Viewport>(&viewport, 1));
  }
  /// Sets the scissor rectangle of each viewport; those that are not given are empty. At first all
  /// are, and nothing is drawn. [D3D12: RSSetScissorRects]
  /// @errors KA0800; KA0742 more than 16.
  void RSSetScissorRects(std::span<const Rect> rects);
  /// Sets one scissor rectangle.
  /// @errors KA0800; KA0742 as of the overload with several.
  void RSSetScissorRects(const Rect& rect) { RSSetScissorRects(std::span<const Rect>(&rect, 1)); }
  /// Sets what draws write to: `count` render targets by RTV handles, and a depth buffer by a DSV
  /// handle or null. The descriptors are read now, so that their slots may be written anew; the
  /// textures must live until the list has executed. [D3D12: OMSetRenderTargets]
  /// @errors KA0800; KA0731 a handle without such a view; KA0742 more than 8 render targets, or a
  /// null pointer to them.
  void OMSetRenderTargets(uint32_t count, const CpuDescriptorHandle* render_targets,
                          bool single_handle_to_descriptor_range = false,
                          const CpuDescriptorHandle* depth_stencil = nullptr);
  /// Sets the factor of Blend::kBlendFactor: red, green, blue, alpha; null and at first: ones.
  /// [D3D12: OMSetBlendFactor]
  /// @errors KA0800.
  void OMSetBlendFactor(const float factor[4]);
  /// Sets the reference of the stencil test, of which the lower 8 bits count; at first 0.
  /// [D3D12: OMSetStencilRef]
  /// @errors KA0800.
  void OMSetStencilRef(uint32_t reference);
  /// Sets the references of front facing triangles and of the others.
  /// [D3D12: OMSetFrontAndBackStencilRef]
  /// @errors KA0800.
  void OMSetFrontAndBackStencilRef(uint32_t front, uint32_t back);
  /// Sets every texel of a render target view, or those in rectangles, to a colour, which is
  /// converted to the format like a pixel shader's output. Viewports, scissors, masks and blending
  /// do not count. [D3D12: ClearRenderTargetView]
  /// @errors KA0800; KA0731 the handle; KA0743 a null pointer.
  void ClearRenderTargetView(CpuDescriptorHandle view, const float color[4],
                             std::span<const Rect> rects = {});
  /// Sets depth (0 to 1), stencil, or both, of every texel of a depth-stencil view, or of those in
  /// rectangles. [D3D12: ClearDepthStencilView]
  /// @errors KA0800; KA0731 the handle; KA0743 no flag, an unknown one, or a depth that is not from
  /// 0 to 1.
  void ClearDepthStencilView(CpuDescriptorHandle view, ClearFlags flags, float depth,
                             uint8_t stencil, std::span<const Rect> rects = {});
  /// Draws vertices 0, 1, ... of each instance; nothing where a count is 0. State is that of now;
  /// vertices, heaps and whatever addresses name are read when the list executes. Results in
  /// targets and depth are as if triangles were drawn one after another, in order. [D3D12:
  /// DrawInstanced]
  /// @errors KA0800; KA0740 no topology is set; KA0811 no graphics pipeline is set; KA0812 the root
  /// signature that is set is not the pipeline's. When it executes: KA0892, KA0893, KA0897 as of
  /// Dispatch.
  void DrawInstanced(uint32_t vertex_count_per_instance, uint32_t instance_count,
                     uint32_t start_vertex_location, uint32_t start_instance_location);
  /// Draws the vertices that indices name, with `base_vertex_location` added to each.
  /// [D3D12: DrawIndexedInstanced]
  /// @errors KA0800, KA0740, KA0811, KA0812 as of DrawInstanced.
  void DrawIndexedInstanced(uint32_t index_count_per_instance, uint32_t instance_count,
                            uint32_t start_index_location, int32_t base_vertex_location,
                            uint32_t start_instance_location);

  /// Up to `max_command_count` dispatches or draws whose arguments stand in `argument_buffer` when
  /// the list executes; fewer if the uint32_t in `count_buffer` is smaller. Offsets are multiples
  /// of 4, and the arguments of max_command_count commands lie inside the buffer. The pipeline and
  /// all other root arguments are those of the list; what the signature sets is 0 afterwards.
  /// Commands of a count of zero are skipped whatever else they hold. [D3D12: ExecuteIndirect; DXR:
  /// ExecuteIndirect, D3D12_INDIRECT_ARGUMENT_TYPE]
  /// @errors KA0800; KA0740, KA0811, KA0812 as of DispatchRays, Dispatch or draws; KA0816 an
  /// offset, a range outside of a buffer, or another root signature than the command signature's;
  /// KA0903 an object of another device; KA0904 an empty signature or argument buffer. When it
  /// executes: KA0898 arguments that break a rule (a table outside every buffer, more than 2^30
  /// threads), and those of the dispatches.
  void ExecuteIndirect(const CommandSignature& signature, uint32_t max_command_count,
                       const Buffer& argument_buffer, uint64_t argument_buffer_offset_bytes,
                       const Buffer& count_buffer = {}, uint64_t count_buffer_offset_bytes = 0);

  /// Builds an acceleration structure, or refits one (kPerformUpdate), and writes postbuild info of
  /// it, of each type at most once. Desc and geometry descs are copied; vertices, indices,
  /// transforms, boxes and instance descs are read when the list executes, after which the
  /// structure does not refer to them. It lasts until something else is written to its bytes. After
  /// a bottom level has changed, the top levels that hold it must be rebuilt or updated before they
  /// are traced (KA0463 in checked mode). An update may change vertex positions, the contents of
  /// transforms, boxes, and everything about instances, and nothing else; inputs may lie elsewhere.
  /// [DXR: BuildRaytracingAccelerationStructure; Acceleration structure update constraints]
  /// @errors KA0800; the inputs: KA0700-0705, KA0707-0710; KA0711 an address that is not a multiple
  /// of 256; KA0712 an address in no live buffer; KA0713 a destination that was not created for
  /// acceleration structures, or scratch memory without kAllowUnorderedAccess; KA0714 a source
  /// without kPerformUpdate; KA0715 postbuild info; KA0717 alignment of instance descs; KA0719 a
  /// buffer is too small. When it executes: KA0790 input outside of its buffer, KA0791 its format,
  /// KA0792 Embree failed, KA0793 the update breaks a rule, KA0794 too many primitives or
  /// instances, KA0795 the destination is too small, KA0796 instance descs. Warnings: KA0797 an
  /// instance is inactive, KA0798 indices past the vertices. Checked mode: KA0450-0476.
  void BuildRaytracingAccelerationStructure(
      const BuildRaytracingAccelerationStructureDesc& desc,
      std::span<const RaytracingAccelerationStructurePostbuildInfoDesc> postbuild_infos = {});
  /// Writes postbuild info of built structures: an array without gaps, one element for each source,
  /// in order; 8 bytes each, of kSerialization 16. The values are those of when the list executes;
  /// a UAV barrier stands between the builds and this.
  /// [DXR: EmitRaytracingAccelerationStructurePostbuildInfo]
  /// @errors KA0800; KA0711-0713 a source; KA0712, KA0719 the destination; KA0715 its type, its
  /// alignment or its buffer's flags. When it executes: KA0795 it does not fit, KA0796 a source
  /// that is no acceleration structure, or one that ExecuteIndirectRTASOperations made, which has
  /// kSerialization and kToolsVisualization only.
  void EmitRaytracingAccelerationStructurePostbuildInfo(
      const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
      std::span<const GpuVirtualAddress> sources);
  /// Copies a structure, or turns one into bytes and back. Both addresses are multiples of 256, and
  /// the ranges do not overlap. The source stays as it is; bottom levels that a top level refers to
  /// are not touched. Sizes: kClone as the source, kCompact, kSerialize and
  /// kVisualizationDecodeForTools by postbuild info, kDeserialize by the header. Structures lie in
  /// buffers for acceleration structures, serialized and decoded bytes in others. EXPERIMENTAL:
  /// what ExecuteIndirectRTASOperations made takes no kClone and no kCompact; clusters lie at
  /// multiples of 128, templates of 32.
  /// [DXR: CopyRaytracingAccelerationStructure, D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE]
  /// @errors KA0800; KA0711 alignment; KA0712 an address in no live buffer; KA0713 a buffer of the
  /// wrong kind, or bytes written to one without kAllowUnorderedAccess; KA0716 the mode, or both
  /// addresses are the same; KA0719 a buffer is too small. When it executes: KA0789 the serialized
  /// data is of another driver or version, damaged, or names a bottom level in no buffer; KA0795 it
  /// does not fit; KA0796 the source is no structure, was built without kAllowCompaction, overlaps
  /// the destination, or does not take the mode. Warnings: KA0797 an instance of a deserialized top
  /// level is inactive, KA0788 a deserialized bottom level lacks one of its clusters.
  void CopyRaytracingAccelerationStructure(GpuVirtualAddress dest, GpuVirtualAddress source,
                                           RaytracingAccelerationStructureCopyMode mode);

  /// EXPERIMENTAL. Runs operations whose arguments stand in GPU memory when the list executes. The
  /// descs are copied. Operations of one call run in any order, and so do the arguments of one; a
  /// UAV barrier stands between a call and what uses its results. What is wrong with an argument in
  /// GPU memory is a warning, and that argument is left out. [DXR 2.0:
  /// ExecuteIndirectRTASOperations]
  /// @errors KA0800; KA0549 the device does not have these operations; KA0748 inputs, or flags;
  /// KA0749 an address: alignment, in no live buffer, a buffer of another kind or too small. When
  /// it executes: KA0792 Embree failed, KA0795 the destination of a partitioned top level is too
  /// small, KA0990. Warnings: KA0797 an instance is inactive, KA0788 an argument breaks a rule.
  void ExecuteIndirectRTASOperations(
      std::span<const RtasOperationDesc> descs,
      ExecuteIndirectRtasOperationsFlags flags = ExecuteIndirectRtasOperationsFlags::kNone);

  /// Copies `size_bytes` from a buffer to another, or within one if the ranges do not overlap; 0
  /// bytes do nothing. The list keeps both alive. [D3D12: CopyBufferRegion]
  /// @errors KA0800; KA0817 bytes past the end of a buffer; KA0818 ranges that overlap; KA0821 to
  /// the upload heap, from the readback heap, or a buffer of acceleration structures; KA0903 a
  /// buffer of another device; KA0904 an empty handle.
  void CopyBufferRegion(const Buffer& dest, uint64_t dest_offset_bytes, const Buffer& source,
                        uint64_t source_offset_bytes, uint64_t size_bytes);
  /// Copies texels between subresources, within one if they do not overlap, or between a
  /// subresource and a buffer: those of `source_box` (null: all) to (x, y, z) of the destination,
  /// with all samples of each. Formats are of one family; values are not converted. An empty box
  /// copies nothing. The list keeps both sides alive.
  /// Block-compressed formats: coordinates are multiples of 4, or for right and bottom the size of
  /// the subresource. Their blocks can also go to and come from texels of integer or typeless
  /// formats with as many bytes: BC1 and BC4 of 8, the others of 16. [D3D12: CopyTextureRegion]
  /// @errors KA0800; KA0572 parts of blocks; KA0574 counts of samples that differ; KA0817 a
  /// subresource that does not exist, texels outside of a side, or a footprint outside of its
  /// buffer; KA0818 texels of one subresource that overlap; KA0819 formats of different families,
  /// two buffers, or a Type that is not the resource's; KA0820 the footprint; KA0903 a resource of
  /// another device; KA0904 an empty handle.
  void CopyTextureRegion(const TextureCopyLocation& dest, uint32_t x, uint32_t y, uint32_t z,
                         const TextureCopyLocation& source, const Box* source_box = nullptr);
  /// Copies a whole buffer to one of the same size, or every subresource of a texture to one of the
  /// same dimension, size and mip levels and of the same format family. [D3D12: CopyResource]
  /// @errors KA0800; KA0818 source and destination are one resource; KA0819 kinds, sizes or formats
  /// that differ; KA0821 as of CopyBufferRegion; KA0903 a resource of another device; KA0904 an
  /// empty resource.
  void CopyResource(const Resource& dest, const Resource& source);

  /// Reduces a subresource of a multisampled texture to one of a texture with one sample and the
  /// same size: the average of each pixel's samples, of sRGB formats in linear space. `format` is
  /// that of both, or a typed one of their family; it is no integer and no depth format. The list
  /// keeps both alive. [D3D12: ResolveSubresource]
  /// @errors KA0800; KA0575 counts, sizes, formats; KA0817 a subresource that does not exist;
  /// KA0903 a texture of another device; KA0904 an empty handle.
  void ResolveSubresource(const Texture& dest, uint32_t dest_subresource, const Texture& source,
                          uint32_t source_subresource, Format format);
  /// Reduces those pixels of `source_rect` (null: all) to (x, y) of the destination by `mode`: the
  /// average as ResolveSubresource, or the least or greatest sample, which integer and depth
  /// formats may have, too. kDecompress takes every sample as it is to a texture with as many, or
  /// to pixels of the same one that do not overlap, and is nothing where both are the same. An
  /// empty rectangle resolves nothing. [D3D12: ResolveSubresourceRegion]
  /// @errors KA0800; KA0575 counts, formats, an unknown mode; KA0817 a subresource that does not
  /// exist, or pixels outside of a side; KA0818 pixels that overlap; KA0903 a texture of another
  /// device; KA0904 an empty handle.
  void ResolveSubresourceRegion(const Texture& dest, uint32_t dest_subresource, uint32_t x,
                                uint32_t y, const Texture& source, uint32_t source_subresource,
                                const Rect* source_rect, Format format, ResolveMode mode);

  /// Fills a view with bits, or those texels or elements of it that are in rectangles; of a buffer,
  /// left and right count elements. The view is that of the CPU handle, in any living heap, and is
  /// taken now; it is of `resource`. The GPU handle may name a slot of any heap that shaders see.
  /// Raw and structured buffers are filled with values[0]; of normalized formats each channel takes
  /// the low bits of its value. `values` is copied. Null views are not written.
  /// [D3D12: ClearUnorderedAccessViewUint]
  /// @errors KA0800; KA0822 a handle in no such heap, a descriptor that is no unordered access view
  /// of the resource, or a null pointer; KA0903 a resource of another device; KA0904 an empty one.
  void ClearUnorderedAccessViewUint(GpuDescriptorHandle gpu_handle, CpuDescriptorHandle cpu_handle,
                                    const Resource& resource, const uint32_t values[4],
                                    std::span<const Rect> rects = {});
  /// Fills a view with floats, which are converted to its format. Otherwise as
  /// ClearUnorderedAccessViewUint. [D3D12: ClearUnorderedAccessViewFloat]
  /// @errors KA0800; KA0822 a handle in no such heap, a descriptor that is no unordered access view
  /// of the resource, or a null pointer; KA0903 a resource of another device; KA0904 an empty one.
  void ClearUnorderedAccessViewFloat(GpuDescriptorHandle gpu_handle, CpuDescriptorHandle cpu_handle,
                                     const Resource& resource, const float values[4],
                                     std::span<const Rect> rects = {});

  /// Writes 32-bit values, in order. `modes` is empty or has one for each. [D3D12:
  /// WriteBufferImmediate]
  /// @errors KA0800; KA0825 an address that is misaligned or in no such buffer, an unknown mode, or
  /// modes of another number; KA0990 no memory.
  void WriteBufferImmediate(std::span<const WriteBufferImmediateParameter> parameters,
                            std::span<const WriteBufferImmediateMode> modes = {});

  /// Begins a query of draws and dispatches, which lasts until its EndQuery in the same list.
  /// Queries of any number may run at once; each begin and end waits for the work before it. There
  /// is none for kTimestamp. [D3D12: BeginQuery]
  /// @errors KA0800; KA0745 a type that the heap does not have, no such query, or one that has been
  /// begun; Close() returns it for a query that is not ended; KA0903 a heap of another device;
  /// KA0904 an empty handle.
  void BeginQuery(const QueryHeap& heap, QueryType type, uint32_t index);
  /// Ends a query. For kTimestamp: writes the time at which all earlier commands of the list are
  /// done, in ticks of CommandQueue::GetTimestampFrequency; later timestamps are never smaller.
  /// [D3D12: EndQuery]
  /// @errors KA0800; KA0745 a type that the heap does not have or that is not the begin's, no such
  /// query, or no BeginQuery before; KA0903 a heap of another device; KA0904 an empty handle.
  void EndQuery(const QueryHeap& heap, QueryType type, uint32_t index);
  /// Copies `count` queries from `start_index` on to a buffer of the default or readback heap,
  /// without gaps: a uint64_t each, or a QueryDataPipelineStatistics. `destination_offset_bytes` is
  /// a multiple of 8. [D3D12: ResolveQueryData]
  /// @errors KA0800; KA0745 a type that the heap does not have, no such queries, one that runs, or
  /// the buffer; KA0903 an object of another device; KA0904 an empty handle. When it executes:
  /// warning KA0899, a query that no EndQuery wrote; it is 0.
  void ResolveQueryData(const QueryHeap& heap, QueryType type, uint32_t start_index, uint32_t count,
                        const Buffer& destination, uint64_t destination_offset_bytes);

  /// From now on, draws, Dispatch, ExecuteIndirect, CopyBufferRegion, CopyTextureRegion,
  /// CopyResource, resolves and clears are left out when the uint64_t at `offset_bytes`, a multiple
  /// of 8, of `buffer` is as `op` says. It is read when the list executes, as it is at this call:
  /// later writes change nothing. An empty buffer ends predication, as the end of the list does.
  /// Builds, DispatchRays and everything else runs in any case. [D3D12: Predication]
  /// @errors KA0800; KA0829 a texture, the offset, or an unknown operation; KA0903 a buffer of
  /// another device.
  void SetPredication(const Resource& buffer, uint64_t offset_bytes, PredicationOp op);

  /// Begins a span of commands that messages call by `name`. Spans nest. [D3D12: BeginEvent]
  /// @errors KA0800.
  void BeginEvent(std::string name);
  /// Ends the innermost span. [D3D12: EndEvent]
  /// @errors KA0800; KA0824 there is none.
  void EndEvent();

  /// For the library itself.
  const std::shared_ptr<detail::CommandListImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::CommandListImpl> impl_;
};

}  // namespace rtapi
