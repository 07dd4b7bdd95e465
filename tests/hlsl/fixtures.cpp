// SPDX-License-Identifier: MIT
#include "fixtures.h"

#include <kaamos/shader/abi.h>
#include <rtapi/rtapi.h>

#include <cstring>

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kResultBytes = 65536;

// The root signature that a library's bindings ask for, and what stands behind each parameter.
struct Fixture {
  Device device;
  CommandQueue queue;
  RootSignatureDesc desc;
  Buffer results;
  std::vector<Buffer> buffers;  // one per root descriptor, in order
  std::vector<std::pair<uint32_t, const shader::BindingDesc*>> tables;  // parameter, binding
  DescriptorHeap heap;
  std::vector<Texture> textures;
};

bool is_results(const shader::BindingDesc& binding) {
  return binding.register_class == shader::RegisterClass::kUnorderedAccess &&
         binding.register_index == 0 && binding.space == 0;
}

Buffer counting_buffer(Fixture& f, ResourceFlags flags) {
  std::vector<uint32_t> words(256);
  for (uint32_t i = 0; i < words.size(); ++i) words[i] = i;
  if (flags == ResourceFlags::kNone) return CreateUploadBuffer(f.device, words).value();
  return CreateDefaultBuffer(f.device, f.queue, std::as_bytes(std::span(words)), flags).value();
}

void add_sampler(Fixture& f, const shader::BindingDesc& binding) {
  StaticSamplerDesc sampler;
  const bool comparison = binding.type == shader::BindingType::kComparisonSampler;
  sampler.Filter = comparison ? Filter::kComparisonMinMagMipPoint : Filter::kMinMagMipPoint;
  sampler.AddressU = sampler.AddressV = sampler.AddressW = TextureAddressMode::kClamp;
  sampler.ComparisonFunc = comparison ? ComparisonFunc::kLess : ComparisonFunc::kNever;
  sampler.ShaderRegister = binding.register_index;
  sampler.RegisterSpace = binding.space;
  f.desc.StaticSamplers.push_back(sampler);
}

void add_binding(Fixture& f, const shader::BindingDesc& b) {
  const bool writable = b.register_class == shader::RegisterClass::kUnorderedAccess;
  if (b.register_class == shader::RegisterClass::kSampler) {
    add_sampler(f, b);
  } else if (b.type == shader::BindingType::kConstantBuffer && b.count == 1) {
    f.desc.Parameters.push_back(RootParameter::Cbv(b.register_index, b.space));
    f.buffers.push_back(counting_buffer(f, ResourceFlags::kNone));
  } else if ((b.type == shader::BindingType::kRawBuffer ||
              b.type == shader::BindingType::kStructuredBuffer) &&
             b.count == 1) {
    f.desc.Parameters.push_back(writable ? RootParameter::Uav(b.register_index, b.space)
                                         : RootParameter::Srv(b.register_index, b.space));
    f.buffers.push_back(is_results(b) ? f.results
                        : writable    ? counting_buffer(f, ResourceFlags::kAllowUnorderedAccess)
                                      : counting_buffer(f, ResourceFlags::kNone));
  } else {
    DescriptorRange range;
    range.RangeType = writable ? DescriptorRangeType::kUav : DescriptorRangeType::kSrv;
    if (b.register_class == shader::RegisterClass::kConstantBuffer) {
      range.RangeType = DescriptorRangeType::kCbv;
    }
    range.NumDescriptors = b.count;
    range.BaseShaderRegister = b.register_index;
    range.RegisterSpace = b.space;
    f.tables.emplace_back(static_cast<uint32_t>(f.desc.Parameters.size()), &b);
    f.desc.Parameters.push_back(RootParameter::Table({range}));
    f.buffers.emplace_back();
  }
}

