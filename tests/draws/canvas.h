// SPDX-License-Identifier: MIT
//
// A target of 64 x 64 pixels with a depth buffer, and what it takes to draw to it.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace kaamos::draws {

inline constexpr uint32_t kSize = 64;

// tint of draws.hlsl.
struct Tint {
  float r = 1, g = 1, b = 1, a = 1;
};

class Canvas {
 public:
  explicit Canvas(const std::string& backend,
                  rtapi::Format format = rtapi::Format::kR32G32B32A32Float,
                  uint32_t max_threads = 0);

  // One target of the canvas's format, D32_FLOAT, no culling.
  rtapi::GraphicsPipelineStateDesc desc(const std::string& vertex, const std::string& pixel) const;
  rtapi::PipelineState make(const rtapi::GraphicsPipelineStateDesc& desc) const;

  // Clears, sets everything but a pipeline and vertex buffers, and records; the list then runs.
  void run(const std::function<void(rtapi::CommandList&)>& record, float clear_depth = 1);
  // The same in two parts: the closed list, and what texel() and depth() read.
  rtapi::CommandList list(const std::function<void(rtapi::CommandList&)>& record,
                          float clear_depth = 1);
  void read_back();
  // Sets a pipeline and the tint.
  static void use(rtapi::CommandList& list, const rtapi::PipelineState& pipeline, Tint tint = {});

  // Texel (x, y) of the target, or of the depth buffer, after run().
  template <class T>
  T texel(uint32_t x, uint32_t y, uint32_t component = 0) const {
    T value;
    std::memcpy(&value,
                color_.data() + (size_t{y} * kSize + x) * texel_bytes_ + component * sizeof(T),
                sizeof value);
    return value;
  }
  float depth(uint32_t x, uint32_t y) const;

  rtapi::Device device;
  rtapi::CommandQueue queue;
  rtapi::RootSignature root_signature;
  rtapi::DescriptorHeap views;  // slot 0: image; 1: scene
  rtapi::Buffer counter;        // two counts
  rtapi::Texture target;
  rtapi::Texture depth_buffer;  // R32_TYPELESS
  rtapi::DescriptorHeap rtvs;
  rtapi::DescriptorHeap dsvs;

 private:
  rtapi::Format format_;
  uint32_t texel_bytes_;
  std::vector<std::byte> color_;
  std::vector<std::byte> depth_;
};

}  // namespace kaamos::draws
