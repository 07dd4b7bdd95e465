// SPDX-License-Identifier: MIT
#include "d3d12/compiler/compile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <rtapi/error_ids.h>

#include "d3d12/container/checksum.h"
#include "d3d12/container/root_signature_blob.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

namespace {

namespace fs = std::filesystem;
using rtapi::ShaderDiagnosticSeverity;

// Warnings that DXC does not have, so that -WX fails for no source that DXC takes: about functions
// that nothing calls, and attributes of vk.
constexpr rtapi::ErrorId kUnreached = rtapi::error_ids::compiler::kSkipped;
constexpr rtapi::ErrorId kOwnWarnings[] = {kUnreached,
                                           rtapi::error_ids::compiler::kVkAttributeIgnored};

bool fails_by_warning(const rtapi::ShaderCompilation& compiled) {
  return std::any_of(compiled.Diagnostics.begin(), compiled.Diagnostics.end(), [](const auto& one) {
    const bool is_own = std::find(std::begin(kOwnWarnings), std::end(kOwnWarnings), one.Id) !=
                        std::end(kOwnWarnings);
    return one.Severity == ShaderDiagnosticSeverity::kWarning && !is_own;
  });
}

// With an entry point of the file chosen, that others of it are not reached is no news.
bool is_news(const rtapi::ShaderDiagnostic& one, const rtapi::ShaderCompileOptions& options) {
  return one.Id != kUnreached || options.EntryPoint.empty();
}

std::string absolute(const std::string& path) {
  std::error_code failed;
  const fs::path full = fs::absolute(path.empty() ? "." : path, failed);
  return failed ? path : full.lexically_normal().generic_string();
}

// A debugger looks for the paths of the container from any folder.
void make_absolute(ShaderSource& source) {
  source.options.File = absolute(source.options.File);
  for (std::string& folder : source.options.IncludeDirectories) folder = absolute(folder);
  for (rtapi::ShaderSourceFile& file : source.files) file.Path = absolute(file.Path);
}

// Returns the source for the container to hold: the main file's text is an option, the others are
// files.
ShaderSource source_of(const rtapi::ShaderCompileOptions& options,
                       const rtapi::ShaderCompilation& compiled) {
  ShaderSource out;
  out.options = options;
  const fs::path main = fs::path(options.File).lexically_normal();
  for (const rtapi::ShaderSourceFile& file : compiled.Sources) {
    if (!options.Source && fs::path(file.Path).lexically_normal() == main) {
      out.options.Source = file.Text;
    }
    out.files.push_back(file);
  }
  return out;
}

// Part RTS0 of the root signature that all entry points with one have; empty if they differ, as a
// container has room for one.
rtapi::Result<std::vector<std::byte>> root_signature_part(
    const rtapi::ShaderReflection& reflection) {
  const std::string* text = nullptr;
  for (const rtapi::ShaderEntryInfo& entry : reflection.Entries) {
    if (entry.RootSignature.empty()) continue;
    if (text != nullptr && *text != entry.RootSignature) return std::vector<std::byte>();
    text = &entry.RootSignature;
  }
  if (text == nullptr) return std::vector<std::byte>();
  const auto desc = rtapi::ParseRootSignature(*text);
  if (!desc) return desc.error();
  return write_root_signature(*desc, D3D_ROOT_SIGNATURE_VERSION_1_1);
}

const char* stage_name(rtapi::ShaderStage stage) {
  switch (stage) {
    case rtapi::ShaderStage::kPixel:
      return "pixel";
    case rtapi::ShaderStage::kVertex:
      return "vertex";
    case rtapi::ShaderStage::kGeometry:
      return "geometry";
    case rtapi::ShaderStage::kCompute:
      return "compute";
    case rtapi::ShaderStage::kRayGeneration:
      return "raygeneration";
    case rtapi::ShaderStage::kIntersection:
      return "intersection";
    case rtapi::ShaderStage::kAnyHit:
      return "anyhit";
    case rtapi::ShaderStage::kClosestHit:
      return "closesthit";
    case rtapi::ShaderStage::kMiss:
      return "miss";
    case rtapi::ShaderStage::kCallable:
      return "callable";
    case rtapi::ShaderStage::kLibrary:
      break;
  }
  return "library";
}

}  // namespace

