// SPDX-License-Identifier: MIT
//
// Thread groups. A grid over the device's limit is split, and each part's block tells its groups
// where the part begins.
#include <algorithm>

#include "runtime/vulkan/rays/checks.h"
#include "runtime/vulkan/rays/dispatch.h"
#include "runtime/vulkan/rays/state_object.h"

namespace kaamos::vulkan {
namespace {

GridLimits limits_of(const Gpu& gpu) {
  GridLimits limits;
  const VkPhysicalDeviceLimits& core = gpu.properties().core.limits;
  for (int axis = 0; axis < 3; ++axis) limits.size[axis] = core.maxComputeWorkGroupCount[axis];
  return limits;
}

rtapi::Status run(const DispatchEnvironment& environment, const runtime::DispatchCommand& command,
                  const std::string& label, std::vector<runtime::ReachedFrom>& reached) {
  CommandStream& stream = *environment.stream;
  Gpu& gpu = stream.gpu();
  if (auto s = stream.flush(); !s) return s;
  const auto& pipeline = static_cast<const ComputePipeline&>(*command.pipeline);
  const auto parts = split_grid({command.groups[0], command.groups[1], command.groups[2]},
                                smaller(limits_of(gpu), environment.limits));
  if (parts.empty()) return {};
  auto scene = environment.structures->tables();
  if (!scene) return scene.error();
  auto buffer = environment.scratch->get(gpu, bytes_of_blocks(parts.size()));
  if (!buffer) return buffer.error();
  shader::spirv::DispatchBlock block = dispatch_block(command.state, *scene);
  std::copy(command.groups, command.groups + 3, block.dimensions);
  auto checks = begin_checks(environment, 0);
  if (!checks) return checks.error();
  write_blocks(block, parts, **buffer, *checks);
  auto commands = stream.record(label);
  if (!commands) return commands.error();
  pipeline.layout().bind(*commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
  for (size_t i = 0; i < parts.size(); ++i) {
    pipeline.layout().push(*commands, address_of_block(**buffer, i));
    gpu.vk().vkCmdDispatch(*commands, parts[i].size[0], parts[i].size[1], parts[i].size[2]);
  }
  auto status = run_dispatch(stream, **buffer, 0, 0, label);
  checks::CodePlace place;
  std::copy(command.groups, command.groups + 3, place.dimensions);
  const runtime::LinkedShader* const shader = &pipeline.shader();
  reached = tell_checks(environment, {&shader, 1}, place);
  return status;
}

}  // namespace

CountedOutcome dispatch_compute(const DispatchEnvironment& environment,
                                const runtime::DispatchCommand& command, const std::string& label) {
  CountedOutcome result;
  result.status = run(environment, command, label, result.reached);
  return result;
}

}  // namespace kaamos::vulkan
