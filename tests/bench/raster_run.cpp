// SPDX-License-Identifier: MIT
#include "raster_run.h"

#include <rtapi/upload.h>
#include <shaders/raster.h>

#include <cstddef>
#include <cstring>

namespace kaamos::bench {
namespace {

using namespace rtapi;

std::vector<Format> formats_of(RasterPass pass) {
  if (pass == RasterPass::kShadow) return {};
  if (pass == RasterPass::kIds) return {Format::kR32Uint};
  return {Format::kR8G8B8A8UnormSrgb, Format::kR16G16B16A16Float, Format::kR8G8B8A8Unorm,
          Format::kR16G16Float, Format::kR32Uint};
}

Device open_device(const std::string& backend, uint32_t threads) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Threads = threads;
  return CreateDevice(desc).value();
}

}  // namespace

RasterRun::RasterRun(const RasterScene& scene, const std::string& backend, uint32_t threads)
    : scene_(scene),
      device_(open_device(backend, threads)),
      queue_(device_.CreateCommandQueue().value()),
      vertices_(CreateUploadBuffer(device_, scene.positions, "vertices").value()),
      indices_(CreateUploadBuffer(device_, scene.indices, "indices").value()) {
  create_targets();
  create_pipeline();
  record();
}

void RasterRun::create_targets() {
  TextureDesc desc;
  desc.Width = scene_.width;
  desc.Height = scene_.height;
  desc.Format = Format::kR32Typeless;
  desc.Flags = ResourceFlags::kAllowDepthStencil;
  desc.InitialState = ResourceStates::kDepthWrite;
  desc.Name = "depth";
  depth_ = device_.CreateTexture(desc).value();
  dsvs_ =
      device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1}).value();
  device_.CreateDepthStencilView(depth_, dsvs_.GetCPUDescriptorHandle(0)).value();
  if (scene_.pass == RasterPass::kShadow) return;
  const std::vector<Format> formats = formats_of(scene_.pass);
  const auto count = static_cast<uint32_t>(formats.size());
  rtvs_ = device_.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = count})
              .value();
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = ResourceStates::kRenderTarget;
  for (uint32_t i = 0; i < count; ++i) {
    desc.Format = formats[i];
    desc.Name = "target " + std::to_string(i);
    colors_.push_back(device_.CreateTexture(desc).value());
    device_.CreateRenderTargetView(colors_[i], rtvs_.GetCPUDescriptorHandle(i)).value();
  }
}

void RasterRun::create_pipeline() {
  root_ = device_
              .CreateRootSignature(
                  "RootFlags(ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT), "
                  "RootConstants(num32BitConstants=29, b0)")
              .value();
  static_assert(sizeof(RasterConstants) == 29 * 4);
  const ShaderLibrary library = LoadShaderLibrary(kaamos_shaders_raster()).value();
  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_;
  desc.InputLayout = {{.SemanticName = "POSITION", .Format = Format::kR32G32B32Float}};
  desc.RasterizerState.CullMode = CullMode::kNone;
  desc.DSVFormat = Format::kD32Float;
  const bool is_gbuffer = scene_.pass == RasterPass::kGBuffer;
  desc.VS = {library, is_gbuffer ? "GBufferVertex" : "DepthVertex"};
  if (scene_.pass != RasterPass::kShadow) {
    desc.PS = {library, is_gbuffer ? "GBufferPixel" : "IdPixel"};
    desc.DepthStencilState.DepthFunc = ComparisonFunc::kGreater;
    desc.RTVFormats = formats_of(scene_.pass);
  }
  pipeline_ = device_.CreateGraphicsPipelineState(desc).value();
}

void RasterRun::record() {
  list_ = device_.CreateCommandList().value();
  const CpuDescriptorHandle dsv = dsvs_.GetCPUDescriptorHandle(0);
  list_.ClearDepthStencilView(dsv, ClearFlags::kDepth, scene_.cleared_depth(), 0);
  std::vector<CpuDescriptorHandle> rtvs;
  const float black[4] = {0, 0, 0, 0};
  for (uint32_t i = 0; i < colors_.size(); ++i) {
    rtvs.push_back(rtvs_.GetCPUDescriptorHandle(i));
    list_.ClearRenderTargetView(rtvs[i], black);
  }
  list_.SetGraphicsRootSignature(root_);
  list_.SetPipelineState(pipeline_);
  list_.SetGraphicsRoot32BitConstants(0, scene_.constants);
  list_.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list_.IASetVertexBuffers(
      0, {vertices_.GetGPUVirtualAddress(), static_cast<uint32_t>(vertices_.size()), 12});
  const IndexBufferView indices{indices_.GetGPUVirtualAddress(),
                                static_cast<uint32_t>(indices_.size()), Format::kR32Uint};
  list_.IASetIndexBuffer(&indices);
  list_.RSSetViewports(
      Viewport{0, 0, static_cast<float>(scene_.width), static_cast<float>(scene_.height), 0, 1});
  list_.RSSetScissorRects(
      Rect{0, 0, static_cast<int32_t>(scene_.width), static_cast<int32_t>(scene_.height)});
  list_.OMSetRenderTargets(static_cast<uint32_t>(rtvs.size()), rtvs.data(), false, &dsv);
  const uint32_t triangles = scene_.triangles_per_draw();
  for (uint32_t draw = 0; draw < scene_.draws; ++draw) {
    list_.SetGraphicsRoot32BitConstant(0, draw * triangles,
                                       offsetof(RasterConstants, first_triangle) / 4);
    list_.DrawIndexedInstanced(3 * triangles, 1, draw * 3 * triangles, 0, 0);
  }
  list_.Close().value();
}

void RasterRun::run() {
  queue_.ExecuteAndWait(list_).value();
}

RasterPictures RasterRun::pictures() {
  RasterPictures pictures;
  const std::vector<std::byte> depth = ReadbackTexture(device_, queue_, depth_, 0).value();
  pictures.depth.resize(depth.size() / sizeof(float));
  std::memcpy(pictures.depth.data(), depth.data(), depth.size());
  for (const Texture& color : colors_) {
    pictures.colors.push_back(ReadbackTexture(device_, queue_, color, 0).value());
  }
  return pictures;
}

}  // namespace kaamos::bench
