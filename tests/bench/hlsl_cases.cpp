// SPDX-License-Identifier: MIT
//
// hlsl/...: the compiler's front end on a large library of mostly dead code, and loading a library
// from the cache.
#include <dlfcn.h>
#include <rtapi/shader_compiler.h>

#include <filesystem>
#include <stdexcept>

#include "fixtures.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/preprocess.h"
#include "temporary_folder.h"

namespace kaamos::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kFunctionLines = 10;

std::string replaced(std::string text, const std::string& number, const std::string& callee) {
  for (size_t at = 0; (at = text.find_first_of("#@", at)) != std::string::npos;) {
    const std::string& by = text[at] == '#' ? number : callee;
    text.replace(at, 1, by);
    at += by.size();
  }
  return text;
}

// A library of `functions` functions of ten lines each. The ray generation shader reaches the first
// `live` of them (a multiple of ten), which call each other in chains of ten.
std::string make_library(int functions, int live) {
  std::string text = "RWStructuredBuffer<float4> g_out : register(u0);\n";
  text += "float4 Function0(float4 p, uint n) { return p * float(n); }\n";
  for (int i = 1; i < functions; ++i) {
    text += replaced(
        "float4 Function#(float4 p, uint n) {\n"
        "  float3 a = normalize(p.xyz * #.0f + float3(0.5f, 1.0f, p.w));\n"
        "  float weight = saturate(dot(a, p.yzw)) + 0.25f;\n"
        "  for (uint i = 0; i < (n & 7u); ++i) {\n"
        "    const float2 s = float2(sin(weight * i), cos(weight));\n"
        "    a += cross(a, float3(s, lerp(s.x, s.y, weight)));\n"
        "    weight = weight > 2.0f ? weight * 0.5f : weight + 1.0f;\n"
        "  }\n"
        "  return Function@(float4(a, weight), n + #u);\n"
        "}\n",
        std::to_string(i), std::to_string(i % 10 == 0 ? 0 : i - 1));
  }
  text += "[shader(\"raygeneration\")]\nvoid Main() {\n  const uint i = DispatchRaysIndex().x;\n";
  for (int last = 9; last < live; last += 10) {
    text += "  g_out[i] = Function" + std::to_string(last) + "(g_out[i], i);\n";
  }
  return text + "}\n";
}

double count_lines(const std::string& text) {
  return static_cast<double>(std::count(text.begin(), text.end(), '\n'));
}

void run_front_end(const std::string& text) {
  hlsl::MemoryFileLoader no_files;
  hlsl::SourceManager sources(no_files);
  hlsl::DiagnosticEngine diagnostics;
  hlsl::FrontendOptions options;
  options.path = "library.hlsl";
  options.text = text;
  if (hlsl::compile_to_ir(options, sources, diagnostics) == nullptr) {
    throw std::runtime_error("the library does not compile: " +
                             hlsl::render(diagnostics.diagnostics().front(), sources));
  }
}

void run_preprocessor(const std::string& text) {
  hlsl::MemoryFileLoader no_files;
  hlsl::SourceManager sources(no_files);
  hlsl::DiagnosticEngine diagnostics;
  hlsl::preprocess_text("library.hlsl", text, {}, sources, diagnostics);
}

Line front_end(Fixtures& fixtures, const Measure& measure) {
  const int functions = (fixtures.options().quick ? 500 : 10000) / kFunctionLines;
  const std::string text = make_library(functions, functions / 5);
  const double lines = count_lines(text);
  Measure one_thread = measure;
  one_thread.threads = 1;
  const Pairs times = time_pairs(
      one_thread, [&] { run_front_end(text); }, [&] { run_preprocessor(text); });
  return {"hlsl/frontend",        lines / times.ours, lines / times.ours,
          lines / times.baseline, "lines/s",          true};
}

fs::path only_object(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".so") return entry.path();
  }
  throw std::runtime_error("the cache holds no shared object after a compilation");
}

void compile_cached(const rtapi::ShaderCompileOptions& options, bool must_be_cached) {
  const rtapi::ShaderCompilation compilation = rtapi::CompileShaderLibrary(options);
  if (!compilation.Status) throw std::runtime_error(compilation.Status.error().message);
  if (must_be_cached && !compilation.FromCache) {
    throw std::runtime_error("the second compilation did not come from the cache");
  }
}

Line cached_load(Fixtures&, const Measure& measure) {
  const TemporaryFolder cache;
  rtapi::ShaderCompileOptions options;
  options.File = "library.hlsl";
  options.Source = make_library(20, 20);
  options.CacheDirectory = cache.path.string();
  compile_cached(options, false);
  const fs::path object = only_object(cache.path);
  Measure one_thread = measure;
  one_thread.threads = 1;
  const Pairs times = time_pairs(
      one_thread, [&] { compile_cached(options, true); },
      [&] {
        void* handle = dlopen(object.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) throw std::runtime_error(dlerror());
        dlclose(handle);
      });
  return {
      "hlsl/cached-load", 1e3 * times.ours, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

}  // namespace

std::vector<Case> hlsl_cases() {
  return {{"hlsl/frontend", front_end}, {"hlsl/cached-load", cached_load}};
}

}  // namespace kaamos::bench
