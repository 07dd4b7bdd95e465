// SPDX-License-Identifier: MIT
// Brings the structures up to date in one frame.
#include <rtapi/upload.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>

#include "effects/assets/common/errors.h"
#include "effects/geometry/structures/structures.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

using Clock = std::chrono::steady_clock;

// To the bit.
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

Error mismatch(const std::string& what, std::size_t actual, std::size_t wanted) {
  return make_error(ErrorId::kStructures,
                    what + ": " + std::to_string(actual) + " given, " + std::to_string(wanted) +
                        " expected; take the states of evaluate_instances for the same scene");
}

}  // namespace

rtapi::Status StructureManager::record(CommandList& list, std::span<const InstanceState> states,
                                       const glm::dvec3& origin) {
  if (const auto s = begin_frame(states); !s) return s;
  record_skinning(list);
  record_bottom_levels(list);
  record_top_level(list, states, origin);
  return {};
}

rtapi::Status StructureManager::execute(const Device& device, CommandQueue& queue,
                                        std::span<const InstanceState> states,
                                        const glm::dvec3& origin) {
  if (const auto s = begin_frame(states); !s) return s;
  const auto stage = [&](double& milliseconds, const auto& recorder) -> rtapi::Status {
    auto list = device.CreateCommandList();
    if (!list) return list.error();
    recorder(*list);
    const auto start = Clock::now();
    const rtapi::Status done = queue.ExecuteAndWait(*list);
    milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return done;
  };
  if (const auto s = stage(statistics_.skinning_ms, [&](CommandList& l) { record_skinning(l); });
      !s) {
    return s;
  }
  if (const auto s =
          stage(statistics_.bottom_level_ms, [&](CommandList& l) { record_bottom_levels(l); });
      !s) {
    return s;
  }
  return stage(statistics_.top_level_ms,
               [&](CommandList& l) { record_top_level(l, states, origin); });
}

// Finds out which bodies moved and uploads their joints.
rtapi::Status StructureManager::begin_frame(std::span<const InstanceState> states) {
  if (states.size() != placements_.size()) {
    return mismatch("states of instances", states.size(), placements_.size());
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::uint32_t mesh = mesh_of(i, states[i]);
    if (placements_[i].body == kNoIndex &&
        (mesh >= gpu_.bottom_levels.size() || !gpu_.bottom_levels[mesh])) {
      return make_error(ErrorId::kStructures, "instance \"" + instances_[i].name + "\": mesh " +
                                                  std::to_string(mesh) +
                                                  " is not one of its levels of detail; take what "
                                                  "select_levels says");
    }
    if (placements_[i].body == kNoIndex) continue;
    const std::uint32_t wanted = bodies_[static_cast<std::size_t>(placements_[i].body)].joint_count;
    if (states[i].joints.size() != wanted) {
      return mismatch("joints of instance \"" + instances_[i].name + "\"", states[i].joints.size(),
                      wanted);
    }
    const std::uint32_t targets =
        bodies_[static_cast<std::size_t>(placements_[i].body)].skinned.morph_targets;
    if (states[i].weights.size() != targets) {
      return mismatch("morph weights of instance \"" + instances_[i].name + "\"",
                      states[i].weights.size(), targets);
    }
  }
  statistics_.frame = frame_;
  statistics_.skinned = statistics_.updated = statistics_.rebuilt = statistics_.skipped = 0;
  statistics_.skinned_vertices = 0;
  statistics_.moved_instances = statistics_.changed_levels = statistics_.barriers = 0;
  statistics_.skinning_ms = statistics_.bottom_level_ms = statistics_.top_level_ms = 0;
  std::vector<bool> seen(bodies_.size(), false);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (placements_[i].body == kNoIndex) continue;
    const std::size_t id = static_cast<std::size_t>(placements_[i].body);
    if (seen[id]) continue;
    seen[id] = true;
    Body& body = bodies_[id];
    body.moved = !body.has_pose || !same(body.joints, states[i].joints) ||
                 !same(body.weights, states[i].weights);
    if (!body.moved) {
      ++statistics_.skipped;
      continue;
    }
    body.has_history = body.has_pose;
    body.has_pose = true;
    body.joints = states[i].joints;
    body.weights = states[i].weights;
    std::copy(body.joints.begin(), body.joints.end(),
              body.skinned.joints.data<JointMatrix>().begin());
    std::copy(body.weights.begin(), body.weights.end(), body.skinned.weights.data<float>().begin());
  }
  return {};
}

void StructureManager::barrier(CommandList& list) {
  list.ResourceBarrier(ResourceBarrier::Uav());
  ++statistics_.barriers;
}

void StructureManager::record_skinning(CommandList& list) {
  std::vector<ResourceBarrier> before, after;
  const ResourceStates unordered = ResourceStates::kUnorderedAccess;
  for (const Body& body : bodies_) {
    if (!body.moved) continue;
    const Buffer& vertices = body.skinned.vertices;
    before.push_back(ResourceBarrier::Transition(vertices, kSkinnedVertexState, unordered));
    after.push_back(ResourceBarrier::Transition(vertices, unordered, kSkinnedVertexState));
  }
  if (before.empty()) return;
  list.BeginEvent("skinning");
  list.ResourceBarrier(before);
  skinning_->begin(list);
  for (const Body& body : bodies_) {
    if (!body.moved) continue;
    skinning_->dispatch(list, body.skinned, body.has_history);
    ++statistics_.skinned;
    statistics_.skinned_vertices += body.skinned.vertex_count;
  }
  list.ResourceBarrier(after);
  statistics_.barriers += 2;
  list.EndEvent();
}

