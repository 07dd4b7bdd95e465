// SPDX-License-Identifier: MIT
//
// compute/long-vectors/...: arithmetic of vectors of 64 components against the same loop over
// arrays of floats, eight threads at once and one by one.
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>

#include <stdexcept>

#include "fixtures.h"

namespace kaamos::bench {
namespace {

constexpr const char* kText = R"(
RWByteAddressBuffer results : register(u0);
#ifdef LONG_VECTORS
typedef vector<float, 64> Floats;
#else
typedef float Floats[64];
#endif
[shader("compute")] [numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  Floats x, weights, sum;
  uint i;
  for (i = 0; i < 64; ++i) {
    x[i] = float((id.x + i) % 100) * 0.01f;
    weights[i] = float((id.x + 7 * i) % 64) * 0.03125f - 1;
    sum[i] = 0;
  }
  for (uint round = 0; round < 64; ++round) {
    const float bias = round * 0.015625f;
#ifdef LONG_VECTORS
    const Floats h = max(x * weights + bias, 0);
    sum += h * x;
    x = lerp(x, h, 0.25f);
#else
    for (i = 0; i < 64; ++i) {
      const float h = max(x[i] * weights[i] + bias, 0);
      sum[i] += h * x[i];
      x[i] = lerp(x[i], h, 0.25f);
    }
#endif
  }
  float total = 0;
  for (i = 0; i < 64; ++i) total += sum[i] + x[i];
  results.Store(4 * id.x, asuint(total));
})";

// The kernel in both forms, and a device to run them on.
class VectorKernels {
 public:
  VectorKernels(bool is_wide, uint32_t groups)
      : groups_(groups),
        device_(rtapi::CreateDevice({.Backend = "embree"}).value()),
        queue_(device_.CreateCommandQueue().value()) {
    rtapi::RootSignatureDesc desc;
    desc.Parameters.push_back(rtapi::RootParameter::Uav(0, 0));
    root_ = device_.CreateRootSignature(desc).value();
    rtapi::BufferDesc buffer;
    buffer.SizeInBytes = uint64_t{4} * groups * 64;
    buffer.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    results_ = device_.CreateBuffer(buffer).value();
    vectors_ = pipeline(is_wide, true);
    arrays_ = pipeline(is_wide, false);
  }

  void run_vectors() { run(vectors_); }
  void run_arrays() { run(arrays_); }
  std::vector<std::byte> results() {
    return rtapi::ReadbackBuffer(device_, queue_, results_).value();
  }

 private:
  rtapi::PipelineState pipeline(bool is_wide, bool has_vectors) {
    rtapi::ShaderCompileOptions options;
    options.File = "long_vectors.hlsl";
    options.Source = kText;
    options.Target = "lib_6_9";
    options.Spirv = false;
    options.WideThreads = is_wide;
    if (has_vectors) options.Defines = {{.Name = "LONG_VECTORS"}};
    const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
    if (!compiled.Status) throw std::runtime_error(compiled.Status.error().message);
    return device_.CreateComputePipelineState({root_, compiled.Library, "", ""}).value();
  }

  void run(const rtapi::PipelineState& pipeline) {
    auto list = device_.CreateCommandList().value();
    list.SetComputeRootSignature(root_);
    list.SetPipelineState(pipeline);
    list.SetComputeRootUnorderedAccessView(0, results_.GetGPUVirtualAddress());
    list.Dispatch(groups_, 1, 1);
    queue_.ExecuteAndWait(list).value();
  }

  uint32_t groups_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::Buffer results_;
  rtapi::PipelineState vectors_;
  rtapi::PipelineState arrays_;
};

Line long_vectors(bool is_wide, Fixtures& fixtures, const Measure& measure) {
  const uint32_t groups = fixtures.options().quick ? 4 : 512;
  VectorKernels kernels(is_wide, groups);
  kernels.run_vectors();
  const std::vector<std::byte> results = kernels.results();
  kernels.run_arrays();
  if (results != kernels.results()) {
    throw std::runtime_error("the kernel gives something else with arrays");
  }
  const Pairs times = time_pairs(
      measure, [&] { kernels.run_vectors(); }, [&] { kernels.run_arrays(); });
  return {is_wide ? "compute/long-vectors/wide" : "compute/long-vectors/single",
          times.ratio,
          1e3 * times.ours,
          1e3 * times.baseline,
          "ms",
          false};
}

}  // namespace

std::vector<Case> vector_cases() {
  std::vector<Case> out;
  for (const bool is_wide : {true, false}) {
    out.push_back({is_wide ? "compute/long-vectors/wide" : "compute/long-vectors/single",
                   [is_wide](Fixtures& fixtures, const Measure& measure) {
                     return long_vectors(is_wide, fixtures, measure);
                   }});
  }
  return out;
}

}  // namespace kaamos::bench
