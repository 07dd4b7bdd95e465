// SPDX-License-Identifier: MIT
#include "d3d12/objects/bundle.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

namespace {

using List = ID3D12GraphicsCommandList4;

// Calls keep what they name alive.
template <class T>
Microsoft::WRL::ComPtr<T> hold(T* object) {
  return Microsoft::WRL::ComPtr<T>(object);
}

std::vector<uint32_t> words(UINT count, const void* values) {
  const auto* first = static_cast<const uint32_t*>(values);
  return values != nullptr ? std::vector<uint32_t>(first, first + count) : std::vector<uint32_t>();
}

}  // namespace

Bundle::Bundle(ID3D12Device* device, CommandAllocator* allocator)
    : DeviceChild(device), open_(allocator != nullptr), allocator_(allocator) {}

Bundle::~Bundle() {
  drop_allocator();
}

void Bundle::drop_allocator() {
  if (allocator_) allocator_->end();
  allocator_ = Held<CommandAllocator>();
}

void Bundle::execute(List* list) const {
  for (const Call& call : calls_) call(list);
}

void Bundle::keep(Call call) {
  if (open_) {
    calls_.push_back(std::move(call));
  } else {
    fail(ErrorId::kCommandList, "a closed bundle records nothing. Reset it first.");
  }
}

HRESULT Bundle::Close() {
  drop_allocator();
  if (!open_) {
    fail(ErrorId::kCommandList, "ID3D12GraphicsCommandList::Close: the bundle is closed.");
    return E_FAIL;
  }
  open_ = false;
  return S_OK;
}

HRESULT Bundle::Reset(ID3D12CommandAllocator* allocator, ID3D12PipelineState* initial_state) {
  auto* taken = static_cast<CommandAllocator*>(allocator);
  if (taken == nullptr || taken->type() != D3D12_COMMAND_LIST_TYPE_BUNDLE) {
    return fail(
        ErrorId::kCommandList,
        "ID3D12GraphicsCommandList::Reset: a bundle takes an allocator of type BUNDLE (1).");
  }
  if (open_) {
    fail(ErrorId::kCommandList,
         "ID3D12GraphicsCommandList::Reset: the bundle is open. Close it first.");
    return E_FAIL;
  }
  if (!taken->begin()) {
    return fail(ErrorId::kCommandList,
                "ID3D12GraphicsCommandList::Reset: another list of the allocator records.");
  }
  allocator_ = Held(taken);
  open_ = true;
  calls_.clear();
  if (initial_state != nullptr) SetPipelineState(initial_state);
  return S_OK;
}

void Bundle::SetPipelineState(ID3D12PipelineState* pipeline) {
  keep([p = hold(pipeline)](List* list) { list->SetPipelineState(p.Get()); });
}
void Bundle::SetPipelineState1(ID3D12StateObject* state_object) {
  keep([s = hold(state_object)](List* list) { list->SetPipelineState1(s.Get()); });
}
void Bundle::SetDescriptorHeaps(UINT count, ID3D12DescriptorHeap* const* heaps) {
  std::vector<Microsoft::WRL::ComPtr<ID3D12DescriptorHeap>> held;
  for (UINT i = 0; i < count; ++i) held.push_back(hold(heaps[i]));
  keep([held = std::move(held)](List* list) {
    std::vector<ID3D12DescriptorHeap*> set;
    for (const auto& heap : held) set.push_back(heap.Get());
    list->SetDescriptorHeaps(static_cast<UINT>(set.size()), set.data());
  });
}

