// SPDX-License-Identifier: MIT
#include "d3d12/objects/command_queue.h"

#include <windows.h>

#include "d3d12/objects/command_allocator.h"
#include "d3d12/objects/device.h"
#include "d3d12/objects/fence.h"
#include "d3d12/objects/graphics_command_list.h"

namespace kaamos::d3d12 {

void CommandQueue::ExecuteCommandLists(UINT count, ID3D12CommandList* const* lists) {
  if (count != 0 && lists == nullptr) {
    fail(ErrorId::kNullPointer, "ExecuteCommandLists: ppCommandLists.");
    return;
  }
  std::vector<rtapi::CommandList> submitted;
  for (UINT i = 0; i < count; ++i) {
    if (lists[i] == nullptr) {
      fail(ErrorId::kNullPointer,
           "ExecuteCommandLists: ppCommandLists[" + std::to_string(i) + "].");
      return;
    }
    if (lists[i]->GetType() == D3D12_COMMAND_LIST_TYPE_BUNDLE) {
      fail(ErrorId::kCommandList, "ExecuteCommandLists: ppCommandLists[" + std::to_string(i) +
                                      "] is a bundle. Execute it on a list, by ExecuteBundle.");
      return;
    }
    submitted.push_back(static_cast<GraphicsCommandList*>(lists[i])->rtapi_list());
  }
  check(queue_.ExecuteCommandLists(submitted));
}

HRESULT CommandQueue::Signal(ID3D12Fence* fence, UINT64 value) {
  if (fence == nullptr) return fail(ErrorId::kNullPointer, "ID3D12CommandQueue::Signal: pFence.");
  return check(queue_.Signal(static_cast<Fence*>(fence)->rtapi_fence(), value));
}

HRESULT CommandQueue::Wait(ID3D12Fence* fence, UINT64 value) {
  if (fence == nullptr) return fail(ErrorId::kNullPointer, "ID3D12CommandQueue::Wait: pFence.");
  return check(queue_.Wait(static_cast<Fence*>(fence)->rtapi_fence(), value));
}

HRESULT CommandQueue::GetTimestampFrequency(UINT64* frequency) {
  if (frequency == nullptr) return E_INVALIDARG;
  const auto ticks = queue_.GetTimestampFrequency();
  if (!ticks) return fail(ticks.error());
  *frequency = *ticks;
  return S_OK;
}

// The GPU's clock is read as programs read it: by a timestamp of a list that does nothing else, on
// a queue of its own, as this one may wait for what the program does later.
HRESULT CommandQueue::GetClockCalibration(UINT64* gpu, UINT64* cpu) {
  if (gpu == nullptr || cpu == nullptr) return E_INVALIDARG;
  const rtapi::Device& device = rtapi_device(this->device());
  const auto heap = device.CreateQueryHeap({.Count = 1});
  if (!heap) return fail(heap.error());
  const auto buffer =
      device.CreateBuffer({.SizeInBytes = sizeof(uint64_t), .Heap = rtapi::HeapType::kReadback});
  if (!buffer) return fail(buffer.error());
  auto list = device.CreateCommandList();
  if (!list) return fail(list.error());
  list->EndQuery(*heap, rtapi::QueryType::kTimestamp, 0);
  list->ResolveQueryData(*heap, rtapi::QueryType::kTimestamp, 0, 1, *buffer, 0);
  auto own = device.CreateCommandQueue();
  if (!own) return fail(own.error());
  if (const auto status = own->ExecuteAndWait(*list); !status) return fail(status.error());
  LARGE_INTEGER now;
  QueryPerformanceCounter(&now);
  *gpu = buffer->data<uint64_t>()[0];
  *cpu = static_cast<UINT64>(now.QuadPart);
  return S_OK;
}

HRESULT Device::CreateCommandQueue(const D3D12_COMMAND_QUEUE_DESC* desc, REFIID riid,
                                   void** queue) {
  if (queue != nullptr) *queue = nullptr;
  if (desc == nullptr) return fail(ErrorId::kNullPointer, "CreateCommandQueue: pDesc.");
  auto made = device_.CreateCommandQueue();
  if (!made) return fail(made.error());
  D3D12_COMMAND_QUEUE_DESC stored = *desc;
  if (stored.NodeMask == 0) stored.NodeMask = 1;
  return hand_out(new CommandQueue(this, *made, stored), riid, queue);
}

HRESULT Device::CreateCommandQueue1(const D3D12_COMMAND_QUEUE_DESC* desc, REFIID, REFIID riid,
                                    void** queue) {
  return CreateCommandQueue(desc, riid, queue);
}

HRESULT Device::CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE type, REFIID riid,
                                       void** allocator) {
  if (allocator != nullptr) *allocator = nullptr;
  if (static_cast<UINT>(type) > D3D12_COMMAND_LIST_TYPE_COPY) {
    return fail(ErrorId::kCommandList,
                "CreateCommandAllocator: type " + std::to_string(type) +
                    "; it is DIRECT (0), BUNDLE (1), COMPUTE (2) or COPY (3).");
  }
  return hand_out(new CommandAllocator(this, type), riid, allocator);
}

}  // namespace kaamos::d3d12
