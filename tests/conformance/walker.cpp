// SPDX-License-Identifier: MIT
#include "tests/conformance/walker.h"

#include <shaders/traversal.h>

#include <algorithm>
#include <cmath>

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// As in traversal.hlsl.
constexpr uint64_t kEventsAt = 65536;
constexpr size_t kFaultWord = 32772 / 4;

using Matrix = std::vector<float>;  // 3x4, row-major

// Rotated about two axes, scaled, sheared, perhaps mirrored, moved by up to `reach`.
Matrix random_transform(Random& random, float reach) {
  const float a = random.between(0, 6.28f), b = random.between(0, 6.28f);
  const float rotation[3][3] = {
      {std::cos(a), -std::sin(a) * std::cos(b), std::sin(a) * std::sin(b)},
      {std::sin(a), std::cos(a) * std::cos(b), -std::cos(a) * std::sin(b)},
      {0, std::sin(b), std::cos(b)}};
  float shape[3][3] = {};
  for (int i = 0; i < 3; ++i) shape[i][i] = random.between(0.4f, 2) * (random.chance(0.3) ? -1 : 1);
  shape[0][1] = random.chance(0.5) ? random.between(-0.7f, 0.7f) : 0;
  Matrix out(12);
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      for (size_t k = 0; k < 3; ++k) {
        out[4 * row + column] += rotation[row][k] * shape[k][column];
      }
    }
    out[4 * row + 3] = random.between(-reach, reach);
  }
  return out;
}

Geometry random_triangles(Random& random) {
  Geometry out;
  const uint32_t count = 5 + random.below(20);
  for (uint32_t i = 0; i < count; ++i) {
    float centre[3];
    for (float& each : centre) each = random.between(-1, 1);
    for (int k = 0; k < 9; ++k) {
      out.vertices.push_back(centre[k % 3] + random.between(-0.7f, 0.7f));
    }
  }
  if (random.chance(0.4)) out.transform = random_transform(random, 0.5f);
  return out;
}

Geometry random_boxes(Random& random) {
  Geometry out;
  const uint32_t count = 3 + random.below(6);
  for (uint32_t i = 0; i < count; ++i) {
    float lower[3], size[3];
    for (float& each : lower) each = random.between(-1.2f, 0.8f);
    for (float& each : size) each = random.between(0.3f, 0.9f);
    out.boxes.push_back(
        {lower[0], lower[1], lower[2], lower[0] + size[0], lower[1] + size[1], lower[2] + size[2]});
  }
  return out;
}

GroupKind random_group(Random& random, const SceneOptions& options) {
  if (!options.null_groups) return GroupKind::kAnyHit;
  const uint32_t roll = random.below(10);
  return roll == 0 ? GroupKind::kNull : roll < 3 ? GroupKind::kNoAnyHit : GroupKind::kAnyHit;
}

// A world-space point on or in one of the scene's primitives.
void random_target(Random& random, const Scene& scene, float* world) {
  const auto& instance =
      scene.instances[random.below(static_cast<uint32_t>(scene.instances.size()))];
  const auto& geometries = scene.bottom_levels[instance.AccelerationStructure];
  const Geometry& geometry = geometries[random.below(static_cast<uint32_t>(geometries.size()))];
  float at[3] = {};
  if (geometry.boxes.empty()) {
    const auto first = 9 * random.below(static_cast<uint32_t>(geometry.vertices.size() / 9));
    const float u = random.between(0, 0.5f), v = random.between(0, 0.5f);
    for (size_t i = 0; i < 3; ++i) {
      at[i] = (1 - u - v) * geometry.vertices[first + i] + u * geometry.vertices[first + 3 + i] +
              v * geometry.vertices[first + 6 + i];
    }
  } else {
    const auto& box = geometry.boxes[random.below(static_cast<uint32_t>(geometry.boxes.size()))];
    at[0] = random.between(box.MinX, box.MaxX);
    at[1] = random.between(box.MinY, box.MaxY);
    at[2] = random.between(box.MinZ, box.MaxZ);
  }
  const auto transformed = [&](const float* m, int row) {
    return m[4 * row] * at[0] + m[4 * row + 1] * at[1] + m[4 * row + 2] * at[2] + m[4 * row + 3];
  };
  if (!geometry.transform.empty()) {
    const float moved[3] = {transformed(geometry.transform.data(), 0),
                            transformed(geometry.transform.data(), 1),
                            transformed(geometry.transform.data(), 2)};
    std::copy(moved, moved + 3, at);
  }
  for (int row = 0; row < 3; ++row) world[row] = transformed(&instance.Transform[0][0], row);
}

}  // namespace

Scene random_scene(Random& random, const SceneOptions& options) {
  Scene out;
  for (uint32_t i = 0; i < (options.boxes ? 6u : 4u); ++i) {
    std::vector<Geometry> geometries;
    for (uint32_t g = 0; g <= random.below(3); ++g) {
      geometries.push_back(i < 4 ? random_triangles(random) : random_boxes(random));
      geometries.back().flags = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
      if (options.opaque && random.chance(0.3)) {
        geometries.back().flags = static_cast<RaytracingGeometryFlags>(3);  // opaque as well
      }
    }
    out.bottom_levels.push_back(std::move(geometries));
  }
  for (uint32_t i = 0; i < 24; ++i) {
    RaytracingInstanceDesc desc;
    const Matrix transform = random_transform(random, 4);
    std::copy(transform.begin(), transform.end(), &desc.Transform[0][0]);
    desc.InstanceID = 1000 + i;
    desc.InstanceContributionToHitGroupIndex = static_cast<uint32_t>(out.records.size());
    desc.AccelerationStructure = i % out.bottom_levels.size();
    if (options.instance_flags) {
      const uint32_t opacity[] = {0, 0, 4, 8};
      desc.Flags = random.below(4) | opacity[random.below(4)];
      desc.InstanceMask = random.chance(0.1) ? 0 : 1 + random.below(255);
    }
    for (size_t g = 0; g < out.bottom_levels[desc.AccelerationStructure].size(); ++g) {
      out.records.push_back(random_group(random, options));
    }
    out.instances.push_back(desc);
  }
  return out;
}

