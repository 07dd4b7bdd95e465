// SPDX-License-Identifier: MIT
//
// Opacity micromaps while rays are traced.
#include "tests/conformance/omm.h"

#include <shaders/omm.h>
#include <shaders/standard.h>

#include <algorithm>
#include <limits>

#include "tests/conformance/compile.h"
#include "tests/conformance/rq.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using MicromapFormat = RaytracingOpacityMicromapFormat;
constexpr auto kTwoStates = MicromapFormat::kOc1_2State;
constexpr auto kFourStates = MicromapFormat::kOc1_4State;
constexpr auto kOpaque = RaytracingGeometryFlags::kOpaque;
constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;

constexpr uint32_t kForceTwoStates = 0x400;
enum InstanceBits : uint32_t { kOpaqueHere = 4, kNonOpaqueHere = 8, kTwoHere = 16, kDisabled = 32 };

// What a ray finds of a micro-triangle, by the text of the rules.
Found outcome(uint32_t state, bool geometry_opaque, uint32_t instance_flags, uint32_t ray_flags) {
  bool opaque = geometry_opaque;
  if ((instance_flags & kDisabled) == 0) {
    const bool two = (instance_flags & kTwoHere) != 0 || (ray_flags & kForceTwoStates) != 0;
    if (two) state &= 1;
    if (state == 0) return kFoundNothing;
    opaque = state == 1;
  }
  if ((instance_flags & kOpaqueHere) != 0) opaque = true;
  if ((instance_flags & kNonOpaqueHere) != 0) opaque = false;
  if ((ray_flags & (opaque ? kCullOpaque : kCullNonOpaque)) != 0) return kFoundNothing;
  if ((ray_flags & kForceOpaque) != 0) opaque = true;
  if ((ray_flags & kForceNonOpaque) != 0) opaque = false;
  return opaque ? kFoundOpaque : kFoundByAnyHit;
}

// Triangles 0 to 3 have the special indices -1 to -4, the others micromaps 6 to 9.
struct Table {
  std::vector<Micromap> micromaps;
  std::vector<int32_t> indices = {-1, -2, -3, -4, 0, 1, 2, 3};

  Table(uint32_t level, MicromapFormat format) {
    for (uint32_t i = 0; i < 10; ++i) micromaps.push_back(pattern(level, format, i));
  }
  uint32_t state(uint32_t triangle, uint32_t micro_triangle) const {
    if (triangle < 4) return triangle;
    return micromaps[6 + indices[triangle]].states[micro_triangle];
  }
};

