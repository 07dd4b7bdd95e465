// SPDX-License-Identifier: MIT
//
// The object behind the handle of device.h, and what the objects that it makes have in common.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <rtapi/device.h>

#include "rtapi/src/device/heap_slot.h"
#include "rtapi/src/device/view_names.h"
#include "rtapi/src/errors/error_table.h"
#include "runtime/backend/backend.h"
#include "runtime/backend/printing.h"
#include "runtime/checks/layer.h"
#include "runtime/checks/report.h"

namespace rtapi::detail {

namespace runtime = kaamos::runtime;
namespace shader = kaamos::shader;

struct DeviceImpl {
  DeviceImpl() = default;
  DeviceImpl(const DeviceImpl&) = delete;
  DeviceImpl& operator=(const DeviceImpl&) = delete;
  ~DeviceImpl();

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
  // Whether it is, for those who look often.
  const std::atomic<bool>& is_removed() const { return is_removed_; }
  // Calls a function when the device is removed: at once if it is. Each is kept until then.
  void when_removed(std::function<void()> call);
  void report(MessageSeverity severity, const Error& error) const;

  // Finds the slot of a handle. Handles carry no type, so heaps are registered by host address.
  void register_heap(uint8_t* host, uint64_t address, const DescriptorHeapDesc& heap,
                     TargetSlot* targets);
  void unregister_heap(uint8_t* host);
  std::optional<HeapSlot> find_slot(CpuDescriptorHandle handle) const;
  // The same by GPU handle, for shader-visible heaps only.
  std::optional<HeapSlot> find_slot(GpuDescriptorHandle handle) const;

  // Returns the library's variant with checks on a checked device, and with coverage where that is
  // asked for; else the library itself.
  ShaderLibrary library_to_run(const ShaderLibrary& library) const;
  bool runs_variants() const;

  // Returns the report that `what` is interpreted for `reason` (ModuleLibrary::slow): each reason
  // once, with the first that it holds for. Empty if there is nothing to report.
  std::string say_interpreted(const std::string& what, const std::string& reason) const;

  // Makes the print buffer for the pipelines that print, unless there is one already.
  Status provide_prints(const runtime::PrintingLibraries& libraries);
  std::shared_ptr<runtime::BackendBuffer> prints() const;

  ShaderIdentifier make_identifier(std::string_view name);

  // Returns "buffer \"x\" (416 bytes)" for a live address, else "no live buffer".
  std::string describe_address(GpuVirtualAddress address) const;

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
  std::atomic<bool> is_removed_ = false;
  std::vector<std::function<void()>> removal_calls_;
  mutable std::mutex said_mutex_;
  mutable std::set<std::string> said_;  // reasons
  mutable std::mutex prints_mutex_;
  std::shared_ptr<runtime::BackendBuffer> prints_;
  std::atomic<uint32_t> next_identifier_{1};

 public:
  uint32_t tag = 0;  // makes identifiers of different devices differ
};

// Returns "buffer \"name\"" or "unnamed buffer".
std::string named(const char* kind, const std::string& name);

// Fails for an empty handle or another device's object; `what` names the argument.
template <class Handle>
Status CheckHandle(const std::shared_ptr<DeviceImpl>& device, const Handle& handle,
                   std::string_view what) {
  if (!handle) return make_error(Id::kNullHandle, what, " is an empty handle");
  if (handle.impl()->device != device) {
    return make_error(Id::kForeignObject, what, " belongs to another device");
  }
  return {};
}

inline uint64_t align_up(uint64_t value, uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

}  // namespace rtapi::detail
