// SPDX-License-Identifier: MIT
// One triangle, traced into a texture.
#pragma once

#include "..\common\program.h"

class Triangle : public Program {
 public:
  explicit Triangle(const Options& options);

  // Records the rays. The image is in state UNORDERED_ACCESS before and afterwards.
  void DispatchRays();
  ID3D12Resource* image() const { return image_.Get(); }

 private:
  void CreatePipeline();
  void BuildAccelerationStructures();

  ComPtr<ID3D12RootSignature> root_signature_;
  ComPtr<ID3D12StateObject> pipeline_;
  ComPtr<ID3D12Resource> raygen_table_, miss_table_, hit_table_;
  ComPtr<ID3D12Resource> vertices_, instances_, bottom_level_, top_level_;
  ComPtr<ID3D12Resource> image_;
  ComPtr<ID3D12DescriptorHeap> heap_;
};
