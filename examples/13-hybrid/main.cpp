// SPDX-License-Identifier: MIT
// Three passes in one list: a rasterized G-buffer, traced shadows, and a pixel shader with a
// RayQuery that puts the picture together.
#include <shaders/hybrid.h>

#include <cmath>

#include "../common/example.h"

using namespace rtapi;

namespace {

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

RaytracingInstanceDesc InstanceOf(const Box& box, const Buffer& bottom_level) {
  RaytracingInstanceDesc instance = example::Instance(bottom_level, 0, 0, 0);
  const float c = std::cos(box.turn);
  const float s = std::sin(box.turn);
  const float turn[3][3] = {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      instance.Transform[row][column] = turn[row][column] * box.half_size[column];
    }
    instance.Transform[row][3] = box.center[row];
  }
  return instance;
}

// The textures of the frame, and their views.
struct Frame {
  explicit Frame(const example::Setup& setup);

  Texture albedo, normals, depth, sunlight, image;
  DescriptorHeap colors, depths, views;
  CpuDescriptorHandle surface_targets[2], image_target, depth_target;
};

Frame::Frame(const example::Setup& setup) {
  const Device& device = setup.device;
  const auto create = [&](Format format, ResourceFlags flags, ResourceStates state,
                          const char* name) {
    return device
        .CreateTexture({.Width = setup.width,
                        .Height = setup.height,
                        .Format = format,
                        .Flags = flags,
                        .InitialState = state,
                        .Name = name})
        .value();
  };
  const auto target = ResourceFlags::kAllowRenderTarget;
  albedo = create(Format::kR8G8B8A8Unorm, target, ResourceStates::kRenderTarget, "albedo");
  normals = create(Format::kR16G16B16A16Float, target, ResourceStates::kRenderTarget, "normals");
  depth = create(Format::kR32Typeless, ResourceFlags::kAllowDepthStencil,
                 ResourceStates::kDepthWrite, "depth");
  sunlight = create(Format::kR8Unorm, ResourceFlags::kAllowUnorderedAccess,
                    ResourceStates::kUnorderedAccess, "sunlight");
  image = create(Format::kR8G8B8A8Unorm, target, ResourceStates::kRenderTarget, "image");

  colors =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 3}).value();
  depths =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1}).value();
  views =
      device
          .CreateDescriptorHeap({.NumDescriptors = 5, .Flags = DescriptorHeapFlags::kShaderVisible})
          .value();
  surface_targets[0] = colors.GetCPUDescriptorHandle(0);
  surface_targets[1] = colors.GetCPUDescriptorHandle(1);
  image_target = colors.GetCPUDescriptorHandle(2);
  depth_target = depths.GetCPUDescriptorHandle(0);
  device.CreateRenderTargetView(albedo, surface_targets[0]).value();
  device.CreateRenderTargetView(normals, surface_targets[1]).value();
  device.CreateRenderTargetView(image, image_target).value();
  device.CreateDepthStencilView(depth, {.Format = Format::kD32Float}, depth_target).value();
  const Texture* read[] = {&albedo, &normals, &depth, &sunlight};
  const Format formats[] = {Format::kR8G8B8A8Unorm, Format::kR16G16B16A16Float, Format::kR32Float,
                            Format::kR8Unorm};
  for (uint32_t i = 0; i < 4; ++i) {
    ShaderResourceViewDesc view;
    view.Format = formats[i];
    view.ViewDimension = SrvDimension::kTexture2D;
    device.CreateShaderResourceView(*read[i], view, views.GetCPUDescriptorHandle(i)).value();
  }
  device.CreateUnorderedAccessView(sunlight, views.GetCPUDescriptorHandle(4)).value();
}

std::vector<InputElementDesc> Layout() {
  std::vector<InputElementDesc> layout = {
      {.SemanticName = "CORNER", .Format = Format::kR32G32B32Float}};
  for (uint32_t row = 0; row < 3; ++row) {
    layout.push_back({.SemanticName = "TRANSFORM",
                      .SemanticIndex = row,
                      .Format = Format::kR32G32B32A32Float,
                      .InputSlot = 1,
                      .InputSlotClass = InputClassification::kPerInstanceData,
                      .InstanceDataStepRate = 1});
  }
  return layout;
}

