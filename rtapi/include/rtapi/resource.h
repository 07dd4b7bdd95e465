// SPDX-License-Identifier: MIT
/// @file
/// Buffers, textures, their states and barriers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>

#include <rtapi/render_target.h>
#include <rtapi/result.h>
#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct BufferImpl;
struct TextureImpl;
}  // namespace detail

/// The kind of memory that a buffer lies in, and so who can read and write it.
/// [D3D12: D3D12_HEAP_TYPE]
enum class HeapType : uint32_t {
  kDefault = 1,   ///< for shaders and commands; the host cannot map it
  kUpload = 2,    ///< the host writes, shaders and copies read
  kReadback = 3,  ///< copies write, the host reads
  /// For everything, and mapped: a custom heap of pages that the processor caches, in its own
  /// memory. What the host writes between two lists shaders see, and the other way round.
  kCustom = 4
};

/// The kind of resource. [D3D12: D3D12_RESOURCE_DIMENSION]
enum class ResourceDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture2D = 3,
  kTexture3D = 4,
};

/// The uses that a resource allows beyond reading. [D3D12: D3D12_RESOURCE_FLAGS]
enum class ResourceFlags : uint32_t {
  kNone = 0,
  kAllowRenderTarget = 0x1,     ///< 2-D textures: draws may write colours to it
  kAllowDepthStencil = 0x2,     ///< 2-D textures of a depth format: draws may test depth with it
  kAllowUnorderedAccess = 0x4,  ///< shaders and builds may write it
  kDenyShaderResource = 0x8,    ///< with kAllowDepthStencil: shaders do not read it
};
template <>
inline constexpr bool kIsFlags<ResourceFlags> = true;

/// The use of a resource between two barriers. Checked mode reports uses that do not go with the
/// state (KA0451), and transitions from another state than the present one (KA0452).
/// [D3D12: D3D12_RESOURCE_STATES]
enum class ResourceStates : uint32_t {
  kCommon = 0,
  kVertexAndConstantBuffer = 0x1,
  kIndexBuffer = 0x2,
  kRenderTarget = 0x4,  ///< draws and clears write colours; alone
  kUnorderedAccess = 0x8,
  kDepthWrite = 0x10,              ///< draws and clears write depth; alone
  kDepthRead = 0x20,               ///< draws test depth without writing it
  kNonPixelShaderResource = 0x40,  ///< what ray tracing shaders, builds and shader tables read
  kPixelShaderResource = 0x80,     ///< what pixel shaders read
  kIndirectArgument = 0x200,       ///< argument and count buffers of ExecuteIndirect
  kPredication = 0x200,            ///< buffers of SetPredication; the same value
  kCopyDest = 0x400,
  kCopySource = 0x800,
  kResolveDest = 0x1000,    ///< what resolves write
  kResolveSource = 0x2000,  ///< the multisampled texture that resolves read
  kGenericRead = 0xAC3,
  kAllShaderResource = 0xC0,
  /// For the whole life of a buffer: no transition into it or out of it.
  /// [DXR: Acceleration structure memory restrictions]
  kRaytracingAccelerationStructure = 0x400000,
};
template <>
inline constexpr bool kIsFlags<ResourceStates> = true;

/// Describes a buffer for Device::CreateBuffer. [D3D12: CreateCommittedResource]
struct BufferDesc {
  uint64_t SizeInBytes = 0;                    ///< 1 to 2^40; the memory starts at zero
  HeapType Heap = HeapType::kDefault;          ///< who can reach it
  ResourceFlags Flags = ResourceFlags::kNone;  ///< unordered access: default and custom heaps
  /// The state before the first barrier. Upload heaps are always in kGenericRead, readback heaps
  /// always in kCopyDest; kCommon stands for either. A buffer for acceleration structures needs
  /// kRaytracingAccelerationStructure, the default heap or a custom one, and kAllowUnorderedAccess.
  ResourceStates InitialState = ResourceStates::kCommon;
  std::string Name = {};  ///< for messages
};

