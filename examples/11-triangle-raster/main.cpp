// SPDX-License-Identifier: MIT
// One rasterized triangle, with every call written out.
#include <shaders/triangle_raster.h>

#include "../common/example.h"

using namespace rtapi;

static Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;

  // The render target: a texture, and a view of it in a heap that only the command list reads.
  const Texture image = device
                            .CreateTexture({.Width = setup.width,
                                            .Height = setup.height,
                                            .Format = Format::kR8G8B8A8Unorm,
                                            .Flags = ResourceFlags::kAllowRenderTarget,
                                            .InitialState = ResourceStates::kRenderTarget,
                                            .Name = "image"})
                            .value();
  const DescriptorHeap targets =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  const CpuDescriptorHandle target = targets.GetCPUDescriptorHandleForHeapStart();
  device.CreateRenderTargetView(image, target).value();

  // Three vertices of 20 bytes: a position and a colour.
  const std::vector<float> corners = {
      0.0f,  0.8f,  1,    0.2f, 0.1f,  // top
      0.8f,  -0.7f, 0.1f, 0.8f, 0.3f,  // right
      -0.8f, -0.7f, 0.1f, 0.3f, 1,     // left
  };
  constexpr uint32_t kStride = 5 * sizeof(float);
  const Buffer vertices = CreateUploadBuffer(device, corners, "vertices").value();

  // The pipeline is everything about a draw that is known before: shaders, how vertices lie in
  // memory, formats of targets, and fixed functions, whose defaults are those of D3D12.
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_triangle_raster()).value();
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature =
      device.CreateRootSignature("RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT)").value();
  desc.VS = {library, "PlaceCorner"};
  desc.PS = {library, "FillPixel"};
  desc.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32Float},
                      {.SemanticName = "COLOR", .Format = Format::kR32G32B32Float}};
  desc.DepthStencilState.DepthEnable = false;
  desc.RTVFormats = {Format::kR8G8B8A8Unorm};
  desc.Name = "triangle";
  const PipelineState pipeline = device.CreateGraphicsPipelineState(desc).value();

  // The viewport is a square in the middle, so that the triangle keeps its shape.
  const auto width = static_cast<float>(setup.width);
  const auto height = static_cast<float>(setup.height);
  const Viewport viewport = {(width - height) / 2, 0, height, height, 0, 1};
  const Rect scissor = {0, 0, static_cast<int32_t>(setup.width),
                        static_cast<int32_t>(setup.height)};
  const float background[4] = {0.12f, 0.12f, 0.15f, 1};

  CommandList list = device.CreateCommandList().value();
  list.ClearRenderTargetView(target, background);
  list.SetGraphicsRootSignature(desc.pRootSignature);
  list.SetPipelineState(pipeline);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.IASetVertexBuffers(0, VertexBufferView{vertices.GetGPUVirtualAddress(),
                                              static_cast<uint32_t>(vertices.size()), kStride});
  list.RSSetViewports(viewport);
  list.RSSetScissorRects(scissor);
  list.OMSetRenderTargets(1, &target);
  list.DrawInstanced(3, 1, 0, 0);
  setup.queue.ExecuteAndWait(list).value();
  return image;
}

int main(int argc, char** argv) {
  return example::Main(argc, argv, "11-triangle-raster", Render);
}
