// SPDX-License-Identifier: MIT
//
// System values and intrinsics.
#include <shaders/nested.h>
#include <shaders/values.h>

#include <cmath>
#include <limits>

#include "tests/conformance/compile.h"
#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

const char* const kStages[] = {"raygeneration", "intersection", "anyhit",
                               "closesthit",    "miss",         "callable"};

struct Intrinsic {
  const char* name;
  const char* statement;
  const char* allowed;  // one character per stage of kStages: x or -
};
constexpr Intrinsic kIntrinsics[] = {
    {"DispatchRaysIndex", "words.Store3(0, DispatchRaysIndex());", "xxxxxx"},
    {"DispatchRaysDimensions", "words.Store3(0, DispatchRaysDimensions());", "xxxxxx"},
    {"WorldRayOrigin", "words.Store3(0, asuint(WorldRayOrigin()));", "-xxxx-"},
    {"WorldRayDirection", "words.Store3(0, asuint(WorldRayDirection()));", "-xxxx-"},
    {"RayTMin", "words.Store(0, asuint(RayTMin()));", "-xxxx-"},
    {"RayTCurrent", "words.Store(0, asuint(RayTCurrent()));", "-xxxx-"},
    {"RayFlags", "words.Store(0, RayFlags());", "-xxxx-"},
    {"InstanceIndex", "words.Store(0, InstanceIndex());", "-xxx--"},
    {"InstanceID", "words.Store(0, InstanceID());", "-xxx--"},
    {"GeometryIndex", "words.Store(0, GeometryIndex());", "-xxx--"},
    {"PrimitiveIndex", "words.Store(0, PrimitiveIndex());", "-xxx--"},
    {"ObjectRayOrigin", "words.Store3(0, asuint(ObjectRayOrigin()));", "-xxx--"},
    {"ObjectRayDirection", "words.Store3(0, asuint(ObjectRayDirection()));", "-xxx--"},
    {"ObjectToWorld3x4", "words.Store(0, asuint(ObjectToWorld3x4()[1][3]));", "-xxx--"},
    {"ObjectToWorld4x3", "words.Store(0, asuint(ObjectToWorld4x3()[3][1]));", "-xxx--"},
    {"WorldToObject3x4", "words.Store(0, asuint(WorldToObject3x4()[1][3]));", "-xxx--"},
    {"WorldToObject4x3", "words.Store(0, asuint(WorldToObject4x3()[3][1]));", "-xxx--"},
    {"HitKind", "words.Store(0, HitKind());", "--xx--"},
    {"TraceRay", "P q = {0}; TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, q);", "x--xx-"},
    {"CallShader", "P q = {0}; CallShader(0, q);", "x--xxx"},
    {"ReportHit", "A b = {float2(0, 0)}; ReportHit(1, 0, b);", "-x----"},
    {"IgnoreHit", "IgnoreHit();", "--x---"},
    {"AcceptHitAndEndSearch", "AcceptHitAndEndSearch();", "--x---"},
    {"RayQuery", "RayQuery<RAY_FLAG_NONE> q; q.TraceRayInline(scene, 0, 0xFF, ray); q.Proceed();",
     "xxxxxx"},
};

void intrinsics_by_stage(Context& t) {
  for (const Intrinsic& intrinsic : kIntrinsics) {
    for (size_t i = 0; i < std::size(kStages); ++i) {
      const std::string what = std::string(intrinsic.name) + " in " + kStages[i];
      const Status status = compile(shader_of(kStages[i], intrinsic.statement));
      if (intrinsic.allowed[i] == 'x') {
        t.accepted(what, status);
      } else {
        t.refused(what, status);
      }
    }
  }
}

void no_intrinsic_of_the_contribution(Context& t) {
  for (const char* stage : {"anyhit", "closesthit", "intersection"}) {
    t.refused(std::string("the intrinsic in ") + stage,
              compile(shader_of(stage, "words.Store(0, InstanceContributionToHitGroupIndex());")));
  }
}

