// SPDX-License-Identifier: MIT
//
// Inline ray tracing: what a query says about its ray, candidate and hit, and where queries may
// live.
#include <shaders/query.h>

#include "tests/conformance/compile.h"
#include "tests/conformance/rq.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kOnce = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;  // not opaque

// Checks what a hit and a candidate report for instance 1: object x = (x - 1) / 2.
void check_hit(Context& t, const std::string& of, const std::vector<uint32_t>& words, size_t start,
               uint32_t kind) {
  const auto word = [&](size_t byte) { return words[(start + byte) / 4]; };
  const auto number = [&](size_t byte) { return at<float>(words, start + byte); };
  t.equal(of + "type", word(0), kind);
  t.equal(of + "InstanceIndex", word(4), 1u);
  t.equal(of + "InstanceID", word(8), 33u);
  t.equal(of + "InstanceContributionToHitGroupIndex", word(12), 77u);
  t.equal(of + "GeometryIndex", word(16), 1u);
  t.equal(of + "PrimitiveIndex", word(20), 1u);
  const float origin[] = {-0.45f, 0.2f, 0};
  const float direction[] = {0, 0, 1};
  for (size_t i = 0; i < 3; ++i) {
    t.close(of + "ObjectRayOrigin", number(32 + 4 * i), origin[i], 1e-6f);
    t.close(of + "ObjectRayDirection", number(44 + 4 * i), direction[i], 1e-6f);
  }
  t.close(of + "ObjectToWorld3x4", number(56), 1, 1e-6f);
  t.close(of + "ObjectToWorld4x3", number(60), 1, 1e-6f);
  t.close(of + "WorldToObject3x4", number(64), -0.5f, 1e-6f);
  t.close(of + "WorldToObject4x3", number(68), -0.5f, 1e-6f);
}

Buffer nested_scene(Context& t, bool boxes) {
  Geometry far = boxes ? box(5, 50, kOnce) : triangle(5, 50, kOnce);
  Geometry both = far;
  const Geometry near = boxes ? box(5, 0, kOnce) : triangle(5, 0, kOnce);
  both.vertices.insert(both.vertices.end(), near.vertices.begin(), near.vertices.end());
  both.boxes.insert(both.boxes.end(), near.boxes.begin(), near.boxes.end());
  RaytracingInstanceDesc second = instance(t.bottom_level({far, both}), 1, 77);
  second.Transform[0][0] = 2;
  second.InstanceID = 33;
  return t.top_level({instance(t.bottom_level({triangle(5)}), 500), second});
}

void accessors_by_state(Context& t) {
  Query triangles(t, "Accessors");
  auto words = triangles.run_rays(nested_scene(t, false), {Ray{}});
  check_hit(t, "triangle candidate: ", words, 0, 0);
  check_hit(t, "committed triangle: ", words, 192, kTriangle);
  t.equal("front face of the candidate", words[72 / 4], 1u);
  t.equal("front face of the hit", words[264 / 4], 1u);
  t.close("t of the candidate", at<float>(words, 76), 5, 1e-5f);
  t.equal("t of the hit", at<float>(words, 268), at<float>(words, 76));
  const std::vector<float> corners = triangle(5).vertices;
  const float u = at<float>(words, 80);
  const float v = at<float>(words, 84);
  t.close("x by the barycentrics", (1 - u - v) * corners[0] + u * corners[3] + v * corners[6],
          -0.45f, 1e-5f);
  t.close("y by the barycentrics", (1 - u - v) * corners[1] + u * corners[4] + v * corners[7], 0.2f,
          1e-5f);
  t.equal("barycentrics of the hit", at<float>(words, 272), u);
  t.equal("barycentrics of the hit", at<float>(words, 276), v);

  Query boxes(t, "Accessors");
  Ray ray;
  ray.t_min = 0.25f;
  ray.t_max = 60;
  ray.flags = kForceNonOpaque;
  words = boxes.run_rays(nested_scene(t, true), {ray});
  check_hit(t, "box candidate: ", words, 0, 1);
  check_hit(t, "committed box: ", words, 192, kBox);
  t.equal("t of the box", at<float>(words, 268), 5.5f);
  t.equal("RayFlags", words[256], ray.flags);
  t.equal("RayTMin", at<float>(words, 1028), 0.25f);
  t.equal("CommittedRayT before the search", at<float>(words, 1032), 60.0f);
  t.equal("WorldRayOrigin", at<float>(words, 1040), 0.1f);
  t.equal("WorldRayDirection", at<float>(words, 1060), 1.0f);
}

