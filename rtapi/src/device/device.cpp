// SPDX-License-Identifier: MIT
#include <rtapi/device.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/shaders/library_variant.h"
#include "runtime/backend/dispatch_checks.h"
#include "runtime/coverage/collector.h"

namespace rtapi {

namespace detail {

namespace {

uint64_t mix(uint64_t x) {  // splitmix64's finisher
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

}  // namespace

void DeviceImpl::Remove(const Error& reason) {
  std::vector<std::function<void()>> calls;
  {
    std::lock_guard lock(removed_mutex_);
    if (!removed_.ok()) return;  // the first reason counts
    Error error = reason;
    error.code = ErrorCode::kDeviceRemoved;
    removed_ = error;
    is_removed_.store(true, std::memory_order_relaxed);
    calls.swap(removal_calls_);
  }
  report(MessageSeverity::kError, reason);
  for (const auto& call : calls) call();
}

void DeviceImpl::when_removed(std::function<void()> call) {
  {
    std::lock_guard lock(removed_mutex_);
    if (removed_.ok()) return removal_calls_.push_back(std::move(call));
  }
  call();
}

Status DeviceImpl::removed() const {
  std::lock_guard lock(removed_mutex_);
  return removed_;
}

void DeviceImpl::report(MessageSeverity severity, const Error& error) const {
  if (desc.OnMessage) desc.OnMessage({severity, error.id, error.message});
}

void DeviceImpl::register_heap(uint8_t* host, uint64_t address, const DescriptorHeapDesc& heap,
                               TargetSlot* targets) {
  std::lock_guard lock(heaps_mutex_);
  heaps_[reinterpret_cast<uintptr_t>(host)] = {
      heap.Type,           HasAny(heap.Flags, DescriptorHeapFlags::kShaderVisible),
      heap.NumDescriptors, address,
      heap.Name,           targets};
}

void DeviceImpl::unregister_heap(uint8_t* host) {
  std::lock_guard lock(heaps_mutex_);
  heaps_.erase(reinterpret_cast<uintptr_t>(host));
}

std::optional<HeapSlot> DeviceImpl::find_slot(CpuDescriptorHandle handle) const {
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

std::optional<HeapSlot> DeviceImpl::find_slot(GpuDescriptorHandle handle) const {
  uintptr_t host = 0;
  {
    std::lock_guard lock(heaps_mutex_);
    for (const auto& [start, heap] : heaps_) {
      const uint64_t bytes = uint64_t{heap.count} * kDescriptorHandleIncrementSize;
      if (!heap.shader_visible || handle.ptr - heap.address >= bytes) continue;
      host = start + (handle.ptr - heap.address);
    }
  }
  return host == 0 ? std::nullopt : find_slot(CpuDescriptorHandle{host});
}

std::string describe_heap(const std::optional<HeapSlot>& slot) {
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

Status DeviceImpl::provide_prints(const runtime::PrintingLibraries& libraries) {
  const std::lock_guard lock(prints_mutex_);
  if (libraries.empty() || prints_) return {};
  BufferDesc buffer;
  buffer.SizeInBytes = runtime::kPrintBufferBytes;
  buffer.Heap = HeapType::kReadback;
  buffer.Name = "print buffer";
  auto made = backend->create_buffer(buffer);
  if (!made.ok()) return made.error();
  runtime::clear_prints(**made, desc.PrintThread);
  prints_ = std::move(*made);
  return {};
}

std::shared_ptr<runtime::BackendBuffer> DeviceImpl::prints() const {
  const std::lock_guard lock(prints_mutex_);
  return prints_;
}

DeviceImpl::~DeviceImpl() {
  if (!kaamos::coverage::is_asked()) return;
  // What runs until the backend ends counts. A failure is told when the process ends.
  prints_.reset();
  backend.reset();
  (void)kaamos::coverage::write();
}

bool DeviceImpl::runs_variants() const {
  return reporter || kaamos::coverage::is_asked();
}

ShaderLibrary DeviceImpl::library_to_run(const ShaderLibrary& library) const {
  if (!runs_variants()) return library;
  const VariantParts parts = {reporter != nullptr, kaamos::coverage::is_asked()};
  const LibraryVariant found = variant_of(library, parts, desc.Backend == "vulkan");
  const std::string interpreted = say_interpreted(in_quotes(library.name()), found.slow);
  if (!found.missing.empty() && parts.checks) {
    reporter->report(
        kaamos::checks::Id::kCodeNotChecked,
        concat(in_quotes(library.name()), " runs without checks of its code: ", found.missing));
  }
  if (!found.missing.empty() && parts.coverage) {
    report(MessageSeverity::kWarning,
           make_error(Id::kNoCoverage, in_quotes(library.name()), ": ", found.missing));
  }
  if (!interpreted.empty() && parts.checks) {
    reporter->report(kaamos::checks::Id::kCodeInterpreted, interpreted);
  } else if (!interpreted.empty()) {
    report(MessageSeverity::kWarning, make_error(Id::kCoverageInterpreted, interpreted));
  }
  return found.library;
}

std::string DeviceImpl::say_interpreted(const std::string& what, const std::string& reason) const {
  if (reason.empty()) return {};
  std::lock_guard lock(said_mutex_);
  if (!said_.insert(reason).second) return {};
  return concat(what,
                ", and what else fails this way, runs about a hundred times slower: ", reason);
}

ShaderIdentifier DeviceImpl::make_identifier(std::string_view name) {
  const uint32_t index = next_identifier_++;
  uint64_t hash = mix((uint64_t{tag} << 32) | index);
  for (char c : name) hash = mix(hash ^ static_cast<unsigned char>(c));
  const uint64_t words[4] = {uint64_t{index} | (uint64_t{tag} << 32), hash, mix(hash),
                             mix(mix(hash))};
  ShaderIdentifier identifier;
  std::memcpy(identifier.data(), words, sizeof words);
  return identifier;
}

std::string DeviceImpl::describe_address(GpuVirtualAddress address) const {
  return runtime::describe_address(addresses, address);
}

std::string named(const char* kind, const std::string& name) {
  return name.empty() ? concat("unnamed ", kind) : concat(kind, " ", in_quotes(name));
}

}  // namespace detail

namespace {

const DeviceDesc kEmptyDesc;
const DeviceInfo kEmptyInfo;

}  // namespace

const DeviceInfo& Device::GetInfo() const {
  return impl_ ? impl_->backend->info() : kEmptyInfo;
}
const DeviceDesc& Device::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyDesc;
}

Status Device::RemoveDevice() const {
  if (!impl_) return detail::make_error(detail::Id::kNullHandle, "the device is an empty handle");
  impl_->Remove(detail::make_error(detail::Id::kRemovedByCall, "by a call of RemoveDevice"));
  return {};
}

Status Device::GetDeviceRemovedReason() const {
  if (!impl_) return detail::make_error(detail::Id::kNullHandle, "the device is an empty handle");
  return impl_->removed();
}

RaytracingStatistics Device::GetStatistics() const {
  return impl_ ? impl_->backend->statistics() : RaytracingStatistics{};
}
void Device::ResetStatistics() {
  if (impl_) impl_->backend->reset_statistics();
}

}  // namespace rtapi