void dispatch_values_at_any_depth(Context& t) {
  Program program(t, kaamos_shaders_values(), {"EchoGrid", "EchoDeep", "EchoCall"});
  program.group("Echo", "EchoDeep");
  program.raygen("EchoGrid");
  program.hit("Echo");
  program.callable("EchoCall");
  program.scene = t.scene({triangle(5)});
  DispatchRaysDesc desc = program.tables_without_miss();
  desc.Width = 3;
  desc.Height = desc.Depth = 2;
  const auto words = program.run(desc);
  for (uint32_t i = 0; i < 12; ++i) {
    const std::vector<uint32_t> index = {i % 3, i / 3 % 2, i / 6};
    const auto at = [&](size_t word) {
      return std::vector<uint32_t>(&words[13 * i + word], &words[13 * i + word] + 3);
    };
    t.equal("depth", words[13 * i], 3u);
    t.equal("DispatchRaysIndex() at depth 3", at(1), index);
    t.equal("DispatchRaysDimensions() at depth 3", at(4), {3u, 2u, 2u});
    t.equal("DispatchRaysIndex() in a callable", at(7), index);
    t.equal("DispatchRaysDimensions() in a callable", at(10), {3u, 2u, 2u});
  }
}

std::vector<float> floats_at(const std::vector<uint32_t>& words, size_t byte, size_t count) {
  std::vector<float> out(count);
  std::memcpy(out.data(), &words[byte / 4], count * 4);
  return out;
}

struct Rays : Standard {
  explicit Rays(Context& t)
      : Standard(t, kaamos_shaders_values(), {"AnyRay", "ClosestRay", "MissRay", "BoxRay"}) {
    group("Ray", "ClosestRay", "AnyRay");
    group("BoxOfRay", "BoxClosest", "", "BoxRay");
    local(kRecordSignature, {"BoxOfRay"});
    miss("MissRay");
    hit("Ray");
    hit("BoxOfRay", {LocalArgument::Constants(Constants{})});
  }
};

void world_ray_is_unmodified(Context& t) {
  Rays program(t);
  program.scene = t.top_level({instance(t.bottom_level({triangle(5, 0, kNonOpaque)}), 0.7f),
                               instance(t.bottom_level({box(5)}), 100.3f, 1)});
  Ray ray;
  const std::vector<float> values = {0.1f, 0.2f, -0.3f, 0.01f, 0.02f, 3.7f, 0.125f};
  std::memcpy(ray.origin, values.data(), 12);
  std::memcpy(ray.direction, values.data() + 3, 12);
  ray.t_min = 0.125f;
  program.prepare({ray});
  auto words = program.run();
  t.equal("in the any-hit shader", floats_at(words, 20000, 7), values);
  t.equal("in the closest-hit shader", floats_at(words, 21000, 7), values);
  std::vector<float> other = values;
  other[0] = 100.1f;
  ray.origin[0] = other[0];
  program.prepare({ray});
  words = program.run();
  t.equal("in the intersection shader", floats_at(words, 23000, 7), other);
  t.equal("in the miss shader", floats_at(words, 22000, 7), other);
}

// An instance whose inverse is exact in float: x' = 2 y + 3, y' = -4 x, z' = z / 2 + 1.
RaytracingInstanceDesc turned(const Buffer& bottom_level) {
  RaytracingInstanceDesc desc = instance(bottom_level);
  const float transform[3][4] = {{0, 2, 0, 3}, {-4, 0, 0, 0}, {0, 0, 0.5f, 1}};
  std::memcpy(desc.Transform, transform, sizeof transform);
  return desc;
}

std::vector<uint32_t> trace_turned(Context& t, const Ray& ray, Seen* seen = nullptr) {
  Rays program(t);
  Geometry geometry = triangle(4);
  geometry.transform = {1, 0, 0, 0.25f, 0, 1, 0, 0.25f, 0, 0, 1, 2};  // puts it at z = 6
  program.scene = t.top_level({turned(t.bottom_level({geometry}))});
  program.prepare({ray});
  const auto words = program.run();
  if (seen != nullptr) *seen = seen_of(words, 1)[0];
  return words;
}

Ray ray_to_turned() {
  Ray ray = ray_at(3);
  ray.direction[2] = 0.5f;
  return ray;
}

void object_ray_is_transformed(Context& t) {
  const Ray ray = ray_to_turned();
  Seen seen;
  const auto words = trace_turned(t, ray, &seen);
  // x = -y' / 4, y = (x' - 3) / 2, z = 2 (z' - 1)
  const float expected[] = {-ray.origin[1] / 4, (ray.origin[0] - 3) / 2, -2, 0, 0, 1};
  const auto found = floats_at(words, 24000, 6);
  for (size_t i = 0; i < 6; ++i) {
    t.close("word " + std::to_string(i) + " of ObjectRayOrigin, ObjectRayDirection", found[i],
            expected[i], 1e-6f);
  }
  t.close("t, the same in both spaces", seen.t, 8, 1e-5f);
}

