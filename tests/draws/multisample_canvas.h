// SPDX-License-Identifier: MIT
//
// A multisampled target of 16 x 16 pixels with a depth buffer, whose samples the host can read, and
// the places of its samples.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace kaamos::draws {

// In sixteenths of a pixel, from its middle. [D3D11.3: 19.2.4 Standard sample patterns]
struct SamplePlace {
  int x;
  int y;
};
std::vector<SamplePlace> standard_pattern(uint32_t count);

struct MultisampleVertex {
  float position[3];
  float value[2];
};
// A corner at (x, y) pixels.
MultisampleVertex corner(float x, float y, float z = 0.5f, float u = 0, float v = 0);

class MultisampleCanvas {
 public:
  static constexpr uint32_t kSide = 16;
  using Record = std::function<void(rtapi::CommandList&)>;

  MultisampleCanvas(const rtapi::Device& device, uint32_t samples,
                    rtapi::Format format = rtapi::Format::kR32G32B32A32Float,
                    uint32_t elements = 1);

  // D32_FLOAT, no culling, no depth test.
  rtapi::GraphicsPipelineStateDesc desc(const std::string& vertex, const std::string& pixel) const;
  rtapi::PipelineState make(const rtapi::GraphicsPipelineStateDesc& desc) const;
  // Clears to 0 and depth 1, binds the targets, records, and reads all samples of the last element.
  void run(const Record& record);
  void use(rtapi::CommandList& list, const rtapi::PipelineState& pipeline,
           std::array<float, 4> tint = {1, 1, 1, 1}) const;
  // Draws triangles; the buffer stays until run() is done.
  void draw(rtapi::CommandList& list, const std::vector<MultisampleVertex>& vertices);

  float sample(uint32_t x, uint32_t y, uint32_t index, uint32_t component = 0) const {
    return texels_[((size_t{y} * kSide + x) * 8 + index) * 4 + component];
  }
  // Runs a compute shader on the target; float4s of its output.
  std::vector<float> compute(const std::string& entry, uint32_t floats);
  uint32_t invocations() const { return invocations_; }
  // The target resolved.
  std::vector<std::byte> resolved(rtapi::Format format);

  rtapi::Device device;
  rtapi::CommandQueue queue;
  rtapi::Texture target;
  rtapi::Texture depth_buffer;  // R32_TYPELESS
  rtapi::DescriptorHeap rtvs;   // the last element
  rtapi::DescriptorHeap dsvs;
  const uint32_t samples;

 private:
  rtapi::Format format_;
  uint32_t elements_;
  rtapi::RootSignature root_signature_;
  rtapi::DescriptorHeap views_;
  rtapi::Buffer output_;
  std::vector<rtapi::Buffer> vertices_;
  std::vector<float> texels_;
  uint32_t invocations_ = 0;
};

}  // namespace kaamos::draws