void all_states_with_all_flags(Context& t) {
  const uint32_t instance_flags[] = {0, 4, 8, 0x10, 0x14, 0x18, 0x20, 0x24, 0x28, 0x30, 0x34, 0x38};
  const uint32_t ray_flags[] = {0, 1, 2, 0x400, 0x401, 0x402, 0x40, 0x80, 0x440, 0x480};
  for (const auto& [level, format, index_format] :
       {std::tuple(0u, kTwoStates, Format::kR8Uint), std::tuple(0u, kFourStates, Format::kR16Uint),
        std::tuple(2u, kFourStates, Format::kR8Uint), std::tuple(3u, kTwoStates, Format::kR32Uint),
        std::tuple(3u, kFourStates, Format::kR32Uint),
        std::tuple(5u, kFourStates, Format::kR16Uint)}) {
    const Table table(level, format);
    const Buffer array = array_of(t, table.micromaps);
    const Buffer indices = indices_of(t, table.indices, index_format, 4);
    for (const bool opaque : {false, true}) {
      LinkedInputs linked(BuildFlags::kAllowDisableOmms);
      linked.add(t, row_of_triangles(8, opaque ? kOpaque : kNonOpaque),
                 linkage_of(array, indices, index_format, 4, 6));
      const Buffer bottom = build_new(t, linked.inputs);
      std::vector<RaytracingInstanceDesc> instances;
      for (size_t i = 0; i < std::size(instance_flags); ++i) {
        instances.push_back(instance(bottom, 0, 0, instance_flags[i]));
        instances.back().Transform[1][3] = 4.0f * static_cast<float>(i);
      }
      struct Expected {
        Found found;
        uint32_t triangle, micro, instance_flags, ray_flags;
      };
      std::vector<Ray> rays;
      std::vector<Expected> expected;
      const uint32_t step = level < 3 ? 1 : level == 3 ? 7 : 101;
      for (uint32_t triangle = 0; triangle < 8; ++triangle) {
        for (uint32_t k = 0; k < 1u << 2 * level; k += step) {
          for (size_t i = 0; i < std::size(instance_flags); ++i) {
            for (const uint32_t flags : ray_flags) {
              const auto [u, v] = middle_of(level, k);
              rays.push_back(ray_in(triangle, u, v, 4.0 * static_cast<double>(i)));
              rays.back().flags = flags;
              expected.push_back(
                  {outcome(table.state(triangle, k), opaque, instance_flags[i], flags), triangle, k,
                   instance_flags[i], flags});
            }
          }
        }
      }
      MicromapProgram program(t);
      program.word_bytes = std::max<uint64_t>(kWordBytes, 64 * rays.size());
      program.scene = t.top_level(instances);
      const auto seen = program.trace(rays);
      uint32_t wrong = 0;
      for (size_t i = 0; i < seen.size(); ++i) {
        const Found found = found_by(seen[i]);
        if (found == expected[i].found || ++wrong > 3) continue;
        const Expected& e = expected[i];
        t.fail("level " + std::to_string(level) + ", triangle " + std::to_string(e.triangle) +
               ", micro-triangle " + std::to_string(e.micro) + ", geometry " +
               (opaque ? "opaque" : "not opaque") + ", instance flags " +
               std::to_string(e.instance_flags) + ", ray flags " + std::to_string(e.ray_flags) +
               ": found " + std::to_string(found) + ", expected " + std::to_string(e.found));
      }
    }
  }
}

// A bottom level of one triangle with a special index.
Buffer special(Context& t, int32_t index, RaytracingGeometryFlags flags = kNonOpaque) {
  LinkedInputs linked;
  linked.add(t, row_of_triangles(1, flags),
             linkage_of({}, indices_of(t, {index}, Format::kR32Uint, 4), Format::kR32Uint, 4));
  return build_new(t, linked.inputs);
}

void the_order_of_micro_triangles(Context& t) {
  // Level 2, by cell (u, v) and half of it: 00u 00d 10u 01u 01d 11u 11d 10d 20u 20d 30u 21u ...
  const Barycentrics points[] = {{0.08, 0.08}, {0.16, 0.16}, {0.33, 0.08}, {0.08, 0.33},
                                 {0.16, 0.41}, {0.33, 0.33}, {0.41, 0.41}, {0.41, 0.16},
                                 {0.58, 0.08}, {0.66, 0.16}, {0.83, 0.08}, {0.58, 0.33},
                                 {0.33, 0.58}, {0.16, 0.66}, {0.08, 0.58}, {0.08, 0.83}};
  for (uint32_t k = 0; k < 16; ++k) {
    Micromap one = {2, kTwoStates, std::vector<uint32_t>(16)};
    one.states[k] = 1;
    LinkedInputs linked;
    linked.add(t, row_of_triangles(1, kNonOpaque), linkage_of(array_of(t, {one})));
    MicromapProgram program(t);
    program.scene = t.top_level({instance(build_new(t, linked.inputs))});
    std::vector<Ray> rays;
    for (const auto& [u, v] : points) rays.push_back(ray_in(0, u, v));
    const auto seen = program.trace(rays);
    for (uint32_t i = 0; i < 16; ++i) {
      const uint32_t expected = i == k ? kFoundOpaque : kFoundNothing;
      t.equal("micro-triangle " + std::to_string(k) + ", place " + std::to_string(i),
              static_cast<uint32_t>(found_by(seen[i])), expected);
    }
  }
}

