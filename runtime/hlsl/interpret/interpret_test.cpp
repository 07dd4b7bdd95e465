// SPDX-License-Identifier: MIT
//
// The parts of the interpreter that the HLSL tests do not cover: hooks, limits, threads, layouts,
// its place in the public API. Libraries are called here as a backend calls them.
#include "runtime/hlsl/interpret/interpret.h"

#include <gtest/gtest.h>
#include <kaamos/shader/abi.h>
#include <kaamos/shader/vector.h>
#include <rtapi/rtapi.h>
#include <rtapi/shader_compiler.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"

namespace kaamos::hlsl {
namespace {

std::shared_ptr<const ir::Module> module_of(const std::string& source) {
  DiskFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  FrontendOptions options;
  options.path = "test.hlsl";
  options.text = source;
  options.native_16bit = true;
  auto module = compile_to_ir(options, sources, diagnostics);
  EXPECT_TRUE(module != nullptr) << render_all(diagnostics, sources);
  return module;
}

std::shared_ptr<const InterpretedLibrary> interpret(const std::string& source,
                                                    const InterpretOptions& options = {}) {
  const auto library = InterpretedLibrary::create(module_of(source), options);
  EXPECT_TRUE(library) << library.error();
  return library ? *library : nullptr;
}

struct Removal {
  int count = 0;
  shader::RemovalReason reason = shader::RemovalReason::kOther;
};

// Calls a kernel whose only binding is a raw buffer in u0, with `buffer` as its contents.
void run_kernel(const shader::LibraryDesc& library, std::vector<uint32_t>& buffer,
                Removal* removal = nullptr) {
  const uint64_t address = reinterpret_cast<uintptr_t>(buffer.data());
  shader::BindingSlot slot;
  slot.source = shader::SlotSource::kRootDescriptor;
  slot.kind = shader::DescriptorKind::kRawBuffer;
  slot.access = shader::DescriptorAccess::kUnorderedAccess;
  shader::Services services = {};
  // Acts like a backend that cannot leave a shader: the interpreter must stop by itself.
  services.remove_device = [](shader::Invocation& invocation, shader::RemovalReason reason) {
    auto& to = *static_cast<Removal*>(invocation.backend);
    ++to.count;
    to.reason = reason;
  };
  shader::DispatchConstants dispatch;
  dispatch.services = &services;
  dispatch.root_arguments = reinterpret_cast<const uint8_t*>(&address);
  shader::Invocation invocation;
  invocation.dispatch = &dispatch;
  invocation.slots = &slot;
  invocation.backend = removal;
  const shader::ComputeDesc& compute = *library.exports[0].compute;
  std::vector<uint64_t> shared(compute.shared_bytes / 8 + 1);
  shader::ComputeGroup group;
  group.shared = shared.data();
  compute.group(invocation, group);
}

TEST(Interpret, AnEndlessLoopEndsAtTheLimitOfSteps) {
  InterpretOptions options;
  options.step_limit = 10000;
  const auto library = interpret(R"(
RWByteAddressBuffer results : register(u0);
void spin() { for (;;) { } }
[shader("compute")] [numthreads(1, 1, 1)] void main() {
  results.Store(0, 1);
  spin();
  results.Store(4, 1);
})",
                                 options);
  std::vector<uint32_t> buffer(2);
  Removal removal;
  run_kernel(library->desc(), buffer, &removal);
  EXPECT_EQ(removal.count, 1);
  EXPECT_EQ(removal.reason, shader::RemovalReason::kStepLimit);
  EXPECT_EQ(buffer, (std::vector<uint32_t>{1, 0}));
}

TEST(Interpret, TheLimitCountsForEachInvocation) {
  InterpretOptions options;
  options.step_limit = 50;
  const auto library = interpret(R"(
RWByteAddressBuffer results : register(u0);
[shader("compute")] [numthreads(100, 1, 1)] void main(uint i : SV_GroupIndex) {
  uint sum = 0;
  for (uint k = 0; k < 10; ++k) sum += k;
  results.Store(4 * i, sum);
})",
                                 options);
  std::vector<uint32_t> buffer(100);
  Removal removal;
  run_kernel(library->desc(), buffer, &removal);
  EXPECT_EQ(removal.count, 0);
  EXPECT_EQ(buffer, std::vector<uint32_t>(100, 45));
}

struct Seen {
  std::vector<uint32_t> lines;
  std::vector<std::pair<InterpretFinding, uint32_t>> findings;
  std::string entry;
};

