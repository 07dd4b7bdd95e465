// SPDX-License-Identifier: MIT
#include "fixtures.h"

#include <kaamos/shader/abi.h>
#include <rtapi/error_ids.h>
#include <rtapi/rtapi.h>

#include <algorithm>

#include "scene.h"
#include "views.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kResultBytes = 65536;
constexpr uint32_t kTableSlots = 8;    // in each table, also for an unbounded array
constexpr uint32_t kHeapSlots = 4;     // of ResourceDescriptorHeap
constexpr uint32_t kSamplerSlots = 2;  // of SamplerDescriptorHeap

// The root signature that a library's bindings need, and the resources behind its parameters.
struct Fixture {
  Fixture(const Device& device, const shader::LibraryDesc& library);

  Device device;
  CommandQueue queue;
  ShaderLibrary library;
  CountingResources resources;
  RootSignatureDesc desc;
  Buffer results;
  Scene scene;
  std::vector<Buffer> buffers;  // one per root descriptor, in order
  std::vector<std::pair<uint32_t, const shader::BindingDesc*>> tables;  // parameter, binding
  DescriptorHeap heap;
  DescriptorHeap sampler_heap;
};

Device single_threaded_device(const std::string& backend, std::vector<std::string>* told,
                              uint32_t wave_lanes) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Threads = 1;
  desc.WaveLanes = wave_lanes;
  desc.ShaderModel = kExperimentalShaderModel;
  if (told != nullptr) {
    desc.Checked = true;
    desc.OnMessage = [told](const Message& message) {
      const bool of_compiling = message.Id == error_ids::checked::kCodeNotChecked ||
                                message.Id == error_ids::checked::kCodeInterpreted;
      if (message.Severity != MessageSeverity::kInfo && !of_compiling) {
        told->push_back(message.Text);
      }
    };
  }
  return CreateDevice(desc).value();
}

Fixture::Fixture(const Device& on, const shader::LibraryDesc& library_desc)
    : device(on),
      queue(device.CreateCommandQueue().value()),
      library(LoadShaderLibrary(&library_desc).value()),
      resources(device, queue) {
  results = device
                .CreateBuffer({.SizeInBytes = kResultBytes,
                               .Flags = ResourceFlags::kAllowUnorderedAccess,
                               .Name = "results"})
                .value();
}

