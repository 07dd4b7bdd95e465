// SPDX-License-Identifier: MIT
// Measures how long the passes of a frame take, by timestamps.
#pragma once

#include <d3d12.h>
#include <windows.h>
#include <wrl/client.h>

#include <string>
#include <vector>

class PassTimes {
 public:
  PassTimes(ID3D12Device* device, ID3D12CommandQueue* queue);

  // Record a timestamp: where the first pass starts, and where each ends. At most 15 passes.
  void Start(ID3D12GraphicsCommandList* list);
  void End(ID3D12GraphicsCommandList* list, const char* pass);
  // Records the copy to memory that Print reads once the list has run.
  void Resolve(ID3D12GraphicsCommandList* list);
  void Print();

 private:
  static constexpr UINT kMost = 16;

  Microsoft::WRL::ComPtr<ID3D12QueryHeap> queries_;
  Microsoft::WRL::ComPtr<ID3D12Resource> ticks_;
  UINT64 frequency_ = 0;
  std::vector<std::string> passes_;
};
