// SPDX-License-Identifier: MIT
//
// Counting buffers, textures and descriptors: the resources behind the registers of an HLSL test.
#pragma once

#include <kaamos/shader/abi.h>
#include <rtapi/rtapi.h>

#include <vector>

namespace kaamos::test {

// Makes resources on request and keeps them alive.
class CountingResources {
 public:
  CountingResources(rtapi::Device device, rtapi::CommandQueue queue)
      : device_(std::move(device)), queue_(std::move(queue)) {}

  // 256 words; word i is i.
  rtapi::Buffer buffer(bool writable);
  // Writes descriptors for `count` elements of a binding into slots of `heap`.
  void fill_table(const shader::BindingDesc& binding, const rtapi::DescriptorHeap& heap,
                  uint32_t first, uint32_t count);
  // The slots of ResourceDescriptorHeap and SamplerDescriptorHeap; see fixtures.h.
  void fill_view_heap(const rtapi::DescriptorHeap& heap, const rtapi::Buffer& results);
  void fill_sampler_heap(const rtapi::DescriptorHeap& heap);

 private:
  rtapi::Texture texture(const std::string& name, bool writable);
  void texture_view(const std::string& name, bool writable, rtapi::CpuDescriptorHandle handle);
  void buffer_view(const shader::BindingDesc& binding, const rtapi::Buffer& buffer,
                   rtapi::CpuDescriptorHandle handle);

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  std::vector<rtapi::Buffer> buffers_;
  std::vector<rtapi::Texture> textures_;
};

}  // namespace kaamos::test
