// SPDX-License-Identifier: MIT
//
// The means that rules of draws need: targets, pipelines for them, a list with everything set, and
// the texels afterwards.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tests/conformance/context.h"

namespace kaamos::shader {
struct LibraryDesc;
}

namespace kaamos::conformance {

inline constexpr char kDrawSignature[] =
    "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), RootConstants(num32BitConstants = 8, b0), "
    "SRV(t0), UAV(u0), DescriptorTable(SRV(t1, numDescriptors = 2), UAV(u1, numDescriptors = 2)), "
    "StaticSampler(s0, filter = FILTER_MIN_MAG_MIP_LINEAR, addressU = TEXTURE_ADDRESS_CLAMP, "
    "addressV = TEXTURE_ADDRESS_CLAMP), "
    "StaticSampler(s1, filter = FILTER_COMPARISON_MIN_MAG_LINEAR_MIP_POINT, "
    "comparisonFunc = COMPARISON_LESS_EQUAL, addressU = TEXTURE_ADDRESS_CLAMP, "
    "addressV = TEXTURE_ADDRESS_CLAMP)";
// Parameters of kDrawSignature.
enum DrawParameter : uint32_t { kConstants, kWords, kOut, kTable };

// ras.hlsli's constants.
struct DrawConstants {
  std::array<float, 4> tint = {1, 1, 1, 1};
  std::array<float, 2> offset = {0, 0};  // of each instance from the one before, in clip space
  float depth = 0.5f;                    // of Whole
  uint32_t number = 0;                   // for a test's own shaders
};

// A vertex of the shader Pass: clip space, and four numbers.
struct Corner {
  std::array<float, 4> position = {0, 0, 0, 1};
  std::array<float, 4> value = {0, 0, 0, 0};
};

// The values that the shader Facts writes.
struct Fact {
  uint32_t vertex;     // SV_VertexID of the leading vertex
  uint32_t primitive;  // SV_PrimitiveID
  uint32_t instance;   // SV_InstanceID
  bool front;          // SV_IsFrontFace
  uint32_t element;    // the leading vertex's value[0]
  bool covered;
};

class Screen {
 public:
  // Targets of size x size pixels. A format kUnknown: no such target. Typeless ones have no view.
  explicit Screen(Context& t,
                  std::vector<rtapi::Format> colors = {rtapi::Format::kR32G32B32A32Float},
                  rtapi::Format depth = rtapi::Format::kUnknown, uint32_t size = 256,
                  uint16_t slices = 1);

  // Shaders are looked for here before ras.hlsl.
  const shader::LibraryDesc* library = nullptr;

  // For these targets: no culling, no blending, depth LESS if there is a depth buffer. The layout
  // is that of Corner if the vertex shader is Pass. An empty pixel shader: none.
  rtapi::GraphicsPipelineStateDesc desc(const std::string& vertex, const std::string& pixel) const;
  rtapi::PipelineState make(const rtapi::GraphicsPipelineStateDesc& desc) const {
    return context_->device().CreateGraphicsPipelineState(desc).value();
  }
  rtapi::PipelineState make(const std::string& vertex, const std::string& pixel) const {
    return make(desc(vertex, pixel));
  }
  rtapi::GraphicsShader shader(const std::string& name) const;

  // Pixels from the upper left corner to clip space: exact for multiples of 1/256 and w = 1.
  Corner at(float x, float y, float z = 0.5f, float w = 1, std::array<float, 4> value = {}) const;
  // Two triangles, (0 1 2) and (2 1 3), both clockwise.
  std::vector<Corner> rectangle(float left, float top, float right, float bottom, float z = 0.5f,
                                std::array<float, 4> value = {1, 1, 1, 1}) const;