Texture Render(const example::Setup& setup) {
  const Device& device = setup.device;
  const Frame frame(setup);

  // The same cube and the same transforms for rays and for draws.
  const example::Mesh cube = example::CreateMesh(setup, kCube, kSides);
  const Buffer bottom_level =
      BuildBottomLevel(setup.device, setup.queue, {cube.geometry}, "bottom level").value();
  std::vector<RaytracingInstanceDesc> instances;
  std::vector<float> colors;
  for (const Box& box : kBoxes) {
    instances.push_back(InstanceOf(box, bottom_level));
    colors.insert(colors.end(), box.color, box.color + 3);
  }
  const Buffer top_level = BuildTopLevel(setup.device, setup.queue, instances, "top level").value();
  const Buffer transforms = CreateUploadBuffer(device, instances, "instances").value();
  const Buffer box_colors = CreateUploadBuffer(device, colors, "box colors").value();
  const std::vector<VertexBufferView> vertices = {
      {cube.vertices.GetGPUVirtualAddress(), static_cast<uint32_t>(cube.vertices.size()),
       3 * sizeof(float)},
      {transforms.GetGPUVirtualAddress(), static_cast<uint32_t>(transforms.size()),
       sizeof(RaytracingInstanceDesc)}};
  const IndexBufferView indices = {cube.indices.GetGPUVirtualAddress(),
                                   static_cast<uint32_t>(cube.indices.size()), Format::kR32Uint};

  const RootSignature root_signature =
      device
          .CreateRootSignature(
              "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT),"
              "RootConstants(num32BitConstants = 2, b0), SRV(t0), SRV(t1),"
              "DescriptorTable(SRV(t0, space = 1, numDescriptors = 4), UAV(u0, space = 1))")
          .value();
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_hybrid()).value();

  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_signature;
  desc.VS = {library, "SeenFromEye"};
  desc.PS = {library, "StoreSurface"};
  desc.InputLayout = Layout();
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kGreater;
  desc.RTVFormats = {Format::kR8G8B8A8Unorm, Format::kR16G16B16A16Float};
  desc.DSVFormat = Format::kD32Float;
  desc.Name = "G-buffer";
  const PipelineState surface_pipeline = device.CreateGraphicsPipelineState(desc).value();

  StateObjectDesc rays;
  rays.Add(DxilLibraryDesc{library, {{"TraceSun"}, {"SunIsSeen"}}});
  rays.Add(HitGroupDesc{.HitGroupExport = "Opaque"});
  rays.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  rays.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 1});
  rays.Add(GlobalRootSignature{root_signature});
  const StateObject sun_pipeline = device.CreateStateObject(rays).value();
  ShaderTable raygen_table(sun_pipeline), miss_table(sun_pipeline), hit_table(sun_pipeline);
  raygen_table.AddRecord("TraceSun").value();
  miss_table.AddRecord("SunIsSeen").value();
  hit_table.AddRecord("Opaque").value();
  for (ShaderTable* table : {&raygen_table, &miss_table, &hit_table}) {
    table->Build(device).value();
  }

  desc.VS = {library, "WholePicture"};
  desc.PS = {library, "Compose"};
  desc.InputLayout = {};
  desc.DepthStencilState.DepthEnable = false;
  desc.RTVFormats = {Format::kR8G8B8A8Unorm};
  desc.DSVFormat = Format::kUnknown;
  desc.Name = "compose";
  const PipelineState compose_pipeline = device.CreateGraphicsPipelineState(desc).value();

  struct Constants {
    uint32_t size[2];
  };
  const Constants constants = {{setup.width, setup.height}};
  const float black[4] = {0, 0, 0, 0};
  const Viewport viewport = {
      0, 0, static_cast<float>(setup.width), static_cast<float>(setup.height), 0, 1};
  const Rect scissor = {0, 0, static_cast<int32_t>(setup.width),
                        static_cast<int32_t>(setup.height)};

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({frame.views});
  list.SetGraphicsRootSignature(root_signature);
  list.SetGraphicsRoot32BitConstants(0, constants);
  list.SetGraphicsRootShaderResourceView(1, top_level.GetGPUVirtualAddress());
  list.SetGraphicsRootShaderResourceView(2, box_colors.GetGPUVirtualAddress());
  list.SetGraphicsRootDescriptorTable(3, frame.views.GetGPUDescriptorHandleForHeapStart());
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.IASetVertexBuffers(0, vertices);
  list.IASetIndexBuffer(&indices);
  list.RSSetViewports(viewport);
  list.RSSetScissorRects(scissor);

  list.ClearRenderTargetView(frame.surface_targets[0], black);
  list.ClearRenderTargetView(frame.surface_targets[1], black);
  list.ClearDepthStencilView(frame.depth_target, ClearFlags::kDepth, 0, 0);
  list.OMSetRenderTargets(2, frame.surface_targets, false, &frame.depth_target);
  list.SetPipelineState(surface_pipeline);
  list.DrawIndexedInstanced(static_cast<uint32_t>(kSides.size()),
                            static_cast<uint32_t>(kBoxes.size()), 0, 0, 0);

  // Both kinds of shaders read what was drawn.
  const auto readable = ResourceStates::kAllShaderResource;
  list.ResourceBarrier(
      {ResourceBarrier::Transition(frame.albedo, ResourceStates::kRenderTarget, readable),
       ResourceBarrier::Transition(frame.normals, ResourceStates::kRenderTarget, readable),
       ResourceBarrier::Transition(frame.depth, ResourceStates::kDepthWrite, readable)});
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRoot32BitConstants(0, constants);
  list.SetComputeRootShaderResourceView(1, top_level.GetGPUVirtualAddress());
  list.SetComputeRootShaderResourceView(2, box_colors.GetGPUVirtualAddress());
  list.SetComputeRootDescriptorTable(3, frame.views.GetGPUDescriptorHandleForHeapStart());
  list.SetPipelineState1(sun_pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen_table.GetRecord(0),
                     .MissShaderTable = miss_table.GetTable(),
                     .HitGroupTable = hit_table.GetTable(),
                     .Width = setup.width,
                     .Height = setup.height});

  list.ResourceBarrier(ResourceBarrier::Transition(frame.sunlight, ResourceStates::kUnorderedAccess,
                                                   ResourceStates::kPixelShaderResource));
  list.OMSetRenderTargets(1, &frame.image_target);
  list.SetPipelineState(compose_pipeline);
  list.DrawInstanced(3, 1, 0, 0);
  setup.queue.ExecuteAndWait(list).value();
  return frame.image;
}

}  // namespace

int main(int argc, char** argv) {
  return example::Main(argc, argv, "13-hybrid", Render);
}
