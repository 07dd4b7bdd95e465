// SPDX-License-Identifier: MIT
#include <rtapi/device.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/backends.h"
#include "rtapi/src/checked_library.h"
#include "rtapi/src/device_impl.h"
#include "rtapi/src/root_signature_impl.h"
#include "runtime/backend/dispatch_checks.h"

namespace rtapi {

namespace detail {

namespace {

uint64_t Mix(uint64_t x) {  // splitmix64's finisher
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

std::atomic<uint32_t> g_device_count{0};

}  // namespace

void DeviceImpl::Remove(const Error& reason) {
  {
    std::lock_guard lock(removed_mutex_);
    if (!removed_.ok()) return;  // the first reason counts
    Error error = reason;
    error.code = ErrorCode::kDeviceRemoved;
    removed_ = error;
  }
  Report(MessageSeverity::kError, reason);
}

Status DeviceImpl::removed() const {
  std::lock_guard lock(removed_mutex_);
  return removed_;
}

void DeviceImpl::Report(MessageSeverity severity, const Error& error) const {
  if (desc.OnMessage) desc.OnMessage({severity, error.id, error.message});
}

void DeviceImpl::RegisterHeap(uint8_t* host, uint64_t address, const DescriptorHeapDesc& heap,
                              TargetSlot* targets) {
  std::lock_guard lock(heaps_mutex_);
  heaps_[reinterpret_cast<uintptr_t>(host)] = {
      heap.Type,           HasAny(heap.Flags, DescriptorHeapFlags::kShaderVisible),
      heap.NumDescriptors, address,
      heap.Name,           targets};
}

void DeviceImpl::UnregisterHeap(uint8_t* host) {
  std::lock_guard lock(heaps_mutex_);
  heaps_.erase(reinterpret_cast<uintptr_t>(host));
}

std::optional<HeapSlot> DeviceImpl::FindSlot(CpuDescriptorHandle handle) const {
  std::lock_guard lock(heaps_mutex_);
  auto it = heaps_.upper_bound(handle.ptr);
  if (it == heaps_.begin()) return std::nullopt;
  const auto& [start, heap] = *std::prev(it);
  const uint64_t offset = handle.ptr - start;
  const uint64_t index = offset / kDescriptorHandleIncrementSize;
  if (index >= heap.count || offset % kDescriptorHandleIncrementSize != 0) return std::nullopt;
  return HeapSlot{heap.type,
                  heap.shader_visible,
                  heap.targets ? nullptr : reinterpret_cast<shader::Descriptor*>(handle.ptr),
                  heap.targets ? heap.targets + index : nullptr,
                  static_cast<uint32_t>(index),
                  heap.count - static_cast<uint32_t>(index),
                  heap.name};
}

std::optional<HeapSlot> DeviceImpl::FindSlot(GpuDescriptorHandle handle) const {
  uintptr_t host = 0;
  {
    std::lock_guard lock(heaps_mutex_);
    for (const auto& [start, heap] : heaps_) {
      const uint64_t bytes = uint64_t{heap.count} * kDescriptorHandleIncrementSize;
      if (!heap.shader_visible || handle.ptr - heap.address >= bytes) continue;
      host = start + (handle.ptr - heap.address);
    }
  }
  return host == 0 ? std::nullopt : FindSlot(CpuDescriptorHandle{host});
}

std::string DescribeHeap(const std::optional<HeapSlot>& slot) {
  if (!slot) return " is not in a live descriptor heap";
  switch (slot->type) {
    case DescriptorHeapType::kCbvSrvUav:
      return " is in a CBV/SRV/UAV heap";
    case DescriptorHeapType::kSampler:
      return " is in a sampler heap";
    case DescriptorHeapType::kRtv:
      return " is in an RTV heap";
    case DescriptorHeapType::kDsv:
      return " is in a DSV heap";
  }
  return " is in a heap of unknown type";
}

ShaderLibrary DeviceImpl::LibraryToRun(const ShaderLibrary& library) const {
  if (!reporter) return library;
  CheckedLibrary found = checked_variant(library, desc.Backend == "vulkan");
  if (!found.note.empty()) {
    reporter->report(
        found.checked ? kaamos::checks::Id::kCodeInterpreted : kaamos::checks::Id::kCodeNotChecked,
        found.note);
  }
  return found.library;
}

ShaderIdentifier DeviceImpl::MakeIdentifier(std::string_view name) {
  const uint32_t index = next_identifier_++;
  uint64_t hash = Mix((uint64_t{tag} << 32) | index);
  for (char c : name) hash = Mix(hash ^ static_cast<unsigned char>(c));
  const uint64_t words[4] = {uint64_t{index} | (uint64_t{tag} << 32), hash, Mix(hash),
                             Mix(Mix(hash))};
  ShaderIdentifier identifier;
  std::memcpy(identifier.data(), words, sizeof words);
  return identifier;
}

std::string DeviceImpl::DescribeAddress(GpuVirtualAddress address) const {
  return runtime::describe_address(addresses, address);
}

std::string Named(const char* kind, const std::string& name) {
  return name.empty() ? Text("unnamed ", kind) : Text(kind, " ", Quoted(name));
}

}  // namespace detail

namespace {

const DeviceDesc kEmptyDesc;
const DeviceInfo kEmptyInfo;

Status CheckDesc(const DeviceDesc& desc) {
  using detail::Id;
  if (desc.Precision > TraversalPrecision::kExact) {
    return detail::MakeError(Id::kDeviceDesc, "Precision is ",
                             static_cast<uint32_t>(desc.Precision),
                             "; it must be kFast, kRobust or kExact");
  }
  if (desc.Tier != RaytracingTier::kTier1_0 && desc.Tier != RaytracingTier::kTier1_1) {
    return detail::MakeError(Id::kDeviceDesc, "Tier is ", static_cast<uint32_t>(desc.Tier),
                             "; it must be kTier1_0 or kTier1_1");
  }
  if (desc.Threads > 4096) {
    return detail::MakeError(Id::kDeviceDesc, "Threads is ", desc.Threads,
                             "; it must be 0 (all threads of the machine) to 4096");
  }
  const uint32_t lanes = desc.WaveLanes;
  if (lanes != 0 && lanes != 4 && lanes != 8 && lanes != 16 && lanes != 32) {
    return detail::MakeError(Id::kDeviceDesc, "WaveLanes is ", lanes,
                             "; it must be 4, 8, 16, 32, or 0 (8 lanes)");
  }
  return {};
}

}  // namespace

std::vector<DeviceInfo> EnumerateDevices() {
  std::vector<DeviceInfo> devices;
  for (const auto* factory : detail::backends()) {
    for (auto& info : factory->enumerate()) devices.push_back(std::move(info));
  }
  return devices;
}

Result<Device> CreateDevice(const DeviceDesc& desc) {
  using namespace detail;
  if (Status s = CheckDesc(desc); !s.ok()) return s.error();
  const auto known = detail::backends();
  if (known.empty()) {
    return MakeError(Id::kNoBackend,
                     "this build has no backend; install libembree-dev and run CMake again");
  }
  auto it = std::find_if(known.begin(), known.end(),
                         [&](const runtime::BackendFactory* f) { return desc.Backend == f->name; });
  if (it == known.end()) {
    std::string names;
    for (const auto* f : known) names += Text(names.empty() ? "" : ", ", Quoted(f->name));
    return MakeError(Id::kUnknownBackend, Quoted(desc.Backend), "; this build has ", names);
  }
  auto impl = std::make_shared<DeviceImpl>();
  impl->desc = desc;
  impl->tag = ++g_device_count;
  impl->context.addresses = &impl->addresses;
  // The backend is a member of the device: the pointer outlives it.
  impl->context.message = [raw = impl.get()](const Message& message) {
    if (raw->desc.OnMessage) raw->desc.OnMessage(message);
  };
  if (desc.Checked) {
    impl->reporter = std::make_unique<kaamos::checks::Reporter>(impl->context.message);
    bool (*same_root_signature)(const RootSignature&, const RootSignature&) =
        &detail::SameDefinition;
    impl->checks = std::make_unique<kaamos::checks::Layer>(impl->addresses, *impl->reporter,
                                                           same_root_signature);
    impl->context.reporter = impl->reporter.get();
    impl->context.observer = impl->checks.get();
  }
  auto backend = (*it)->create(desc, impl->context);
  if (!backend.ok()) return backend.error();
  impl->backend = std::move(*backend);
  return Device(std::move(impl));
}

const DeviceInfo& Device::GetInfo() const {
  return impl_ ? impl_->backend->info() : kEmptyInfo;
}
const DeviceDesc& Device::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyDesc;
}

Status Device::GetDeviceRemovedReason() const {
  if (!impl_) return detail::MakeError(detail::Id::kNullHandle, "the device is an empty handle");
  return impl_->removed();
}

RaytracingStatistics Device::GetStatistics() const {
  return impl_ ? impl_->backend->statistics() : RaytracingStatistics{};
}
void Device::ResetStatistics() {
  if (impl_) impl_->backend->reset_statistics();
}

}  // namespace rtapi