void both_sides_show_the_same(Context& t) {
  const Micromap micromap = pattern(3, kFourStates, 3);
  LinkedInputs linked;
  linked.add(t, row_of_triangles(1, kNonOpaque), linkage_of(array_of(t, {micromap})));
  const Buffer bottom = build_new(t, linked.inputs);
  const auto expected = expected_of(micromap);
  for (const uint32_t flags : {0u, 2u}) {  // TRIANGLE_FRONT_COUNTERCLOCKWISE
    const Buffer top = t.top_level({instance(bottom, 0, 0, flags)});
    for (const bool behind : {false, true}) {
      std::vector<Ray> rays;
      for (uint32_t k = 0; k < 64; ++k) {
        const auto [u, v] = middle_of(3, k);
        rays.push_back(ray_in(0, u, v));
        if (!behind) continue;
        rays.back().origin[2] = 10;
        rays.back().direction[2] = -1;
      }
      MicromapProgram program(t);
      program.scene = top;
      const auto seen = program.trace(rays);
      for (uint32_t k = 0; k < 64; ++k) {
        t.equal("micro-triangle " + std::to_string(k), static_cast<uint32_t>(found_by(seen[k])),
                static_cast<uint32_t>(expected[k]));
      }
    }
  }
}

void without_permission_they_are_ignored(Context& t) {
  MicromapProgram program(t, false);
  const Buffer transparent = t.top_level({instance(special(t, -1))});
  t.equal("transparent",
          static_cast<uint32_t>(found_by(program.trace(transparent, ray_in(0, .2, .2)))),
          static_cast<uint32_t>(kFoundByAnyHit));
  const Buffer opaque = t.top_level({instance(special(t, -1, kOpaque))});
  t.equal("transparent, geometry opaque",
          static_cast<uint32_t>(found_by(program.trace(opaque, ray_in(0, .2, .2)))),
          static_cast<uint32_t>(kFoundOpaque));
}

void queries(Context& t) {
  const Micromap micromap = pattern(3, kFourStates, 5);
  LinkedInputs linked;
  linked.add(t, row_of_triangles(1, kOpaque), linkage_of(array_of(t, {micromap})));
  std::vector<Ray> rays;
  for (uint32_t i = 0; i < 64 * 4; ++i) {
    const auto [u, v] = middle_of(3, i % 64);
    rays.push_back(ray_in(0, u, v));
    rays.back().extra[0] = i < 192;
    const uint32_t flags[] = {0, kForceTwoStates, kForceOpaque, 0};
    rays.back().flags = flags[i / 64];
  }
  Program program(t, kaamos_shaders_omm());
  program.raygen("AskOfMicromaps");
  program.scene = t.top_level({instance(build_new(t, linked.inputs))});
  program.rays = t.upload(rays);
  const auto words = program.run(static_cast<uint32_t>(rays.size()));
  for (uint32_t i = 0; i < rays.size(); ++i) {
    const uint32_t state = micromap.states[i % 64];
    const Found expected =
        rays[i].extra[0] != 0 ? outcome(state, true, 0, rays[i].flags) : kFoundOpaque;
    const std::string what = "query " + std::to_string(i);
    t.equal(what + " status", words[4 * i], expected == kFoundNothing ? 0u : 1u);
    t.equal(what + " candidates", words[4 * i + 1], expected == kFoundByAnyHit ? 1u : 0u);
    t.equal(what + " flags", words[4 * i + 2], rays[i].flags);
    t.equal(what + " hit object", words[4 * i + 3], words[4 * i]);
  }
}

// What has no micromaps keeps its opacity, in a top level with something that has.
std::vector<RaytracingInstanceDesc> neighbours(Context& t) {
  std::vector<RaytracingInstanceDesc> instances = {instance(special(t, -3))};
  for (const auto flags : {kNonOpaque, kOpaque}) {
    for (const uint32_t instance_flags : {0u, uint32_t{kOpaqueHere}, uint32_t{kNonOpaqueHere}}) {
      const float x = 4.0f * static_cast<float>(instances.size());
      instances.push_back(instance(t.bottom_level({triangle(5, 0, flags)}), x, 0, instance_flags));
      instances.push_back(instance(t.bottom_level({box(5, 0, flags)}), x + 4, 4, instance_flags));
    }
  }
  return instances;
}
// The rays meet neighbour 1 to 12, with each of these flags.
constexpr uint32_t kOpacityFlags[] = {0,           kForceOpaque,   kForceNonOpaque,
                                      kCullOpaque, kCullNonOpaque, kForceTwoStates};