Texture counting_texture(Fixture& f, Format format, ResourceFlags flags) {
  TextureDesc desc;
  desc.Width = 8;
  desc.Height = 8;
  desc.MipLevels = 2;
  desc.DepthOrArraySize = 2;
  desc.Format = format;
  desc.Flags = flags;
  const Texture texture = f.device.CreateTexture(desc).value();
  for (uint32_t element = 0; element < 2; ++element) {
    for (uint32_t mip = 0; mip < 2; ++mip) {
      const uint32_t side = 8u >> mip;
      std::vector<float> texels;
      for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
          for (const uint32_t v : {x, y, mip, element}) texels.push_back(static_cast<float>(v));
        }
      }
      UploadTexture(f.device, f.queue, texture, mip + element * 2, std::as_bytes(std::span(texels)))
          .value();
    }
  }
  f.textures.push_back(texture);
  return texture;
}

// Descriptors of one table: an array of constant buffers, typed buffers, or 2D textures.
void fill_table(Fixture& f, const shader::BindingDesc& b, uint32_t first, uint32_t count) {
  const bool writable = b.register_class == shader::RegisterClass::kUnorderedAccess;
  const auto flags = writable ? ResourceFlags::kAllowUnorderedAccess : ResourceFlags::kNone;
  // A null acceleration structure: every ray misses it.
  if (b.type == shader::BindingType::kAccelerationStructure) return;
  for (uint32_t i = 0; i < count; ++i) {
    const CpuDescriptorHandle handle = f.heap.GetCPUDescriptorHandle(first + i);
    if (b.type == shader::BindingType::kTexture) {
      const Texture texture = counting_texture(f, Format::kR32G32B32A32Float, flags);
      if (writable) {
        UnorderedAccessViewDesc view;
        view.Format = Format::kR32G32B32A32Float;
        view.ViewDimension = UavDimension::kTexture2D;
        f.device.CreateUnorderedAccessView(texture, view, handle).value();
      } else {
        ShaderResourceViewDesc view;
        view.Format = Format::kR32G32B32A32Float;
        view.ViewDimension = SrvDimension::kTexture2D;
        f.device.CreateShaderResourceView(texture, view, handle).value();
      }
      continue;
    }
    const Buffer buffer = counting_buffer(f, flags);
    f.buffers.push_back(buffer);
    if (b.type == shader::BindingType::kConstantBuffer) {
      f.device.CreateConstantBufferView({buffer.GetGPUVirtualAddress(), 1024}, handle).value();
    } else if (writable) {
      UnorderedAccessViewDesc view;
      view.ViewDimension = UavDimension::kBuffer;
      view.Format = b.type == shader::BindingType::kTypedBuffer ? Format::kR32Uint
                    : b.type == shader::BindingType::kRawBuffer ? Format::kR32Typeless
                                                                : Format::kUnknown;
      view.Buffer.Flags =
          b.type == shader::BindingType::kRawBuffer ? BufferUavFlags::kRaw : BufferUavFlags::kNone;
      view.Buffer.StructureByteStride =
          b.type == shader::BindingType::kStructuredBuffer ? b.size_bytes : 0;
      f.device.CreateUnorderedAccessView(buffer, view, handle).value();
    } else {
      ShaderResourceViewDesc view;
      view.ViewDimension = SrvDimension::kBuffer;
      view.Format = b.type == shader::BindingType::kTypedBuffer ? Format::kR32Uint
                    : b.type == shader::BindingType::kRawBuffer ? Format::kR32Typeless
                                                                : Format::kUnknown;
      view.Buffer.Flags =
          b.type == shader::BindingType::kRawBuffer ? BufferSrvFlags::kRaw : BufferSrvFlags::kNone;
      view.Buffer.StructureByteStride =
          b.type == shader::BindingType::kStructuredBuffer ? b.size_bytes : 0;
      f.device.CreateShaderResourceView(buffer, view, handle).value();
    }
  }
}

