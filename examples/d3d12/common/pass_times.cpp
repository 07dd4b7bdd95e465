// SPDX-License-Identifier: MIT
#include "pass_times.h"

#include <d3dx12.h>

#include <cstdio>

#include "program.h"

PassTimes::PassTimes(ID3D12Device* device, ID3D12CommandQueue* queue) {
  D3D12_QUERY_HEAP_DESC queries = {};
  queries.Type = D3D12_QUERY_HEAP_TYPE_TIMESTAMP;
  queries.Count = kMost;
  CHECK(device->CreateQueryHeap(&queries, IID_PPV_ARGS(&queries_)));
  const CD3DX12_HEAP_PROPERTIES heap(D3D12_HEAP_TYPE_READBACK);
  const auto desc = CD3DX12_RESOURCE_DESC::Buffer(kMost * sizeof(UINT64));
  CHECK(device->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &desc,
                                        D3D12_RESOURCE_STATE_COPY_DEST, nullptr,
                                        IID_PPV_ARGS(&ticks_)));
  CHECK(queue->GetTimestampFrequency(&frequency_));
}

void PassTimes::Start(ID3D12GraphicsCommandList* list) {
  passes_.clear();
  list->EndQuery(queries_.Get(), D3D12_QUERY_TYPE_TIMESTAMP, 0);
}

void PassTimes::End(ID3D12GraphicsCommandList* list, const char* pass) {
  passes_.push_back(pass);
  list->EndQuery(queries_.Get(), D3D12_QUERY_TYPE_TIMESTAMP, static_cast<UINT>(passes_.size()));
}

void PassTimes::Resolve(ID3D12GraphicsCommandList* list) {
  list->ResolveQueryData(queries_.Get(), D3D12_QUERY_TYPE_TIMESTAMP, 0,
                         static_cast<UINT>(passes_.size()) + 1, ticks_.Get(), 0);
}

void PassTimes::Print() {
  UINT64* ticks = nullptr;
  CHECK(ticks_->Map(0, nullptr, reinterpret_cast<void**>(&ticks)));
  for (size_t i = 0; i < passes_.size(); ++i) {
    const auto taken = static_cast<double>(ticks[i + 1] - ticks[i]);
    printf("%-10s %8.2f ms\n", passes_[i].c_str(), 1000 * taken / static_cast<double>(frequency_));
  }
  const CD3DX12_RANGE nothing(0, 0);
  ticks_->Unmap(0, &nothing);
}