TEST(Interpret, HooksSeeStatementsAndFindings) {
  Seen seen;
  InterpretOptions options;
  options.hooks.user = &seen;
  options.hooks.statement = [](void* user, const InterpretPlace& place) {
    auto& to = *static_cast<Seen*>(user);
    to.lines.push_back(place.location.line);
    to.entry = place.entry->name;
  };
  options.hooks.finding = [](void* user, InterpretFinding finding, const InterpretPlace& place) {
    static_cast<Seen*>(user)->findings.emplace_back(finding, place.location.line);
  };
  const auto library = interpret(
      "RWByteAddressBuffer results : register(u0);\n"
      "[shader(\"compute\")] [numthreads(1, 1, 1)] void main() {\n"
      "  uint values[3] = {5, 6, 7};\n"
      "  uint i = results.Load(0);\n"
      "  values[i] = 9;\n"
      "  results.Store(4, values[i] + values[2]);\n"
      "}\n",
      options);
  std::vector<uint32_t> buffer = {3, 0};
  run_kernel(library->desc(), buffer);
  EXPECT_EQ(buffer[1], 7u);
  EXPECT_EQ(seen.entry, "main");
  for (const uint32_t line : {3u, 4u, 5u, 6u}) {
    EXPECT_NE(std::find(seen.lines.begin(), seen.lines.end(), line), seen.lines.end()) << line;
  }
  const std::vector<std::pair<InterpretFinding, uint32_t>> expected = {
      {InterpretFinding::kIndexOutOfRange, 5}, {InterpretFinding::kIndexOutOfRange, 6}};
  EXPECT_EQ(seen.findings, expected);
}

TEST(Interpret, ThreadsShareALibrary) {
  const auto library = interpret(R"(
RWByteAddressBuffer results : register(u0);
static uint calls;
groupshared uint total;
uint next(inout uint state) { ++calls; state = state * 1664525 + 1013904223; return state >> 8; }
[shader("compute")] [numthreads(16, 1, 1)] void main(uint i : SV_GroupIndex) {
  uint state = results.Load(4 * i);
  uint sum = 0;
  for (uint k = 0; k < 200; ++k) sum += next(state);
  InterlockedAdd(total, calls);
  results.Store(4 * i, sum);
  results.Store(64, total);
})");
  const auto run = [&](uint32_t seed) {
    std::vector<uint32_t> buffer(17);
    for (uint32_t i = 0; i < 16; ++i) buffer[i] = seed * 16 + i;
    for (int round = 0; round < 5; ++round) run_kernel(library->desc(), buffer);
    return buffer;
  };
  std::vector<std::vector<uint32_t>> results(4);
  std::vector<std::thread> threads;
  for (uint32_t t = 0; t < 4; ++t) threads.emplace_back([&, t] { results[t] = run(t); });
  for (std::thread& thread : threads) thread.join();
  for (uint32_t t = 0; t < 4; ++t) {
    EXPECT_EQ(results[t], run(t));
    EXPECT_EQ(results[t][16], 16u * 200u);
  }
}

// The struct as emit_cpp prints the payload below.
struct Inner {
  bool flag;
  shader::half3 h;
};
struct Payload {
  bool first;
  double wide;
  Inner inner[2];
  shader::float3x2 matrix;
  shader::bool2 flags;
  uint64_t last;
};

TEST(Interpret, PayloadsLieAsCompiledShadersHaveThem) {
  const auto library = interpret(R"(
struct Inner { bool flag; float16_t3 h; };
struct Payload { bool first; double wide; Inner inner[2]; float3x2 m; bool2 flags; uint64_t last; };
[shader("miss")] void main(inout Payload p) {
  p.first = true;
  p.wide += 1;
  p.inner[1].h.z = (float16_t)2;
  p.m[2][1] = p.m._m00 + 1;
  p.flags.y = true;
  p.last = p.last * 3;
})");
  const shader::ExportDesc& code = library->desc().exports[0];
  EXPECT_EQ(code.payload_storage_bytes, sizeof(Payload));
  Payload payload = {};
  payload.wide = 0.5;
  payload.matrix.e[0].e[0] = 4;
  payload.last = 7;
  shader::Invocation invocation;
  reinterpret_cast<shader::MissFn>(code.entry)(invocation, &payload);
  EXPECT_TRUE(payload.first);
  EXPECT_EQ(payload.wide, 1.5);
  EXPECT_EQ(payload.inner[1].h.e[2].bits, 0x4000);
  EXPECT_EQ(payload.inner[0].h.e[2].bits, 0);
  EXPECT_EQ(payload.matrix.e[2].e[1], 5.0f);
  EXPECT_FALSE(payload.flags.e[0]);
  EXPECT_TRUE(payload.flags.e[1]);
  EXPECT_EQ(payload.last, 21u);
}

