// SPDX-License-Identifier: MIT
#include "tests/shaders/runner.h"

#include <rtapi/error_ids.h>
#include <rtapi/shader_table.h>
#include <rtapi/state_object.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

namespace kaamos::hlsl {
extern const std::pair<std::string_view, std::string_view> kTestHeaders[];  // [CMakeLists.txt]
}

namespace kaamos::shader_tests {
namespace {

using rtapi::ShaderBindingInfo;
using rtapi::ShaderResourceType;

constexpr uint32_t kSceneSpace = 9999;  // TestScene, the lone triangle and the lone box
// The size of every buffer that a test declares.
constexpr uint64_t kBufferBytes = 64 * 1024;
constexpr char kOwnHeader[] = "kaamos/test.hlsli";

std::optional<std::string> read_file(const std::string& path) {
  if (path.ends_with(kOwnHeader)) return std::string(hlsl::kTestHeaders[0].second);
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

rtapi::ShaderCompileOptions compile_options(const Source& source) {
  rtapi::ShaderCompileOptions out;
  out.File = source.options.path;
  out.Source = source.text;
  out.Target = source.options.target;
  out.Experimental = out.Target.ends_with("_10");
  out.Defines = source.options.defines;
  out.IncludeDirectories = source.options.include_folders;
  out.IncludeDirectories.emplace_back(".");  // where kaamos/test.hlsli is found
  out.ReadFile = read_file;
  return out;
}

std::string text_of(const std::vector<rtapi::ShaderDiagnostic>& diagnostics) {
  std::string out;
  for (const rtapi::ShaderDiagnostic& one : diagnostics) {
    if (one.Severity == rtapi::ShaderDiagnosticSeverity::kError) out += one.Text + "\n";
  }
  return out;
}

// "UAV(u0, space = 1)"; empty: no root parameter holds it.
std::string parameter_of(const ShaderBindingInfo& binding) {
  const bool is_bytes = binding.Type == ShaderResourceType::kByteAddressBuffer ||
                        binding.Type == ShaderResourceType::kStructuredBuffer ||
                        binding.Type == ShaderResourceType::kConstantBuffer ||
                        binding.Type == ShaderResourceType::kAccelerationStructure;
  if (!is_bytes || binding.Count != 1) return {};
  const std::string view = binding.RegisterClass == 'b'   ? "CBV"
                           : binding.RegisterClass == 'u' ? "UAV"
                                                          : "SRV";
  return view + "(" + binding.RegisterClass + std::to_string(binding.Register) +
         ", space = " + std::to_string(binding.Space) + ")";
}

// Whether a local root signature has the binding's register, by a constant or a descriptor of its
// own; the records of tests have no descriptor tables.
bool has_register(const rtapi::RootSignatureDesc& signature, const ShaderBindingInfo& binding) {
  using Type = rtapi::RootParameterType;
  for (const rtapi::RootParameter& parameter : signature.Parameters) {
    if (parameter.ParameterType == Type::kDescriptorTable) continue;
    const bool constants = parameter.ParameterType == Type::k32BitConstants;
    const char register_class = constants || parameter.ParameterType == Type::kCbv ? 'b'
                                : parameter.ParameterType == Type::kUav            ? 'u'
                                                                                   : 't';
    const uint32_t number =
        constants ? parameter.Constants.ShaderRegister : parameter.Descriptor.ShaderRegister;
    const uint32_t space =
        constants ? parameter.Constants.RegisterSpace : parameter.Descriptor.RegisterSpace;
    if (register_class == binding.RegisterClass && number == binding.Register &&
        space == binding.Space) {
      return true;
    }
  }
  return false;
}

// "(0,0,0): text" of "KA0845 printf: (0,0,0): text".
std::string after_title(const std::string& text) {
  const size_t colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

constexpr std::string_view kValues = "[values] ";
constexpr std::string_view kSkipped = "[skipped] ";

}  // namespace

bool is_executor(const std::string& name) {
  return name == "interpreter" || name == "embree" || name == "vulkan";
}

Source read_source(const SourceOptions& options) {
  Source out;
  out.options = options;
  auto text = read_file(options.path);
  if (!text) {
    out.error = "\"" + options.path + "\" cannot be read";
    return out;
  }
  out.text = *std::move(text);
  out.dependencies.push_back(options.path);
  rtapi::ShaderCompileOptions compile = compile_options(out);
  compile.ReadFile = [&](const std::string& path) {
    auto found = read_file(path);
    if (found && !path.ends_with(kOwnHeader)) out.dependencies.push_back(path);
    return found;
  };
  const rtapi::ShaderPreprocessing plain = rtapi::PreprocessShader(compile);
  if (!plain.Status.ok()) {
    out.error = text_of(plain.Diagnostics);
    return out;
  }
  out.tests = find_tests(plain.Text, options.path);
  out.scene = read_scene(out.text, std::filesystem::path(options.path).parent_path().string());
  out.dependencies.insert(out.dependencies.end(), out.scene.files.begin(), out.scene.files.end());
  out.records = table_records(out.tests, out.scene);
  if (!out.records.error.empty()) out.error = options.path + ": " + out.records.error;
  if (!out.scene.error.empty()) out.error = options.path + ", " + out.scene.error;
  if (!out.tests.error.empty()) out.error = out.tests.error;
  return out;
}

Runner::Runner(const Source& source, std::string executor)
    : source_(source), executor_(std::move(executor)) {}

std::string Runner::prepare() {
  rtapi::ShaderCompileOptions options = compile_options(source_);
  const size_t lines =
      static_cast<size_t>(std::count(source_.text.begin(), source_.text.end(), '\n'));
  *options.Source += "\n#line " + std::to_string(lines + 2) + " \"" + options.File + "\"\n" +
                     source_.tests.entry_points;
  for (rtapi::ShaderDefine& define : record_defines(source_.records)) {
    options.Defines.push_back(std::move(define));
  }
  options.Interpret = executor_ != "embree";  // Vulkan needs no native code
  options.Spirv = executor_ == "vulkan";
  options.Quick = true;
  options.NoWarnings = true;
  compiled_ = rtapi::CompileShaderLibrary(options);
  if (!compiled_.Status.ok()) {
    const std::string diagnostics = text_of(compiled_.Diagnostics);
    return diagnostics.empty() ? compiled_.Status.error().message : diagnostics;
  }
  bindings_ = compiled_.Reflection.Bindings;
  for (const std::string& text : source_.tests.local_root_signatures) {
    const auto signature = rtapi::ParseRootSignature(text);
    if (!signature.ok()) continue;  // the compiler has said so
    std::erase_if(bindings_,
                  [&](const auto& binding) { return has_register(*signature, binding); });
  }
  for (const ShaderBindingInfo& binding : bindings_) {
    const std::string parameter = parameter_of(binding);
    if (parameter.empty()) {
      return "\"" + binding.Name +
             "\" cannot be bound: tests have constant, raw and structured buffers (zeros of 64 "
             "KiB) "
             "and TestScene; pass other values as arguments";
    }
    root_signature_text_ += (root_signature_text_.empty() ? "" : ", ") + parameter;
  }
  return make_device();
}

std::string Runner::make_device() {
  rtapi::DeviceDesc desc;
  desc.Backend = executor_ == "vulkan" ? "vulkan" : "embree";
  if (source_.options.target.ends_with("_10")) desc.ShaderModel = rtapi::ShaderModel::k6_10;
  desc.OnMessage = [this](const rtapi::Message& message) { hear(message); };
  auto device = rtapi::CreateDevice(desc);
  if (!device.ok()) {
    has_no_device_ = true;
    return device.error().message;
  }
  device_ = *device;
  auto queue = device_.CreateCommandQueue();
  if (!queue.ok()) return queue.error().message;
  queue_ = *queue;
  auto signature = device_.CreateRootSignature(root_signature_text_);
  if (!signature.ok()) return signature.error().message;
  root_signature_ = *signature;
  rays_pipeline_ = {};
  for (std::optional<Scene>& scene : scenes_) scene.reset();
  return {};
}

void Runner::hear(const rtapi::Message& message) {
  if (tell_ == nullptr) return;
  std::string text = after_title(message.Text);
  if (message.Id == rtapi::error_ids::backend::kShaderPrint) {
    const size_t begin = text.find(": ") + 2;
    const std::string_view said = std::string_view(text).substr(begin);
    if (said.starts_with(kValues)) {
      values_ = said.substr(kValues.size());
    } else if (said.starts_with(kSkipped)) {
      (*tell_)({Report::Kind::kSkipped, std::string(said.substr(kSkipped.size()))});
    } else {
      (*tell_)({Report::Kind::kOutput, text});
    }
    return;
  }
  if (message.Id == rtapi::error_ids::backend::kShaderError) {
    const size_t begin = text.find(": ");
    const std::string thread = text.substr(0, begin);
    text = text.substr(begin + 2);
    if (!values_.empty()) text += "\n  " + values_;
    if (thread != "(0,0,0)") text += "\n  in thread " + thread;
    values_.clear();
    (*tell_)({Report::Kind::kFailure, text});
    return;
  }
  const bool is_error = message.Severity == rtapi::MessageSeverity::kError;
  (*tell_)({is_error ? Report::Kind::kFailure : Report::Kind::kOutput, message.Text});
}

rtapi::GpuVirtualAddress Runner::resource(const ShaderBindingInfo& binding) {
  if (binding.Type == ShaderResourceType::kAccelerationStructure) {
    if (binding.Space != kSceneSpace || binding.Register >= std::size(scenes_)) return 0;
    std::optional<Scene>& scene = scenes_[binding.Register];
    if (!scene) {
      scene = build_scene(
          device_, queue_,
          binding.Register == 0 ? source_.scene : lone_primitive(binding.Register == 2));
    }
    return scene->top_level.GetGPUVirtualAddress();
  }
  rtapi::BufferDesc desc;
  desc.SizeInBytes = kBufferBytes;
  desc.Name = binding.Name;
  if (binding.RegisterClass == 'u') {
    desc.Flags = rtapi::ResourceFlags::kAllowUnorderedAccess;
    desc.InitialState = rtapi::ResourceStates::kUnorderedAccess;
  } else {
    desc.Heap = rtapi::HeapType::kUpload;
    desc.InitialState = rtapi::ResourceStates::kGenericRead;
  }
  buffers_.push_back(device_.CreateBuffer(desc).value());
  return buffers_.back().GetGPUVirtualAddress();
}

void Runner::bind(rtapi::CommandList& list, bool of_draws) {
  using List = rtapi::CommandList;
  using SetView = void (List::*)(uint32_t, rtapi::GpuVirtualAddress);
  of_draws ? list.SetGraphicsRootSignature(root_signature_)
           : list.SetComputeRootSignature(root_signature_);
  uint32_t parameter = 0;
  for (const ShaderBindingInfo& binding : bindings_) {
    const SetView set_view =
        binding.RegisterClass == 'u'   ? of_draws ? &List::SetGraphicsRootUnorderedAccessView
                                                  : &List::SetComputeRootUnorderedAccessView
        : binding.RegisterClass == 'b' ? of_draws ? &List::SetGraphicsRootConstantBufferView
                                                  : &List::SetComputeRootConstantBufferView
        : of_draws                     ? &List::SetGraphicsRootShaderResourceView
                                       : &List::SetComputeRootShaderResourceView;
    (list.*set_view)(parameter++, resource(binding));
  }
}

// All tests that trace have one pipeline, of everything in the file.
const rtapi::StateObject& Runner::rays_pipeline() {
  if (rays_pipeline_) return rays_pipeline_;
  rtapi::StateObjectDesc desc;
  desc.Type = rtapi::StateObjectType::kRaytracingPipeline;
  desc.Subobjects.emplace_back(rtapi::DxilLibraryDesc{compiled_.Library, {}});
  desc.Subobjects.emplace_back(rtapi::GlobalRootSignature{root_signature_});
  if (!source_.tests.has_shader_config) {
    desc.Subobjects.emplace_back(rtapi::RaytracingShaderConfig{256, 32});
  }
  if (!source_.tests.has_pipeline_config) {
    desc.Subobjects.emplace_back(rtapi::RaytracingPipelineConfig{8});
  }
  rays_pipeline_ = device_.CreateStateObject(desc).value();
  return rays_pipeline_;
}

void Runner::dispatch_rays(const TestRun& test, rtapi::CommandList& list) {
  const rtapi::StateObject& pipeline = rays_pipeline();
  const auto build = [&](const std::vector<SceneRecord>& of, const char* name,
                         bool ends_with_null = false) {
    rtapi::ShaderTable made(pipeline, name);
    for (const SceneRecord& record : of) {
      std::vector<rtapi::LocalArgument> arguments;
      for (const std::vector<uint32_t>& constants : record.constants) {
        arguments.push_back(rtapi::LocalArgument::Constants(std::span<const uint32_t>(constants)));
      }
      made.AddRecord(record.export_name, arguments).value();
    }
    if (ends_with_null) made.AddNullRecord();
    if (made.record_count() != 0) made.Build(device_).value();
    return made;
  };
  const TableRecords& records = source_.records;
  const rtapi::ShaderTable start = build({{test.entry, {}}}, "ray generation");
  const rtapi::ShaderTable miss = build(records.miss_shaders, "miss shaders", true);
  const rtapi::ShaderTable hit = build(records.hit_groups, "hit groups");
  const rtapi::ShaderTable callable = build(records.callable_shaders, "callable shaders");
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = start.GetRecord(0);
  desc.MissShaderTable = miss.GetTable();
  if (hit.record_count() != 0) desc.HitGroupTable = hit.GetTable();
  if (callable.record_count() != 0) desc.CallableShaderTable = callable.GetTable();
  desc.Width = test.size[0];
  desc.Height = test.size[1];
  desc.Depth = test.size[2];
  bind(list);
  list.SetPipelineState1(pipeline);
  list.DispatchRays(desc);
  for (const rtapi::ShaderTable* table : {&start, &miss, &hit, &callable}) {
    buffers_.push_back(table->buffer());
  }
}

void Runner::draw(const TestRun& test, rtapi::CommandList& list) {
  rtapi::GraphicsPipelineStateDesc desc;
  desc.pRootSignature = root_signature_;
  desc.VS = {compiled_.Library, kVertexShader};
  desc.PS = {compiled_.Library, test.entry};
  desc.DepthStencilState.DepthEnable = false;
  desc.Name = test.name;
  const rtapi::PipelineState pipeline = device_.CreateGraphicsPipelineState(desc).value();
  bind(list, true);
  list.SetPipelineState(pipeline);
  list.IASetPrimitiveTopology(rtapi::PrimitiveTopology::kTriangleList);
  const auto width = static_cast<float>(test.size[0]);
  const auto height = static_cast<float>(test.size[1]);
  list.RSSetViewports(rtapi::Viewport{0, 0, width, height});
  list.RSSetScissorRects(
      rtapi::Rect{0, 0, static_cast<int32_t>(test.size[0]), static_cast<int32_t>(test.size[1])});
  list.DrawInstanced(3, 1, 0, 0);
}

void Runner::dispatch(const TestRun& test, rtapi::CommandList& list) {
  const rtapi::PipelineState pipeline =
      device_
          .CreateComputePipelineState({root_signature_, compiled_.Library, test.entry, test.name})
          .value();
  bind(list);
  list.SetPipelineState(pipeline);
  list.Dispatch(test.size[0], test.size[1], test.size[2]);
}

void Runner::run(const TestRun& test, const Tell& tell) {
  tell_ = &tell;
  values_.clear();
  try {
    rtapi::CommandList list = device_.CreateCommandList().value();
    switch (test.stage) {
      case TestStage::kCompute:
        dispatch(test, list);
        break;
      case TestStage::kRays:
        dispatch_rays(test, list);
        break;
      case TestStage::kPixels:
        draw(test, list);
        break;
    }
    queue_.ExecuteAndWait(list).value();
  } catch (const rtapi::ResultError& error) {
    tell({Report::Kind::kFailure, error.what()});
  }
  tell_ = nullptr;
  buffers_.clear();
  if (device_.GetDeviceRemovedReason().ok()) return;
  const std::string error = make_device();
  if (!error.empty()) tell({Report::Kind::kFailure, error});
}

}  // namespace kaamos::shader_tests