std::vector<Ray> random_rays(Random& random, const Scene& scene, uint32_t count, Mode mode,
                             const std::vector<uint32_t>& flags) {
  std::vector<Ray> out(count);
  for (Ray& ray : out) {
    float target[3];
    random_target(random, scene, target);
    const float stretch = random.between(0.05f, 2);
    for (int i = 0; i < 3; ++i) {
      ray.origin[i] = random.between(-8, 8);
      ray.direction[i] = stretch * (target[i] - ray.origin[i]);
    }
    ray.flags = flags[random.below(static_cast<uint32_t>(flags.size()))];
    ray.multiplier = 1;
    ray.extra[0] = mode;
    ray.extra[1] = random.below(0xFFFFFFFF);
  }
  return out;
}

Walker::Walker(Context& t)
    : Standard(t, kaamos_shaders_traversal(),
               {"Walk", "BoxWalk", "Sphere", "Script", "ScriptAny", "CountCandidates", "Shadowed",
                "Straight", "AddTen", "WriteBoard", "AnswerBoard", "QueryAndTrace", "QueryWithSkip",
                "Waves", "WavesInHit"},
               (std::string(kGlobalSignature) + ", SRV(t2), SRV(t3), UAV(u1)").c_str()),
      context_(&t) {
  group("WalkTriangle", "Closest", "Walk");
  group("WalkSphere", "BoxClosest", "BoxWalk", "Sphere");
  group("PlainSphere", "BoxClosest", "", "Sphere");
  group("WalkScript", "BoxClosest", "ScriptAny", "Script");
  group("PlainScript", "BoxClosest", "", "Script");
  group("ShadowedTriangle", "Closest", "Shadowed");
  group("Board", "AnswerBoard");
  group("WavesOfHit", "WavesInHit");
  local(kRecordSignature, {"ShadowedTriangle", "Board", "WavesOfHit", "WalkTriangle", "WalkSphere",
                           "PlainSphere", "WalkScript", "PlainScript"});
  // The largest pipeline of all; Vulkan drivers take seconds to compile it.
  share_as("walker");
}

void Walker::build(const Scene& description) {
  std::vector<Buffer> bottom_levels;
  std::vector<RaytracingAabb> boxes;
  std::vector<std::vector<uint32_t>> first_box;  // by bottom level and geometry
  for (const auto& geometries : description.bottom_levels) {
    bottom_levels.push_back(context_->bottom_level(geometries));
    first_box.emplace_back();
    for (const Geometry& each : geometries) {
      first_box.back().push_back(static_cast<uint32_t>(boxes.size()));
      boxes.insert(boxes.end(), each.boxes.begin(), each.boxes.end());
    }
  }
  std::vector<RaytracingInstanceDesc> instances = description.instances;
  for (RaytracingInstanceDesc& each : instances) {
    const auto level = each.AccelerationStructure;
    const auto& geometries = description.bottom_levels[level];
    each.AccelerationStructure = bottom_levels[level].GetGPUVirtualAddress();
    for (size_t g = 0; g < geometries.size(); ++g) {
      const GroupKind kind = description.records[each.InstanceContributionToHitGroupIndex + g];
      const bool any = kind == GroupKind::kAnyHit, is_box = !geometries[g].boxes.empty();
      const char* group = is_box ? any ? "WalkSphere" : "PlainSphere"
                          : any  ? "WalkTriangle"
                                 : "Plain";
      record(kind == GroupKind::kNull ? "" : group, 0, first_box[level][g]);
    }
  }
  scene = context_->top_level(instances);
  boxes.push_back({});
  const Buffer all_boxes = context_->upload(boxes);
  bind = [all_boxes](CommandList& list) {
    list.SetComputeRootShaderResourceView(3, all_boxes.GetGPUVirtualAddress());
  };
}

std::vector<uint32_t> Walker::count(const std::vector<Ray>& list) {
  create();
  if (shader_tables[0].record_count() == 0) raygen("CountCandidates");
  prepare(list);
  word_bytes = kEventsAt + list.size() * 4;
  const auto words = run(static_cast<uint32_t>(list.size()));
  const auto first = words.begin() + static_cast<std::ptrdiff_t>(kEventsAt / 4);
  return {first, first + static_cast<std::ptrdiff_t>(list.size())};
}

std::vector<Walked> Walker::walk(const std::vector<Ray>& list) {
  prepare(list);
  word_bytes = kEventsAt + list.size() * kEventsPerRay * sizeof(Event);
  const auto words = run(static_cast<uint32_t>(list.size()));
  const auto seen = seen_of(words, list.size());
  faults_ = words[kFaultWord];
  std::vector<Walked> out;
  for (size_t i = 0; i < list.size(); ++i) {
    out.push_back({seen[i], {}});
    out[i].events.resize(std::min(seen[i].any_hits, kEventsPerRay));
    if (out[i].events.empty()) continue;
    std::memcpy(out[i].events.data(), &words[kEventsAt / 4 + i * kEventsPerRay * 2],
                out[i].events.size() * sizeof(Event));
  }
  return out;
}

}  // namespace kaamos::conformance