void copies_share_one_state(Context& t) {
  Query query(t, "Aliases");
  const auto words = query.run_rays(t.scene({triangle(5, 0, kOnce)}), {Ray{}});
  t.equal("candidates by the first name", words[0], 1u);
  t.equal("status by the first name", words[1], kTriangle);
  t.distance("t by the second name", at<float>(words, 8), 5.0f);
  t.equal("Proceed() by the second name", words[3], 0u);
  const std::string start =
      "RWByteAddressBuffer words : register(u0);\n"
      "void step(RayQuery<RAY_FLAG_FORCE_OPAQUE> query) { query.Proceed(); }\n"
      "[shader(\"raygeneration\")]\nvoid Main() {\n  RayQuery<RAY_FLAG_";
  t.accepted("an argument with the parameter's flags",
             compile(start + "FORCE_OPAQUE> query;\n  step(query);\n}\n"));
  t.refused("an argument with other flags", compile(start + "NONE> query;\n  step(query);\n}\n"));
  t.refused("a copy with other flags",
            compile(start + "NONE> query;\n  RayQuery<RAY_FLAG_FORCE_OPAQUE> other = query;\n}\n"));
}

void queries_in_every_stage(Context& t) {
  Query query(t, "Interleaved");
  const auto pair =
      query.run_rays(t.scene({triangle(6, 0, kOnce), triangle(5, 0, kOnce), triangle(8, 20, kOnce),
                              triangle(9, 20, kOnce), triangle(10, 20, kOnce)}),
                     {asking(kCommitTriangles), asking(kCommitTriangles, 0, 20)});
  t.distance("t of the first of two", at<Asked>(pair, 0).t, 5.0f);
  t.distance("t of the second of two", at<Asked>(pair, 64).t, 8.0f);

  Program program(
      t, kaamos_shaders_query(),
      {"StagesAsk", "AnyHitAsks", "BoxAsks", "ClosestAsks", "MissAsks", "CallableAsks"});
  program.group("Asking", "ClosestAsks", "AnyHitAsks", "BoxAsks");
  program.raygen("StagesAsk");
  program.hit("Asking");
  program.miss("MissAsks");
  program.callable("CallableAsks");
  program.scene =
      t.top_level({instance(t.bottom_level({box(5, 0, kOnce)})),
                   instance(t.bottom_level({triangle(6, 20, kOnce), triangle(5, 20, kOnce)}))});
  program.rays = t.upload(std::vector<Ray>{Ray{}, asking(kCommitTriangles, 0, 20)});
  const auto words = program.run();
  const char* stages[] = {"any-hit", "intersection", "closest-hit", "miss", "callable"};
  for (size_t i = 0; i < 5; ++i) {
    const Asked found = at<Asked>(words, 1024 + 64 * i);
    t.equal(std::string("status in the ") + stages[i] + " shader", found.status, kTriangle);
    t.distance(std::string("t in the ") + stages[i] + " shader", found.t, 5.0f);
  }
  const Seen seen = at<Seen>(words, 0);
  t.equal("end of the trace around them", seen.end, kClosestHitRan);
  t.equal("its t", seen.t, 5.0f);
  t.equal("its attributes", seen.box_record, 9u);
  t.equal("its any-hit shader", seen.any_hits, 1u);
}

}  // namespace

std::vector<RuleTest> rq_accessors_tests() {
  return {{"RQ-13", accessors_by_state},
          {"RQ-14", copies_share_one_state},
          {"RQ-15", queries_in_every_stage}};
}

}  // namespace kaamos::conformance
