// SPDX-License-Identifier: MIT
//
// Intersection shaders: what their reports do.
#include <bit>
#include <cmath>

#include "tests/conformance/compile.h"
#include "tests/conformance/walker.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr uint32_t kAcceptFirst = 0x4;
// As in traversal.hlsl.
constexpr size_t kReportWord = 65536 / 4, kEndWord = 49152 / 4;

struct Report {
  float t;
  uint32_t kind;
  uint32_t value;  // returned in Seen::box_record
  Decision decision = kAccept;
};

// A ray into a box whose intersection shader makes these reports.
struct Story {
  std::vector<Report> reports = {};
  float t_min = 0;
  float t_max = 100;
  uint32_t flags = 0;
  bool has_any_hit = true;
};

// The outcome of a report, and of a story.
struct Told {
  uint32_t accepted;  // 1 yes, 2 no, 0 did not return
  float before, after, t_min;
};
struct Outcome {
  std::vector<Told> reports;
  bool came_to_its_end;
  Seen seen;
};

std::vector<Outcome> tell(Context& t, const std::vector<Story>& stories) {
  Walker program(t);
  program.record("WalkScript");
  program.record("PlainScript");
  const Buffer geometry =
      t.bottom_level({box(5, 0, RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation)});
  program.scene = t.top_level({instance(geometry), instance(geometry, 10, 1)});
  std::vector<Report> script;
  std::vector<Ray> rays;
  for (const Story& story : stories) {
    Ray ray = ray_at(story.has_any_hit ? 0 : 10);
    ray.t_min = story.t_min;
    ray.t_max = story.t_max;
    ray.flags = story.flags;
    ray.extra[0] = static_cast<uint32_t>(script.size());
    ray.extra[1] = static_cast<uint32_t>(story.reports.size());
    rays.push_back(ray);
    script.insert(script.end(), story.reports.begin(), story.reports.end());
  }
  const Buffer scripts = t.upload(script);
  program.bind = [scripts](CommandList& list) {
    list.SetComputeRootShaderResourceView(4, scripts.GetGPUVirtualAddress());
  };
  program.word_bytes = kReportWord * 4 + 16 * script.size();
  program.prepare(rays);
  const auto words = program.run(static_cast<uint32_t>(rays.size()));
  const auto seen = seen_of(words, rays.size());
  std::vector<Outcome> out;
  for (size_t i = 0; i < rays.size(); ++i) {
    Outcome outcome = {{}, words[kEndWord + i] != 0, seen[i]};
    for (size_t k = 0; k < stories[i].reports.size(); ++k) {
      const uint32_t* at = &words[kReportWord + 4 * (rays[i].extra[0] + k)];
      outcome.reports.push_back({at[1], std::bit_cast<float>(at[0]), std::bit_cast<float>(at[2]),
                                 std::bit_cast<float>(at[3])});
    }
    out.push_back(std::move(outcome));
  }
  return out;
}

std::vector<uint32_t> answers(const Outcome& outcome) {
  std::vector<uint32_t> out;
  for (const Told& each : outcome.reports) out.push_back(each.accepted);
  return out;
}

constexpr uint32_t kYes = 1, kNo = 2, kDidNotReturn = 0;

// Applies the rules of [DXR: ReportHit], one report after the other.
void check_story(Context& t, const std::string& name, const Story& story, const Outcome& found) {
  float current = story.t_max;
  uint32_t any_hits = 0, end = kMissRan, kind = 0xFFFFFFFF, value = 0xFFFFFFFF;
  bool ended = false;
  for (size_t i = 0; i < story.reports.size(); ++i) {
    const std::string what = name + ", report " + std::to_string(i) + ": ";
    const Report& report = story.reports[i];
    const Told& told = found.reports[i];
    if (ended) {
      t.equal(what + "of a shader that has ended, before", told.before, 0.0f);
      continue;
    }
    t.equal(what + "RayTCurrent() before", told.before, current);
    bool accepted = report.t >= story.t_min && report.t <= current;
    if (accepted && story.has_any_hit) ++any_hits;
    const Decision decision = story.has_any_hit ? report.decision : kAccept;
    accepted = accepted && decision != kIgnore;
    if (accepted) {
      current = report.t;
      end = kClosestHitRan;
      kind = report.kind;
      value = report.value;
      ended = decision == kAcceptAndEnd || (story.flags & kAcceptFirst) != 0;
    }
    t.equal(what + "answer", told.accepted, ended ? kDidNotReturn : accepted ? kYes : kNo);
    if (ended) continue;
    t.equal(what + "RayTCurrent() after", told.after, current);
    t.equal(what + "RayTMin() after", told.t_min, story.t_min);
  }
  t.equal(name + ": the shader came to its end", found.came_to_its_end ? 1 : 0, ended ? 0 : 1);
  t.equal(name + ": end", found.seen.end, end);
  t.equal(name + ": any-hit shaders", found.seen.any_hits, any_hits);
  t.equal(name + ": RayTCurrent() at the end", found.seen.t, current);
  t.equal(name + ": HitKind()", found.seen.hit_kind, kind);
  t.equal(name + ": attributes", found.seen.box_record, value);
}

