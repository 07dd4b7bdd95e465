// SPDX-License-Identifier: MIT
// Compiles probe.hlsl, or another file for a given target, for a debugger, and sends one ray
// through two triangles.
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>

#include <cstdio>
#include <cstring>

#include "../../examples/common/example.h"

using namespace rtapi;

static int Probe(const char* shader, const char* target) {
  example::Setup setup;
  DeviceDesc device_desc;
  device_desc.Threads = 1;
  device_desc.ShaderModel = kExperimentalShaderModel;
  setup.device = CreateDevice(device_desc).value();
  setup.queue = setup.device.CreateCommandQueue().value();
  const Device& device = setup.device;

  ShaderCompileOptions options;
  options.File = shader;
  options.Debug = true;
  options.Experimental = true;
  if (target != nullptr) options.Target = target;
  const ShaderCompilation compiled = CompileShaderLibrary(options);
  compiled.Status.value();

  const example::Mesh mesh =
      example::CreateMesh(setup, {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1}, {},
                          RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation);
  const Buffer bottom_level = BuildBottomLevel(setup.device, setup.queue, {mesh.geometry}).value();
  const Buffer top_level =
      BuildTopLevel(setup.device, setup.queue, {example::Instance(bottom_level, 0, 0, 0)}).value();
  const Buffer results =
      device.CreateBuffer({.SizeInBytes = 8, .Flags = ResourceFlags::kAllowUnorderedAccess})
          .value();

  const RootSignature root_signature = device.CreateRootSignature("SRV(t0), UAV(u0)").value();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{compiled.Library, {}});
  desc.Add(HitGroupDesc{.HitGroupExport = "Group", .AnyHitShaderImport = "ProbeAnyHit"});
  desc.Add(RaytracingShaderConfig{16, 8});
  desc.Add(RaytracingPipelineConfig{1});
  desc.Add(GlobalRootSignature{root_signature});
  const StateObject pipeline = device.CreateStateObject(desc).value();
  ShaderTable raygen(pipeline), miss(pipeline), hit(pipeline);
  raygen.AddRecord("ProbeRayGen").value();
  miss.AddRecord("ProbeMiss").value();
  hit.AddRecord("Group").value();
  for (ShaderTable* table : {&raygen, &miss, &hit}) {
    table->Build(device).value();
  }
  CommandList list = device.CreateCommandList().value();
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootShaderResourceView(0, top_level.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, results.GetGPUVirtualAddress());
  list.SetPipelineState1(pipeline);
  list.DispatchRays({.RayGenerationShaderRecord = raygen.GetRecord(0),
                     .MissShaderTable = miss.GetTable(),
                     .HitGroupTable = hit.GetTable()});
  setup.queue.ExecuteAndWait(list).value();
  const auto bytes = ReadbackBuffer(device, setup.queue, results).value();
  float transmittance = 0;
  uint32_t layers = 0;
  std::memcpy(&transmittance, bytes.data(), 4);
  std::memcpy(&layers, bytes.data() + 4, 4);
  std::printf("%g after %u layers\n", static_cast<double>(transmittance), layers);
  return 0;
}

int main(int argc, char** argv) {
  try {
    return argc == 2 || argc == 3 ? Probe(argv[1], argv[2]) : 2;
  } catch (const ResultError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