  // Clears, sets all that draws need but a pipeline, and executes what `record` adds; then reads
  // the targets. Without clears it draws over what is there.
  void run(const std::function<void(rtapi::CommandList&)>& record);
  // The state that run() sets.
  void begin(rtapi::CommandList& list) const;
  // Draws triangles, in a list of their own or in an open one.
  void draw(const rtapi::PipelineState& pipeline, const std::vector<Corner>& corners,
            const DrawConstants& constants = {});
  void draw(rtapi::CommandList& list, const rtapi::PipelineState& pipeline,
            const std::vector<Corner>& corners, const DrawConstants& constants = {});
  // Draws the triangle of Whole, which covers the target.
  void cover(rtapi::CommandList& list, const rtapi::PipelineState& pipeline,
             const DrawConstants& constants = {});
  static void use(rtapi::CommandList& list, const rtapi::PipelineState& pipeline,
                  const DrawConstants& constants = {});
  // Vertex buffer 0.
  void vertices(rtapi::CommandList& list, const std::vector<Corner>& corners);
  template <class T>
  rtapi::VertexBufferView view(const std::vector<T>& elements, uint32_t stride = sizeof(T)) {
    const rtapi::Buffer buffer = context_->upload(elements);
    return {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(elements.size() * sizeof(T)),
            stride};
  }
  // Index buffer of uint16_t or uint32_t.
  template <class T>
  void indices(rtapi::CommandList& list, const std::vector<T>& elements) {
    const rtapi::IndexBufferView view = {
        context_->upload(elements).GetGPUVirtualAddress(),
        static_cast<uint32_t>(elements.size() * sizeof(T)),
        sizeof(T) == 2 ? rtapi::Format::kR16Uint : rtapi::Format::kR32Uint};
    list.IASetIndexBuffer(&view);
  }

  // After run().
  template <class T>
  T texel(uint32_t x, uint32_t y, uint32_t component = 0, size_t target = 0,
          uint32_t slice = 0) const {
    T value;
    const std::vector<std::byte>& texels = texels_[target * slices_ + slice];
    const size_t bytes = texels.size() / (size_t{size_} * size_);
    std::memcpy(&value, texels.data() + (size_t{y} * size_ + x) * bytes + component * sizeof(T),
                sizeof value);
    return value;
  }
  Fact fact(uint32_t x, uint32_t y) const;
  // Reads D32_FLOAT and D16_UNORM.
  float depth(uint32_t x, uint32_t y) const;
  uint32_t depth_bits(uint32_t x, uint32_t y) const;
  // Counts the pixels that have another value than expected(x, y).
  template <class T>
  uint32_t differing(const std::function<T(uint32_t x, uint32_t y)>& expected,
                     uint32_t component = 0, size_t target = 0, uint32_t slice = 0) const {
    return count([&](uint32_t x, uint32_t y) {
      return !(texel<T>(x, y, component, target, slice) == expected(x, y));
    });
  }
  uint32_t count(const std::function<bool(uint32_t x, uint32_t y)>& condition) const;
  // Counts the pixels that have a first component other than 0, as floats.
  uint32_t covered(size_t target = 0, uint32_t slice = 0) const;

  uint32_t size() const { return size_; }
  rtapi::CpuDescriptorHandle rtv(uint32_t target = 0) const {
    return rtvs_.GetCPUDescriptorHandle(target);
  }
  rtapi::CpuDescriptorHandle dsv() const { return dsvs_.GetCPUDescriptorHandle(0); }
  Context& context() { return *context_; }

  std::array<float, 4> clear_color = {0, 0, 0, 0};
  float clear_depth = 1;
  bool clears = true;
  rtapi::RootSignature root_signature;
  std::vector<rtapi::Texture> colors;
  rtapi::Texture depth_texture;
  rtapi::DescriptorHeap views;  // shader-visible: t1, t2, u1, u2
  rtapi::Buffer words;          // at u0, 4096 bytes of zeros

 private:
  void read();

  Context* context_;
  std::vector<rtapi::Format> formats_;
  rtapi::Format depth_format_;
  uint32_t size_;
  uint16_t slices_;
  rtapi::DescriptorHeap rtvs_;
  rtapi::DescriptorHeap dsvs_;
  std::vector<std::vector<std::byte>> texels_ = {};
  std::vector<std::byte> depth_texels_ = {};
};

// Description of a layout: an element per vertex in slot 0, behind the one before.
rtapi::InputElementDesc element(const std::string& semantic, rtapi::Format format,
                                uint32_t slot = 0, uint32_t index = 0);
rtapi::InputElementDesc instance_element(const std::string& semantic, rtapi::Format format,
                                         uint32_t slot, uint32_t step_rate, uint32_t index = 0);
rtapi::Format typeless_of_depth(rtapi::Format depth);

}  // namespace kaamos::conformance
