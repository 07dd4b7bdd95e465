// SPDX-License-Identifier: MIT
#include "tests/parity/sampled.h"

#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>
#include <shaders/sampled.h>

#include <array>
#include <cstring>

namespace kaamos::parity {

using namespace rtapi;

std::vector<float> sample_between_texels(const std::string& backend, uint32_t count) {
  DeviceDesc device_desc;
  device_desc.Backend = backend;
  const Device device = CreateDevice(device_desc).value();
  CommandQueue queue = device.CreateCommandQueue().value();
  TextureDesc texture_desc;
  texture_desc.Width = 2;
  texture_desc.Height = 1;
  texture_desc.Format = Format::kR8G8B8A8Unorm;
  const Texture texture = device.CreateTexture(texture_desc).value();
  std::array<std::byte, 8> texels = {};
  texels[4] = std::byte{255};
  UploadTexture(device, queue, texture, 0, texels).value();
  DescriptorHeapDesc heap_desc;
  heap_desc.NumDescriptors = 1;
  heap_desc.Flags = DescriptorHeapFlags::kShaderVisible;
  const DescriptorHeap heap = device.CreateDescriptorHeap(heap_desc).value();
  device.CreateShaderResourceView(texture, heap.GetCPUDescriptorHandle(0)).value();
  BufferDesc buffer_desc;
  buffer_desc.SizeInBytes = uint64_t{count} * 4;
  buffer_desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  buffer_desc.InitialState = ResourceStates::kUnorderedAccess;
  const Buffer values = device.CreateBuffer(buffer_desc).value();

  const RootSignature root =
      device
          .CreateRootSignature(
              "DescriptorTable(SRV(t0)), UAV(u0),"
              "StaticSampler(s0, filter = FILTER_MIN_MAG_MIP_LINEAR,"
              "addressU = TEXTURE_ADDRESS_CLAMP, addressV = TEXTURE_ADDRESS_CLAMP)")
          .value();
  StateObjectDesc desc;
  DxilLibraryDesc library;
  library.DXILLibrary = LoadShaderLibrary(kaamos_shaders_sampled()).value();
  desc.Add(library);
  desc.Add(RaytracingShaderConfig{4, 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{root});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable table(pipeline);
  table.AddRecord("Sample").value();
  table.Build(device).value();

  CommandList list = device.CreateCommandList().value();
  list.SetDescriptorHeaps({heap});
  list.SetComputeRootSignature(root);
  list.SetPipelineState1(pipeline);
  list.SetComputeRootDescriptorTable(0, heap.GetGPUDescriptorHandle(0));
  list.SetComputeRootUnorderedAccessView(1, values.GetGPUVirtualAddress());
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = table.GetRecord(0);
  dispatch.Width = count;
  dispatch.Height = 1;
  list.DispatchRays(dispatch);
  queue.ExecuteAndWait(list).value();
  const auto bytes = ReadbackBuffer(device, queue, values).value();
  std::vector<float> out(count);
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

}  // namespace kaamos::parity
