// SPDX-License-Identifier: MIT
//
// Graphics pipelines whose shaders do nothing, on the null device.
#pragma once

#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "rtapi/testing/command_list_fixture.h"
#include "runtime/backend/linked_graphics.h"

namespace rtapi::testing {

class GraphicsTest : public CommandListTest {
 protected:
  using Elements = std::vector<shader::SignatureElement>;
  using T = shader::ColumnType;
  using V = shader::SystemValue;

  static shader::SignatureElement Position() {
    return LibraryBuilder::Element("SV_Position", 0, 4, T::kFloat, V::kPosition);
  }
  static shader::SignatureElement Target(uint32_t slot, uint8_t components = 4,
                                         T type = T::kFloat) {
    return LibraryBuilder::Element("SV_Target", slot, components, type, V::kTarget);
  }
  static shader::SignatureElement Value(const char* semantic, uint32_t index, uint8_t components,
                                        T type = T::kFloat) {
    return LibraryBuilder::Element(semantic, index, components, type);
  }

  ShaderLibrary Vertex(Elements inputs, Elements outputs) {
    LibraryBuilder& b = builders_.emplace_back("vs.hlsl", "vs_6_6");
    b.GraphicsExport("vs", shader::Stage::kVertex, std::move(inputs), std::move(outputs));
    return b.Build();
  }
  ShaderLibrary Pixel(Elements inputs, Elements outputs) {
    LibraryBuilder& b = builders_.emplace_back("ps.hlsl", "ps_6_6");
    b.GraphicsExport("ps", shader::Stage::kPixel, std::move(inputs), std::move(outputs));
    return b.Build();
  }

  // One RGBA8 target, a vertex shader that writes only a position, no inputs.
  GraphicsPipelineStateDesc Desc() {
    GraphicsPipelineStateDesc desc;
    desc.pRootSignature = Global("RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)");
    desc.VS = {Vertex({}, {Position()}), {}};
    desc.PS = {Pixel({}, {Target(0)}), {}};
    desc.RTVFormats = {Format::kR8G8B8A8Unorm};
    return desc;
  }
  Result<PipelineState> Make(const GraphicsPipelineStateDesc& desc) {
    return device_.CreateGraphicsPipelineState(desc);
  }
  const kaamos::runtime::LinkedGraphics& Linked() { return *null_log().last_graphics; }

  Texture MakeTarget(Format format, ResourceFlags flags, uint32_t width = 16, uint32_t height = 16,
                     uint16_t slices = 1, uint16_t mips = 1) {
    return device_
        .CreateTexture({.Width = width,
                        .Height = height,
                        .DepthOrArraySize = slices,
                        .MipLevels = mips,
                        .Format = format,
                        .Flags = flags,
                        .Name = "target"})
        .value();
  }

  std::deque<LibraryBuilder> builders_;
};

}  // namespace rtapi::testing
