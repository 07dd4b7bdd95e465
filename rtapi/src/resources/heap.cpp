// SPDX-License-Identifier: MIT
#include <rtapi/heap.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/resources/resource_impl.h"
#include "runtime/backend/errors.h"
#include "runtime/backend/heap_memory.h"

namespace rtapi {

namespace detail {

// What lies where in a heap, for checked mode.
class PlacedResources {
 public:
  struct Resource {
    uint64_t offset = 0;
    uint64_t size = 0;
    bool structures = false;
    std::weak_ptr<const void> handle;
    std::string name;
  };

  // Adds a resource, and reports those that live there and hold structures where it does not, or
  // the other way round. [AS-23]
  void add(Resource placed, kaamos::checks::Reporter& reporter) {
    const std::lock_guard lock(mutex_);
    std::erase_if(resources_, [](const Resource& r) { return r.handle.expired(); });
    for (const Resource& other : resources_) {
      const bool apart =
          other.offset + other.size <= placed.offset || placed.offset + placed.size <= other.offset;
      if (apart || other.structures == placed.structures) continue;
      const Resource& built = placed.structures ? placed : other;
      const Resource& plain = placed.structures ? other : placed;
      reporter.report(kaamos::checks::Id::kStructureAliased,
                      concat(built.name, ", which is for acceleration structures, lies at bytes ",
                             built.offset, "..", built.offset + built.size, " of its heap, and ",
                             plain.name, " at ", plain.offset, "..", plain.offset + plain.size));
    }
    resources_.push_back(std::move(placed));
  }