std::vector<Ray> rays_at_neighbours() {
  std::vector<Ray> rays;
  for (uint32_t i = 1; i <= 12; ++i) {
    for (const uint32_t flags : kOpacityFlags) {
      Ray ray;
      ray.origin[0] = 4.0f * static_cast<float>(i);
      ray.flags = flags;
      ray.extra[0] = 1;
      rays.push_back(ray);
    }
  }
  return rays;
}
Found expected_of_neighbour(uint32_t ray) {
  const uint32_t i = ray / std::size(kOpacityFlags);
  const uint32_t instance_flags[] = {0, kOpaqueHere, kNonOpaqueHere};
  return outcome(0, i >= 6, instance_flags[i / 2 % 3] | kDisabled,
                 kOpacityFlags[ray % std::size(kOpacityFlags)]);
}

void others_keep_their_opacity(Context& t) {
  const auto rays = rays_at_neighbours();
  MicromapProgram program(t);
  program.record("BoxCounted", 4.5f, 17);
  program.scene = t.top_level(neighbours(t));
  const auto seen = program.trace(rays);
  for (uint32_t i = 0; i < rays.size(); ++i) {
    const std::string what = "ray " + std::to_string(i);
    t.equal(what, static_cast<uint32_t>(found_by(seen[i])),
            static_cast<uint32_t>(expected_of_neighbour(i)));
    t.equal(what + " RayFlags()", seen[i].flags, rays[i].flags);
  }
}

void queries_of_others(Context& t) {
  const auto rays = rays_at_neighbours();
  Program program(t, kaamos_shaders_omm());
  program.raygen("AskOfMicromaps");
  program.scene = t.top_level(neighbours(t));
  program.rays = t.upload(rays);
  const auto words = program.run(static_cast<uint32_t>(rays.size()));
  for (uint32_t i = 0; i < rays.size(); ++i) {
    const bool is_box = i / std::size(kOpacityFlags) % 2 == 1;
    const Found expected = expected_of_neighbour(i);
    const uint32_t status = expected == kFoundNothing ? 0 : is_box ? 2 : 1;
    const uint32_t candidates = expected == kFoundByAnyHit           ? (is_box ? 0x101 : 1)
                                : expected == kFoundOpaque && is_box ? 1
                                                                     : 0;
    const std::string what = "query " + std::to_string(i);
    t.equal(what + " status", words[4 * i], status);
    t.equal(what + " candidates", words[4 * i + 1], candidates);
    t.equal(what + " flags", words[4 * i + 2], rays[i].flags);
    t.equal(what + " hit object", words[4 * i + 3], uint32_t{status != 0});
  }
}

void ray_flags_show_it(Context& t) {
  MicromapProgram program(t);
  Ray ray = ray_in(0, 0.2, 0.2);
  const Buffer top = t.top_level({instance(special(t, -4))});
  for (const uint32_t others : {0u, uint32_t{kForceOpaque}, uint32_t{kCullOpaque}}) {
    ray.flags = kForceTwoStates | others;
    const Seen seen = program.trace(top, ray);
    t.equal("RayFlags()", seen.flags, ray.flags);
    t.equal("found", static_cast<uint32_t>(found_by(seen)),
            static_cast<uint32_t>(outcome(3, false, 0, ray.flags)));
  }
}

void what_the_compiler_refuses(Context& t) {
  const auto query = [](const std::string& target, const std::string& arguments) {
    return compile(shader_of("raygeneration", "RayQuery<" + arguments + "> query;"), target,
                   target == "lib_6_9" ? std::optional(false) : std::nullopt);
  };
  t.accepted("both arguments", query("lib_6_9",
                                     "RAY_FLAG_FORCE_OMM_2_STATE, "
                                     "RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS"));
  t.refused("the second argument in 6.8",
            query("lib_6_8", "0, RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS"));
  t.refused("the flag without permission", query("lib_6_9", "RAY_FLAG_FORCE_OMM_2_STATE"));
}

