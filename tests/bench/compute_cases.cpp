// SPDX-License-Identifier: MIT
//
// compute/split/...: kernels with barriers, split at the barriers, against the same kernels on
// fibers. compute/interpreted: a kernel in the interpreter against the same in native code.
#include <dlfcn.h>
#include <kaamos/shader/abi.h>
#include <rtapi/rtapi.h>

#include <stdexcept>

#include "fixtures.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/interpret/interpret.h"
#include "temporary_folder.h"

namespace kaamos::bench {
namespace {

constexpr uint32_t kGroupThreads = 256;

struct Kernel {
  const char* name;
  const char* text;
};

constexpr Kernel kKernels[] = {
    {"reduction", R"(
RWByteAddressBuffer results : register(u0);
groupshared float values[256];
[shader("compute")] [numthreads(256, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  values[i] = float(id.x % 1000) * 0.25f;
  for (uint s = 128; s > 0; s >>= 1) {
    GroupMemoryBarrierWithGroupSync();
    if (i < s) values[i] += values[i + s];
  }
  GroupMemoryBarrierWithGroupSync();
  results.Store(4 * id.x, asuint(values[0]));
})"},
    {"product", R"(
RWByteAddressBuffer results : register(u0);
groupshared float a[16][16];
groupshared float b[16][16];
[shader("compute")] [numthreads(16, 16, 1)]
void main(uint3 t : SV_GroupThreadID, uint i : SV_GroupIndex, uint3 g : SV_GroupID) {
  float sum = 0;
  for (uint step = 0; step < 8; ++step) {
    a[t.y][t.x] = float((i + step) & 15);
    b[t.y][t.x] = float((i * 3 + g.x) & 31);
    GroupMemoryBarrierWithGroupSync();
    for (uint k = 0; k < 16; ++k) sum += a[t.y][k] * b[k][t.x];
    GroupMemoryBarrierWithGroupSync();
  }
  results.Store(4 * (g.x * 256 + i), asuint(sum));
})"},
    {"blur", R"(
RWByteAddressBuffer results : register(u0);
groupshared float3 row[256];
[shader("compute")] [numthreads(256, 1, 1)]
void main(uint i : SV_GroupIndex, uint3 id : SV_DispatchThreadID) {
  row[i] = float3(id.x & 255, (id.x >> 3) & 255, (id.x >> 6) & 255) / 255;
  GroupMemoryBarrierWithGroupSync();
  float3 sum = 0;
  for (int k = -8; k <= 8; ++k) sum += row[clamp(int(i) + k, 0, 255)] * exp(-k * k / 32.0f);
  results.Store(4 * id.x, asuint(dot(sum, float3(0.2f, 0.7f, 0.1f))));
})"},
};

// One kernel in each variant, and a device to run it on.
class Comparison {
 public:
  Comparison(const Kernel& kernel, uint32_t groups)
      : groups_(groups),
        device_(rtapi::CreateDevice({.Backend = "embree"}).value()),
        queue_(device_.CreateCommandQueue().value()) {
    rtapi::RootSignatureDesc desc;
    desc.Parameters.push_back(rtapi::RootParameter::Uav(0, 0));
    root_ = device_.CreateRootSignature(desc).value();
    rtapi::BufferDesc buffer;
    buffer.SizeInBytes = uint64_t{4} * groups * kGroupThreads;
    buffer.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    results_ = device_.CreateBuffer(buffer).value();
    build(kernel);
  }
  ~Comparison() {
    cut_ = fibers_ = interpreted_ = {};
    if (handle_ != nullptr) dlclose(handle_);
  }
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  void run_cut() { run(cut_); }
  void run_fibers() { run(fibers_); }
  void run_interpreted() { run(interpreted_); }
  std::vector<std::byte> results() {
    return rtapi::ReadbackBuffer(device_, queue_, results_).value();
  }

 private:
  void build(const Kernel& kernel) {
    hlsl::MemoryFileLoader no_files;
    hlsl::SourceManager sources(no_files);
    hlsl::DiagnosticEngine diagnostics;
    hlsl::FrontendOptions options;
    options.path = std::string(kernel.name) + ".hlsl";
    options.text = kernel.text;
    const std::shared_ptr<const hlsl::ir::Module> module =
        hlsl::compile_to_ir(options, sources, diagnostics);
    if (module == nullptr) throw std::runtime_error(hlsl::render_all(diagnostics, sources));
    const std::string source =
        hlsl::emit_cpp(*module, {.entry_point = "cut"}) +
        hlsl::emit_cpp(*module, {.entry_point = "fibers", .split_groups = false});
    const auto compiler = hlsl::find_host_compiler();
    if (!compiler) throw std::runtime_error(compiler.error());
    const auto object =
        hlsl::build_shared_object(*compiler, source, hlsl::Optimisation::kFull, folder_.path);
    if (object.error) throw std::runtime_error(object.error.message());
    handle_ = dlopen(object.path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) throw std::runtime_error(dlerror());
    cut_ = pipeline("cut", true);
    fibers_ = pipeline("fibers", false);
    const auto interpreted = hlsl::InterpretedLibrary::create(module, {});
    if (!interpreted) throw std::runtime_error(interpreted.error());
    interpreted_ =
        pipeline(rtapi::LoadShaderLibrary(&(*interpreted)->desc(), *interpreted).value());
  }

  rtapi::PipelineState pipeline(const char* name, bool is_cut) {
    void* entry = dlsym(handle_, name);
    if (entry == nullptr) throw std::runtime_error("the shared object lacks its entry");
    const auto* library = reinterpret_cast<shader::LibraryEntryPointFn>(entry)();
    if ((library->exports[0].compute->group != nullptr) != is_cut) {
      throw std::runtime_error("the kernel was not compiled as the case needs it");
    }
    return pipeline(rtapi::LoadShaderLibrary(library).value());
  }
  rtapi::PipelineState pipeline(const rtapi::ShaderLibrary& library) {
    return device_.CreateComputePipelineState({root_, library, "", ""}).value();
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
  TemporaryFolder folder_;
  void* handle_ = nullptr;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::Buffer results_;
  rtapi::PipelineState cut_;
  rtapi::PipelineState fibers_;
  rtapi::PipelineState interpreted_;
};

std::vector<std::byte> results_of(Comparison& comparison, void (Comparison::*run)()) {
  (comparison.*run)();
  return comparison.results();
}

Line split(const Kernel& kernel, Fixtures& fixtures, const Measure& measure) {
  const uint32_t groups = fixtures.options().quick ? 4 : 2048;
  Comparison comparison(kernel, groups);
  if (results_of(comparison, &Comparison::run_cut) !=
      results_of(comparison, &Comparison::run_fibers)) {
    throw std::runtime_error("the kernel gives something else on fibers");
  }
  const Pairs times = time_pairs(
      measure, [&] { comparison.run_cut(); }, [&] { comparison.run_fibers(); });
  const double threads = 1e-6 * groups * kGroupThreads;
  return {"compute/split/" + std::string(kernel.name),
          1 / times.ratio,
          threads / times.ours,
          threads / times.baseline,
          "Mthreads/s",
          true};
}

Line interpreted(Fixtures& fixtures, const Measure& measure) {
  const uint32_t groups = fixtures.options().quick ? 2 : 64;
  Comparison comparison(kKernels[1], groups);
  if (results_of(comparison, &Comparison::run_interpreted) !=
      results_of(comparison, &Comparison::run_fibers)) {
    throw std::runtime_error("the kernel gives something else interpreted");
  }
  const Pairs times = time_pairs(
      measure, [&] { comparison.run_interpreted(); }, [&] { comparison.run_cut(); });
  return {"compute/interpreted", times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

}  // namespace

std::vector<Case> compute_cases() {
  std::vector<Case> out = {{"compute/interpreted", interpreted}};
  for (const Kernel& kernel : kKernels) {
    out.push_back({"compute/split/" + std::string(kernel.name),
                   [&kernel](Fixtures& fixtures, const Measure& measure) {
                     return split(kernel, fixtures, measure);
                   }});
  }
  return out;
}

}  // namespace kaamos::bench