/// Linear memory with a GPU virtual address, which is a multiple of 64 KiB as in D3D12. A copyable
/// handle. The address is live as long as a handle exists.
///
/// A buffer is kept alive by some uses and not by others:
/// - A call that takes the handle (copies, barriers, ExecuteIndirect, clears) keeps it until the
///   list is reset and its work is done.
/// - A call that takes an address keeps nothing: shader tables, root views, inputs and results of
///   builds. Executing a list after such a buffer was freed is an error that names the table,
///   parameter or input and the buffer (KA0856), in every mode and on every backend, even if
///   another buffer has the address by now. From the begin of its execution to the end a list holds
///   them all.
/// - What is in memory keeps nothing and is not looked at beforehand: views in descriptor heaps,
///   addresses in shader records, instances of a top level. Reading freed memory through them gives
///   any value or removes the device; checked mode names the view or argument (KA0419, KA0425,
///   KA0437), and a top level misses the instance (KA0797).
///
/// [D3D12: ID3D12Resource]
class Buffer {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same buffer.
  ///@{
  Buffer() = default;
  explicit Buffer(std::shared_ptr<detail::BufferImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Buffer&) const = default;
  ///@}

  /// Returns the desc that the buffer was created with, and its present name. Valid as long as the
  /// buffer lives. An empty handle has a default BufferDesc.
  const BufferDesc& GetDesc() const;
  /// Bytes of the buffer; 0 for an empty handle.
  uint64_t size() const { return GetDesc().SizeInBytes; }
  /// The address of byte 0, the same for the buffer's whole life; 0 for an empty handle. Address +
  /// n is byte n. [D3D12: ID3D12Resource::GetGPUVirtualAddress]
  GpuVirtualAddress GetGPUVirtualAddress() const;
  /// The name in messages.
  const std::string& name() const { return GetDesc().Name; }
  /// Changes the name in messages. Not while another thread uses the buffer. Does nothing on an
  /// empty handle.
  void SetName(std::string name);

  /// The memory of a buffer that is not on the default heap, size() bytes. It is mapped from its
  /// creation on and stays so: the span is valid as long as the buffer lives. Reads see what
  /// completed commands wrote; commands see what was written before they execute. [D3D12:
  /// ID3D12Resource::Map]
  /// @errors KA0904 empty handle; KA0911 default heap.
  Result<std::span<std::byte>> Map() const;
  /// Does nothing: mapped memory stays mapped. [D3D12: ID3D12Resource::Unmap]
  void Unmap() const {}

  /// The mapped memory as size() / sizeof(T) elements; bytes at the end that make no whole element
  /// are left out. Empty where Map would fail.
  template <class T>
  std::span<T> data() const {
    auto bytes = mapped_bytes();
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }

  /// For the library itself.
  const std::shared_ptr<detail::BufferImpl>& impl() const { return impl_; }

 private:
  std::span<std::byte> mapped_bytes() const;
  std::shared_ptr<detail::BufferImpl> impl_;
};

/// Samples of each pixel. [D3D12: DXGI_SAMPLE_DESC]
struct SampleDesc {
  /// 1, or a count for which Device::GetMultisampleQualityLevels gives levels: of 2, 4 and 8. They
  /// lie where D3D12's standard patterns have them. [D3D11.3: 19.2.4 Standard sample patterns]
  uint32_t Count = 1;
  uint32_t Quality = 0;  ///< 0, the only level; 0xFFFFFFFF, the standard pattern, is the same

  /// True if both members are equal.
  bool operator==(const SampleDesc&) const = default;
};

/// Describes a texture for Device::CreateTexture. [D3D12: D3D12_RESOURCE_DESC]
struct TextureDesc {
  ResourceDimension Dimension = ResourceDimension::kTexture2D;  ///< kTexture1D, 2D or 3D
  /// Texels: 1 to 16384, of a 3-D texture to 2048. No multiples of 4 are needed where texels come
  /// in blocks. [D3D12: UnalignedBlockTexturesSupported]
  uint32_t Width = 1;
  uint32_t Height = 1;  ///< texels, as Width; 1 for a 1-D texture
  /// Depth of a 3-D texture, else array elements: 1 to 2048; 6 for a cube.
  uint16_t DepthOrArraySize = 1;
  uint16_t MipLevels = 1;                          ///< at most the full chain; 0: the full chain
  rtapi::Format Format = rtapi::Format::kUnknown;  ///< any with a FormatInfo; typeless ones too
  /// More than 1: a 2-D texture with one mip that is a target, which only draws, clears and copies
  /// between textures of the same count write. `MipLevels` 0 is then 1.
  rtapi::SampleDesc SampleDesc = {};
  ResourceFlags Flags = ResourceFlags::kNone;  ///< what may write it
  /// The state before the first barrier, of all subresources; not
  /// kRaytracingAccelerationStructure, which is for buffers.
  ResourceStates InitialState = ResourceStates::kCommon;
  std::string Name = {};  ///< for messages
  /// Targets: what they will be cleared to most often. A hint without effect.
  ClearValue OptimizedClearValue = {};
};