TEST(Interpret, ALibraryNeedsNoCompilerAndHasSpirv) {
  rtapi::ShaderCompileOptions options;
  options.File = "test.hlsl";
  options.Source = R"(struct P { float x; };
[shader("miss")] void Dark(inout P p) { p.x = 1; })";
  options.Interpret = true;
  options.CxxCompiler = "/no/such/compiler";
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  ASSERT_TRUE(compiled.Status.ok()) << compiled.Status.error().message;
  ASSERT_NE(compiled.Library.FindExport("Dark"), nullptr);
  EXPECT_EQ(compiled.Library.FindExport("Dark")->PayloadSizeInBytes, 4u);
  const shader::ExportDesc& code = compiled.Library.impl()->desc->exports[0];
  ASSERT_GT(code.spirv_words, 5u);
  EXPECT_EQ(code.spirv[0], 0x07230203u);
  options.Spirv = false;
  const rtapi::ShaderCompilation without = rtapi::CompileShaderLibrary(options);
  ASSERT_TRUE(without.Status.ok());
  EXPECT_EQ(without.Library.impl()->desc->exports[0].spirv, nullptr);
}

TEST(Interpret, WithoutACompilerTheErrorNamesTheInterpreter) {
  rtapi::ShaderCompileOptions options;
  options.File = "test.hlsl";
  options.Source = "";
  options.CxxCompiler = "/no/such/compiler";
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  ASSERT_FALSE(compiled.Status.ok());
  EXPECT_EQ(compiled.Status.error().id.text(), "KA2750");
  EXPECT_NE(compiled.Status.error().message.find("ShaderCompileOptions::Interpret"),
            std::string::npos)
      << compiled.Status.error().message;
}

// Runs the kernel of the source in u0 on a device; `results` are 4 words, initially zero.
rtapi::Status run_on_device(const rtapi::ShaderCompileOptions& options,
                            std::vector<uint32_t>& results) {
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);
  if (!compiled.Status.ok()) return compiled.Status;
  const auto device = rtapi::CreateDevice({.Backend = "embree"}).value();
  auto queue = device.CreateCommandQueue().value();
  rtapi::RootSignatureDesc signature;
  signature.Parameters.push_back(rtapi::RootParameter::Uav(0, 0));
  const auto root = device.CreateRootSignature(signature).value();
  const std::vector<uint32_t> zeros(4);
  const auto buffer = rtapi::CreateDefaultBuffer(device, queue, std::as_bytes(std::span(zeros)),
                                                 rtapi::ResourceFlags::kAllowUnorderedAccess)
                          .value();
  auto list = device.CreateCommandList().value();
  list.SetComputeRootSignature(root);
  list.SetPipelineState(
      device.CreateComputePipelineState({root, compiled.Library, "", ""}).value());
  list.SetComputeRootUnorderedAccessView(0, buffer.GetGPUVirtualAddress());
  list.Dispatch(1, 1, 1);
  const auto status = queue.ExecuteAndWait(list);
  if (!status.ok()) return status.error();
  const auto bytes = rtapi::ReadbackBuffer(device, queue, buffer).value();
  results.resize(4);
  std::memcpy(results.data(), bytes.data(), 16);
  return {};
}

TEST(Interpret, OnADeviceTheLimitOfStepsRemovesIt) {
  rtapi::ShaderCompileOptions options;
  options.File = "test.hlsl";
  options.Source = R"(RWByteAddressBuffer results : register(u0);
[shader("compute")] [numthreads(1, 1, 1)] void main() { while (true) { } results.Store(0, 1); })";
  options.Interpret = true;
  options.InterpretStepLimit = 1000;
  std::vector<uint32_t> results;
  const rtapi::Status status = run_on_device(options, results);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("KA0897"), std::string::npos) << status.error().message;
  EXPECT_NE(status.error().message.find("main"), std::string::npos) << status.error().message;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// On most machines 12 MB do not fit on the stack, and nothing but the device may be affected.
TEST(Interpret, VariablesLargerThanTheStackRemoveTheDevice) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer reports the access itself";
  rtapi::ShaderCompileOptions options;
  options.File = "test.hlsl";
  options.Source = R"(RWByteAddressBuffer results : register(u0);
[shader("compute")] [numthreads(1, 1, 1)] void main() {
  uint many[3 << 20];
  for (uint i = 0; i < 8; ++i) many[(i * 400000 + results.Load(0)) % (3 << 20)] = i + 1;
  results.Store(4, many[400000] + results.Load(8));
})";
  for (const bool interpret : {false, true}) {
    options.Interpret = interpret;
    std::vector<uint32_t> results;
    const rtapi::Status status = run_on_device(options, results);
    if (status.ok()) {
      EXPECT_EQ(results[1], 2u);
    } else {
      EXPECT_NE(status.error().message.find("KA089"), std::string::npos) << status.error().message;
    }
  }
}

}  // namespace
}  // namespace kaamos::hlsl
