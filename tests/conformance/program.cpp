// SPDX-License-Identifier: MIT
#include "tests/conformance/program.h"

#include <shaders/ser.h>
#include <shaders/standard.h>

namespace kaamos::conformance {

using namespace rtapi;

Ray ray_at(float x, float y) {
  Ray ray;
  ray.origin[0] = x + 0.1f;
  ray.origin[1] = y;
  return ray;
}

std::vector<Seen> seen_of(const std::vector<uint32_t>& words, size_t count) {
  std::vector<Seen> out(count);
  std::memcpy(out.data(), words.data(), count * sizeof(Seen));
  return out;
}

Program::Program(Context& t, const shader::LibraryDesc* library, std::vector<std::string> exports,
                 const char* global_signature)
    : context_(&t) {
  DxilLibraryDesc code;
  code.DXILLibrary = LoadShaderLibrary(library).value();
  for (const std::string& name : exports) code.Exports.push_back({name, ""});
  global = t.device().CreateRootSignature(global_signature).value();
  desc.Add(code);
  desc.Add(RaytracingShaderConfig{64, 32});
  desc.Add(RaytracingPipelineConfig1{3});
  desc.Add(GlobalRootSignature{global});
}

void Program::group(const std::string& name, const std::string& closest, const std::string& any,
                    const std::string& intersection) {
  HitGroupDesc out;
  out.HitGroupExport = name;
  out.ClosestHitShaderImport = closest;
  out.AnyHitShaderImport = any;
  out.IntersectionShaderImport = intersection;
  if (!intersection.empty()) out.Type = HitGroupType::kProceduralPrimitive;
  desc.Add(out);
}

void Program::local(const std::string& signature, const std::vector<std::string>& exports) {
  const RootSignature root = context_->device().CreateRootSignature(signature).value();
  desc.Associate(desc.Add(LocalRootSignature{root}), exports);
}

namespace {

// The only subobjects that tests change in place.
std::string configs_of(const StateObjectDesc& desc) {
  std::string out;
  for (const StateSubobject& each : desc.Subobjects) {
    if (const auto* shader = std::get_if<RaytracingShaderConfig>(&each)) {
      out += ", payload " + std::to_string(shader->MaxPayloadSizeInBytes) + ", attributes " +
             std::to_string(shader->MaxAttributeSizeInBytes);
    } else if (const auto* config = std::get_if<RaytracingPipelineConfig1>(&each)) {
      out += ", depth " + std::to_string(config->MaxTraceRecursionDepth) + ", flags " +
             std::to_string(static_cast<uint32_t>(config->Flags));
    } else if (const auto* old = std::get_if<RaytracingPipelineConfig>(&each)) {
      out += ", depth " + std::to_string(old->MaxTraceRecursionDepth);
    }
  }
  return out;
}

}  // namespace

// Tier 1.0 knows no pipeline config 1, which differs by its flags.
void Program::suit_tier() {
  if (context_->target().tier >= RaytracingTier::kTier1_1) return;
  for (StateSubobject& each : desc.Subobjects) {
    const auto* config = std::get_if<RaytracingPipelineConfig1>(&each);
    if (config == nullptr || config->Flags != RaytracingPipelineFlags::kNone) continue;
    each = RaytracingPipelineConfig{config->MaxTraceRecursionDepth};
  }
}

void Program::create() {
  if (pipeline) return;
  suit_tier();
  if (shared_name_.empty() || desc.Subobjects.size() != shared_size_) {
    pipeline = try_create().value();
  } else {
    SharedDevice::Pipeline& shared = context_->pipelines()[shared_name_ + configs_of(desc)];
    if (!shared.object) shared = {try_create().value(), global};
    pipeline = shared.object;
    global = shared.global;
  }
  for (const char* name : {"ray generation", "miss", "hit", "callable"}) {
    shader_tables.emplace_back(pipeline, name);
  }
}

void Program::share_as(const std::string& name) {
  shared_name_ = name;
  shared_size_ = desc.Subobjects.size();
}

uint32_t Program::add(size_t table, const std::string& name,
                      const std::vector<LocalArgument>& arguments) {
  create();
  if (name.empty()) return shader_tables[table].AddNullRecord();
  return shader_tables[table].AddRecord(name, arguments).value();
}

uint32_t Program::raygen(const std::string& name, std::vector<LocalArgument> arguments) {
  return add(0, name, arguments);
}

uint32_t Program::miss(const std::string& name, std::vector<LocalArgument> arguments) {
  return add(1, name, arguments);
}

uint32_t Program::hit(const std::string& name, std::vector<LocalArgument> arguments) {
  return add(2, name, arguments);
}

uint32_t Program::callable(const std::string& name, std::vector<LocalArgument> arguments) {
  return add(3, name, arguments);
}

DispatchRaysDesc Program::tables() {
  for (ShaderTable& table : shader_tables) {
    if (table.record_count() > 0) table.Build(context_->device()).value();
  }
  DispatchRaysDesc out;
  out.RayGenerationShaderRecord = shader_tables[0].GetRecord(0);
  out.MissShaderTable = shader_tables[1].GetTable();
  out.HitGroupTable = shader_tables[2].GetTable();
  out.CallableShaderTable = shader_tables[3].GetTable();
  return out;
}

DispatchRaysDesc Program::tables_without_miss() {
  DispatchRaysDesc out = tables();
  const Buffer records = context_->upload(std::vector<uint32_t>(16));
  out.MissShaderTable = {records.GetGPUVirtualAddress(), records.size(), 32};
  return out;
}

std::vector<uint32_t> Program::run(const DispatchRaysDesc& dispatch) {
  const Buffer words = context_->zeros(word_bytes);
  CommandList list = context_->device().CreateCommandList().value();
  list.SetComputeRootSignature(global);
  list.SetPipelineState1(pipeline);
  if (scene) list.SetComputeRootShaderResourceView(0, scene.GetGPUVirtualAddress());
  if (rays) list.SetComputeRootShaderResourceView(1, rays.GetGPUVirtualAddress());
  if (bind) bind(list);
  list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  list.DispatchRays(dispatch);
  context_->queue().ExecuteAndWait(list).value();
  return context_->read(words);
}

std::vector<uint32_t> Program::run(uint32_t width, uint32_t height, uint32_t depth) {
  DispatchRaysDesc dispatch = tables();
  dispatch.Width = width;
  dispatch.Height = height;
  dispatch.Depth = depth;
  return run(dispatch);
}

namespace {

std::vector<std::string> with_standard_exports(std::vector<std::string> exports) {
  for (const char* name : {"Trace", "WriteOrdinal", "Miss", "Closest", "Count", "Ignore", "Boxed",
                           "BoxClosest", "BoxCount", "BoxIgnore"}) {
    exports.push_back(name);
  }
  return exports;
}

}  // namespace

Standard::Standard(Context& t, const shader::LibraryDesc* library,
                   std::vector<std::string> more_exports, const char* global_signature)
    : Program(t,
              library != nullptr               ? library
              : t.traces_through_hit_objects() ? kaamos_shaders_ser()
                                               : kaamos_shaders_standard(),
              with_standard_exports(more_exports), global_signature),
      context_(&t) {
  group("Plain", "Closest");
  group("Counted", "Closest", "Count");
  group("Ignored", "Closest", "Ignore");
  group("Box", "BoxClosest", "", "Boxed");
  group("BoxCounted", "BoxClosest", "BoxCount", "Boxed");
  group("BoxIgnored", "BoxClosest", "BoxIgnore", "Boxed");
  local(kRecordSignature,
        {"Plain", "Counted", "Ignored", "Box", "BoxCounted", "BoxIgnored", "Miss", "WriteOrdinal"});
  if (library == nullptr && more_exports.empty()) {
    share_as(std::string(t.traces_through_hit_objects() ? "by hit objects, " : "standard, ") +
             global_signature);
  }
}

void Standard::set_pipeline_flags(RaytracingPipelineFlags flags) {
  for (StateSubobject& each : desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingPipelineConfig1>(&each)) config->Flags = flags;
  }
}

uint32_t Standard::record(const std::string& name, float reported_t, uint32_t reported_kind) {
  create();
  const uint32_t ordinal = shader_tables[2].record_count();
  if (name.empty()) return hit("");
  return hit(name, {LocalArgument::Constants(Constants{ordinal, reported_t, reported_kind, 0})});
}

void Standard::records(const std::string& name, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) record(name);
}

void Standard::miss_records(uint32_t count) {
  for (uint32_t i = 0; i < count; ++i)
    miss("Miss", {LocalArgument::Constants(Constants{1000 + i})});
}

void Standard::prepare(const std::vector<Ray>& list) {
  create();
  if (shader_tables[0].record_count() == 0) raygen("Trace");
  if (shader_tables[1].record_count() == 0) miss_records(1);
  rays = context_->upload(list);
}

std::vector<Seen> Standard::trace(const std::vector<Ray>& list) {
  prepare(list);
  const auto words = run(static_cast<uint32_t>(list.size()));
  intersections_ = words[kIntersectionWord];
  return seen_of(words, list.size());
}

Seen Standard::trace(const Buffer& top_level, const Ray& ray) {
  scene = top_level;
  return trace(ray);
}

}  // namespace kaamos::conformance