CompiledSource compile_source(const DxcArguments& arguments) {
  rtapi::ShaderCompileOptions options = arguments.options;
  options.CheckOnly = true;
  const rtapi::ShaderCompilation compiled = rtapi::CompileShaderLibrary(options);

  CompiledSource out;
  for (const std::string& note : arguments.notes) {
    if (!options.NoWarnings) out.messages += note + "\n";
  }
  for (const rtapi::ShaderDiagnostic& one : compiled.Diagnostics) {
    if (is_news(one, options)) out.messages += one.Text;
  }
  out.dependencies = compiled.Dependencies;
  if (!compiled.Status.ok()) {
    if (compiled.Diagnostics.empty()) out.messages += compiled.Status.error().message + "\n";
    return out;
  }
  if (arguments.warnings_as_errors && fails_by_warning(compiled)) {
    out.messages += "error: warnings are errors [-WX]\n";
    return out;
  }
  ShaderSource source = source_of(options, compiled);
  if (arguments.absolute_paths) make_absolute(source);
  const std::vector<std::byte> part = write_source(source);
  out.hash.digest = md5(part);
  std::vector<Part> parts = {{kSourcePart, part},
                             {kHashPart, std::as_bytes(std::span(&out.hash, 1))}};
  const auto root_signature = root_signature_part(compiled.Reflection);
  if (!root_signature) {
    out.messages += "error: [RootSignature]: " + root_signature.error().message + "\n";
    return out;
  }
  if (!root_signature->empty()) {
    parts.push_back({fourcc("RTS0"), *root_signature});
    out.root_signature = write_container({&parts.back(), 1});
  }
  out.container = write_container(parts);
  out.reflection = compiled.Reflection;
  out.ok = true;
  return out;
}

PreprocessedSource preprocess_source(const DxcArguments& arguments) {
  rtapi::ShaderCompileOptions options = arguments.options;
  if (options.Target.empty()) options.Target = "lib_6_8";  // -P needs no -T
  const rtapi::ShaderPreprocessing done = rtapi::PreprocessShader(options);
  PreprocessedSource out;
  for (const rtapi::ShaderDiagnostic& one : done.Diagnostics) out.messages += one.Text;
  out.text = done.Text;
  out.ok = done.Status.ok();
  return out;
}

std::string list_reflection(const rtapi::ShaderReflection& reflection, const std::string& target) {
  std::string out = ";\n; " + target + ", HLSL and arguments for Kaamos\n;\n; Exports:\n;\n";
  const auto add_line = [&out](const std::string& name, const auto&... columns) {
    std::string line = "; " + name;
    size_t width = 32;
    ((line.resize(std::max(line.size() + 1, width), ' '), line += columns, width += 15), ...);
    out += line + "\n";
  };
  add_line("Name", std::string("Stage"), std::string("Payload"), std::string("Attributes"));
  for (const rtapi::ShaderEntryInfo& entry : reflection.Entries) {
    const rtapi::ShaderExportInfo& info = entry.Export;
    add_line(info.Name, std::string(stage_name(info.Stage)),
             std::to_string(info.PayloadSizeInBytes), std::to_string(info.AttributeSizeInBytes));
  }
  out += ";\n; Resource Bindings:\n;\n";
  add_line("Name", std::string("HLSL Bind"), std::string("Space"), std::string("Count"));
  for (const rtapi::ShaderBindingInfo& binding : reflection.Bindings) {
    const bool is_unbounded = binding.Count == 0xFFFFFFFFu;
    add_line(binding.Name, binding.RegisterClass + std::to_string(binding.Register),
             std::to_string(binding.Space),
             is_unbounded ? std::string("unbounded") : std::to_string(binding.Count));
  }
  return out + ";\n";
}

std::optional<std::string> read_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

}  // namespace kaamos::d3d12