/// A texture on the default heap; its texels start at zero. Filled and read by
/// CommandList::CopyTextureRegion, or by UploadTexture and ReadbackTexture of upload.h. A copyable
/// handle; views keep nothing alive. [D3D12: ID3D12Resource]
class Texture {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same texture.
  ///@{
  Texture() = default;
  explicit Texture(std::shared_ptr<detail::TextureImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const Texture&) const = default;
  ///@}

  /// Returns the desc that the texture was created with, where MipLevels is the number of levels
  /// even if 0 was given. Valid as long as the texture lives. An empty handle has a default
  /// TextureDesc.
  const TextureDesc& GetDesc() const;
  /// Subresources: MipLevels * array elements * planes; a 3-D texture has one for each mip. Formats
  /// with depth and stencil have two planes, depth and then stencil, all others one. Subresource
  /// `mip + (element + plane * elements) * MipLevels` is a mip of an array element. 0 for an empty
  /// handle.
  /// [D3D12: subresources]
  uint32_t subresource_count() const;
  /// The name in messages.
  const std::string& name() const { return GetDesc().Name; }
  /// Changes the name in messages. Not while another thread uses the texture. Does nothing on an
  /// empty handle.
  void SetName(std::string name);

  /// For the library itself.
  const std::shared_ptr<detail::TextureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::TextureImpl> impl_;
};

/// A buffer, a texture, or nothing.
using Resource = std::variant<std::monostate, Buffer, Texture>;

// ---------------------------------------------------------------------------------------------
// Barriers

/// The kind of barrier.
/// [D3D12: D3D12_RESOURCE_BARRIER_TYPE]
enum class ResourceBarrierType : uint32_t { kTransition = 0, kAliasing = 1, kUav = 2 };

/// A barrier for CommandList::ResourceBarrier; make it by Transition, Uav or Aliasing.
/// [D3D12: D3D12_RESOURCE_BARRIER]
struct ResourceBarrier {
  ResourceBarrierType Type =
      ResourceBarrierType::kUav;  ///< what it orders, and which members count
  /// The resource that the barrier is for. Empty in a UAV barrier: every resource. In an aliasing
  /// barrier: the placed resource that was used before; empty: any.
  /// [DXR: Synchronizing acceleration structure memory writes/reads]
  rtapi::Resource Resource = {};
  /// Transitions of textures: one subresource, or all of them.
  uint32_t Subresource = kResourceBarrierAllSubresources;
  /// Transitions: the states before and after, which differ.
  ///@{
  ResourceStates StateBefore = ResourceStates::kCommon;
  ResourceStates StateAfter = ResourceStates::kCommon;
  ///@}
  /// Aliasing: the placed resource that is used from now on; empty: any.
  rtapi::Resource ResourceAfter = {};