// Up to four reports at a few different t, so that interval ends and ties are common.
void random_stories(Context& t) {
  Random random(7);
  std::vector<Story> stories(300);
  for (Story& story : stories) {
    for (uint32_t i = 0; i <= random.below(4); ++i) {
      story.reports.push_back({1 + 0.5f * static_cast<float>(random.below(8)), random.below(128),
                               random.below(0xFFFFFF), static_cast<Decision>(random.below(3))});
    }
    story.t_min = random.chance(0.3) ? 2 : 0;
    story.t_max = random.chance(0.3) ? 4.5f : 100;
    story.flags = random.chance(0.2) ? kAcceptFirst : 0;
    story.has_any_hit = random.chance(0.7);
  }
  const auto outcomes = tell(t, stories);
  for (size_t i = 0; i < stories.size() && t.failures().size() < 8; ++i) {
    check_story(t, "story " + std::to_string(i), stories[i], outcomes[i]);
  }
}

void reports_out_of_the_interval(Context& t) {
  const float above = std::nextafter(8.0f, 9.0f), below = std::nextafter(2.0f, 0.0f);
  const Story story = {{{above, 1, 1}, {below, 2, 2}, {8, 3, 3}, {2, 4, 4}}, 2, 8};
  const Outcome found = tell(t, {story})[0];
  t.equal("answers at TMax + ulp, TMin - ulp, TMax, TMin", answers(found), {kNo, kNo, kYes, kYes});
  t.equal("any-hit shaders", found.seen.any_hits, 2u);
}

void many_reports(Context& t) {
  const Outcome found = tell(t, {{{{5, 1, 1}, {3, 2, 2}, {4, 3, 3}}}})[0];
  t.equal("answers at t 5, 3, 4", answers(found), {kYes, kYes, kNo});
  t.equal("t in the closest-hit shader", found.seen.t, 3.0f);
  t.equal(
      "RayTCurrent() after each",
      std::vector<float>{found.reports[0].after, found.reports[1].after, found.reports[2].after},
      {5.0f, 3.0f, 3.0f});
}

void the_last_of_equal_reports(Context& t) {
  const Outcome found = tell(t, {{{{4, 17, 1}, {4, 18, 2}}}})[0];
  t.equal("answers", answers(found), {kYes, kYes});
  t.equal("any-hit shaders", found.seen.any_hits, 2u);
  t.equal("HitKind()", found.seen.hit_kind, 18u);
  t.equal("attributes", found.seen.box_record, 2u);
}

// Boxes that report the same t: the one that comes last is the hit.
void the_last_of_equal_boxes(Context& t) {
  Standard program(t);
  for (uint32_t kind = 0; kind < 3; ++kind) program.record("BoxCounted", 5, kind);
  Geometry plate = box(5, 0, RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation);
  for (const float thickness : {1.0f, 0.0f}) {
    plate.boxes[0].MinZ = 5 - thickness;
    plate.boxes[0].MaxZ = 5 + thickness;
    program.scene = t.scene({plate, plate, plate});
    Ray ray;
    ray.multiplier = 1;
    const Seen seen = program.trace(ray);
    t.equal("any-hit shaders of three boxes", seen.any_hits, 3u);
    t.equal("record of the hit, that of the last any-hit shader", seen.record, seen.any_record);
    t.equal("HitKind()", seen.hit_kind, seen.record);
  }
}

