// SPDX-License-Identifier: MIT
//
// Traversal: intervals, inactive and degenerate primitives, what ends a trace.
#include <cmath>
#include <limits>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<uint32_t> ends_of(const std::vector<Seen>& seen) {
  std::vector<uint32_t> out;
  for (const Seen& each : seen) out.push_back(each.end);
  return out;
}

Ray between(float t_min, float t_max) {
  Ray ray;
  ray.t_min = t_min;
  ray.t_max = t_max;
  return ray;
}

void directions_are_not_normalised(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(8)});
  Ray four = Ray{}, quarter = Ray{};
  four.direction[2] = 4;
  quarter.direction[2] = 0.25f;
  const auto seen = program.trace({Ray{}, four, quarter});
  t.distance("t of direction x 1", seen[0].t, 8.0f);
  t.distance("t of direction x 4", seen[1].t, 2.0f);
  t.distance("t of direction / 4", seen[2].t, 32.0f);
}

void triangles_lie_strictly_between(Context& t) {
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(8)});
  const float met = program.trace(Ray{}).t;  // as the traversal rounds it
  t.distance("t", met, 8.0f);
  const float below = std::nextafter(met, 0.0f), above = std::nextafter(met, 9.0f);
  t.equal("ends of TMin = t, TMax = t, TMin below t, TMax above t",
          ends_of(program.trace(
              {between(met, 100), between(0, met), between(below, 100), between(0, above)})),
          {kMissRan, kMissRan, kClosestHitRan, kClosestHitRan});
}

void procedural_hits_include_the_ends(Context& t) {
  Standard program(t);
  program.record("Box", 8);
  program.scene = t.scene({box(8)});
  const float below = std::nextafter(8.0f, 0.0f), above = std::nextafter(8.0f, 9.0f);
  t.equal("ends of TMin = t, TMax = t, TMin above t, TMax below t",
          ends_of(program.trace(
              {between(8, 100), between(0, 8), between(above, 100), between(0, below)})),
          {kClosestHitRan, kClosestHitRan, kMissRan, kMissRan});
}

void a_null_structure_is_missed(Context& t) {
  Standard program(t);
  program.record("Plain");
  t.equal("end", program.trace(Ray{}).end, kMissRan);
  t.equal("end in an empty top level", program.trace(t.top_level({})).end, kMissRan);
}

// Rays at x = 0, 10, ... into triangles there, with a NaN in one vertex or one row each.
void a_nan_in_any_x_deactivates(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry geometry;
  for (int i = 0; i < 4; ++i) {
    Geometry one = triangle(5, 10.0f * static_cast<float>(i));
    if (i < 3) one.vertices[3 * static_cast<size_t>(i)] = kNan;
    geometry.vertices.insert(geometry.vertices.end(), one.vertices.begin(), one.vertices.end());
  }
  program.scene = t.scene({geometry});
  const auto seen = program.trace({ray_at(0), ray_at(10), ray_at(20), ray_at(30)});
  t.equal("ends", ends_of(seen), {kMissRan, kMissRan, kMissRan, kClosestHitRan});
  t.equal("PrimitiveIndex() of the active one", seen[3].primitive, 3u);
}

void inactive_boxes_and_instances(Context& t) {
  Standard program(t);
  program.record("Box");
  Geometry boxes = box(5);
  boxes.boxes.insert(boxes.boxes.begin(), box(5).boxes[0]);
  boxes.boxes[0].MinX = kNan;
  boxes.boxes[1] = box(5, 10).boxes[0];
  RaytracingInstanceDesc inactive = instance(t.bottom_level({box(5)}), 20);
  inactive.AccelerationStructure = 0;
  program.scene = t.top_level({inactive, instance(t.bottom_level({boxes}))});
  const auto seen = program.trace({ray_at(0), ray_at(10), ray_at(20)});
  // Boxes may be enlarged, so a ray beside one may meet it; but no ray meets an inactive one.
  for (const Seen& each : seen) {
    t.holds("no inactive box or instance is hit",
            each.end == kMissRan || (each.primitive == 1 && each.instance_index == 1));
  }
  t.equal("end at the active box", seen[1].end, kClosestHitRan);
  t.equal("PrimitiveIndex() behind an inactive box", seen[1].primitive, 1u);
  t.equal("InstanceIndex() behind an inactive instance", seen[1].instance_index, 1u);
}