void matrices_are_the_instances(Context& t) {
  const auto words = trace_turned(t, ray_to_turned());
  const std::vector<float> to_world = {0, 2, 0, 3, -4, 0, 0, 0, 0, 0, 0.5f, 1};
  const std::vector<float> to_object = {0, -0.25f, 0, 0, 0.5f, 0, 0, -1.5f, 0, 0, 2, -2};
  t.equal("ObjectToWorld3x4()", floats_at(words, 24024, 12), to_world);
  t.equal("WorldToObject3x4()", floats_at(words, 24072, 12), to_object);
  t.equal("ObjectToWorld4x3(), transposed", floats_at(words, 24120, 12), to_world);
  t.equal("WorldToObject4x3(), transposed", floats_at(words, 24168, 12), to_object);
}

void ray_t_current_by_stage(Context& t) {
  Standard program(t);
  program.record("BoxCounted");
  program.record("Counted");
  program.scene = t.top_level({instance(t.bottom_level({box(5, 0, kNonOpaque)})),
                               instance(t.bottom_level({triangle(6, 0, kNonOpaque)}), 10, 1)});
  Ray miss = ray_at(100);
  miss.t_max = kInfinity;
  const auto seen = program.trace({Ray{}, ray_at(10), miss});
  t.equal("in the intersection shader before any hit", seen[0].barycentrics[0], 1000.0f);
  t.equal("in the any-hit shader of a box", seen[0].any_t, 5.0f);
  t.equal("in the closest-hit shader of a box", seen[0].t, 5.0f);
  t.distance("in the any-hit shader of a triangle", seen[1].any_t, 6.0f);
  t.distance("in the closest-hit shader of a triangle", seen[1].t, 6.0f);
  t.equal("in the miss shader", seen[2].t, kInfinity);
}

void instance_index_counts_inactive(Context& t) {
  Standard program(t);
  program.record("Plain");
  RaytracingInstanceDesc inactive;
  const Buffer geometry = t.bottom_level({triangle(5)});
  std::vector<RaytracingInstanceDesc> instances = {inactive, instance(geometry), inactive,
                                                   instance(geometry, 10)};
  instances[0].InstanceID = 1;
  instances[1].InstanceID = 0xFFFFFF;
  instances[3].InstanceID = 0x123456;
  program.scene = t.top_level(instances);
  const auto seen = program.trace({ray_at(0), ray_at(10)});
  t.equal("InstanceIndex() of the second", seen[0].instance_index, 1u);
  t.equal("InstanceID() of the second", seen[0].instance_id, 0xFFFFFFu);
  t.equal("InstanceIndex() of the fourth", seen[1].instance_index, 3u);
  t.equal("InstanceID() of the fourth", seen[1].instance_id, 0x123456u);
}

void append(Geometry& geometry, const Geometry& more) {
  geometry.vertices.insert(geometry.vertices.end(), more.vertices.begin(), more.vertices.end());
  geometry.boxes.insert(geometry.boxes.end(), more.boxes.begin(), more.boxes.end());
}

void primitive_index_restarts(Context& t) {
  Standard program(t);
  program.records("Plain", 1);
  program.records("Box", 1);
  Geometry first, second, boxes;
  append(first, triangle(5, kNan));              // inactive
  append(first, {{0, 0, 5, 1, 1, 5, 0, 0, 5}});  // degenerate
  append(first, triangle(5));
  append(second, triangle(5, 10));
  append(second, triangle(5, kNan));
  append(second, triangle(5, 20));
  append(boxes, box(5, kNan));
  append(boxes, box(5));
  program.scene = t.top_level(
      {instance(t.bottom_level({first, second})), instance(t.bottom_level({boxes}), 30, 1)});
  std::vector<uint32_t> found;
  for (const Seen& each : program.trace({ray_at(0), ray_at(10), ray_at(20), ray_at(30)})) {
    t.equal("end", each.end, kClosestHitRan);
    found.push_back(each.primitive);
  }
  t.equal("PrimitiveIndex()", found, {2u, 0u, 2u, 1u});
}

void geometry_index_is_the_position(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(5, 20), triangle(5), triangle(5, 10)});
  std::vector<uint32_t> found;
  for (const Seen& each : program.trace({ray_at(0), ray_at(10), ray_at(20)})) {
    found.push_back(each.geometry);
  }
  t.equal("GeometryIndex()", found, {1u, 2u, 0u});
}