// Rebuilds are staggered by rank, so that not all fall in the same frame. A body that was skipped
// in its frame is rebuilt with its next change.
bool StructureManager::must_rebuild(const Body& body) const {
  if (!body.has_history || body.build_class == BuildClass::kEveryFrame) return true;
  const std::uint32_t period =
      body.build_class == BuildClass::kHero ? options_.hero_period : options_.deformable_period;
  if (period == 0) return false;
  return frame_ % period == body.rank % period || body.updates + 1 >= period;
}

void StructureManager::record_bottom_levels(CommandList& list) {
  bool any = false;
  for (Body& body : bodies_) {
    if (!body.moved) continue;
    if (!any) list.BeginEvent("bottom levels");
    any = true;
    BuildRaytracingAccelerationStructureDesc desc;
    desc.Inputs = inputs(body);
    desc.DestAccelerationStructureData = body.structure.GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = body.scratch.GetGPUVirtualAddress();
    if (must_rebuild(body)) {
      body.updates = 0;
      ++statistics_.rebuilt;
    } else {
      desc.Inputs.Flags =
          desc.Inputs.Flags | RaytracingAccelerationStructureBuildFlags::kPerformUpdate;
      desc.SourceAccelerationStructureData = desc.DestAccelerationStructureData;
      ++body.updates;
      ++statistics_.updated;
    }
    list.BuildRaytracingAccelerationStructure(desc);
  }
  if (!any) return;
  barrier(list);
  list.EndEvent();
}

std::uint32_t StructureManager::mesh_of(std::size_t instance, const InstanceState& state) const {
  return state.mesh == kNoIndex ? instances_[instance].mesh
                                : static_cast<std::uint32_t>(state.mesh);
}

std::uint32_t StructureManager::traced_mesh(std::size_t instance, std::uint32_t drawn) const {
  const std::vector<Level>& levels = instances_[instance].levels;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].mesh != drawn) continue;
    return levels[std::min(i + options_.coarser_rays, levels.size() - 1)].mesh;
  }
  return drawn;
}

RaytracingInstanceDesc StructureManager::instance_desc(std::size_t i, const Instance& now,
                                                       const glm::dvec3& origin) const {
  const Placement& placement = placements_[i];
  const Body* body =
      placement.body == kNoIndex ? nullptr : &bodies_[static_cast<std::size_t>(placement.body)];
  RaytracingInstanceDesc desc;
  const glm::mat3x4 rows = transform_3x4(now, origin);
  std::memcpy(desc.Transform, &rows, sizeof desc.Transform);
  desc.InstanceID = static_cast<std::uint32_t>(i) & 0xFFFFFFu;
  desc.InstanceMask = instance_mask(now);
  const std::size_t first_record = body ? body->first_record : meshes_[now.mesh].first;
  desc.InstanceContributionToHitGroupIndex =
      static_cast<std::uint32_t>(first_record * kRayTypeCount) & 0xFFFFFFu;
  // The traversal of opaque instances never looks for an any-hit shader. [Northlight deck:
  // FORCE_OPAQUE]
  desc.Flags = meshes_[now.mesh].opaque && !(now.mask & kMaskTransparent)
                   ? static_cast<std::uint32_t>(RaytracingInstanceFlags::kForceOpaque)
                   : 0u;
  desc.AccelerationStructure =
      (body ? body->structure : gpu_.bottom_levels[now.mesh]).GetGPUVirtualAddress();
  return desc;
}

void StructureManager::write_instances(std::span<const InstanceState> states,
                                       const glm::dvec3& origin) {
  const std::span<RaytracingInstanceDesc> descs = gpu_.instances.data<RaytracingInstanceDesc>();
  const std::span<PreviousInstance> previous = gpu_.previous_instances.data<PreviousInstance>();
  for (std::size_t i = 0; i < placements_.size(); ++i) {
    Placement& placement = placements_[i];
    Instance now = instances_[i];
    now.transform = states[i].transform;
    now.mesh = mesh_of(i, states[i]);
    if (frame_ > 0 && now.mesh != placement.mesh) ++statistics_.changed_levels;
    placement.mesh = now.mesh;
    const Body* body =
        placement.body == kNoIndex ? nullptr : &bodies_[static_cast<std::size_t>(placement.body)];
    Instance traced = now;
    traced.mesh = traced_mesh(i, now.mesh);
    descs[i] = instance_desc(i, traced, origin);
    if (gpu_.drawn_instances) {
      gpu_.drawn_instances.data<RaytracingInstanceDesc>()[i] = instance_desc(i, now, origin);
    }

    PreviousInstance before;
    if (frame_ > 0) {
      if (body && body->moved) before.flags = kPreviousMoved | kPreviousDeformed;
      if (placement.transform != now.transform) before.flags |= kPreviousMoved;
    }
    if (before.flags != 0) {
      Instance then = now;
      then.transform = placement.transform;
      before.object_to_world = transform_3x4(then, previous_origin_);
      ++statistics_.moved_instances;
    }
    previous[i] = before;
    placement.transform = now.transform;
  }
  previous_origin_ = origin;
}

void StructureManager::record_top_level(CommandList& list, std::span<const InstanceState> states,
                                        const glm::dvec3& origin) {
  write_instances(states, origin);
  list.BeginEvent("top level");
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs.Flags = RaytracingAccelerationStructureBuildFlags::kPreferFastTrace;
  desc.Inputs.NumDescs = static_cast<std::uint32_t>(placements_.size());
  desc.Inputs.InstanceDescs = gpu_.instances.GetGPUVirtualAddress();
  desc.DestAccelerationStructureData = gpu_.top_level.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = top_scratch_.GetGPUVirtualAddress();
  list.BuildRaytracingAccelerationStructure(desc);
  barrier(list);
  list.EndEvent();
  ++frame_;
}

}  // namespace kaamos::effects
