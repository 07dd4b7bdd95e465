// SPDX-License-Identifier: MIT
//
// The layer's part in draws: what their shaders and the input assembler read.
#include <string>
#include <vector>

#include "runtime/backend/linked_graphics.h"
#include "runtime/checks/arguments.h"
#include "runtime/checks/layer.h"
#include "runtime/checks/names.h"
#include "runtime/checks/targets.h"

namespace kaamos::checks {

using rtapi::ResourceStates;

void Layer::check(const runtime::DrawCommand& command) {
  draws_.check(command, label());
  const auto input = [&](uint64_t address, ResourceStates state, const std::string& what) {
    hazards_.use(address, state, draws_.who() + ": " + what);
  };
  for (const runtime::LinkedElement& element : command.linked->elements) {
    input(command.state->vertex_buffers[element.slot].BufferLocation,
          ResourceStates::kVertexAndConstantBuffer,
          "the vertex buffer of slot " + std::to_string(element.slot));
  }
  if (command.indexed) {
    input(command.state->index_buffer.BufferLocation, ResourceStates::kIndexBuffer,
          "the index buffer");
  }
  Arguments arguments;
  arguments.global = command.bindings.root_arguments->bytes.data();
  arguments.state = &command.bindings;
  std::vector<ShaderUse> uses;
  for (const runtime::LinkedShader* shader : command.linked->shaders()) {
    const std::string where =
        draws_.who() + ": " + stage_name(shader->stage) + " shader " + in_quotes(shader->name);
    check_arguments(inputs(), *shader, arguments, where);
    for (uint32_t i = 0; i < shader->slots.size(); ++i) {
      const auto& binding = shader->library->bindings[i];
      if (binding.type != shader::BindingType::kAccelerationStructure || binding.count != 1) {
        continue;
      }
      for (const uint64_t address : structures_behind(*shader, i, arguments)) {
        if (address != 0) check_top_level(inputs(), address, where + ", " + binding_name(binding));
      }
    }
    collect_uses(*shader, arguments, where, uses);
  }
  check_feedback(command, uses);
  check_uses(uses);
}

void Layer::check_feedback(const runtime::DrawCommand& command, std::vector<ShaderUse>& uses) {
  const runtime::DrawTargets& targets = command.state->targets;
  const auto drop = [&](const runtime::TargetView& view, const std::string& what,
                        uint32_t plane = 0) {
    if (view.texture == nullptr) return;
    const Subresources bound = subresources_of(view, plane);
    std::erase_if(uses, [&](const ShaderUse& use) {
      if (!use.texture || !textures_.shows(use.address, view.texture.get(), bound)) return false;
      reporter_.report(Id::kTargetRead,
                       use.what + " is a view of " + textures_.name_of(view.texture.get()) +
                           ", which is " + what +
                           " of the same draw; what is read is undefined. Draw to another "
                           "texture, or read a copy.");
      return true;
    });
  };
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    drop(targets.color[i], "render target " + std::to_string(i));
  }
  if (writes_depth(command)) drop(targets.depth, "the depth buffer, which is written,");
  if (writes_stencil(command)) {
    drop(targets.depth, "the depth buffer, whose stencil is written,", runtime::kStencilPlane);
  }
}

}  // namespace kaamos::checks