 private:
  std::mutex mutex_;
  std::vector<Resource> resources_;
};

struct HeapImpl {
  std::shared_ptr<DeviceImpl> device;
  HeapDesc desc;
  std::shared_ptr<const runtime::HeapMemory> memory;
  std::shared_ptr<PlacedResources> placed = std::make_shared<PlacedResources>();
};

namespace {

constexpr uint64_t kMaxHeapBytes = uint64_t{1} << 40;
constexpr uint64_t kSmallPlacement = 4096;
constexpr uint64_t kPlacement = 64 * 1024;
constexpr uint64_t kMultisampledPlacement = 4 * 1024 * 1024;
constexpr ResourceFlags kTargets =
    ResourceFlags::kAllowRenderTarget | ResourceFlags::kAllowDepthStencil;

// Tiles of `tile` bytes, of sides as equal as they can be, that the most detailed mip takes.
uint64_t tiles_of_first_mip(const TextureDesc& desc, uint64_t tile) {
  const MipExtent elements = get_mip_elements(desc, 0);
  const uint64_t count[3] = {elements.width, elements.height, elements.depth};
  const int axes = static_cast<int>(desc.Dimension) - 1;
  uint64_t side[3] = {1, 1, 1};
  uint64_t bytes = uint64_t{GetFormatInfo(desc.Format).bytes} * desc.SampleDesc.Count;
  for (int axis = 0; bytes < tile; axis = (axis + 1) % axes, bytes *= 2) side[axis] *= 2;
  uint64_t tiles = 1;
  for (int axis = 0; axis < 3; ++axis) tiles *= (count[axis] + side[axis] - 1) / side[axis];
  return tiles;
}

// Textures that are no targets may have 4 KiB if their first mip takes up to 16 tiles of that size;
// multisampled ones have 4 MiB, or 64 KiB if it takes up to 64. [D3D12: D3D12_RESOURCE_DESC,
// Alignment]
Result<uint64_t> placement_alignment(const TextureDesc& desc, uint64_t wanted) {
  const bool multisampled = desc.SampleDesc.Count > 1;
  const uint64_t usual = multisampled ? kMultisampledPlacement : kPlacement;
  const uint64_t small = multisampled ? kPlacement : kSmallPlacement;
  if (wanted == 0 || wanted == usual) return usual;
  const bool may_be_small = (multisampled || !HasAny(desc.Flags, kTargets)) &&
                            tiles_of_first_mip(desc, small) <= usual / small;
  if (wanted == small && may_be_small) return small;
  return make_error(Id::kPlacement, named("texture", desc.Name), " has alignment ", wanted,
                    multisampled ? " and several samples" : "", "; it is 0 or ", usual,
                    may_be_small ? concat(" or ", small) : std::string());
}

// Every sample of every subresource, each rounded up to 64 bytes.
uint64_t texel_bytes(const TextureDesc& desc) {
  constexpr uint64_t kLine = 64;
  const FormatInfo format = GetFormatInfo(desc.Format);
  uint64_t bytes = 0;
  for (uint32_t mip = 0; mip < desc.MipLevels; ++mip) {
    const MipExtent size = get_mip_elements(desc, mip);
    const uint64_t of_mip = uint64_t{size.width} * size.height * size.depth * format.bytes;
    bytes += (of_mip + kLine - 1) / kLine * kLine;
  }
  return bytes * desc.SampleDesc.Count * array_size(desc);
}

Status check_place(const HeapImpl& heap, const std::string& name, uint64_t offset,
                   const ResourceAllocationInfo& info) {
  const uint64_t heap_bytes = heap.memory->size_bytes();
  if (offset % info.Alignment == 0 && offset <= heap_bytes &&
      info.SizeInBytes <= heap_bytes - offset) {
    return {};
  }
  return make_error(Id::kPlacement, name, " is placed at byte ", offset, " of ",
                    named("heap", heap.desc.Name), " and takes ", info.SizeInBytes,
                    "; the heap has ", heap_bytes, ", and the offset is a multiple of ",
                    info.Alignment);
}

}  // namespace
}  // namespace detail

using namespace detail;

const HeapDesc& Heap::GetDesc() const {
  static const HeapDesc kEmpty;
  return impl_ ? impl_->desc : kEmpty;
}

Result<Heap> CreateHeap(const Device& device, const HeapDesc& desc) {
  const std::shared_ptr<DeviceImpl>& impl = device.impl();
  if (!impl) return make_error(Id::kNullHandle, "CreateHeap on an empty device handle");
  if (Status s = impl->removed(); !s.ok()) return s.error();
  const std::string name = named("heap", desc.Name);
  if (desc.SizeInBytes == 0 || desc.SizeInBytes > kMaxHeapBytes) {
    return make_error(Id::kPlacement, name, " has ", desc.SizeInBytes,
                      " bytes; it must have 1 to 2^40");
  }
  if (desc.Type < HeapType::kDefault || desc.Type > HeapType::kCustom) {
    return make_error(Id::kPlacement, name, " has type ", static_cast<uint32_t>(desc.Type),
                      "; it must be kDefault, kUpload, kReadback or kCustom");
  }
  auto memory = runtime::HeapMemory::create(desc.SizeInBytes);
  if (!memory) {
    return runtime::make_error(runtime::Id::kOutOfMemory, concat(name, " of ", desc.SizeInBytes,
                                                                 " bytes could not be allocated."));
  }
  return Heap(std::make_shared<HeapImpl>(HeapImpl{impl, desc, std::move(memory)}));
}

Result<Heap> OpenHeap(const Device& device, const Heap& heap) {
  const std::shared_ptr<DeviceImpl>& impl = device.impl();
  if (!impl) return make_error(Id::kNullHandle, "OpenHeap on an empty device handle");
  if (!heap) return make_error(Id::kNullHandle, "OpenHeap of an empty heap handle");
  if (Status s = impl->removed(); !s.ok()) return s.error();
  return Heap(std::make_shared<HeapImpl>(
      HeapImpl{impl, heap.GetDesc(), heap.impl()->memory, heap.impl()->placed}));
}

Result<ResourceAllocationInfo> GetResourceAllocationInfo(const Device& device,
                                                         const TextureDesc& desc,
                                                         uint64_t alignment) {
  if (!device) {
    return make_error(Id::kNullHandle, "GetResourceAllocationInfo on an empty device handle");
  }
  const auto checked = checked_texture(*device.impl(), desc);
  if (!checked.ok()) return checked.error();
  const auto aligned = placement_alignment(*checked, alignment);
  if (!aligned.ok()) return aligned.error();
  const uint64_t bytes =
      std::max(texel_bytes(*checked), device.impl()->backend->placed_bytes(*checked));
  return ResourceAllocationInfo{align_up(bytes, *aligned), *aligned};
}

Result<Buffer> CreatePlacedResource(const Heap& heap, uint64_t offset, const BufferDesc& desc) {
  if (!heap) return make_error(Id::kNullHandle, "CreatePlacedResource on an empty heap handle");
  const HeapImpl& impl = *heap.impl();
  const std::string name = named("buffer", desc.Name);
  if (desc.Heap != impl.desc.Type) {
    return make_error(Id::kPlacement, name, " has heap type ", static_cast<uint32_t>(desc.Heap),
                      "; ", named("heap", impl.desc.Name), " has ",
                      static_cast<uint32_t>(impl.desc.Type));
  }
  const uint64_t bytes = align_up(std::min(desc.SizeInBytes, kMaxHeapBytes), kPlacement);
  if (Status s = check_place(impl, name, offset, {bytes, kPlacement}); !s.ok()) return s.error();
  const runtime::HeapPlace place = {impl.memory.get(), offset, bytes};
  auto buffer = make_buffer(impl.device, desc, &place);
  if (buffer.ok() && impl.device->reporter) {
    const bool structures = desc.InitialState == ResourceStates::kRaytracingAccelerationStructure;
    impl.placed->add({offset, bytes, structures, buffer->impl(), name}, *impl.device->reporter);
  }
  return buffer;
}

Result<Texture> CreatePlacedResource(const Heap& heap, uint64_t offset, const TextureDesc& desc,
                                     uint64_t alignment) {
  if (!heap) return make_error(Id::kNullHandle, "CreatePlacedResource on an empty heap handle");
  const HeapImpl& impl = *heap.impl();
  const auto info = GetResourceAllocationInfo(Device(impl.device), desc, alignment);
  if (!info.ok()) return info.error();
  if (Status s = check_place(impl, named("texture", desc.Name), offset, *info); !s.ok()) {
    return s.error();
  }
  const runtime::HeapPlace place = {impl.memory.get(), offset, info->SizeInBytes};
  auto texture = make_texture(impl.device, desc, &place);
  if (texture.ok() && impl.device->reporter) {
    impl.placed->add(
        {offset, info->SizeInBytes, false, texture->impl(), named("texture", desc.Name)},
        *impl.device->reporter);
  }
  return texture;
}

}  // namespace rtapi