void an_ended_search_ends_the_shader(Context& t) {
  const auto found = tell(t, {{{{4, 1, 1}, {3, 2, 2}}, 0, 100, kAcceptFirst},
                              {{{4, 1, 1, kAcceptAndEnd}, {3, 2, 2}}},
                              {{{4, 1, 1}, {3, 2, 2}}, 0, 100, kAcceptFirst, false},
                              {{{4, 1, 1, kIgnore}, {3, 2, 2}}, 0, 100, kAcceptFirst}});
  for (size_t i = 0; i < 3; ++i) {
    t.equal("answers", answers(found[i]), {kDidNotReturn, kDidNotReturn});
    t.holds("the shader does not come to its end", !found[i].came_to_its_end);
    t.equal("t", found[i].seen.t, 4.0f);
  }
  t.equal("answers behind an ignored hit", answers(found[3]), {kNo, kDidNotReturn});
  t.equal("t behind an ignored hit", found[3].seen.t, 3.0f);
}

void hit_kinds_up_to_127(Context& t) {
  std::vector<Story> stories;
  for (uint32_t kind = 0; kind < 128; ++kind) stories.push_back({{{3, kind, 1}}});
  const auto found = tell(t, stories);
  for (uint32_t kind = 0; kind < 128; ++kind) {
    t.equal("HitKind()", found[kind].seen.hit_kind, kind);
  }
}

void a_rejected_report_leaves_the_attributes(Context& t) {
  const auto found = tell(t, {{{{4, 11, 77}, {3, 12, 88, kIgnore}, {9, 13, 99}}},
                              {{{4, 11, 77}, {5, 12, 88}}, 0, 100, 0, false}});
  for (const Outcome& each : found) {
    t.equal("attributes", each.seen.box_record, 77u);
    t.equal("HitKind()", each.seen.hit_kind, 11u);
    t.equal("t", each.seen.t, 4.0f);
  }
}

void no_payload(Context& t) {
  const char* const head =
      "struct P { uint value; };\nstruct A { float2 barycentrics; };\n"
      "[shader(\"intersection\")]\n";
  const char* const body = " { A a = {float2(0, 0)}; ReportHit(1, 0, a); }\n";
  t.accepted("an intersection shader without parameters",
             compile(std::string(head) + "void Shader()" + body));
  t.refused("with a payload", compile(std::string(head) + "void Shader(inout P p)" + body));
  t.refused("with a payload and attributes",
            compile(std::string(head) + "void Shader(inout P p, A b)" + body));
}

void faces_do_not_clip(Context& t) {
  Standard program(t);
  program.record("Box", 500);
  program.record("Box", 0.5f);
  Ray oblique;
  oblique.direction[0] = 0.05f;
  const Seen behind = program.trace(t.scene({box(5)}), oblique);
  t.equal("t far behind the box", behind.t, 500.0f);
  t.equal("t before the box", program.trace(t.scene({box(5)}, 1)).t, 0.5f);
}

void rays_from_inside_a_box(Context& t) {
  Standard program(t);
  program.record("Box", 0.25f);
  Ray ray, backwards;
  ray.origin[2] = backwards.origin[2] = 5;
  backwards.direction[2] = -1;
  backwards.direction[0] = 0.3f;
  program.scene = t.scene({box(5)});
  for (const Seen& each : program.trace({ray, backwards})) {
    t.equal("end", each.end, kClosestHitRan);
    t.equal("t", each.t, 0.25f);
  }
}

}  // namespace

std::vector<RuleTest> trv_report_tests() {
  return {{"TRV-04, TRV-05, TRV-07, TRV-08, TRV-35, TRV-36, TRV-37, TRV-38, TRV-39, TRV-43",
           random_stories},
          {"TRV-35", reports_out_of_the_interval},
          {"TRV-37, TRV-38", many_reports},
          {"TRV-07", the_last_of_equal_reports},
          {"TRV-05, TRV-07", the_last_of_equal_boxes},
          {"TRV-23, TRV-36, TRV-39", an_ended_search_ends_the_shader},
          {"TRV-40", hit_kinds_up_to_127},
          {"TRV-28, TRV-43", a_rejected_report_leaves_the_attributes},
          {"TRV-42", no_payload},
          {"TRV-17", faces_do_not_clip},
          {"TRV-18", rays_from_inside_a_box}};
}

}  // namespace kaamos::conformance
