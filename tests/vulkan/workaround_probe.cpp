// SPDX-License-Identifier: MIT
//
// workaround_probe balance | payload: shows what workarounds B11 and PAYLOAD do. It is a process of
// its own because B11 is measured by the processor time of the driver's threads and PAYLOAD keeps
// the process alive. Exits with 0 and prints one line: the busiest thread's share of the work, or
// whether the traces returned.
#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>
#include <rtapi/upload.h>
#include <shaders/workaround_probe.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace {

using namespace rtapi;

class Probe {
 public:
  // `miss` may be null. Compiles only the shaders named: the driver takes minutes for NestDeeper's
  // payload on some CPUs.
  Probe(const char* ray_generation, const char* miss)
      : ray_generation_(ray_generation), miss_(miss) {
    DeviceDesc desc;
    desc.Backend = "vulkan";
    device_ = CreateDevice(desc).value();
    queue_ = device_.CreateCommandQueue().value();
    root_ = device_.CreateRootSignature("SRV(t0), UAV(u0), RootConstants(num32BitConstants=1, b0)")
                .value();
    BufferDesc results;
    results.SizeInBytes = uint64_t{kWidth} * kHeight * 4;
    results.Flags = ResourceFlags::kAllowUnorderedAccess;
    results.InitialState = ResourceStates::kUnorderedAccess;
    results_ = device_.CreateBuffer(results).value();
    StateObjectDesc state;
    DxilLibraryDesc library;
    library.DXILLibrary = LoadShaderLibrary(kaamos_shaders_workaround_probe()).value();
    library.Exports = {{ray_generation}};
    if (miss != nullptr) library.Exports.push_back({miss});
    state.Add(library);
    state.Add(RaytracingShaderConfig{4096, 8});
    state.Add(RaytracingPipelineConfig{31});
    state.Add(GlobalRootSignature{root_});
    pipeline_ = device_.CreateStateObject(state).value();
  }

  Status run(uint32_t count, uint32_t width, uint32_t height) {
    ShaderTable ray_generations(pipeline_);
    ray_generations.AddRecord(ray_generation_).value();
    ray_generations.Build(device_).value();
    ShaderTable misses(pipeline_);
    if (miss_ != nullptr) {
      misses.AddRecord(miss_).value();
      misses.Build(device_).value();
    }
    CommandList list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root_);
    list.SetPipelineState1(pipeline_);
    list.SetComputeRootShaderResourceView(0, 0);
    list.SetComputeRootUnorderedAccessView(1, results_.GetGPUVirtualAddress());
    list.SetComputeRoot32BitConstant(2, count, 0);
    DispatchRaysDesc dispatch;
    dispatch.RayGenerationShaderRecord = ray_generations.GetRecord(0);
    if (miss_ != nullptr) dispatch.MissShaderTable = misses.GetTable();
    dispatch.Width = width;
    dispatch.Height = height;
    list.DispatchRays(dispatch);
    return queue_.ExecuteAndWait(list);
  }

  uint32_t first_result() {
    const auto bytes = ReadbackBuffer(device_, queue_, results_).value();
    uint32_t value;
    std::memcpy(&value, bytes.data(), sizeof(value));
    return value;
  }

  static constexpr uint32_t kWidth = 64;
  static constexpr uint32_t kHeight = 64;

 private:
  const char* ray_generation_;
  const char* miss_;
  Device device_;
  CommandQueue queue_;
  RootSignature root_;
  Buffer results_;
  StateObject pipeline_;
};

// Processor time by thread, in nanoseconds.
std::map<std::string, double> thread_times() {
  std::map<std::string, double> times;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream(task.path() / "schedstat") >> times[task.path().filename().string()];
  }
  return times;
}

void print_balance() {
  Probe probe("WorkBelow", nullptr);
  probe.run(1, Probe::kWidth, Probe::kHeight).value();
  const auto before = thread_times();
  probe.run(100'000, Probe::kWidth, Probe::kHeight).value();
  double most = 0, all = 0;
  for (const auto& [thread, time] : thread_times()) {
    const auto known = before.find(thread);
    const double worked = time - (known == before.end() ? 0 : known->second);
    most = std::max(most, worked);
    all += worked;
  }
  std::printf("%.3f\n", most / all);
}

void print_nesting() {
  Probe probe("Nest", "NestDeeper");
  const Status status = probe.run(31, 8, 1);
  if (!status) {
    std::printf("%s\n", status.error().message.c_str());
  } else {
    std::printf("finished: %u\n", probe.first_result());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc == 2 ? argv[1] : "";
  if (what != "balance" && what != "payload") {
    std::fprintf(stderr, "usage: workaround_probe balance | payload\n");
    return 2;
  }
  try {
    what == "balance" ? print_balance() : print_nesting();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "workaround_probe: %s\n", error.what());
    return 1;
  }
  return 0;
}
