// SPDX-License-Identifier: MIT
#include "rtapi/src/commands/root_state.h"

#include <algorithm>
#include <cstring>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/pipelines/root_signature_impl.h"

namespace rtapi {

namespace detail {

void RootState::write(uint32_t offset, const void* value, size_t bytes) {
  if (offset + bytes > runtime::kRootArgumentBytes) return;  // 64 DWORDs always fit
  if (arguments.use_count() > 1) arguments = std::make_shared<runtime::RootArguments>(*arguments);
  std::memcpy(arguments->bytes.data() + offset, value, bytes);
}

void RootState::clear(uint32_t offset, uint32_t bytes) {
  static constexpr uint8_t kZeros[runtime::kRootArgumentBytes] = {};
  if (bytes <= sizeof kZeros) write(offset, kZeros, bytes);
}

void RootState::keep_arguments(const RootState& before) {
  if (!before.signature) return;
  const auto& old = before.signature.GetDesc().Parameters;
  const auto& parameters = signature.GetDesc().Parameters;
  for (uint32_t i = 0; i < std::min(old.size(), parameters.size()); ++i) {
    const RootParameterType type = parameters[i].ParameterType;
    if (type != old[i].ParameterType) continue;
    uint32_t bytes = 8;
    if (type == RootParameterType::k32BitConstants) {
      bytes = 4 * std::min(old[i].Constants.Num32BitValues, parameters[i].Constants.Num32BitValues);
    }
    const uint32_t from = before.signature.GetArgumentOffset(i);
    if (from + bytes > runtime::kRootArgumentBytes) continue;
    write(signature.GetArgumentOffset(i), before.arguments->bytes.data() + from, bytes);
    if (const auto view = before.views.find(i); view != before.views.end()) views.insert(*view);
  }
}

const RootParameter* RootSetter::find(uint32_t index, RootParameterType type) {
  if (!list.check_open(call)) return nullptr;
  if (!root.signature) {
    list.fail(
        make_error(Id::kRootSignatureNotSet, call, ": call ",
                   &root == &list.graphics ? "SetGraphicsRootSignature" : "SetComputeRootSignature",
                   " first"));
    return nullptr;
  }
  const auto& parameters = root.signature.GetDesc().Parameters;
  if (index >= parameters.size()) {
    list.fail(make_error(Id::kRootParameterMismatch, call, ": parameter ", index,
                         " does not exist; the root signature has ", parameters.size(),
                         " parameters"));
    return nullptr;
  }
  const RootParameterType declared = parameters[index].ParameterType;
  if (declared != type) {
    list.fail(make_error(Id::kRootParameterMismatch, call, ": parameter ", index, " is of type ",
                         static_cast<uint32_t>(parameters[index].ParameterType),
                         ", but this call sets one of type ", static_cast<uint32_t>(type)));
    // Drivers take the address of any view.
    const bool views = declared >= RootParameterType::kCbv && type >= RootParameterType::kCbv;
    const bool goes_on = views && list.device->desc.InvalidCalls == InvalidCalls::kDropCall;
    return goes_on ? &parameters[index] : nullptr;
  }
  return &parameters[index];
}

void RootSetter::set_signature(const RootSignature& signature) {
  if (!list.check_open(call)) return;
  if (Status s = CheckHandle(list.device, signature, concat(call, ": the signature")); !s.ok()) {
    return list.fail(s.error());
  }
  if (signature.is_local()) {
    return list.fail(make_error(Id::kRootSignatureKind, call,
                                " takes a global root signature, but this one is local; local "
                                "arguments belong in shader records"));
  }
  if (root.signature && same_definition(root.signature, signature)) return;
  RootState now;
  now.signature = signature;
  now.forgotten_parameters = root.set_parameters | root.forgotten_parameters;
  if (list.device->desc.InvalidCalls == InvalidCalls::kDropCall) now.keep_arguments(root);
  root = std::move(now);
}

void RootSetter::set_constants(uint32_t parameter, uint32_t count, const void* values,
                               uint32_t dest_offset) {
  const auto* p = find(parameter, RootParameterType::k32BitConstants);
  if (!p) return;
  const uint32_t total = p->Constants.Num32BitValues;
  if (dest_offset > total || count > total - dest_offset) {
    return list.fail(make_error(Id::kRootConstantsRange, call, ": values ", dest_offset, "..",
                                uint64_t{dest_offset} + count, " of parameter ", parameter,
                                ", which has only ", total));
  }
  if (count != 0 && !values) {
    return list.fail(make_error(Id::kRootConstantsRange, call,
                                ": the pointer to the values of parameter ", parameter,
                                " is null"));
  }
  if (count == 0) return;
  root.note_set(parameter);
  root.write(root.signature.GetArgumentOffset(parameter) + dest_offset * 4, values,
             size_t{count} * 4);
}

void RootSetter::set_view(uint32_t index, RootParameterType type, GpuVirtualAddress address) {
  if (!find(index, type)) return;
  const uint32_t alignment = type == RootParameterType::kCbv ? 256 : 4;
  // Address 0 is a null descriptor: an acceleration structure that every ray misses.
  if (address % alignment != 0 || (address != 0 && !list.device->addresses.find(address))) {
    return list.fail(make_error(Id::kRootDescriptorAddress, call, ": parameter ", index, " is ",
                                list.device->describe_address(address),
                                "; it must lie in a live buffer, at a multiple of ", alignment));
  }
  root.note_set(index);
  root.write(root.signature.GetArgumentOffset(index), &address, sizeof address);
  root.views.erase(index);
  if (address != 0) {
    root.views[index] = use_of(*list.device, address, concat("root parameter ", index));
  }
}

void RootSetter::set_table(uint32_t parameter, GpuDescriptorHandle base) {
  const auto* p = find(parameter, RootParameterType::kDescriptorTable);
  if (!p) return;
  const bool samplers =
      p->DescriptorTable.Ranges.front().RangeType == DescriptorRangeType::kSampler;
  const DescriptorHeap& heap = samplers ? list.sampler_heap : list.view_heap;
  const uint64_t start = heap.GetGPUDescriptorHandleForHeapStart().ptr;
  const uint64_t offset = base.ptr - start;
  const bool inside = heap && base.ptr >= start && offset % kDescriptorHandleIncrementSize == 0 &&
                      offset / kDescriptorHandleIncrementSize < heap.GetDesc().NumDescriptors;
  if (!inside) {
    return list.fail(make_error(Id::kDescriptorTableHandle, call, ": handle ", hex(base.ptr),
                                " for parameter ", parameter, " is not in the ",
                                samplers ? "sampler" : "CBV/SRV/UAV", " heap that is set",
                                heap ? "" : "; call SetDescriptorHeaps first"));
  }
  root.note_set(parameter);
  root.write(root.signature.GetArgumentOffset(parameter), &base.ptr, sizeof base.ptr);
}

}  // namespace detail

using namespace detail;

void CommandList::SetComputeRootSignature(const RootSignature& signature) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRootSignature"}.set_signature(signature);
}
void CommandList::SetComputeRoot32BitConstant(uint32_t parameter, uint32_t value,
                                              uint32_t dest_offset) {
  SetComputeRoot32BitConstants(parameter, 1, &value, dest_offset);
}
void CommandList::SetComputeRoot32BitConstants(uint32_t parameter, uint32_t count,
                                               const void* values, uint32_t dest_offset) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRoot32BitConstants"}.set_constants(
      parameter, count, values, dest_offset);
}
void CommandList::SetComputeRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRootConstantBufferView"}.set_view(
      parameter, RootParameterType::kCbv, address);
}
void CommandList::SetComputeRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRootShaderResourceView"}.set_view(
      parameter, RootParameterType::kSrv, address);
}
void CommandList::SetComputeRootUnorderedAccessView(uint32_t parameter, GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRootUnorderedAccessView"}.set_view(
      parameter, RootParameterType::kUav, address);
}
void CommandList::SetComputeRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->compute, "SetComputeRootDescriptorTable"}.set_table(parameter, base);
}

