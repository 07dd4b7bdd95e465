// SPDX-License-Identifier: MIT
#include "runtime/embree/state_object.h"

#include <utility>

namespace kaamos::embree {
namespace {

Shader flatten(const runtime::LinkedShader& shader, uint32_t number) {
  return {shader.name.c_str(),
          shader.code->entry,
          shader.slots.data(),
          static_cast<uint32_t>(shader.stack_bytes),
          (shader.code->flags & shader::kExportReadsHitKind) != 0,
          number,
          &shader};
}

}  // namespace

RaytracingPipeline::RaytracingPipeline(std::shared_ptr<const runtime::LinkedPipeline> linked)
    : linked_(std::move(linked)) {
  for (const auto& record : linked_->records) {
    RecordTarget target;
    target.kind = record->kind;
    target.procedural = record->hit_group_type == rtapi::HitGroupType::kProceduralPrimitive;
    target.shader = add(record->shader);
    target.any_hit = add(record->any_hit);
    target.closest_hit = add(record->closest_hit);
    target.intersection = add(record->intersection);
    targets_.emplace(record.get(), target);
  }
}

Shader RaytracingPipeline::add(const runtime::LinkedShader* shader) {
  if (shader == nullptr) return {};
  const auto next = static_cast<uint32_t>(shaders_.size());
  const auto [place, is_new] = numbers_.emplace(shader, next);
  if (is_new) shaders_.push_back(shader);
  return flatten(*shader, place->second);
}

const RecordTarget* RaytracingPipeline::find(const void* self, const uint8_t* identifier) {
  const auto& pipeline = *static_cast<const RaytracingPipeline*>(self);
  const runtime::LinkedRecord* record = pipeline.linked_->identifiers.find(identifier);
  if (record == nullptr) return nullptr;
  const auto target = pipeline.targets_.find(record);
  return target == pipeline.targets_.end() ? nullptr : &target->second;
}

ComputePipeline::ComputePipeline(std::shared_ptr<const runtime::LinkedCompute> linked)
    : linked_(std::move(linked)), shader_(flatten(linked_->shader, 0)) {}

GraphicsPipeline::GraphicsPipeline(std::shared_ptr<const runtime::LinkedGraphics> linked)
    : linked_(std::move(linked)), vertex_(flatten(linked_->vertex, 0)) {
  uint32_t number = 1;
  if (linked_->has_pixel()) pixel_ = flatten(linked_->pixel, number++);
  if (linked_->has_geometry()) geometry_ = flatten(linked_->geometry, number);
}

}  // namespace kaamos::embree