bool is_results(const shader::BindingDesc& binding) {
  return binding.register_class == shader::RegisterClass::kUnorderedAccess &&
         binding.register_index == 0 && binding.space == 0;
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

void add_table(Fixture& f, const shader::BindingDesc& b) {
  DescriptorRange range;
  range.RangeType =
      b.register_class == shader::RegisterClass::kUnorderedAccess  ? DescriptorRangeType::kUav
      : b.register_class == shader::RegisterClass::kConstantBuffer ? DescriptorRangeType::kCbv
                                                                   : DescriptorRangeType::kSrv;
  range.NumDescriptors = b.count;
  range.BaseShaderRegister = b.register_index;
  range.RegisterSpace = b.space;
  f.tables.emplace_back(static_cast<uint32_t>(f.desc.Parameters.size()), &b);
  f.desc.Parameters.push_back(RootParameter::Table({range}));
  f.buffers.emplace_back();
}

// Root descriptors have no counters.
bool has_counter(const shader::BindingDesc& binding) {
  return std::string_view(binding.name).find("counted") != std::string_view::npos;
}

void add_binding(Fixture& f, const shader::BindingDesc& b) {
  const bool writable = b.register_class == shader::RegisterClass::kUnorderedAccess;
  if (b.register_class == shader::RegisterClass::kSampler) {
    add_sampler(f, b);
  } else if (b.type == shader::BindingType::kConstantBuffer && b.count == 1) {
    f.desc.Parameters.push_back(RootParameter::Cbv(b.register_index, b.space));
    f.buffers.push_back(f.resources.buffer(false));
  } else if (b.type == shader::BindingType::kAccelerationStructure && b.count == 1) {
    if (!f.scene.top_level) f.scene = build_scene(f.device, f.queue, f.library);
    f.desc.Parameters.push_back(RootParameter::Srv(b.register_index, b.space));
    f.buffers.push_back(f.scene.top_level);
  } else if ((b.type == shader::BindingType::kRawBuffer ||
              b.type == shader::BindingType::kStructuredBuffer) &&
             b.count == 1 && !has_counter(b)) {
    f.desc.Parameters.push_back(writable ? RootParameter::Uav(b.register_index, b.space)
                                         : RootParameter::Srv(b.register_index, b.space));
    f.buffers.push_back(is_results(b) ? f.results : f.resources.buffer(writable));
  } else {
    add_table(f, b);
  }
}

// The slots of ResourceDescriptorHeap come first, followed by those of the tables.
void set_heaps(Fixture& f, CommandList& list) {
  const auto tables = static_cast<uint32_t>(f.tables.size());
  const auto heap = [&f](DescriptorHeapType type, uint32_t slots) {
    return f.device.CreateDescriptorHeap({type, slots, DescriptorHeapFlags::kShaderVisible, "test"})
        .value();
  };
  f.heap = heap(DescriptorHeapType::kCbvSrvUav, kHeapSlots + kTableSlots * tables);
  f.sampler_heap = heap(DescriptorHeapType::kSampler, kSamplerSlots);
  f.resources.fill_view_heap(f.heap, f.results);
  f.resources.fill_sampler_heap(f.sampler_heap);
  list.SetDescriptorHeaps({f.heap, f.sampler_heap});
}

// Sets every root argument on the open list.
void bind(Fixture& f, CommandList& list) {
  for (uint32_t i = 0; i < f.tables.size(); ++i) {
    const auto& [parameter, binding] = f.tables[i];
    const uint32_t first = kHeapSlots + i * kTableSlots;
    f.resources.fill_table(*binding, f.heap, first, std::min(binding->count, kTableSlots));
    list.SetComputeRootDescriptorTable(parameter, f.heap.GetGPUDescriptorHandle(first));
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

std::vector<std::byte> run(const Device& device, const shader::LibraryDesc& library_desc,
                           const uint32_t (&size)[3]) {
  Fixture f(device, library_desc);
  for (uint32_t i = 0; i < library_desc.binding_count; ++i) {
    add_binding(f, library_desc.bindings[i]);
  }
  uint32_t flags = 0;
  bool compute = false;
  for (uint32_t i = 0; i < library_desc.export_count; ++i) {
    flags |= library_desc.exports[i].flags;
    compute = compute || library_desc.exports[i].stage == shader::Stage::kCompute;
  }
  if ((flags & shader::kExportUsesViewHeap) != 0) {
    f.desc.Flags = f.desc.Flags | RootSignatureFlags::kCbvSrvUavHeapDirectlyIndexed;
  }
  if ((flags & shader::kExportUsesSamplerHeap) != 0) {
    f.desc.Flags = f.desc.Flags | RootSignatureFlags::kSamplerHeapDirectlyIndexed;
  }
  const RootSignature root = f.device.CreateRootSignature(f.desc).value();
  CommandList list = f.device.CreateCommandList().value();
  set_heaps(f, list);
  list.SetComputeRootSignature(root);
  bind(f, list);
  if (compute) {
    list.SetPipelineState(f.device.CreateComputePipelineState({root, f.library, "", ""}).value());
    list.Dispatch(size[0], size[1], size[2]);
    f.queue.ExecuteAndWait(list).value();
  } else {
    dispatch_rays(f.device, f.queue, f.library, root, list, size);
  }
  return ReadbackBuffer(f.device, f.queue, f.results).value();
}

}  // namespace

hlsl::Result<std::vector<std::byte>> run_on_device(const std::string& backend,
                                                   const shader::LibraryDesc& library,
                                                   const uint32_t (&size)[3],
                                                   std::vector<std::string>* told,
                                                   uint32_t wave_lanes) {
  try {
    return run(single_threaded_device(backend, told, wave_lanes), library, size);
  } catch (const ResultError& failure) {
    return hlsl::Failure{failure.what()};
  }
}

}  // namespace kaamos::test