void system_values_are_the_triangles(Context& t) {
  const Micromap micromap = {2, kTwoStates, std::vector<uint32_t>(16, 1)};
  LinkedInputs linked;
  linked.add_plain(t, row_of_triangles(1, kOpaque));
  Geometry far = row_of_triangles(3, kNonOpaque);
  for (size_t i = 1; i < far.vertices.size(); i += 3) far.vertices[i] += 8;
  linked.add(t, far, linkage_of(array_of(t, {micromap, micromap, micromap})));
  MicromapProgram program(t);
  program.scene = t.top_level({instance(build_new(t, linked.inputs))});
  std::vector<Ray> rays;
  for (uint32_t k = 0; k < 16; ++k) {
    const auto [u, v] = middle_of(2, k);
    rays.push_back(ray_in(2, u, v, 8));
  }
  rays.push_back(ray_in(0, 0.3, 0.3));
  const auto seen = program.trace(rays);
  for (uint32_t k = 0; k < 16; ++k) {
    const auto [u, v] = middle_of(2, k);
    t.equal("geometry", seen[k].geometry, 1u);
    t.equal("record", seen[k].record, 0u);
    t.equal("primitive", seen[k].primitive, 2u);
    t.equal("hit kind", seen[k].hit_kind, seen[0].hit_kind);
    t.distance("t", seen[k].t, 5.0f);
    t.close("barycentrics.x", seen[k].barycentrics[0], static_cast<float>(u), 1e-5f);
    t.close("barycentrics.y", seen[k].barycentrics[1], static_cast<float>(v), 1e-5f);
  }
  t.equal("the plain one's geometry", seen[16].geometry, 0u);
}

void the_first_accepted_hit_ends_the_search(Context& t) {
  const Buffer transparent = special(t, -1);
  const Buffer opaque = special(t, -2);
  std::vector<RaytracingInstanceDesc> instances = {instance(transparent), instance(opaque)};
  instances[1].Transform[2][3] = 2;
  MicromapProgram program(t);
  Ray ray = ray_in(0, 0.2, 0.2);
  ray.flags = kAcceptFirst;
  const Seen seen = program.trace(t.top_level(instances), ray);
  t.equal("instance", seen.instance_index, 1u);
  t.distance("t", seen.t, 7.0f);
  t.equal("any-hit shaders", seen.any_hits, 0u);
}

void one_any_hit_call(Context& t) {
  LinkedInputs linked;
  linked.add(t, row_of_triangles(1, RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation),
             linkage_of({}, indices_of(t, {-4}, Format::kR8Uint, 1), Format::kR8Uint, 1));
  MicromapProgram program(t);
  program.scene = t.top_level({instance(build_new(t, linked.inputs))});
  std::vector<Ray> rays;
  for (uint32_t k = 0; k < 256; ++k) {
    const auto [u, v] = middle_of(4, k);
    rays.push_back(ray_in(0, u, v));
  }
  for (const Seen& seen : program.trace(rays)) t.equal("any-hit shaders", seen.any_hits, 1u);
}

void without_any_hit_shader_unknown_is_opaque(Context& t) {
  Standard program(t);
  program.set_pipeline_flags(RaytracingPipelineFlags::kAllowOpacityMicromaps);
  program.record("Plain");
  for (const int32_t index : {-1, -2, -3, -4}) {
    const Seen seen = program.trace(t.top_level({instance(special(t, index))}), ray_in(0, .2, .2));
    t.equal("end with index " + std::to_string(index), seen.end,
            index == -1 ? uint32_t{kMissRan} : uint32_t{kClosestHitRan});
  }
}

// Records 0 and 1 are hit groups without and with an any-hit shader.
void looks_micromaps_up(Context& t, const std::string& what, Standard& program) {
  for (const uint32_t record : {0u, 1u}) {
    for (const int32_t index : {-1, -2, -4}) {
      const Buffer top = t.top_level({instance(special(t, index), 0, record)});
      const Found found = found_by(program.trace(top, ray_in(0, 0.2, 0.2)));
      const Found expected = index == -1                  ? kFoundNothing
                             : index == -2 || record == 0 ? kFoundOpaque
                                                          : kFoundByAnyHit;
      t.equal(what + ", record " + std::to_string(record) + ", index " + std::to_string(index),
              static_cast<uint32_t>(found), static_cast<uint32_t>(expected));
    }
  }
}