void inactivity_is_judged_after_the_transform(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry geometry = triangle(5);
  geometry.transform = {kNan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const auto seen = program.trace(t.scene({geometry, triangle(6)}));
  t.equal("GeometryIndex()", seen.geometry, 1u);
}

void degenerate_triangles_are_never_hit(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry geometry;
  geometry.vertices = {0.1f, -1,   5, 0.1f, 0,    5, 0.1f, 1,    5,   // collinear
                       0.1f, 0.2f, 5, 0.1f, 0.2f, 5, 0.1f, 0.2f, 5,   // a point
                       -1,   0.2f, 5, 1,    0.2f, 5, -1,   0.2f, 5};  // one vertex twice
  t.equal("end", program.trace(t.scene({geometry})).end, kMissRan);
  t.distance("t behind them", program.trace(t.scene({geometry, triangle(6)})).t, 6.0f);
}

void degenerate_instances_are_legal(Context& t) {
  Standard program(t);
  program.record("Plain");
  Geometry inactive = triangle(5, kNan);
  const Buffer empty = t.bottom_level({inactive});
  t.equal("end of nothing but such", program.trace(t.top_level({instance(empty)})).end, kMissRan);
  program.scene = t.top_level({instance(empty), instance(t.bottom_level({triangle(5)}))});
  t.equal("InstanceIndex() beside one", program.trace(Ray{}).instance_index, 1u);
}

void plates_are_not_lost(Context& t) {
  Standard program(t);
  program.record("Box", 5);
  Geometry plate;
  plate.boxes = {{-4, -4, 5, 4, 4, 5}};
  program.scene = t.scene({plate});
  std::vector<Ray> rays;
  for (int i = 0; i < 400; ++i) {
    Ray ray;
    ray.direction[0] = -0.5f + 0.0025f * static_cast<float>(i);
    ray.direction[1] = 0.3f - 0.0017f * static_cast<float>(i);
    rays.push_back(ray);
  }
  uint32_t hits = 0;
  for (const Seen& each : program.trace(rays)) hits += each.end == kClosestHitRan ? 1 : 0;
  t.equal("hits of 400 oblique rays", hits, 400u);
}

void repeated_runs_agree(Context& t) {
  std::vector<uint32_t> first;
  for (int run = 0; run < 3; ++run) {
    Standard program(t);
    program.record("Counted");
    std::vector<Geometry> geometries;
    std::vector<Ray> rays;
    for (int i = 0; i < 40; ++i) {
      geometries.push_back(triangle(3 + 0.37f * static_cast<float>(i * 17 % 40),
                                    0.11f * static_cast<float>(i), RaytracingGeometryFlags::kNone));
      rays.push_back(ray_at(0.1f * static_cast<float>(i)));
    }
    program.scene = t.scene(geometries);
    program.prepare(rays);
    auto words = program.run(40);
    words.resize(40 * sizeof(Seen) / 4);
    if (run == 0) first = words;
    t.holds("run " + std::to_string(run) + " gives the bits of the first", words == first);
  }
}

}  // namespace

std::vector<RuleTest> trv_tests() {
  return {{"TRV-01", directions_are_not_normalised},
          {"TRV-03", triangles_lie_strictly_between},
          {"TRV-04", procedural_hits_include_the_ends},
          {"TRV-13", repeated_runs_agree},
          {"TRV-19", plates_are_not_lost},
          {"TRV-46", a_null_structure_is_missed},
          {"TRV-55", a_nan_in_any_x_deactivates},
          {"TRV-56, TRV-58", inactive_boxes_and_instances},
          {"TRV-57", inactivity_is_judged_after_the_transform},
          {"TRV-63", degenerate_triangles_are_never_hit},
          {"TRV-67", degenerate_instances_are_legal}};
}

}  // namespace kaamos::conformance
