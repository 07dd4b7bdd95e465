// SPDX-License-Identifier: MIT
// Dispatches squares.hlsl with an installed Kaamos and checks every number that it wrote. Before
// that, it compiles another shader by itself.
#include <rtapi/error_ids.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <shaders/squares.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr uint32_t kCount = 1000;

std::vector<uint32_t> RunSquares() {
  const rtapi::Device device = rtapi::CreateDevice().value();
  rtapi::CommandQueue queue = device.CreateCommandQueue().value();
  const rtapi::Buffer result =
      device
          .CreateBuffer({.SizeInBytes = kCount * sizeof(uint32_t),
                         .Flags = rtapi::ResourceFlags::kAllowUnorderedAccess,
                         .Name = "squares"})
          .value();
  const rtapi::RootSignature root_signature =
      device.CreateRootSignature({.Parameters = {rtapi::RootParameter::Uav(0)}}).value();

  rtapi::StateObjectDesc desc;
  desc.Add(rtapi::DxilLibraryDesc{rtapi::LoadShaderLibrary(kaamos_shaders_squares()).value(), {}});
  desc.Add(rtapi::RaytracingShaderConfig{.MaxPayloadSizeInBytes = 4});
  desc.Add(rtapi::RaytracingPipelineConfig{.MaxTraceRecursionDepth = 0});
  desc.Add(rtapi::GlobalRootSignature{root_signature});
  const rtapi::StateObject pipeline = device.CreateStateObject(desc).value();

  rtapi::ShaderTable table(pipeline, "ray generation table");
  table.AddRecord("Squares").value();
  table.Build(device).value();

  rtapi::CommandList list = device.CreateCommandList().value();
  list.SetComputeRootSignature(root_signature);
  list.SetComputeRootUnorderedAccessView(0, result.GetGPUVirtualAddress());
  list.SetPipelineState1(pipeline);
  rtapi::DispatchRaysDesc dispatch;
  dispatch.RayGenerationShaderRecord = table.GetRecord(0);
  dispatch.Width = kCount;
  dispatch.Height = 1;
  list.DispatchRays(dispatch);
  queue.ExecuteAndWait(list).value();

  const std::vector<std::byte> bytes = rtapi::ReadbackBuffer(device, queue, result).value();
  std::vector<uint32_t> numbers(bytes.size() / sizeof(uint32_t));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(uint32_t));
  return numbers;
}

// Compiles a library at run time, with the machine's C++ compiler.
bool CompilesShaders() {
  rtapi::ShaderCompileOptions options;
  options.File = "one.hlsl";
  options.Source =
      "RWByteAddressBuffer results : register(u0);\n"
      "[shader(\"raygeneration\")] void One() { results.Store(0, 1); }\n";
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  if (compiled.Status.ok() && compiled.Library.FindExport("One") != nullptr) return true;
  std::fprintf(stderr, "%s\n",
               compiled.Status.ok() ? "no One" : compiled.Status.error().message.c_str());
  return false;
}

// An error has the id that <rtapi/error_ids.h> names.
bool ErrorsHaveNames() {
  const auto device = rtapi::CreateDevice({.Backend = "none"});
  if (!device && device.error().id == rtapi::error_ids::api::kUnknownBackend) return true;
  std::fprintf(stderr, "%s\n", device ? "a device" : device.error().message.c_str());
  return false;
}

// The library, its headers and its package are of one installation.
bool VersionsAgree() {
  const std::string headers = std::to_string(rtapi::kVersionMajor) + "." +
                              std::to_string(rtapi::kVersionMinor) + "." +
                              std::to_string(rtapi::kVersionPatch);
  if (headers == rtapi::GetVersion() && headers == KAAMOS_PACKAGE_VERSION) return true;
  std::fprintf(stderr, "library %s, headers %s, package %s\n", rtapi::GetVersion(), headers.c_str(),
               KAAMOS_PACKAGE_VERSION);
  return false;
}

}  // namespace

int main() try {
  if (!VersionsAgree() || !ErrorsHaveNames() || !CompilesShaders()) return 1;
  const std::vector<uint32_t> numbers = RunSquares();
  for (uint32_t i = 0; i < kCount; ++i) {
    if (numbers.at(i) != i * i) {
      std::fprintf(stderr, "number %u is %u, not %u\n", i, numbers[i], i * i);
      return 1;
    }
  }
  std::printf("%u squares are right\n", kCount);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