void collections_and_additions(Context& t) {
  constexpr auto kAllow = RaytracingPipelineFlags::kAllowOpacityMicromaps;
  Standard collected(t);
  collected.set_pipeline_flags(kAllow);
  collected.desc.Type = StateObjectType::kCollection;
  const StateObject collection = collected.try_create().value();
  collected.desc = {};
  collected.desc.Add(ExistingCollectionDesc::Of(collection));
  collected.record("Plain");
  collected.record("Counted");
  looks_micromaps_up(t, "a collection", collected);

  Standard parent(t);
  parent.set_pipeline_flags(kAllow);
  parent.desc.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  parent.create();
  Program late(t, kaamos_shaders_standard(), {});
  auto& library = std::get<DxilLibraryDesc>(late.desc.Subobjects[0]);
  library.Exports = {{"LateClosest", "Closest"}, {"LateCount", "Count"}};
  std::get<RaytracingPipelineConfig1>(late.desc.Subobjects[2]).Flags = kAllow;
  late.desc.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  late.group("LatePlain", "LateClosest");
  late.group("LateCounted", "LateClosest", "LateCount");
  late.local(kRecordSignature, {"LatePlain", "LateCounted"});
  parent.pipeline = t.device().AddToStateObject(late.desc, parent.pipeline).value();
  for (ShaderTable& table : parent.shader_tables) table = ShaderTable(parent.pipeline, "table");
  parent.record("LatePlain");
  parent.record("LateCounted");
  looks_micromaps_up(t, "an addition", parent);
}

void through_hit_objects(Context& t) {
  t.trace_through_hit_objects(true);
  all_states_with_all_flags(t);
  others_keep_their_opacity(t);
  ray_flags_show_it(t);
  the_first_accepted_hit_ends_the_search(t);
  one_any_hit_call(t);
  without_any_hit_shader_unknown_is_opaque(t);
  without_permission_they_are_ignored(t);
  t.trace_through_hit_objects(false);
}

void inactive_triangles_stay_so(Context& t) {
  Geometry geometry = row_of_triangles(1, kNonOpaque);
  geometry.vertices[0] = std::numeric_limits<float>::quiet_NaN();
  LinkedInputs linked;
  linked.add(t, geometry,
             linkage_of({}, indices_of(t, {-2}, Format::kR8Uint, 1), Format::kR8Uint, 1));
  MicromapProgram program(t);
  const Seen seen =
      program.trace(t.top_level({instance(build_new(t, linked.inputs))}), ray_in(0, 0.2, 0.2));
  t.equal("end", seen.end, uint32_t{kMissRan});
}

}  // namespace

std::vector<RuleTest> omm_tests() {
  return {{"OMM-04, OMM-16, OMM-17, OMM-33, OMM-34, OMM-35, OMM-36, OMM-37, OMM-38, OMM-39",
           all_states_with_all_flags},
          {"OMM-39", others_keep_their_opacity},
          {"OMM-33, OMM-34, OMM-35, OMM-36, OMM-37, OMM-38, OMM-39, OMM-40, OMM-42, OMM-46, OMM-48",
           through_hit_objects, "KA0493"},
          {"OMM-28", the_order_of_micro_triangles},
          {"OMM-32", both_sides_show_the_same},
          {"OMM-40", without_permission_they_are_ignored, "KA0493"},
          {"OMM-41", queries, "KA0493"},
          {"OMM-39, OMM-41", queries_of_others},
          {"OMM-42", ray_flags_show_it},
          {"OMM-43", what_the_compiler_refuses},
          {"OMM-14, OMM-45", system_values_are_the_triangles},
          {"OMM-46", the_first_accepted_hit_ends_the_search},
          {"OMM-47", one_any_hit_call},
          {"OMM-48", without_any_hit_shader_unknown_is_opaque},
          {"OMM-33, OMM-34, OMM-35, OMM-48", collections_and_additions},
          {"OMM-49", inactive_triangles_stay_so}};
}

}  // namespace kaamos::conformance
