// SPDX-License-Identifier: MIT
#include "runtime/checks/traced_levels.h"

#include <algorithm>

#include "kaamos/shader/query_permissions.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {

using runtime::LinkedShader;
using shader::TraceCall;

namespace {

bool skips_triangles(uint32_t ray_flags) {
  constexpr uint32_t kSkipTriangles = 0x100;
  return (ray_flags & kSkipTriangles) != 0;
}

}  // namespace

std::string shader_name(const LinkedShader& shader) {
  return std::string(stage_name(shader.stage)) + " shader " + in_quotes(shader.name);
}

std::string call_place(const TraceCall& call) {
  std::string file = call.file;
  file = file.substr(file.find_last_of('/') + 1);
  return " (" + file + ":" + std::to_string(call.line) + ")";
}

TraceCall call_of(const runtime::ReachedFrom& from) {
  const shader::ReachedCall& reached = from.call;
  const uint32_t file = reached.site >> 20;
  TraceCall call = {};
  call.ray_flags = reached.ray_flags;
  call.mask = reached.indices & 0xFFu;
  call.ray_contribution = reached.indices >> 8 & 15u;
  call.multiplier = reached.indices >> 12 & 15u;
  call.miss_index = reached.indices >> 16;
  call.line = reached.site & 0xFFFFFu;
  call.file = file < from.shader->library->file_count ? from.shader->library->files[file] : "";
  return call;
}

std::string level_name(const ProofInputs& inputs, const TrackedInstance& instance) {
  return "the bottom level at " + address_name(inputs.addresses, instance.bottom_level);
}
std::string linked_name(const ProofInputs& inputs, const TrackedInstance& instance,
                        const TrackedStructure& level) {
  const auto linked = std::find_if(level.geometries.begin(), level.geometries.end(),
                                   [](const auto& shape) { return shape.linked; });
  const std::string geometry =
      linked == level.geometries.end()
          ? std::string()
          : "geometry " + std::to_string(linked - level.geometries.begin()) + " of ";
  return geometry + level_name(inputs, instance);
}

bool meets_micromaps(const TrackedInstance& instance, const TrackedStructure& level,
                     uint32_t ray_flags) {
  constexpr uint32_t kDisabled = 0x20;
  return !skips_triangles(ray_flags) && (instance.flags & kDisabled) == 0 &&
         !level.linkages.empty();
}
bool meets_clusters(const TrackedStructure& level, uint32_t ray_flags) {
  return !skips_triangles(ray_flags) && level.of_clusters;
}

// Checks the micromaps of one bottom level. `place` names the top level.
static bool check_micromaps(const ProofInputs& inputs, const TrackedInstance& instance,
                            const TrackedStructure& level, uint32_t index,
                            const std::string& place) {
  const std::string of = place + ", whose instance " + std::to_string(index) +
                         " refers to the bottom level at " +
                         address_name(inputs.addresses, instance.bottom_level);
  constexpr uint32_t kDisabled = 0x20;
  bool good = true;
  if ((instance.flags & kDisabled) != 0 && !level.linkages.empty() &&
      !rtapi::HasAny(level.flags, runtime::BuildFlags::kAllowDisableOmms)) {
    good = false;
    inputs.reporter.report(
        Id::kMicromapsDisabled,
        of + " with kDisableOmms, but " +
            (level.of_clusters ? "not all of its clusters with micromaps were" : "it was not") +
            " built with kAllowDisableOmms. Its micromaps are ignored.");
  }
  for (const TrackedLinkage& linkage : level.linkages) {
    if (linkage.version == 0) continue;
    StructureState state;
    const TrackedStructure* array = inputs.structures.find(linkage.array, state);
    if (array != nullptr && state == StructureState::kAlive && array->version == linkage.version) {
      continue;
    }
    inputs.reporter.report(
        Id::kMicromapsReplaced,
        of + ", which is linked to the micromap array at " +
            address_name(inputs.addresses, linkage.array) + ": " +
            (state == StructureState::kAlive
                 ? "another one has been built there"
                 : "an acceleration structure " + inputs.structures.history(linkage.array, state)) +
            ". Rays see what was linked. " +
            (level.of_clusters ? "Build the cluster and the bottom level anew."
                               : "Link the bottom level anew, by a build or an update."));
    return false;
  }
  return good;
}

static Id id_of(StructureState state) {
  switch (state) {
    case StructureState::kFreed:
      return Id::kStructureFreed;
    case StructureState::kOverwritten:
    case StructureState::kReplaced:
      return Id::kStructureOverwritten;
    case StructureState::kBytesCopied:
      return Id::kStructureBytesCopied;
    default:
      return Id::kStructureMissing;
  }
}

