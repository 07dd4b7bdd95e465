// SPDX-License-Identifier: MIT
//
// Ray tracing, compute and graphics pipelines as this backend runs them: linked exports, flattened
// to what a call needs.
#pragma once

#include <deque>
#include <memory>
#include <unordered_map>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/backend/linked_graphics.h"
#include "runtime/embree/shader_record.h"

namespace kaamos::embree {

class RaytracingPipeline final : public runtime::BackendPipeline {
 public:
  explicit RaytracingPipeline(std::shared_ptr<const runtime::LinkedPipeline> linked);

  const runtime::LinkedPipeline& linked() const { return *linked_; }
  TargetLookup lookup() const { return {find, this}; }
  // Indexed by Shader::number.
  const std::vector<const runtime::LinkedShader*>& shaders() const { return shaders_; }

 private:
  static const RecordTarget* find(const void* self, const uint8_t* identifier);
  Shader add(const runtime::LinkedShader* shader);

  std::shared_ptr<const runtime::LinkedPipeline> linked_;
  std::vector<const runtime::LinkedShader*> shaders_;
  std::unordered_map<const runtime::LinkedShader*, uint32_t> numbers_;
  std::unordered_map<const runtime::LinkedRecord*, RecordTarget> targets_;  // nodes do not move
};

class ComputePipeline final : public runtime::BackendPipeline {
 public:
  explicit ComputePipeline(std::shared_ptr<const runtime::LinkedCompute> linked);

  const shader::ComputeDesc& compute() const { return *linked_->shader.code->compute; }
  const Shader& shader() const { return shader_; }

 private:
  std::shared_ptr<const runtime::LinkedCompute> linked_;
  Shader shader_;
};

class GraphicsPipeline final : public runtime::BackendPipeline {
 public:
  explicit GraphicsPipeline(std::shared_ptr<const runtime::LinkedGraphics> linked);

  const runtime::LinkedGraphics& linked() const { return *linked_; }
  const Shader& vertex() const { return vertex_; }
  const Shader& pixel() const { return pixel_; }  // runs nothing if there is none
  const Shader& geometry() const { return geometry_; }

 private:
  std::shared_ptr<const runtime::LinkedGraphics> linked_;
  Shader vertex_;
  Shader pixel_;
  Shader geometry_;
};

}  // namespace kaamos::embree