void CommandList::SetGraphicsRootSignature(const RootSignature& signature) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRootSignature"}.set_signature(signature);
}
void CommandList::SetGraphicsRoot32BitConstant(uint32_t parameter, uint32_t value,
                                               uint32_t dest_offset) {
  SetGraphicsRoot32BitConstants(parameter, 1, &value, dest_offset);
}
void CommandList::SetGraphicsRoot32BitConstants(uint32_t parameter, uint32_t count,
                                                const void* values, uint32_t dest_offset) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRoot32BitConstants"}.set_constants(
      parameter, count, values, dest_offset);
}
void CommandList::SetGraphicsRootConstantBufferView(uint32_t parameter, GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRootConstantBufferView"}.set_view(
      parameter, RootParameterType::kCbv, address);
}
void CommandList::SetGraphicsRootShaderResourceView(uint32_t parameter, GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRootShaderResourceView"}.set_view(
      parameter, RootParameterType::kSrv, address);
}
void CommandList::SetGraphicsRootUnorderedAccessView(uint32_t parameter,
                                                     GpuVirtualAddress address) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRootUnorderedAccessView"}.set_view(
      parameter, RootParameterType::kUav, address);
}
void CommandList::SetGraphicsRootDescriptorTable(uint32_t parameter, GpuDescriptorHandle base) {
  if (!impl_) return;
  RootSetter{*impl_, impl_->graphics, "SetGraphicsRootDescriptorTable"}.set_table(parameter, base);
}

}  // namespace rtapi
