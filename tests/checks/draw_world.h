// SPDX-License-Identifier: MIT
//
// A draw without mistakes on a device in checked mode; each test breaks one thing in it.
#pragma once

#include <gtest/gtest.h>
#include <rtapi/rtapi.h>
#include <rtapi/upload.h>

#include <string>
#include <vector>

namespace kaamos::checks::test {

class DrawWorld : public ::testing::Test {
 protected:
  static constexpr uint32_t kSize = 16;  // of targets, in pixels

  void SetUp() override;

  // "plain": WholeTarget and Constant, one target, D32_FLOAT, LESS, no culling.
  rtapi::GraphicsPipelineStateDesc desc(const std::string& pixel = "Constant",
                                        const std::string& vertex = "WholeTarget") const;
  rtapi::PipelineState make(const rtapi::GraphicsPipelineStateDesc& desc) const {
    return device_.CreateGraphicsPipelineState(desc).value();
  }
  rtapi::Texture texture(const std::string& name, rtapi::Format format, rtapi::ResourceFlags flags,
                         rtapi::ResourceStates state, uint32_t size = kSize,
                         const rtapi::ClearValue& clear = {});
  template <class T>
  rtapi::Buffer upload(const std::vector<T>& elements, const std::string& name) {
    keep_.push_back(rtapi::CreateUploadBuffer(device_, elements, name).value());
    return keep_.back();
  }
  static rtapi::VertexBufferView vertices(const rtapi::Buffer& buffer, uint32_t stride) {
    return {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(buffer.size()), stride};
  }
  static rtapi::IndexBufferView indices(const rtapi::Buffer& buffer, rtapi::Format format) {
    return {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(buffer.size()), format};
  }

  // A list with both targets cleared, and all set that a draw needs but the pipeline.
  rtapi::CommandList begin(float clear_depth = 1);
  // Everything that a draw needs but targets and pipeline.
  void set_all(rtapi::CommandList& list);
  void set_tint(rtapi::CommandList& list, float x, float y = 0, float z = 0, float w = 0.5f);
  // Sets the pipeline and draws three vertices.
  void draw(rtapi::CommandList& list, const rtapi::GraphicsPipelineStateDesc& desc);
  void draw(rtapi::CommandList& list) { draw(list, desc()); }
  void bind(rtapi::CommandList& list, uint32_t rtv, int dsv = 0);
  void run(rtapi::CommandList& list);

  // The messages since the last call, without those on how shaders were compiled.
  std::vector<std::string> told();
  // There must be exactly one, with this id and all parts in this order.
  void expect_one(const std::string& id, const std::vector<std::string>& parts);
  void expect_none();

  std::vector<rtapi::Message> messages_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::Texture color_, small_, bytes_, depth_, image_;
  rtapi::DescriptorHeap rtvs_;   // 0: color_, 1: small_, 2: bytes_
  rtapi::DescriptorHeap dsvs_;   // 0: depth_, 1: the same, read only
  rtapi::DescriptorHeap views_;  // 0: image_, 1: color_, 2: depth_
  rtapi::Buffer stored_;
  std::vector<rtapi::Buffer> keep_;
};

}  // namespace kaamos::checks::test
