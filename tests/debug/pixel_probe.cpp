// SPDX-License-Identifier: MIT
// Compiles pixel_probe.hlsl for a debugger and draws one triangle to 4 x 4 pixels.
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/upload.h>

#include <cstdio>
#include <cstring>

using namespace rtapi;

static int Probe(const char* shader) {
  constexpr uint32_t kSize = 4;
  DeviceDesc device_desc;
  device_desc.Backend = "embree";
  device_desc.Threads = 1;
  const Device device = CreateDevice(device_desc).value();
  CommandQueue queue = device.CreateCommandQueue().value();

  ShaderCompileOptions options;
  options.File = shader;
  options.Debug = true;
  const ShaderCompilation compiled = CompileShaderLibrary(options);
  compiled.Status.value();

  TextureDesc texture;
  texture.Width = kSize;
  texture.Height = kSize;
  texture.Format = Format::kR32G32B32A32Float;
  texture.Flags = ResourceFlags::kAllowRenderTarget;
  texture.InitialState = ResourceStates::kRenderTarget;
  const Texture target = device.CreateTexture(texture).value();
  const DescriptorHeap heap =
      device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1}).value();
  device.CreateRenderTargetView(target, heap.GetCPUDescriptorHandle(0)).value();

  GraphicsPipelineStateDesc desc;
  desc.pRootSignature = device.CreateRootSignature(RootSignatureDesc{}).value();
  desc.VS = {compiled.Library, "ProbeVertex"};
  desc.PS = {compiled.Library, "ProbePixel"};
  desc.DepthStencilState.DepthEnable = false;
  desc.RTVFormats = {texture.Format};
  const PipelineState pipeline = device.CreateGraphicsPipelineState(desc).value();

  CommandList list = device.CreateCommandList().value();
  list.SetGraphicsRootSignature(desc.pRootSignature);
  list.SetPipelineState(pipeline);
  list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
  list.RSSetViewports(Viewport{0, 0, kSize, kSize, 0, 1});
  list.RSSetScissorRects(Rect{0, 0, kSize, kSize});
  const CpuDescriptorHandle rtv = heap.GetCPUDescriptorHandle(0);
  list.OMSetRenderTargets(1, &rtv, false, nullptr);
  list.DrawInstanced(3, 1, 0, 0);
  queue.ExecuteAndWait(list).value();
  const auto bytes = ReadbackTexture(device, queue, target, 0).value();
  float pixel;  // (2, 1)
  std::memcpy(&pixel, bytes.data() + (1 * kSize + 2) * 16, sizeof pixel);
  std::printf("%g\n", static_cast<double>(pixel));
  return 0;
}

int main(int argc, char** argv) {
  try {
    return argc == 2 ? Probe(argv[1]) : 2;
  } catch (const ResultError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
