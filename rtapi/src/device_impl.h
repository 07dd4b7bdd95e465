// SPDX-License-Identifier: MIT
//
// The objects behind the handles of device.h, resource.h and descriptor.h.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <rtapi/device.h>

#include "rtapi/src/error_table.h"
#include "rtapi/src/target_view.h"
#include "rtapi/src/view_names.h"
#include "runtime/backend/backend.h"
#include "runtime/checks/layer.h"
#include "runtime/checks/report.h"

namespace rtapi::detail {

namespace runtime = kaamos::runtime;
namespace shader = kaamos::shader;

// The heap slot that a CPU or GPU descriptor handle points at.
struct HeapSlot {
  DescriptorHeapType type = DescriptorHeapType::kCbvSrvUav;
  bool shader_visible = false;
  shader::Descriptor* slot = nullptr;  // null in heaps of targets
  TargetSlot* target = nullptr;        // null in other heaps
  uint32_t index = 0;
  uint32_t count_from_here = 0;
  std::string heap_name = {};
};

// Returns " is in a sampler heap", or that it is in no live heap: the middle of an error's text.
std::string DescribeHeap(const std::optional<HeapSlot>& slot);

struct DeviceImpl {
  DeviceDesc desc;
  ViewNames views;  // which textures and samplers the descriptors stand for
  runtime::AddressMap addresses;
  runtime::Context context;
  // Checked mode; null if it is off.
  std::unique_ptr<kaamos::checks::Reporter> reporter;
  std::unique_ptr<kaamos::checks::Layer> checks;
  std::unique_ptr<runtime::BackendDevice> backend;

  // Executions run one at a time, whatever the queue: a dispatch or build uses every core already.
  std::mutex execute_mutex;

  void Remove(const Error& reason);
  Status removed() const;
  void Report(MessageSeverity severity, const Error& error) const;

  // Finds the slot of a handle. Handles carry no type, so heaps are registered by host address.
  void RegisterHeap(uint8_t* host, uint64_t address, const DescriptorHeapDesc& heap,
                    TargetSlot* targets);
  void UnregisterHeap(uint8_t* host);
  std::optional<HeapSlot> FindSlot(CpuDescriptorHandle handle) const;
  // The same by GPU handle, for shader-visible heaps only.
  std::optional<HeapSlot> FindSlot(GpuDescriptorHandle handle) const;

  // Returns the library's checked variant on a checked device, else the library itself.
  ShaderLibrary LibraryToRun(const ShaderLibrary& library) const;

  ShaderIdentifier MakeIdentifier(std::string_view name);

  // Returns "buffer \"x\" (416 bytes)" for a live address, else "no live buffer".
  std::string DescribeAddress(GpuVirtualAddress address) const;

 private:
  struct HeapRange {
    DescriptorHeapType type;
    bool shader_visible;
    uint32_t count;
    uint64_t address;  // for GPU handles
    std::string name;
    TargetSlot* targets;  // null unless RTVs or DSVs
  };
  mutable std::mutex heaps_mutex_;
  std::map<uintptr_t, HeapRange> heaps_;
  mutable std::mutex removed_mutex_;
  Status removed_;
  std::atomic<uint32_t> next_identifier_{1};

 public:
  uint32_t tag = 0;  // makes identifiers of different devices differ
};

struct BufferImpl {
  std::shared_ptr<DeviceImpl> device;
  BufferDesc desc;
  std::shared_ptr<runtime::BackendBuffer> memory;
  ~BufferImpl();
};

struct TextureImpl {
  std::shared_ptr<DeviceImpl> device;
  TextureDesc desc;
  std::shared_ptr<runtime::BackendTexture> memory;
};

struct DescriptorHeapImpl {
  std::shared_ptr<DeviceImpl> device;
  DescriptorHeapDesc desc;
  std::shared_ptr<runtime::BackendBuffer> memory;
  std::vector<TargetSlot> targets;  // of RTVs and DSVs; their memory only gives them addresses
  ~DescriptorHeapImpl();
};

// Returns "buffer \"name\"" or "unnamed buffer".
std::string Named(const char* kind, const std::string& name);

// Fails for an empty handle or another device's object; `what` names the argument.
template <class Handle>
Status CheckHandle(const std::shared_ptr<DeviceImpl>& device, const Handle& handle,
                   std::string_view what) {
  if (!handle) return MakeError(Id::kNullHandle, what, " is an empty handle");
  if (handle.impl()->device != device) {
    return MakeError(Id::kForeignObject, what, " belongs to another device");
  }
  return {};
}

inline uint64_t AlignUp(uint64_t value, uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

// Size of a mip level in texels.
struct MipExtent {
  uint32_t width, height, depth;
  bool operator==(const MipExtent&) const = default;
};
MipExtent GetMipExtent(const TextureDesc& desc, uint32_t mip);
// The same in elements of the format: in whole blocks, if it is block-compressed.
MipExtent GetMipElements(const TextureDesc& desc, uint32_t mip);
uint32_t FullMipCount(const TextureDesc& desc);
uint32_t ArraySize(const TextureDesc& desc);  // 1 for 3-D textures

// Formats of one family share their texel layout; 0 for formats that belong to none.
uint32_t FormatFamily(Format format);

}  // namespace rtapi::detail