void hit_kinds(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.record("Box", 5, 0);
  program.record("Box", 5, 127);
  const Buffer boxes = t.bottom_level({box(5)});
  const Buffer triangles = t.bottom_level({triangle(5)});
  program.scene = t.top_level({instance(triangles), instance(triangles, 10, 0, 2),
                               instance(boxes, 20, 1), instance(boxes, 30, 2)});
  std::vector<uint32_t> found;
  for (const Seen& each : program.trace({ray_at(0), ray_at(10), ray_at(20), ray_at(30)})) {
    found.push_back(each.hit_kind);
  }
  t.equal("HitKind() of front, back, 0, 127", found, {254u, 255u, 0u, 127u});
}

void barycentrics_weigh_vertices_1_and_2(Context& t) {
  Standard program(t);
  program.record("Plain");
  Ray ray;
  ray.origin[0] = 1;
  ray.origin[1] = -1;
  // (1, -1) = v0 + 1/2 (v1 - v0) + 1/6 (v2 - v0)
  const Seen seen = program.trace(t.scene({triangle(5)}), ray);
  t.close("x", seen.barycentrics[0], 1.0f / 2, 1e-6f);
  t.close("y", seen.barycentrics[1], 1.0f / 6, 1e-6f);
}

void triangle_attributes_have_8_bytes(Context& t) {
  Standard program(t, kaamos_shaders_values(), {"ClosestTooLarge"});
  program.group("TooLarge", "ClosestTooLarge");
  t.refused("a triangle group with attributes of 12 bytes", program.try_create());
}

void values_outlive_nested_traces(Context& t) {
  Standard program(t, kaamos_shaders_nested(), {"NestedValues"});
  program.group("Nested", "NestedValues");
  program.local(kRecordSignature, {"Nested"});
  program.record("Nested");
  program.record("Plain");
  Geometry near;
  append(near, triangle(5, 100));
  append(near, triangle(5));
  RaytracingInstanceDesc far = instance(t.bottom_level({triangle(10)}), 0, 0, 2);
  far.InstanceID = 50;
  RaytracingInstanceDesc mine = instance(t.bottom_level({triangle(90), near}));
  mine.InstanceID = 60;
  const Seen seen = program.trace(t.top_level({far, mine}));
  t.equal("end of the nested trace", seen.any_hits, kClosestHitRan);
  t.equal("PrimitiveIndex() of the nested trace", seen.any_record, 0u);
  t.equal("PrimitiveIndex()", seen.primitive, 1u);
  t.equal("GeometryIndex()", seen.geometry, 1u);
  t.equal("InstanceIndex()", seen.instance_index, 1u);
  t.equal("InstanceID()", seen.instance_id, 60u);
  t.equal("HitKind()", seen.hit_kind, 254u);
  t.distance("RayTCurrent()", seen.t, 5.0f);
  t.equal("record", seen.record, 0u);
}

void both_positions_agree(Context& t) {
  Standard program(t);
  program.record("Plain");
  Ray ray;
  ray.direction[0] = 0.11f;
  ray.direction[1] = -0.07f;
  const Seen seen = program.trace(t.scene({triangle(5)}), ray);
  const float u = seen.barycentrics[0], v = seen.barycentrics[1];
  const float by_vertices[] = {3 * u - 3 * v, 3 - 6 * u - 6 * v, 5};
  for (int i = 0; i < 3; ++i) {
    t.close("axis " + std::to_string(i), by_vertices[i], ray.origin[i] + seen.t * ray.direction[i],
            1e-5f);
  }
}

}  // namespace

std::vector<RuleTest> sv_tests() {
  return {{"SV-01, ERR-32", intrinsics_by_stage},
          {"SV-02", dispatch_values_at_any_depth},
          {"SV-03", world_ray_is_unmodified},
          {"SV-04", object_ray_is_transformed},
          {"SV-05", ray_t_current_by_stage},
          {"SV-07", instance_index_counts_inactive},
          {"SV-08", primitive_index_restarts},
          {"SV-09", geometry_index_is_the_position},
          {"SV-10", hit_kinds},
          {"SV-11", matrices_are_the_instances},
          {"SV-12", barycentrics_weigh_vertices_1_and_2},
          {"SV-13", triangle_attributes_have_8_bytes},
          {"SV-14", values_outlive_nested_traces},
          {"SV-15", no_intrinsic_of_the_contribution},
          {"SV-17", both_positions_agree}};
}

}  // namespace kaamos::conformance
