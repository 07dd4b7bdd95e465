// SPDX-License-Identifier: MIT
//
// Inline ray tracing.
#include <shaders/query.h>

#include <array>

#include "tests/conformance/compile.h"
#include "tests/conformance/program.h"
#include "tests/conformance/walker.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kOpaque = RaytracingGeometryFlags::kOpaque;
constexpr auto kOnce = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;  // not opaque

// Of query.hlsl.
enum Do : uint32_t {
  kCommitTriangles = 1,
  kCommitBoxes = 2,
  kAbort = 4,
  kTwice = 8,
  kStop = 16,
};
struct Asked {
  uint32_t status;  // Committed
  uint32_t triangles;
  uint32_t boxes;
  uint32_t non_opaque_boxes;
  float t;
  uint32_t instance_index;
  uint32_t instance_id;
  uint32_t contribution;
  uint32_t geometry;
  uint32_t primitive;
  uint32_t front_face;
  uint32_t flags;
  float barycentrics[2];
  uint32_t status_on_the_way;
  uint32_t proceeds;
};
static_assert(sizeof(Asked) == 64);
enum Committed : uint32_t { kNothing, kTriangle, kBox };

enum Flags : uint32_t {
  kForceOpaque = 1,
  kForceNonOpaque = 2,
  kAcceptFirst = 4,
  kCullOpaque = 0x40,
  kCullNonOpaque = 0x80,
  kSkipTriangles = 0x100,
  kSkipBoxes = 0x200,
};

template <class T>
T at(const std::vector<uint32_t>& words, size_t byte_offset) {
  T out;
  std::memcpy(&out, &words[byte_offset / 4], sizeof out);
  return out;
}

Ray asking(uint32_t what, uint32_t flags = 0, float x = 0) {
  Ray ray = ray_at(x);
  ray.flags = flags;
  ray.contribution = what;
  const float box_t = 4.5f;
  std::memcpy(&ray.extra[0], &box_t, sizeof box_t);
  return ray;
}

// One shader of query.hlsl; no hit groups, no tables but its own.
struct Query : Program {
  Query(Context& t, const char* shader)
      : Program(t, kaamos_shaders_query(), {shader}), context(&t) {
    raygen(shader);
  }
  std::vector<uint32_t> run_rays(const Buffer& top_level, const std::vector<Ray>& list,
                                 uint32_t width = 1) {
    scene = top_level;
    rays = context->upload(list);
    return run(width);
  }
  Context* context;
};

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
  // What the query with both kinds of flags meets: candidates among triangles, boxes, its end.
  const std::array<uint32_t, 3> expected[] = {{1, 1, kNothing}, {0, 0, kTriangle},
                                              {1, 1, kNothing}, {0, 1, kNothing},
                                              {1, 0, kNothing}, {0, 0, kNothing}};
  for (size_t i = 0; i < 6; ++i) {
    const std::string what = "template flags " + std::to_string(template_flags[i]) + ": ";
    t.equal(what + "RayFlags()", words[4 * i], template_flags[i] | kAcceptFirst);
    // After the forced-opaque triangle ends the search the box may have been a candidate before.
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
  t.equal("its t", opaque.t, 5.0f);
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
  // What lies behind a commit is no candidate any more.
  const Buffer mixed = t.scene({triangle(5, 0, kOpaque), triangle(9, 0, kOnce)});
  const Asked both = ask(t, mixed, asking(kCommitTriangles));
  t.equal("t of the closest of both", both.t, 5.0f);
  t.holds("the far one is a candidate at most once", both.triangles <= 1);
  Ray short_ray = asking(kCommitTriangles);
  short_ray.t_max = 4;
  t.equal("candidates out of range", ask(t, mixed, short_ray).triangles, 0u);
}

// Geometry, then instance, then ray: the last that speaks decides.
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
  t.holds("t of the only candidate", committed.t == 5 || committed.t == 6 || committed.t == 7);
  t.equal("Proceed() that gave TRUE", committed.proceeds, 0u);
  t.equal("status where nothing was committed", ask(t, structure, asking(kAbort)).status, kNothing);
}

void commits_of_triangles(Context& t) {
  const Buffer structure = three_triangles(t, kOnce);
  for (const uint32_t what : {uint32_t{kCommitTriangles}, kCommitTriangles | kTwice}) {
    const Asked found = ask(t, structure, asking(what));
    t.equal("status", found.status, kTriangle);
    t.equal("t", found.t, 5.0f);
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

// What a hit and a candidate say of instance 1: object x = (x - 1) / 2.
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
  t.equal("t by the second name", at<float>(words, 8), 5.0f);
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
  t.equal("t of the first of two", at<Asked>(pair, 0).t, 5.0f);
  t.equal("t of the second of two", at<Asked>(pair, 64).t, 8.0f);

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
    t.equal(std::string("t in the ") + stages[i] + " shader", found.t, 5.0f);
  }
  const Seen seen = at<Seen>(words, 0);
  t.equal("end of the trace around them", seen.end, kClosestHitRan);
  t.equal("its t", seen.t, 5.0f);
  t.equal("its attributes", seen.box_record, 9u);
  t.equal("its any-hit shader", seen.any_hits, 1u);
}

// Random rays by a query and by TraceRay with an any-hit shader that accepts.
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
    t.equal("t", found.t, 5.0f);
  }
}

}  // namespace

std::vector<RuleTest> rq_tests() {
  return {{"RQ-01", flags_add_up},
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
          {"RQ-13", accessors_by_state},
          {"RQ-14", copies_share_one_state},
          {"RQ-15", queries_in_every_stage},
          {"RQ-16", null_structures_and_parity},
          {"RQ-17", contribution_is_only_told}};
}

}  // namespace kaamos::conformance
