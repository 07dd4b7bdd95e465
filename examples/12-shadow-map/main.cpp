// SPDX-License-Identifier: MIT
// Two passes in one list: depth from the sun, then the scene, which reads it.
#include <shaders/shadow_map.h>

#include "../common/example.h"

using namespace rtapi;

namespace {

constexpr uint32_t kMapSize = 1024;

// The data that an instance adds to the unit cube; per-instance data of the input layout.
struct Box {
  float center[3];
  float half_size[3];
  float turn;  // radians about y
  float color[3];
};
const std::vector<Box> kBoxes = {
    {{0, -0.5f, 0}, {8, 0.5f, 8}, 0, {0.75f, 0.74f, 0.7f}},
    {{-2.4f, 1, 1}, {0.8f, 1, 0.8f}, 0.5f, {0.8f, 0.3f, 0.2f}},
    {{0.2f, 0.6f, -1.2f}, {0.6f, 0.6f, 0.6f}, 0.9f, {0.25f, 0.5f, 0.8f}},
    {{2.6f, 1.5f, 1.4f}, {0.5f, 1.5f, 0.5f}, 0.2f, {0.3f, 0.65f, 0.35f}},
    {{0.3f, 2.1f, 2.6f}, {3.6f, 0.12f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
    {{-3.2f, 1.05f, 3}, {0.12f, 1.05f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
    {{3.8f, 1.05f, 2.2f}, {0.12f, 1.05f, 0.12f}, 0.1f, {0.85f, 0.7f, 0.3f}},
};
const std::vector<float> kCube = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                  -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
// Clockwise, seen from outside.
const std::vector<uint32_t> kSides = {0, 2, 1, 1, 2, 3, 1, 3, 5, 5, 3, 7, 5, 7, 4, 4, 7, 6,
                                      4, 6, 0, 0, 6, 2, 2, 6, 3, 3, 6, 7, 4, 0, 5, 5, 0, 1};

template <class T>
VertexBufferView ViewOf(const Buffer& buffer) {
  return {buffer.GetGPUVirtualAddress(), static_cast<uint32_t>(buffer.size()), sizeof(T)};
}

std::vector<InputElementDesc> Layout() {
  std::vector<InputElementDesc> layout = {
      {.SemanticName = "CORNER", .Format = Format::kR32G32B32Float}};
  const auto per_instance = [&](const char* name, Format format) {
    layout.push_back({.SemanticName = name,
                      .Format = format,
                      .InputSlot = 1,
                      .InputSlotClass = InputClassification::kPerInstanceData,
                      .InstanceDataStepRate = 1});
  };
  per_instance("CENTER", Format::kR32G32B32Float);
  per_instance("HALF_SIZE", Format::kR32G32B32Float);
  per_instance("TURN", Format::kR32Float);
  per_instance("COLOR", Format::kR32G32B32Float);
  return layout;
}

Texture CreateDepth(const Device& device, uint32_t width, uint32_t height, const char* name) {
  // Typeless, so that it is depth to draws and a number to shaders.
  return device
      .CreateTexture({.Width = width,
                      .Height = height,
                      .Format = Format::kR32Typeless,
                      .Flags = ResourceFlags::kAllowDepthStencil,
                      .InitialState = ResourceStates::kDepthWrite,
                      .Name = name})
      .value();
}

void SetArea(CommandList& list, uint32_t width, uint32_t height) {
  list.RSSetViewports(Viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1});
  list.RSSetScissorRects(Rect{0, 0, static_cast<int32_t>(width), static_cast<int32_t>(height)});
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const Texture image = device
                            .CreateTexture({.Width = setup.width,
                                            .Height = setup.height,
                                            .Format = Format::kR8G8B8A8Unorm,
                                            .Flags = ResourceFlags::kAllowRenderTarget,
                                            .InitialState = ResourceStates::kRenderTarget,
                                            .Name = "image"})
                            .value();
  const Texture depth = CreateDepth(device, setup.width, setup.height, "depth");
  const Texture map = CreateDepth(device, kMapSize, kMapSize, "shadow map");
  const DescriptorHeap colors =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  const DescriptorHeap depths =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 2}).value();
  const DescriptorHeap views =
      device
          .CreateDescriptorHeap({.NumDescriptors = 1, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  const CpuDescriptorHandle image_target = colors.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle depth_target = depths.GetCPUDescriptorHandle(0);
  const CpuDescriptorHandle map_target = depths.GetCPUDescriptorHandle(1);
  const DepthStencilViewDesc as_depth = {.Format = Format::kD32Float};
  device.CreateRenderTargetView(image, image_target).value();
  device.CreateDepthStencilView(depth, as_depth, depth_target).value();
  device.CreateDepthStencilView(map, as_depth, map_target).value();
  ShaderResourceViewDesc as_number;
  as_number.Format = Format::kR32Float;
  as_number.ViewDimension = SrvDimension::kTexture2D;
  device.CreateShaderResourceView(map, as_number, views.GetCPUDescriptorHandle(0)).value();

  const Buffer cube = CreateUploadBuffer(device, kCube, "cube").value();
  const Buffer sides = CreateUploadBuffer(device, kSides, "sides").value();
  const Buffer boxes = CreateUploadBuffer(device, kBoxes, "boxes").value();
  const std::vector<VertexBufferView> vertices = {ViewOf<float[3]>(cube), ViewOf<Box>(boxes)};
  const IndexBufferView indices = {sides.GetGPUVirtualAddress(),
                                   static_cast<uint32_t>(sides.size()), Format::kR32Uint};

  // Outside of the map everything is lit: the border is as far away as depth can be.
  const RootSignature root_signature =
      device
          .CreateRootSignature(
              "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT),"
              "RootConstants(num32BitConstants = 2, b0), DescriptorTable(SRV(t0)),"
              "StaticSampler(s0, filter = FILTER_COMPARISON_MIN_MAG_LINEAR_MIP_POINT,"
              "addressU = TEXTURE_ADDRESS_BORDER, addressV = TEXTURE_ADDRESS_BORDER,"
              "borderColor = STATIC_BORDER_COLOR_OPAQUE_WHITE,"
              "comparisonFunc = COMPARISON_LESS_EQUAL)")
          .value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_shadow_map()).value();
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_signature;
  desc.InputLayout = Layout();
  desc.VS = {library, "SeenFromSun"};
  desc.DSVFormat = Format::kD32Float;
  // A texel of the map holds one depth of a slope: the bias lets none of it shade itself.
  desc.RasterizerState.SlopeScaledDepthBias = 2;
  desc.Name = "shadow map";
  const PipelineState map_pipeline = device.CreateGraphicsPipelineState(desc).value();
  desc.VS = {library, "SeenFromEye"};
  desc.PS = {library, "Shade"};
  desc.RasterizerState.SlopeScaledDepthBias = 0;
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kGreater;
  desc.RTVFormats = {Format::kR8G8B8A8Unorm};
  desc.Name = "scene";
  const PipelineState scene_pipeline = device.CreateGraphicsPipelineState(desc).value();

  struct Constants {
    float aspect;
    float texel;
  };
  const Constants constants = {static_cast<float>(setup.width) / static_cast<float>(setup.height),
                               1.0f / kMapSize};
  const float sky[4] = {0.6f, 0.75f, 0.9f, 1};
  const auto index_count = static_cast<uint32_t>(kSides.size());
  const auto box_count = static_cast<uint32_t>(kBoxes.size());

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({views});
  list.SetGraphicsRootSignature(root_signature);
  list.SetGraphicsRoot32BitConstants(0, constants);
  list.SetGraphicsRootDescriptorTable(1, views.GetGPUDescriptorHandleForHeapStart());
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.IASetVertexBuffers(0, vertices);
  list.IASetIndexBuffer(&indices);

  list.ClearDepthStencilView(map_target, ClearFlags::kDepth, 1, 0);
  list.OMSetRenderTargets(0, nullptr, false, &map_target);
  SetArea(list, kMapSize, kMapSize);
  list.SetPipelineState(map_pipeline);
  list.DrawIndexedInstanced(index_count, box_count, 0, 0, 0);

  list.ResourceBarrier(ResourceBarrier::Transition(map, ResourceStates::kDepthWrite,
                                                   ResourceStates::kPixelShaderResource));
  list.ClearRenderTargetView(image_target, sky);
  list.ClearDepthStencilView(depth_target, ClearFlags::kDepth, 0, 0);
  list.OMSetRenderTargets(1, &image_target, false, &depth_target);
  SetArea(list, setup.width, setup.height);
  list.SetPipelineState(scene_pipeline);
  list.DrawIndexedInstanced(index_count, box_count, 0, 0, 0);
  setup.queue.ExecuteAndWait(list).value();
  return image;
}

}  // namespace

int main(int argc, char** argv) {
  return example::Main(argc, argv, "12-shadow-map", Render);
}