  /// A transition of `resource`, or of one subresource of a texture, from state `before` to
  /// `after`. The rules are checked by CommandList::ResourceBarrier.
  static ResourceBarrier Transition(rtapi::Resource resource, ResourceStates before,
                                    ResourceStates after,
                                    uint32_t subresource = kResourceBarrierAllSubresources) {
    return {ResourceBarrierType::kTransition, std::move(resource), subresource, before, after, {}};
  }
  /// Orders unordered accesses, builds and reads of acceleration structures before the barrier and
  /// those after it; without a resource for all of them.
  /// [DXR: Synchronizing acceleration structure memory writes/reads]
  static ResourceBarrier Uav(rtapi::Resource resource = {}) {
    return {ResourceBarrierType::kUav, std::move(resource),     kResourceBarrierAllSubresources,
            ResourceStates::kCommon,   ResourceStates::kCommon, {}};
  }
  /// Orders uses of placed resources before the barrier, and those of resources that share their
  /// memory after it. [D3D12: D3D12_RESOURCE_ALIASING_BARRIER]
  static ResourceBarrier Aliasing(rtapi::Resource before = {}, rtapi::Resource after = {}) {
    return {ResourceBarrierType::kAliasing,  std::move(before),
            kResourceBarrierAllSubresources, ResourceStates::kCommon,
            ResourceStates::kCommon,         std::move(after)};
  }
};

// ---------------------------------------------------------------------------------------------
// Copies between buffers and textures

/// The layout of one subresource's texels in a buffer: rows of RowPitch bytes, Height rows to a
/// slice, Depth slices. In block-compressed formats a row is one of blocks, and Width and Height
/// are multiples of 4. [D3D12: D3D12_SUBRESOURCE_FOOTPRINT]
struct SubresourceFootprint {
  /// A format of the texture's family. The planes of depth and stencil have formats of R32 and R8;
  /// the lower 24 bits hold a depth of 24 bits, and the upper ones are undefined.
  rtapi::Format Format = rtapi::Format::kUnknown;
  uint32_t Width = 0;     ///< texels, at least 1
  uint32_t Height = 0;    ///< rows, at least 1
  uint32_t Depth = 0;     ///< slices, at least 1
  uint32_t RowPitch = 0;  ///< bytes from row to row: a multiple of 256, at least those of a row
};

/// A footprint and where it starts in its buffer. GetCopyableFootprints makes them.
/// [D3D12: D3D12_PLACED_SUBRESOURCE_FOOTPRINT]
struct PlacedSubresourceFootprint {
  uint64_t Offset = 0;                  ///< bytes from the start of the buffer, a multiple of 512
  SubresourceFootprint Footprint = {};  ///< what lies there
};

/// Tells which member of a TextureCopyLocation counts. [D3D12: D3D12_TEXTURE_COPY_TYPE]
enum class TextureCopyType : uint32_t { kSubresourceIndex = 0, kPlacedFootprint = 1 };

/// One side of a CopyTextureRegion: a subresource of a texture, or texels in a buffer.
/// [D3D12: D3D12_TEXTURE_COPY_LOCATION]
struct TextureCopyLocation {
  /// A subresource of a texture, see Texture::subresource_count.
  TextureCopyLocation(Texture texture, uint32_t subresource)
      : pResource(std::move(texture)),
        Type(TextureCopyType::kSubresourceIndex),
        SubresourceIndex(subresource) {}
  /// Texels in a buffer.
  TextureCopyLocation(Buffer buffer, const PlacedSubresourceFootprint& footprint)
      : pResource(std::move(buffer)),
        Type(TextureCopyType::kPlacedFootprint),
        PlacedFootprint(footprint) {}

  Resource pResource;                          ///< the texture or buffer
  TextureCopyType Type;                        ///< goes with the kind of pResource
  PlacedSubresourceFootprint PlacedFootprint;  ///< buffers
  uint32_t SubresourceIndex = 0;               ///< textures
};

/// What CommandList::ResolveSubresourceRegion makes of a pixel's samples.
/// [D3D12: D3D12_RESOLVE_MODE]
enum class ResolveMode : uint32_t {
  kDecompress = 0,  ///< every sample as it is, to a texture with as many
  kMin = 1,         ///< the least of each component
  kMax = 2,         ///< the greatest of each component
  kAverage = 3,     ///< no integer and no depth formats
};

/// Texels [left, right) x [top, bottom) x [front, back) of a subresource or footprint. Nothing is
/// copied where one of the three is empty. [D3D12: D3D12_BOX]
struct Box {
  /// A border, in texels.
  ///@{
  uint32_t left = 0;
  uint32_t top = 0;
  uint32_t front = 0;
  uint32_t right = 0;
  uint32_t bottom = 0;
  uint32_t back = 0;
  ///@}
};

}  // namespace rtapi
