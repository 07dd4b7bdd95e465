// SPDX-License-Identifier: MIT
//
// Inline ray tracing.
#include <shaders/query.h>

#include <array>

#include "tests/conformance/rq.h"
#include "tests/conformance/walker.h"

namespace kaamos::conformance {

using namespace rtapi;

Ray asking(uint32_t what, uint32_t flags, float x) {
  Ray ray = ray_at(x);
  ray.flags = flags;
  ray.contribution = what;
  const float box_t = 4.5f;
  std::memcpy(&ray.extra[0], &box_t, sizeof box_t);
  return ray;
}

Query::Query(Context& t, const char* shader)
    : Program(t, kaamos_shaders_query(), {shader}), context_(&t) {
  raygen(shader);
}

std::vector<uint32_t> Query::run_rays(const Buffer& top_level, const std::vector<Ray>& list,
                                      uint32_t width) {
  scene = top_level;
  rays = context_->upload(list);
  return run(width);
}

std::vector<Asked> ask(Context& t, const Buffer& top_level, const std::vector<Ray>& list) {
  Query query(t, "Ask");
  const auto words = query.run_rays(top_level, list, static_cast<uint32_t>(list.size()));
  std::vector<Asked> out;
  for (size_t i = 0; i < list.size(); ++i) out.push_back(at<Asked>(words, 64 * i));
  return out;
}
Asked ask(Context& t, const Buffer& top_level, const Ray& ray) {
  return ask(t, top_level, std::vector<Ray>{ray})[0];
}

namespace {

constexpr auto kOpaque = RaytracingGeometryFlags::kOpaque;
constexpr auto kOnce = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;  // not opaque

Buffer three_triangles(Context& t, RaytracingGeometryFlags flags) {
  return t.scene({triangle(6, 0, flags), triangle(5, 0, flags), triangle(7, 0, flags)});
}

void flags_add_up(Context& t) {
  Query query(t, "AskWithFlags");
  const Buffer structure = t.top_level({instance(t.bottom_level({triangle(5, 0, kOnce)})),
                                        instance(t.bottom_level({box(8, 0, kOnce)}))});
  const auto words = query.run_rays(structure, {asking(0, kAcceptFirst)});
  const uint32_t template_flags[] = {0,          kForceOpaque,  kForceNonOpaque, kSkipTriangles,
                                     kSkipBoxes, kCullNonOpaque};
  // The query with both kinds of flags meets these: candidate triangles, candidate boxes, its end.
  const std::array<uint32_t, 3> expected[] = {{1, 1, kNothing}, {0, 0, kTriangle},
                                              {1, 1, kNothing}, {0, 1, kNothing},
                                              {1, 0, kNothing}, {0, 0, kNothing}};
  for (size_t i = 0; i < 6; ++i) {
    const std::string what = "template flags " + std::to_string(template_flags[i]) + ": ";
    t.equal(what + "RayFlags()", words[4 * i], template_flags[i] | kAcceptFirst);
    // The box may have been a candidate before the forced-opaque triangle ends the search.
    t.equal(what + "triangles", words[4 * i + 1], expected[i][0]);
    if (i != 1) t.equal(what + "any boxes", words[4 * i + 2] > 0 ? 1u : 0u, expected[i][1]);
    t.equal(what + "status", words[4 * i + 3], expected[i][2]);
  }
}

void trace_restarts(Context& t) {
  Query query(t, "Restart");
  const Buffer structure =
      t.scene({triangle(5, 0, kOnce), triangle(6, 0, kOnce), triangle(9, 20, kOnce)});
  Ray second = asking(kCommitTriangles, 0, 20);
  second.t_max = 50;
  const auto words = query.run_rays(structure, {asking(kCommitTriangles), second});
  t.equal("status of what is given up", at<Asked>(words, 0).status, kTriangle);
  t.equal("status at once after the second start", at<Asked>(words, 64).status, kNothing);
  t.equal("CommittedRayT() there", at<Asked>(words, 64).t, 50.0f);
  t.equal("status of the second ray", at<Asked>(words, 128).status, kTriangle);
  t.equal("geometry of the second ray", at<Asked>(words, 128).geometry, 2u);
}

void proceed_tells_of_candidates(Context& t) {
  const Asked opaque = ask(t, t.scene({triangle(5, 0, kOpaque)}), asking(0));
  t.equal("candidates of an opaque triangle", opaque.triangles, 0u);
  t.equal("its status", opaque.status, kTriangle);
  t.distance("its t", opaque.t, 5.0f);
  const Asked other = ask(t, t.scene({triangle(5, 0, kOnce)}), asking(0));
  t.equal("candidates of a triangle that is not opaque", other.triangles, 1u);
  t.equal("its status, not committed", other.status, kNothing);
  for (const auto flags : {kOpaque, kOnce}) {
    const Buffer boxes = t.scene({box(5, 0, flags)});
    const std::string what = flags == kOpaque ? "an opaque box" : "a box that is not opaque";
    t.holds("a candidate of " + what, ask(t, boxes, asking(0)).boxes >= 1);
    t.equal("status of " + what + ", not committed", ask(t, boxes, asking(0)).status, kNothing);
    const uint32_t cull = flags == kOpaque ? kCullOpaque : kCullNonOpaque;
    t.equal("candidates of " + what + ", culled", ask(t, boxes, asking(0, cull)).boxes, 0u);
    t.equal("candidates of " + what + ", skipped", ask(t, boxes, asking(0, kSkipBoxes)).boxes, 0u);
  }
  // Nothing behind a committed hit is a candidate any more.
  const Buffer mixed = t.scene({triangle(5, 0, kOpaque), triangle(9, 0, kOnce)});
  const Asked both = ask(t, mixed, asking(kCommitTriangles));
  t.distance("t of the closest of both", both.t, 5.0f);
  t.holds("the far one is a candidate at most once", both.triangles <= 1);
  Ray short_ray = asking(kCommitTriangles);
  short_ray.t_max = 4;
  t.equal("candidates out of range", ask(t, mixed, short_ray).triangles, 0u);
}

// Geometry, then instance, then ray: the last one with a flag decides.
bool is_opaque(bool geometry, uint32_t instance_flags, uint32_t ray_flags) {
  if (ray_flags & kForceOpaque) return true;
  if (ray_flags & kForceNonOpaque) return false;
  if (instance_flags & 4) return true;
  if (instance_flags & 8) return false;
  return geometry;
}

template <class Check>
void for_opacities(Context& t, bool boxes, const Check& check) {
  for (const bool geometry : {false, true}) {
    const auto flags = geometry ? kOpaque : kOnce;
    for (const uint32_t instance_flags : {0u, 4u, 8u}) {
      const Buffer structure =
          t.scene({boxes ? box(5, 0, flags) : triangle(5, 0, flags)}, 0, instance_flags);
      const std::vector<Ray> rays = {asking(0), asking(0, kForceOpaque),
                                     asking(0, kForceNonOpaque)};
      const auto found = ask(t, structure, rays);
      for (size_t i = 0; i < rays.size(); ++i) {
        const std::string what = std::string(geometry ? "opaque geometry" : "geometry") +
                                 ", instance flags " + std::to_string(instance_flags) +
                                 ", ray flags " + std::to_string(rays[i].flags) + ": ";
        check(what, found[i], is_opaque(geometry, instance_flags, rays[i].flags));
      }
    }
  }
}

void opacity_comes_from_flags(Context& t) {
  for_opacities(t, false, [&](const std::string& what, const Asked& found, bool opaque) {
    t.equal(what + "candidates", found.triangles, opaque ? 0u : 1u);
    t.equal(what + "status", found.status, opaque ? kTriangle : kNothing);
  });
}

void false_is_final(Context& t) {
  for (const uint32_t what : {0u, uint32_t{kCommitTriangles}}) {
    const Asked found = ask(t, three_triangles(t, kOnce), asking(what));
    t.equal("Proceed() that gave TRUE after FALSE", found.proceeds, 0u);
    t.holds("candidates before", found.triangles >= 1);
  }
  t.equal("Proceed() that gave TRUE after a miss",
          ask(t, three_triangles(t, kOnce), asking(0, 0, 50)).proceeds, 0u);
}

void abort_ends_the_search(Context& t) {
  const Buffer structure = three_triangles(t, kOnce);
  const Asked committed = ask(t, structure, asking(kCommitTriangles | kAbort));
  t.equal("candidates", committed.triangles, 1u);
  t.equal("status", committed.status, kTriangle);
  t.holds("t of the only candidate", t.is_distance(committed.t, 5) ||
                                         t.is_distance(committed.t, 6) ||
                                         t.is_distance(committed.t, 7));
  t.equal("Proceed() that gave TRUE", committed.proceeds, 0u);
  t.equal("status where nothing was committed", ask(t, structure, asking(kAbort)).status, kNothing);
}

void commits_of_triangles(Context& t) {
  const Buffer structure = three_triangles(t, kOnce);
  for (const uint32_t what : {uint32_t{kCommitTriangles}, kCommitTriangles | kTwice}) {
    const Asked found = ask(t, structure, asking(what));
    t.equal("status", found.status, kTriangle);
    t.distance("t", found.t, 5.0f);
    t.equal("geometry", found.geometry, 1u);
  }
}

void commits_of_boxes(Context& t) {
  for (const uint32_t what : {uint32_t{kCommitBoxes}, kCommitBoxes | kTwice}) {
    const Buffer both = t.top_level(
        {instance(t.bottom_level({box(5, 0, kOnce)})), instance(t.bottom_level({triangle(30)}))});
    const Asked found = ask(t, both, asking(what));
    t.equal("status", found.status, kBox);
    t.equal("t", found.t, 4.5f);
    t.equal("instance", found.instance_index, 0u);
  }
}

void the_first_commit_ends(Context& t) {
  const Asked own = ask(t, three_triangles(t, kOnce), asking(kCommitTriangles, kAcceptFirst));
  t.equal("candidates until the commit", own.triangles, 1u);
  t.equal("status", own.status, kTriangle);
  t.equal("Proceed() that gave TRUE after it", own.proceeds, 0u);
  const Asked none = ask(t, three_triangles(t, kOnce), asking(0, kAcceptFirst));
  t.equal("candidates without a commit", none.triangles, 3u);
  const Asked system = ask(t, three_triangles(t, kOpaque), asking(0, kAcceptFirst));
  t.equal("status after a commit by the system", system.status, kTriangle);
  t.equal("its candidates", system.triangles, 0u);
  const Buffer boxes = t.scene({box(5, 0, kOnce), box(15, 0, kOnce), box(25, 0, kOnce)});
  const Asked box_hit = ask(t, boxes, asking(kCommitBoxes, kAcceptFirst));
  t.equal("boxes until the commit", box_hit.boxes, 1u);
  t.equal("status of the box", box_hit.status, kBox);
}

void status_is_readable(Context& t) {
  Query query(t, "Values");
  const auto words = query.run_rays(t.scene({triangle(5)}), {Ray{}});
  t.equal("COMMITTED_* and CANDIDATE_*", std::vector<uint32_t>(words.begin(), words.begin() + 5),
          {0u, 1u, 2u, 0u, 1u});
  t.equal("states around the candidates of triangles",
          ask(t, three_triangles(t, kOnce), asking(kCommitTriangles)).status_on_the_way,
          (1u << kNothing) | (1u << kTriangle));
  t.equal("states around the candidates of a box",
          ask(t, t.scene({box(5, 0, kOnce)}), asking(kCommitBoxes)).status_on_the_way,
          (1u << kNothing) | (1u << kBox));
  const Asked stopped = ask(t, three_triangles(t, kOnce), asking(kCommitTriangles | kStop));
  t.equal("status where the loop is left early", stopped.status, kTriangle);
}

void t_starts_at_t_max(Context& t) {
  Ray ray = asking(0, 0, 50);
  ray.t_max = 123.5f;
  const Asked missed = ask(t, three_triangles(t, kOnce), ray);
  t.equal("status", missed.status, kNothing);
  t.equal("CommittedRayT() of a miss", missed.t, 123.5f);
  ray = asking(0);
  ray.t_max = 123.5f;
  t.equal("CommittedRayT() where no candidate was committed",
          ask(t, three_triangles(t, kOnce), ray).t, 123.5f);
}

void boxes_say_whether_they_are_opaque(Context& t) {
  for_opacities(t, true, [&](const std::string& what, const Asked& found, bool opaque) {
    t.holds(what + "the box is a candidate", found.boxes >= 1);
    t.equal(what + "candidates that are not opaque", found.non_opaque_boxes,
            opaque ? 0u : found.boxes);
    t.equal(what + "status", found.status, kNothing);
  });
}

// Random rays, traced both by a query and by TraceRay with an any-hit shader that accepts.
void queries_agree_with_traces(Context& t) {
  SceneOptions options;
  options.instance_flags = true;
  options.opaque = true;
  options.boxes = false;
  uint32_t hits = 0;
  for (const uint32_t seed : {11u, 12u, 13u}) {
    Random random(seed);
    const Scene description = random_scene(random, options);
    Walker builder(t);
    builder.build(description);
    std::vector<Ray> rays =
        random_rays(random, description, 300, kAcceptSome,
                    {0, kForceOpaque, kForceNonOpaque, 0x10, 0x20, kCullOpaque, kCullNonOpaque});
    for (Ray& ray : rays) {
      ray.contribution = kCommitTriangles;
      ray.miss = 0;
      ray.mask = random.chance(0.3) ? random.below(256) : 0xFF;
      if (random.chance(0.3)) ray.t_max = random.between(0.5f, 20);
    }
    Standard tracing(t);
    tracing.record("Counted");
    tracing.scene = builder.scene;
    tracing.prepare(rays);
    DispatchRaysDesc desc = tracing.tables();
    desc.HitGroupTable.StrideInBytes = 0;
    desc.Width = static_cast<uint32_t>(rays.size());
    const auto seen = seen_of(tracing.run(desc), rays.size());
    const auto asked = ask(t, builder.scene, rays);
    for (size_t i = 0; i < rays.size(); ++i) {
      const std::string what = "seed " + std::to_string(seed) + ", ray " + std::to_string(i) + ": ";
      const bool hit = seen[i].end == kClosestHitRan;
      hits += hit;
      t.equal(what + "status", asked[i].status, hit ? kTriangle : kNothing);
      if (!hit || asked[i].status != kTriangle) continue;
      t.equal(what + "t", asked[i].t, seen[i].t);
      t.equal(what + "instance", asked[i].instance_index, seen[i].instance_index);
      t.equal(what + "geometry", asked[i].geometry, seen[i].geometry);
      t.equal(what + "primitive", asked[i].primitive, seen[i].primitive);
      t.equal(what + "front face", asked[i].front_face, seen[i].hit_kind == 254 ? 1u : 0u);
      t.equal(what + "barycentrics", asked[i].barycentrics[0], seen[i].barycentrics[0]);
    }
  }
  t.holds("many of the rays hit", hits > 150);
}

void null_structure(Context& t) {
  Query query(t, "Ask");
  query.bind = [](CommandList& list) { list.SetComputeRootShaderResourceView(0, 0); };
  const Asked found = at<Asked>(query.run_rays({}, {asking(kCommitTriangles | kCommitBoxes)}), 0);
  t.equal("status", found.status, kNothing);
  t.equal("CommittedRayT()", found.t, 1000.0f);
  t.equal("candidates", found.triangles + found.boxes, 0u);
  Ray masked = asking(kCommitTriangles);
  masked.mask = 0;
  t.equal("status with mask 0", ask(t, three_triangles(t, kOnce), masked).status, kNothing);
}

void null_structures_and_parity(Context& t) {
  null_structure(t);
  queries_agree_with_traces(t);
}

void contribution_is_only_told(Context& t) {
  for (const uint32_t contribution : {0u, 77u, 0xFFFFFFu}) {
    const Asked found = ask(t, t.scene({triangle(5)}, contribution), asking(kCommitTriangles));
    t.equal("contribution", found.contribution, contribution);
    t.distance("t", found.t, 5.0f);
  }
}

}  // namespace

std::vector<RuleTest> rq_tests() {
  std::vector<RuleTest> tests = {{"RQ-01", flags_add_up},
                                 {"RQ-02", trace_restarts},
                                 {"RQ-03", proceed_tells_of_candidates},
                                 {"RQ-04", opacity_comes_from_flags},
                                 {"RQ-05", false_is_final},
                                 {"RQ-06", abort_ends_the_search},
                                 {"RQ-07", commits_of_triangles},
                                 {"RQ-08", commits_of_boxes},
                                 {"RQ-09", the_first_commit_ends},
                                 {"RQ-10", status_is_readable},
                                 {"RQ-11", t_starts_at_t_max},
                                 {"RQ-12", boxes_say_whether_they_are_opaque},
                                 {"RQ-16", null_structures_and_parity},
                                 {"RQ-17", contribution_is_only_told}};
  const std::vector<RuleTest> more = rq_accessors_tests();
  tests.insert(tests.end(), more.begin(), more.end());
  return tests;
}

}  // namespace kaamos::conformance