// Checks that the clusters of a bottom level are those that it was built from.
static bool check_clusters(const ProofInputs& inputs, const TrackedInstance& instance,
                           const TrackedStructure& level, uint32_t index,
                           const std::string& place) {
  for (const TrackedCluster& cluster : level.clusters) {
    StructureState state;
    const TrackedStructure* now = inputs.structures.find(cluster.address, state);
    const bool alive = state == StructureState::kAlive;
    if (now != nullptr && alive && now->version == cluster.version) continue;
    inputs.reporter.report(
        alive ? Id::kStructureOverwritten : id_of(state),
        place + ", whose instance " + std::to_string(index) + " refers to the bottom level at " +
            address_name(inputs.addresses, instance.bottom_level) + ". Of its cluster at " +
            address_name(inputs.addresses, cluster.address) + ": " +
            (alive ? "another one has been built there"
                   : "an acceleration structure " +
                         inputs.structures.history(cluster.address, state)) +
            ". Rays see what it was. Build bottom levels anew after their clusters, and keep the "
            "clusters while rays use them.");
    return false;
  }
  return true;
}

bool check_top_level(const ProofInputs& inputs, uint64_t address, const std::string& user) {
  const auto report = [&](Id id, const std::string& text) {
    inputs.reporter.report(id, text);
    return false;
  };
  StructureState state;
  const Structures& all = inputs.structures;
  const TrackedStructure* top = all.find(address, state);
  const std::string place = user + " uses " + address_name(inputs.addresses, address);
  if (state != StructureState::kAlive) {
    return report(id_of(state), place + ": an acceleration structure " +
                                    all.history(address, state) +
                                    ". Every ray misses; build one there before the dispatch.");
  }
  if (!top->known) return true;
  if (!top->top) {
    return report(Id::kStructureLevel,
                  place +
                      ", which is a bottom level, but rays are traced against top levels. Make an "
                      "instance of it in a top level, and pass that.");
  }
  bool good = true;
  for (uint32_t i = 0; i < top->instances.size(); ++i) {
    const TrackedInstance& instance = top->instances[i];
    if (instance.version == 0) continue;
    const TrackedStructure* level = all.find(instance.bottom_level, state);
    if (level != nullptr && state == StructureState::kAlive && level->version == instance.version) {
      good = check_micromaps(inputs, instance, *level, i, place) &&
             check_clusters(inputs, instance, *level, i, place) && good;
      continue;
    }
    const std::string of = place + ", whose instance " + std::to_string(i) +
                           " refers to the bottom level at " +
                           address_name(inputs.addresses, instance.bottom_level);
    if (level != nullptr && state == StructureState::kAlive) {
      report(Id::kStructureStale,
             of + (top->partitioned
                       ? ", which was built or updated after the instance was written. Write or "
                         "update the instance after its bottom level."
                       : ", which was built or updated after the top level. Build or update the "
                         "top level after its bottom levels."));
    } else {
      report(id_of(state), of + ": an acceleration structure " +
                               all.history(instance.bottom_level, state) +
                               ". Keep bottom levels unchanged while a top level refers to them.");
    }
    good = false;
    break;  // the others probably have the same problem
  }
  return good;
}

bool check_inline_reached(const ProofInputs& inputs, const runtime::ReachedFrom& from) {
  const shader::ReachedCall& reached = from.call;
  const uint64_t scene = reached.acceleration_structure;
  if (scene == 0) return true;
  const std::string user = shader_name(*from.shader);
  bool good =
      reached.by == shader::ReachedBy::kTraceRayInlineKnown || check_top_level(inputs, scene, user);
  StructureState state;
  const TrackedStructure* top = inputs.structures.find(scene, state);
  if (top == nullptr || state != StructureState::kAlive || !top->top) return good;
  const TraceCall call = call_of(from);
  const auto lacks = [&](uint32_t permission) { return (call.ray_flags & permission) == 0; };
  bool micromaps = lacks(shader::kRayQueryAllowsMicromaps);
  bool clusters = lacks(shader::kRayQueryAllowsClusters);
  const auto report = [&](bool& untold, Id id, const std::string& what) {
    untold = good = false;
    inputs.reporter.report(id, user + call_place(call) + ": a RayQuery reaches " + what);
  };
  for (const TrackedInstance& instance : top->instances) {
    if (!micromaps && !clusters) break;
    if ((instance.mask & call.mask) == 0 || instance.version == 0) continue;
    const TrackedStructure* level = inputs.structures.find(instance.bottom_level, state);
    if (level == nullptr || level->version != instance.version) continue;
    if (micromaps && meets_micromaps(instance, *level, call.ray_flags)) {
      report(micromaps, Id::kMicromapsNotAllowed,
             linked_name(inputs, instance, *level) +
                 ", which has opacity micromaps, but it lacks "
                 "RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS. They are ignored.");
    }
    if (clusters && meets_clusters(*level, call.ray_flags)) {
      report(clusters, Id::kClustersNotAllowed,
             level_name(inputs, instance) +
                 ", which consists of clusters, but it lacks "
                 "RAYQUERY_FLAG_ALLOW_CLUSTERED_GEOMETRY. They are hit here, but need not be "
                 "elsewhere.");
    }
  }
  return good;
}

}  // namespace kaamos::checks
