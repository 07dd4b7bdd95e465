// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include <rtapi/descriptor.h>
#include <rtapi/device.h>

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

using namespace detail;

namespace {

const DescriptorHeapDesc kEmptyHeap;

bool holds_targets(DescriptorHeapType type) {
  return type == DescriptorHeapType::kRtv || type == DescriptorHeapType::kDsv;
}

Status check_heap(const DescriptorHeapDesc& desc) {
  const std::string name = named("descriptor heap", desc.Name);
  const bool samplers = desc.Type == DescriptorHeapType::kSampler;
  if (desc.Type > DescriptorHeapType::kDsv) {
    return make_error(Id::kHeapType, name, " has type ", static_cast<uint32_t>(desc.Type),
                      "; it must be kCbvSrvUav, kSampler, kRtv or kDsv");
  }
  const bool visible = HasAny(desc.Flags, DescriptorHeapFlags::kShaderVisible);
  if ((desc.Flags & ~DescriptorHeapFlags::kShaderVisible) != DescriptorHeapFlags::kNone) {
    return make_error(Id::kHeapType, name, " has undefined flags ",
                      hex(static_cast<uint32_t>(desc.Flags)));
  }
  if (visible && holds_targets(desc.Type)) {
    return make_error(Id::kHeapType, name,
                      " has kShaderVisible, but shaders do not read heaps of RTVs and DSVs");
  }
  const uint32_t limit = samplers && visible ? kMaxShaderVisibleSamplerHeapSize : kMaxViewHeapSize;
  if (desc.NumDescriptors == 0 || desc.NumDescriptors > limit) {
    return make_error(Id::kHeapSize, name, " has ", desc.NumDescriptors,
                      " descriptors; it must have 1 to ", limit);
  }
  return {};
}

}  // namespace

detail::DescriptorHeapImpl::~DescriptorHeapImpl() {
  if (memory) device->unregister_heap(memory->host());
}

const DescriptorHeapDesc& DescriptorHeap::GetDesc() const {
  return impl_ ? impl_->desc : kEmptyHeap;
}
CpuDescriptorHandle DescriptorHeap::GetCPUDescriptorHandleForHeapStart() const {
  return {impl_ ? reinterpret_cast<size_t>(impl_->memory->host()) : 0};
}
GpuDescriptorHandle DescriptorHeap::GetGPUDescriptorHandleForHeapStart() const {
  const bool visible = HasAny(GetDesc().Flags, DescriptorHeapFlags::kShaderVisible);
  return {impl_ && visible ? impl_->memory->address() : 0};
}

Result<DescriptorHeap> Device::CreateDescriptorHeap(const DescriptorHeapDesc& desc) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateDescriptorHeap on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  if (Status s = check_heap(desc); !s.ok()) return s.error();
  BufferDesc memory_desc;
  memory_desc.SizeInBytes = uint64_t{desc.NumDescriptors} * kDescriptorHandleIncrementSize;
  memory_desc.Heap = HeapType::kUpload;
  memory_desc.Name = desc.Name;
  auto memory = impl_->backend->create_buffer(memory_desc);
  if (!memory.ok()) return memory.error();
  auto heap = std::make_shared<DescriptorHeapImpl>();
  heap->device = impl_;
  heap->desc = desc;
  heap->memory = std::move(*memory);
  if (holds_targets(desc.Type)) heap->targets.resize(desc.NumDescriptors);
  impl_->register_heap(heap->memory->host(), heap->memory->address(), desc,
                       heap->targets.empty() ? nullptr : heap->targets.data());
  return DescriptorHeap(std::move(heap));
}

Status Device::CopyDescriptorsSimple(uint32_t count, CpuDescriptorHandle dest,
                                     CpuDescriptorHandle source, DescriptorHeapType type) const {
  if (!impl_) return make_error(Id::kNullHandle, "CopyDescriptorsSimple on an empty device handle");
  if (count == 0) return {};
  const auto to = impl_->find_slot(dest);
  const auto from = impl_->find_slot(source);
  if (!to || !from) {
    return make_error(Id::kDescriptorHandle, to ? "source " : "dest ",
                      hex(to ? source.ptr : dest.ptr), " is not in a live descriptor heap");
  }
  if (to->type != type || from->type != type) {
    return make_error(Id::kDescriptorCopy, "the copy is of type ", static_cast<uint32_t>(type),
                      ", but dest is in a heap of type ", static_cast<uint32_t>(to->type),
                      " and source in one of type ", static_cast<uint32_t>(from->type));
  }
  if (from->shader_visible) {
    return make_error(Id::kDescriptorCopy,
                      "source is in a shader-visible heap, which the host cannot read in D3D12; "
                      "keep a copy in a heap without that flag");
  }
  if (count > to->count_from_here || count > from->count_from_here) {
    return make_error(Id::kDescriptorCopy, count, " descriptors do not fit: dest has ",
                      to->count_from_here, " from slot ", to->index, " on, source ",
                      from->count_from_here, " from slot ", from->index, " on");
  }
  if (to->target) {
    const std::vector<TargetSlot> copied(from->target, from->target + count);
    std::copy(copied.begin(), copied.end(), to->target);
    return {};
  }
  std::memmove(to->slot, from->slot, size_t{count} * kDescriptorHandleIncrementSize);
  return {};
}

}  // namespace rtapi