void Bundle::SetComputeRootSignature(ID3D12RootSignature* root_signature) {
  keep([r = hold(root_signature)](List* list) { list->SetComputeRootSignature(r.Get()); });
}
void Bundle::SetGraphicsRootSignature(ID3D12RootSignature* root_signature) {
  keep([r = hold(root_signature)](List* list) { list->SetGraphicsRootSignature(r.Get()); });
}
void Bundle::SetComputeRootDescriptorTable(UINT parameter, D3D12_GPU_DESCRIPTOR_HANDLE base) {
  keep([=](List* list) { list->SetComputeRootDescriptorTable(parameter, base); });
}
void Bundle::SetGraphicsRootDescriptorTable(UINT parameter, D3D12_GPU_DESCRIPTOR_HANDLE base) {
  keep([=](List* list) { list->SetGraphicsRootDescriptorTable(parameter, base); });
}
void Bundle::SetComputeRoot32BitConstant(UINT parameter, UINT value, UINT offset) {
  keep([=](List* list) { list->SetComputeRoot32BitConstant(parameter, value, offset); });
}
void Bundle::SetGraphicsRoot32BitConstant(UINT parameter, UINT value, UINT offset) {
  keep([=](List* list) { list->SetGraphicsRoot32BitConstant(parameter, value, offset); });
}
void Bundle::SetComputeRoot32BitConstants(UINT parameter, UINT count, const void* values,
                                          UINT offset) {
  keep([=, kept = words(count, values)](List* list) {
    list->SetComputeRoot32BitConstants(parameter, static_cast<UINT>(kept.size()), kept.data(),
                                       offset);
  });
}
void Bundle::SetGraphicsRoot32BitConstants(UINT parameter, UINT count, const void* values,
                                           UINT offset) {
  keep([=, kept = words(count, values)](List* list) {
    list->SetGraphicsRoot32BitConstants(parameter, static_cast<UINT>(kept.size()), kept.data(),
                                        offset);
  });
}
void Bundle::SetComputeRootConstantBufferView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetComputeRootConstantBufferView(parameter, address); });
}
void Bundle::SetGraphicsRootConstantBufferView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetGraphicsRootConstantBufferView(parameter, address); });
}
void Bundle::SetComputeRootShaderResourceView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetComputeRootShaderResourceView(parameter, address); });
}
void Bundle::SetGraphicsRootShaderResourceView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetGraphicsRootShaderResourceView(parameter, address); });
}
void Bundle::SetComputeRootUnorderedAccessView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetComputeRootUnorderedAccessView(parameter, address); });
}
void Bundle::SetGraphicsRootUnorderedAccessView(UINT parameter, D3D12_GPU_VIRTUAL_ADDRESS address) {
  keep([=](List* list) { list->SetGraphicsRootUnorderedAccessView(parameter, address); });
}

void Bundle::IASetPrimitiveTopology(D3D12_PRIMITIVE_TOPOLOGY topology) {
  keep([=](List* list) { list->IASetPrimitiveTopology(topology); });
}
void Bundle::IASetIndexBuffer(const D3D12_INDEX_BUFFER_VIEW* view) {
  std::optional<D3D12_INDEX_BUFFER_VIEW> kept;
  if (view != nullptr) kept = *view;
  keep([=](List* list) { list->IASetIndexBuffer(kept ? &*kept : nullptr); });
}
void Bundle::IASetVertexBuffers(UINT start_slot, UINT count,
                                const D3D12_VERTEX_BUFFER_VIEW* views) {
  std::vector<D3D12_VERTEX_BUFFER_VIEW> kept;
  if (views != nullptr) kept.assign(views, views + count);
  keep([=](List* list) {
    list->IASetVertexBuffers(start_slot, count, kept.empty() ? nullptr : kept.data());
  });
}
void Bundle::OMSetBlendFactor(const FLOAT factor[4]) {
  std::optional<std::array<FLOAT, 4>> kept;
  if (factor != nullptr) std::copy_n(factor, 4, kept.emplace().begin());
  keep([=](List* list) { list->OMSetBlendFactor(kept ? kept->data() : nullptr); });
}
void Bundle::OMSetStencilRef(UINT value) {
  keep([=](List* list) { list->OMSetStencilRef(value); });
}

void Bundle::Dispatch(UINT x, UINT y, UINT z) {
  keep([=](List* list) { list->Dispatch(x, y, z); });
}
void Bundle::DispatchRays(const D3D12_DISPATCH_RAYS_DESC* desc) {
  if (desc == nullptr) {
    fail(ErrorId::kNullPointer, "DispatchRays: pDesc.");
    return;
  }
  keep([kept = *desc](List* list) { list->DispatchRays(&kept); });
}
void Bundle::DrawInstanced(UINT vertices, UINT instances, UINT start_vertex, UINT start_instance) {
  keep([=](List* list) { list->DrawInstanced(vertices, instances, start_vertex, start_instance); });
}
void Bundle::DrawIndexedInstanced(UINT indices, UINT instances, UINT start_index, INT base_vertex,
                                  UINT start_instance) {
  keep([=](List* list) {
    list->DrawIndexedInstanced(indices, instances, start_index, base_vertex, start_instance);
  });
}
void Bundle::ExecuteIndirect(ID3D12CommandSignature* signature, UINT max_count,
                             ID3D12Resource* arguments, UINT64 arguments_offset,
                             ID3D12Resource* count, UINT64 count_offset) {
  keep([=, s = hold(signature), a = hold(arguments), c = hold(count)](List* list) {
    list->ExecuteIndirect(s.Get(), max_count, a.Get(), arguments_offset, c.Get(), count_offset);
  });
}

}  // namespace kaamos::d3d12