// Sets every root argument of the open list.
void bind(Fixture& f, CommandList& list) {
  constexpr uint32_t kTableSlots = 8;  // of an unbounded array
  if (!f.tables.empty()) {
    f.heap = f.device
                 .CreateDescriptorHeap(
                     {.NumDescriptors = kTableSlots * static_cast<uint32_t>(f.tables.size()),
                      .Flags = DescriptorHeapFlags::kShaderVisible})
                 .value();
    list.SetDescriptorHeaps({f.heap});
  }
  for (uint32_t i = 0; i < f.tables.size(); ++i) {
    const auto& [parameter, binding] = f.tables[i];
    fill_table(f, *binding, i * kTableSlots, std::min(binding->count, kTableSlots));
    list.SetComputeRootDescriptorTable(parameter, f.heap.GetGPUDescriptorHandle(i * kTableSlots));
  }
  for (uint32_t i = 0; i < f.desc.Parameters.size(); ++i) {
    const GpuVirtualAddress address = f.buffers[i].GetGPUVirtualAddress();
    switch (f.desc.Parameters[i].ParameterType) {
      case RootParameterType::kCbv:
        list.SetComputeRootConstantBufferView(i, address);
        break;
      case RootParameterType::kSrv:
        list.SetComputeRootShaderResourceView(i, address);
        break;
      case RootParameterType::kUav:
        list.SetComputeRootUnorderedAccessView(i, address);
        break;
      default:
        break;
    }
  }
}

void dispatch_rays(Fixture& f, const ShaderLibrary& library, const RootSignature& root,
                   CommandList& list) {
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library, {}});
  desc.Add(RaytracingShaderConfig{64, 32});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{root});
  const StateObject pipeline = f.device.CreateStateObject(desc).value();
  std::string miss_name;
  std::string raygen_name;
  std::string callable_name;
  for (const ShaderExportInfo& e : library.GetExports()) {
    if (e.Stage == ShaderStage::kRayGeneration) raygen_name = e.Name;
    if (e.Stage == ShaderStage::kMiss) miss_name = e.Name;
    if (e.Stage == ShaderStage::kCallable) callable_name = e.Name;
  }
  ShaderTable raygen(pipeline), miss(pipeline), callable(pipeline);
  raygen.AddRecord(raygen_name).value();
  raygen.Build(f.device).value();
  DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = raygen.GetRecord(0);
  if (!miss_name.empty()) {
    miss.AddRecord(miss_name).value();
    miss.Build(f.device).value();
    dispatch.MissShaderTable = miss.GetTable();
  }
  if (!callable_name.empty()) {
    callable.AddRecord(callable_name).value();
    callable.Build(f.device).value();
    dispatch.CallableShaderTable = callable.GetTable();
  }
  list.SetPipelineState1(pipeline);
  list.DispatchRays(dispatch);
  f.queue.ExecuteAndWait(list).value();
}

std::vector<std::byte> run(const shader::LibraryDesc& library_desc) {
  Fixture f;
  DeviceDesc device_desc;
  device_desc.Threads = 1;
  f.device = CreateDevice(device_desc).value();
  f.queue = f.device.CreateCommandQueue().value();
  f.results = f.device
                  .CreateBuffer({.SizeInBytes = kResultBytes,
                                 .Flags = ResourceFlags::kAllowUnorderedAccess,
                                 .Name = "results"})
                  .value();
  for (uint32_t i = 0; i < library_desc.binding_count; ++i) {
    add_binding(f, library_desc.bindings[i]);
  }
  f.desc.Flags = RootSignatureFlags::kCbvSrvUavHeapDirectlyIndexed |
                 RootSignatureFlags::kSamplerHeapDirectlyIndexed;
  const RootSignature root = f.device.CreateRootSignature(f.desc).value();
  const ShaderLibrary library = LoadShaderLibrary(&library_desc).value();
  CommandList list = f.device.CreateCommandList().value();
  list.SetComputeRootSignature(root);
  bind(f, list);
  bool compute = false;
  for (const ShaderExportInfo& e : library.GetExports()) {
    compute = compute || e.Stage == ShaderStage::kCompute;
  }
  if (compute) {
    list.SetPipelineState(f.device.CreateComputePipelineState({root, library, "", ""}).value());
    list.Dispatch(1, 1, 1);
    f.queue.ExecuteAndWait(list).value();
  } else {
    dispatch_rays(f, library, root, list);
  }
  return ReadbackBuffer(f.device, f.queue, f.results).value();
}

}  // namespace

std::vector<std::byte> run_on_device(const shader::LibraryDesc& library, std::string& error) {
  try {
    return run(library);
  } catch (const ResultError& failure) {
    error = failure.what();
    return {};
  }
}

}  // namespace kaamos::test
