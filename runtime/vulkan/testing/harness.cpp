// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/harness.h"

#include <algorithm>
#include <cstring>

#include "runtime/vulkan/testing/glsl.h"

namespace kaamos::vulkan::testing {
namespace {

rtapi::ShaderIdentifier next_identifier() {
  static uint32_t next = 1;
  rtapi::ShaderIdentifier identifier = {};
  const uint64_t words[4] = {next, next * 77ull, 3, 4};
  ++next;
  std::memcpy(identifier.data(), words, sizeof(words));
  return identifier;
}

runtime::RootBindings state_of(const std::vector<uint64_t>& arguments) {
  auto root = std::make_shared<runtime::RootArguments>();
  std::copy(arguments.begin(), arguments.end(), reinterpret_cast<uint64_t*>(root->bytes.data()));
  return {root, nullptr, nullptr};
}

}  // namespace

PipelineBuilder::PipelineBuilder(uint32_t max_recursion_depth) {
  pipeline_->name = "test";
  pipeline_->max_recursion_depth = max_recursion_depth;
}

std::shared_ptr<PipelineBuilder::Code> PipelineBuilder::code(shader::Stage stage,
                                                             const std::string& glsl, bool spirv) {
  auto made = std::make_shared<Code>();
  if (spirv) made->words = compile_shader(stage, glsl);
  made->desc.name = made->desc.mangled_name = "test";
  made->desc.stage = stage;
  made->desc.compute = stage == shader::Stage::kCompute ? &made->compute : nullptr;
  if (glsl.find("executeCallableEXT") != std::string::npos) {
    made->desc.flags |= shader::kExportCalls;
  }
  if (glsl.find("// uses hit objects") != std::string::npos) {
    made->desc.flags |= shader::kExportUsesHitObject;
  }
  made->desc.spirv = spirv ? made->words.data() : nullptr;
  made->desc.spirv_words = static_cast<uint32_t>(made->words.size());
  made->library.name = "test.hlsl";
  return made;
}

const runtime::LinkedShader* PipelineBuilder::shader(shader::Stage stage, const std::string& glsl,
                                                     std::vector<shader::BindingSlot> slots) {
  auto made = code(stage, glsl);
  auto linked = std::make_unique<runtime::LinkedShader>();
  linked->name = "shader" + std::to_string(pipeline_->shaders.size());
  linked->stage = stage;
  linked->code = &made->desc;
  linked->library = &made->library;
  linked->slots = std::move(slots);
  pipeline_->keep_alive.push_back(made);
  pipeline_->shaders.push_back(std::move(linked));
  return pipeline_->shaders.back().get();
}

const runtime::LinkedShader* PipelineBuilder::native_shader(shader::Stage stage) {
  auto made = code(stage, "", false);
  auto linked = std::make_unique<runtime::LinkedShader>();
  linked->name = "native";
  linked->stage = stage;
  linked->code = &made->desc;
  linked->library = &made->library;
  pipeline_->keep_alive.push_back(made);
  pipeline_->shaders.push_back(std::move(linked));
  return pipeline_->shaders.back().get();
}

rtapi::ShaderIdentifier PipelineBuilder::add(std::unique_ptr<runtime::LinkedRecord> record) {
  record->identifier = next_identifier();
  pipeline_->identifiers.insert(record.get());
  const rtapi::ShaderIdentifier identifier = record->identifier;
  pipeline_->records.push_back(std::move(record));
  return identifier;
}

rtapi::ShaderIdentifier PipelineBuilder::record(runtime::RecordKind kind,
                                                const runtime::LinkedShader* shader) {
  auto made = std::make_unique<runtime::LinkedRecord>();
  made->kind = kind;
  made->shader = shader;
  return add(std::move(made));
}

rtapi::ShaderIdentifier PipelineBuilder::hit_group(const runtime::LinkedShader* closest_hit,
                                                   const runtime::LinkedShader* any_hit,
                                                   const runtime::LinkedShader* intersection) {
  auto made = std::make_unique<runtime::LinkedRecord>();
  made->kind = runtime::RecordKind::kHitGroup;
  made->hit_group_type = intersection == nullptr ? rtapi::HitGroupType::kTriangles
                                                 : rtapi::HitGroupType::kProceduralPrimitive;
  made->closest_hit = closest_hit;
  made->any_hit = any_hit;
  made->intersection = intersection;
  return add(std::move(made));
}

rtapi::ShaderIdentifier PipelineBuilder::ray_generation(const std::string& glsl) {
  return record(runtime::RecordKind::kRayGeneration, shader(shader::Stage::kRayGeneration, glsl));
}
rtapi::ShaderIdentifier PipelineBuilder::miss(const std::string& glsl) {
  return record(runtime::RecordKind::kMiss, shader(shader::Stage::kMiss, glsl));
}
rtapi::ShaderIdentifier PipelineBuilder::callable(const std::string& glsl) {
  return record(runtime::RecordKind::kCallable, shader(shader::Stage::kCallable, glsl));
}

std::shared_ptr<const runtime::LinkedCompute> PipelineBuilder::compute(const std::string& glsl) {
  struct Owner {
    runtime::LinkedCompute linked;
    std::shared_ptr<Code> code;
  };
  auto owner = std::make_shared<Owner>();
  owner->code = code(shader::Stage::kCompute, glsl);
  owner->linked.shader.name = "compute";
  owner->linked.shader.stage = shader::Stage::kCompute;
  owner->linked.shader.code = &owner->code->desc;
  owner->linked.shader.library = &owner->code->library;
  return {owner, &owner->linked};
}

Bench::Bench(std::shared_ptr<Gpu> gpu)
    : scene(gpu),
      descriptors(DescriptorSet::create(gpu).value()),
      layout(PipelineLayout::create(gpu, descriptors).value()) {}

std::shared_ptr<runtime::BackendBuffer> Bench::table(
    const std::vector<rtapi::ShaderIdentifier>& ids) {
  auto made = scene.buffer(64 * ids.size());
  for (size_t i = 0; i < ids.size(); ++i) {
    std::memcpy(made->host() + i * 64, ids[i].data(), 32);
    const auto index = static_cast<uint32_t>(i);
    std::memcpy(made->host() + i * 64 + 32, &index, sizeof(index));
  }
  return made;
}

rtapi::GpuVirtualAddressRangeAndStride Bench::range(
    const std::shared_ptr<runtime::BackendBuffer>& table, uint64_t stride_bytes) {
  return {table->address(), table->size_bytes(), stride_bytes};
}

CountedOutcome Bench::rays(const std::shared_ptr<runtime::BackendPipeline>& pipeline,
                           const rtapi::DispatchRaysDesc& desc, std::vector<uint64_t> arguments) {
  runtime::DispatchRaysCommand command;
  command.pipeline = pipeline;
  command.state = state_of(arguments);
  command.desc = desc;
  return dispatch_rays({&scene.stream(), &scene.memory(), &scene.structures(), &scratch, limits},
                       command, "DispatchRays 0");
}

CountedOutcome Bench::groups(const std::shared_ptr<runtime::BackendPipeline>& pipeline, uint32_t x,
                             uint32_t y, uint32_t z, std::vector<uint64_t> arguments) {
  runtime::DispatchCommand command;
  command.pipeline = pipeline;
  command.state = state_of(arguments);
  command.groups[0] = x;
  command.groups[1] = y;
  command.groups[2] = z;
  return dispatch_compute({&scene.stream(), &scene.memory(), &scene.structures(), &scratch, limits},
                          command, "Dispatch 0");
}

}  // namespace kaamos::vulkan::testing
