// SPDX-License-Identifier: MIT
//
// A Vulkan device with pipelines linked by hand from GLSL. The tests of this folder run on it,
// without the HLSL compiler and without the API layer of rtapi.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "runtime/vulkan/rays/dispatch.h"
#include "runtime/vulkan/rays/state_object.h"
#include "runtime/vulkan/testing/scene_harness.h"

namespace kaamos::vulkan::testing {

// Builds what rtapi's linker would build.
class PipelineBuilder {
 public:
  explicit PipelineBuilder(uint32_t max_recursion_depth = 1);

  // A shader from GLSL, behind the preamble of glsl.h. `slots` are for the library's bindings.
  const runtime::LinkedShader* shader(shader::Stage stage, const std::string& glsl,
                                      std::vector<shader::BindingSlot> slots = {});
  // A shader without SPIR-V.
  const runtime::LinkedShader* native_shader(shader::Stage stage);
  rtapi::ShaderIdentifier record(runtime::RecordKind kind, const runtime::LinkedShader* shader);
  rtapi::ShaderIdentifier hit_group(const runtime::LinkedShader* closest_hit,
                                    const runtime::LinkedShader* any_hit = nullptr,
                                    const runtime::LinkedShader* intersection = nullptr);
  rtapi::ShaderIdentifier ray_generation(const std::string& glsl);
  rtapi::ShaderIdentifier miss(const std::string& glsl);
  rtapi::ShaderIdentifier callable(const std::string& glsl);

  std::shared_ptr<runtime::LinkedPipeline> pipeline() { return pipeline_; }
  std::shared_ptr<const runtime::LinkedCompute> compute(const std::string& glsl);

 private:
  // Code that the linked objects point to; it lives as long as they do.
  struct Code {
    std::vector<uint32_t> words;
    shader::ExportDesc desc = {};
    shader::LibraryDesc library = {};
    shader::ComputeDesc compute = {};
  };
  std::shared_ptr<Code> code(shader::Stage stage, const std::string& glsl, bool spirv = true);
  rtapi::ShaderIdentifier add(std::unique_ptr<runtime::LinkedRecord> record);

  std::shared_ptr<runtime::LinkedPipeline> pipeline_ = std::make_shared<runtime::LinkedPipeline>();
};

// Runs dispatches in a scene.
class Bench {
 public:
  explicit Bench(std::shared_ptr<Gpu> gpu);

  std::shared_ptr<runtime::BackendBuffer> buffer(uint64_t size_bytes) {
    return scene.buffer(size_bytes);
  }
  // A table of 64-byte records with these identifiers; each record's first local argument is its
  // index.
  std::shared_ptr<runtime::BackendBuffer> table(const std::vector<rtapi::ShaderIdentifier>& ids);
  static rtapi::GpuVirtualAddressRangeAndStride range(
      const std::shared_ptr<runtime::BackendBuffer>& table, uint64_t stride_bytes = 64);

  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create(
      std::shared_ptr<const runtime::LinkedPipeline> linked) {
    return RaytracingPipeline::create(layout, std::move(linked));
  }
  // The addresses given are the root arguments.
  CountedOutcome rays(const std::shared_ptr<runtime::BackendPipeline>& pipeline,
                      const rtapi::DispatchRaysDesc& desc, std::vector<uint64_t> arguments);
  CountedOutcome groups(const std::shared_ptr<runtime::BackendPipeline>& pipeline, uint32_t x,
                        uint32_t y, uint32_t z, std::vector<uint64_t> arguments);

  SceneHarness scene;
  std::shared_ptr<DescriptorSet> descriptors;
  std::shared_ptr<PipelineLayout> layout;
  DispatchMemory scratch;
  GridLimits limits;  // for the next dispatches
};

inline uint32_t* words_of(const std::shared_ptr<runtime::BackendBuffer>& buffer) {
  return reinterpret_cast<uint32_t*>(buffer->host());
}

}  // namespace kaamos::vulkan::testing
