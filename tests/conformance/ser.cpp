// SPDX-License-Identifier: MIT
//
// Hit objects: what they hold, and what Invoke runs.
#include <shaders/ser.h>
#include <shaders/ser_qualified.h>

#include "tests/conformance/checked.h"
#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;

// The structure of ser.hlsl.
struct Object {
  uint32_t is_nop, is_hit, is_miss, flags;
  float t_min, t;
  float world_origin[3], world_direction[3], object_origin[3], object_direction[3];
  float to_world[12], to_object[12];  // by columns, as HLSL stores a matrix
  uint32_t transposed, geometry, instance_index, instance_id, primitive, hit_kind, record;
  float attributes[2];
  uint32_t constants[2];
};
static_assert(sizeof(Object) == 212);

enum Source : uint32_t { kTraced, kMakeMiss, kMakeNop, kNoValue, kOfQuery, kUnused, kOfQueryKind };
enum Use : uint32_t { kKeep, kSetIndex, kSetIndexOfCopy, kInvoke, kInvokeTwice };

Ray object_ray(Source source, Use use = kKeep, uint32_t argument = 0, float x = 0) {
  Ray ray = ray_at(x);
  ray.extra[0] = source;
  ray.extra[1] = use;
  ray.extra[2] = argument;
  return ray;
}

struct Outcome {
  Seen seen;
  Object object;
};

// Standard's records, and the ray generation shaders of ser.hlsl.
struct Objects : Standard {
  explicit Objects(Context& t, const char* entry = "Objects", uint32_t misses = 4)
      : Standard(t, kaamos_shaders_ser(), {entry, "NestedClosest", "CountSmall"},
                 "SRV(t0), SRV(t1), UAV(u0), UAV(u1)"),
        entry_(entry),
        misses_(misses) {
    group("Nested", "NestedClosest");
    group("SmallCounted", "Closest", "CountSmall");
    local(kRecordSignature, {"Nested", "SmallCounted"});
  }

  std::vector<Outcome> outcomes(const std::vector<Ray>& list, uint32_t width = 0) {
    create();
    raygen(entry_);
    miss_records(misses_);
    prepare(list);
    const auto words = run(width != 0 ? width : static_cast<uint32_t>(list.size()));
    std::vector<Outcome> out(list.size());
    for (size_t i = 0; i < list.size(); ++i) {
      std::memcpy(&out[i].seen, words.data() + 128 * i, sizeof(Seen));
      std::memcpy(&out[i].object, words.data() + 128 * i + 16, sizeof(Object));
    }
    return out;
  }
  Outcome outcome(const Ray& ray) { return outcomes({ray})[0]; }

 private:
  const char* entry_;
  uint32_t misses_;
};

void expect_identity(Context& t, const Object& object, const std::string& what) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const float expected = row == column ? 1.0f : 0.0f;
      t.equal(what + ", ObjectToWorld", object.to_world[column * 3 + row], expected);
      t.equal(what + ", WorldToObject", object.to_object[column * 3 + row], expected);
    }
  }
}

void expect_nop(Context& t, const Object& object, const std::string& what) {
  t.equal(what + ", IsNop", object.is_nop, 1u);
  t.equal(what + ", IsHit and IsMiss", object.is_hit + object.is_miss, 0u);
  t.equal(what + ", flags", object.flags, 0u);
  t.equal(what + ", TMin and TCurrent", object.t_min + object.t, 0.0f);
  for (int i = 0; i < 3; ++i) {
    t.equal(what + ", rays",
            std::abs(object.world_origin[i]) + std::abs(object.world_direction[i]) +
                std::abs(object.object_origin[i]) + std::abs(object.object_direction[i]),
            0.0f);
  }
  expect_identity(t, object, what);
  t.equal(what + ", indices",
          object.geometry + object.instance_index + object.instance_id + object.primitive +
              object.hit_kind + object.record + object.constants[0] + object.constants[1],
          0u);
  t.equal(what + ", attributes", object.attributes[0] + object.attributes[1], 0.0f);
}

// Two instances: the second is moved by (20, 0, 0), scaled by 2, with ID 77 and contribution 2.
struct Moved : Objects {
  explicit Moved(Context& t, const char* entry = "Objects", uint32_t misses = 4)
      : Objects(t, entry, misses) {
    level = t.bottom_level({triangle(5, 0, kNonOpaque), triangle(5, 10, kNonOpaque)});
    RaytracingInstanceDesc second = instance(level, 20, 2);
    second.InstanceID = 77;
    for (int i = 0; i < 3; ++i) second.Transform[i][i] = 2;
    scene = t.top_level({instance(level), second});
    for (int i = 0; i < 64; ++i) record("Counted");
  }
  Buffer level;
};

void trace_runs_no_closest_hit_or_miss(Context& t) {
  Moved program(t);
  const auto found = program.outcomes({object_ray(kTraced), object_ray(kTraced, kKeep, 0, 100)});
  t.equal("closest-hit and miss shaders", found[0].seen.end + found[1].seen.end, 0u);
  t.equal("any-hit shaders of the hit", found[0].seen.any_hits, 1u);
  t.equal("IsHit of the hit", found[0].object.is_hit, 1u);
  t.equal("IsMiss of the hit", found[0].object.is_miss + found[0].object.is_nop, 0u);
  t.equal("IsMiss of the miss", found[1].object.is_miss, 1u);
  t.equal("IsHit of the miss", found[1].object.is_hit + found[1].object.is_nop, 0u);
}

void nops(Context& t) {
  Moved program(t);
  const auto found = program.outcomes({object_ray(kMakeNop), object_ray(kNoValue)});
  expect_nop(t, found[0].object, "MakeNop");
  expect_nop(t, found[1].object, "an element without a value");
}

void getters_of_a_hit(Context& t) {
  Moved program(t);
  Ray ray = object_ray(kTraced, kKeep, 0, 40);  // (10, 0) of the second instance
  ray.flags = 0x10;
  ray.t_min = 0.5f;
  ray.contribution = 1;
  ray.multiplier = 1;
  const Object hit = program.outcome(ray).object;
  t.equal("flags", hit.flags, 0x10u);
  t.equal("TMin", hit.t_min, 0.5f);
  t.distance("TCurrent", hit.t, 10);
  t.equal("world origin", hit.world_origin[0], 40.1f);
  t.equal("world direction", hit.world_direction[2], 1.0f);
  t.close("object origin", hit.object_origin[0], 10.05f, 1e-5f);
  t.close("object direction", hit.object_direction[2], 0.5f, 1e-6f);
  t.equal("scale of ObjectToWorld", hit.to_world[0], 2.0f);
  t.equal("offset of ObjectToWorld", hit.to_world[9], 20.0f);
  t.close("scale of WorldToObject", hit.to_object[0], 0.5f, 1e-6f);
  t.close("offset of WorldToObject", hit.to_object[9], -10.0f, 1e-5f);
  t.equal("the 4x3 forms are transposed", hit.transposed, 1u);
  t.equal("geometry", hit.geometry, 1u);
  t.equal("instance", hit.instance_index, 1u);
  t.equal("ID", hit.instance_id, 77u);
  t.equal("primitive", hit.primitive, 0u);
  t.equal("kind", hit.hit_kind, 254u);
  t.equal("record: ray + geometry + instance", hit.record, 1u + 1u + 2u);
}

void getters_of_a_miss(Context& t) {
  Moved program(t);
  Ray ray = object_ray(kTraced, kKeep, 0, 500);
  ray.flags = 0x4;
  ray.t_min = 0.25f;
  ray.t_max = 77;
  ray.miss = 0x10002;
  Ray made = ray;
  made.extra[0] = kMakeMiss;
  const auto found = program.outcomes({ray, made});
  for (const auto& [what, object] :
       {std::pair("traced miss", found[0].object), std::pair("made miss", found[1].object)}) {
    const std::string name = what;
    t.equal(name + ", IsMiss", object.is_miss, 1u);
    t.equal(name + ", flags", object.flags, 4u);
    t.equal(name + ", TMin", object.t_min, 0.25f);
    t.equal(name + ", TCurrent is TMax", object.t, 77.0f);
    for (int i = 0; i < 3; ++i) {
      t.equal(name + ", object origin", object.object_origin[i], object.world_origin[i]);
      t.equal(name + ", object direction", object.object_direction[i], object.world_direction[i]);
    }
    expect_identity(t, object, name);
    t.equal(name + ", indices",
            object.geometry + object.instance_index + object.instance_id + object.primitive +
                object.hit_kind,
            0u);
    t.equal(name + ", record", object.record, 2u);
    t.equal(name + ", its constant", object.constants[0], 1002u);
  }
}

void flags_are_the_defined_ones(Context& t) {
  Moved program(t);
  Ray ray = object_ray(kMakeMiss);
  ray.flags = 0xFFFFFC04;
  t.equal("flags", program.outcome(ray).object.flags & 0x3FFu, 4u);
  t.equal("bits that are not defined", program.outcome(ray).object.flags >> 12, 0u);
}

// The record, whatever the four terms are.
void record_is_the_full_sum(Context& t) {
  Moved program(t);
  std::vector<Ray> rays;
  std::vector<uint32_t> expected;
  for (const uint32_t contribution : {0u, 3u, 0x1Fu}) {
    for (const uint32_t multiplier : {0u, 2u, 0x11u}) {
      for (uint32_t instance = 0; instance < 2; ++instance) {
        for (uint32_t geometry = 0; geometry < 2; ++geometry) {
          Ray ray = object_ray(kTraced, kKeep, 0,
                               instance == 0 ? 10.0f * static_cast<float>(geometry)
                                             : 20 + 20.0f * static_cast<float>(geometry));
          ray.flags = 1;  // opaque: no any-hit shader of a record that is not there
          ray.contribution = contribution;
          ray.multiplier = multiplier;
          rays.push_back(ray);
          expected.push_back((contribution & 15) + (multiplier & 15) * geometry + 2 * instance);
        }
      }
    }
  }
  std::vector<uint32_t> found;
  for (const Outcome& each : program.outcomes(rays)) found.push_back(each.object.record);
  t.equal("records", found, expected);
}

void kinds_and_attributes(Context& t) {
  Objects program(t);
  program.scene = t.scene({triangle(5)});
  program.record("Plain");
  Ray back = object_ray(kTraced);
  back.origin[2] = 10;
  back.direction[2] = -1;
  const auto sides = program.outcomes({object_ray(kTraced), back});
  t.equal("kind of a front", sides[0].object.hit_kind, 254u);
  t.equal("kind of a back", sides[1].object.hit_kind, 255u);
  Standard classic(t);
  classic.scene = t.scene({triangle(5)});
  classic.record("Plain");
  const Seen expected = classic.trace(ray_at(0));
  t.equal("first barycentric", sides[0].object.attributes[0], expected.barycentrics[0]);
  t.equal("second barycentric", sides[0].object.attributes[1], expected.barycentrics[1]);

  Objects boxes(t);
  boxes.scene = t.scene({box(5)});
  boxes.record("Box", 4.5f, 17);
  const Object hit = boxes.outcome(object_ray(kTraced)).object;
  t.equal("kind of a box", hit.hit_kind, 17u);
  t.equal("t of a box", hit.t, 4.5f);
  t.equal("attributes of a box", hit.attributes[1], 1000.0f);  // BoxAttributes.t: TMax
}

// Sections of the list that trace by Standard, through hit objects.
void sections_through_hit_objects(Context& t) {
  t.trace_through_hit_objects(true);
  for (const auto& tests : {sbt_tests(), flg_tests(), trv_tests(), trv_any_hit_tests(),
                            trv_report_tests(), trv_inactive_tests()}) {
    for (const RuleTest& test : tests) {
      const size_t before = t.failures().size();
      test.run(t);
      if (t.failures().size() != before) t.fail(std::string("through hit objects: ") + test.rules);
    }
  }
  t.trace_through_hit_objects(false);
}

void payloads_of_two_types(Context& t) {
  Objects program(t, "TwoPayloads");
  program.scene = t.scene({triangle(5, 0, kNonOpaque), triangle(6, 0, kNonOpaque)});
  program.create();
  program.raygen("TwoPayloads");
  program.miss_records(1);
  program.record("SmallCounted");
  program.record("SmallCounted");
  program.prepare({ray_at(0), ray_at(100)});
  const auto seen = seen_of(program.run(2), 2);
  t.equal("end of the hit", seen[0].end, kClosestHitRan);
  t.holds("any-hit shaders counted on 40", seen[0].any_hits == 41 || seen[0].any_hits == 42);
  t.equal("end of the miss", seen[1].end, kMissRan);
  t.equal("payload of the miss", seen[1].any_hits, 40u);
}

void qualifiers_of_the_halves(Context& t) {
  Program program(t, kaamos_shaders_ser_qualified());
  program.group("Group", "AnswerSplit", "NoteSplit");
  program.local(kRecordSignature, {"Group"});
  program.scene = t.scene({triangle(5, 0, kNonOpaque)});
  program.create();
  program.raygen("TraceSplit");
  program.hit("Group", {LocalArgument::Constants(Constants{})});
  program.rays = t.upload(std::vector<Ray>{ray_at(0)});
  DispatchRaysDesc desc = program.tables_without_miss();
  const auto words = program.run(desc);
  t.equal("what the any-hit shader wrote, in between", words[0], 17u);
  t.equal("what the closest-hit shader saw", words[1], 22002u);
}

void invoke_sees_the_object(Context& t) {
  Moved program(t);
  Ray ray = object_ray(kTraced, kInvoke, 0, 40);
  ray.flags = 0x10;
  ray.contribution = 1;
  Ray made = object_ray(kMakeMiss, kInvoke);
  made.miss = 3;
  made.flags = 0x80;
  made.t_max = 55;
  const auto found = program.outcomes({ray, made});
  const auto& [seen, object] = found[0];
  t.equal("end", seen.end, kClosestHitRan);
  t.equal("record", seen.record, object.record);
  t.equal("instance", seen.instance_index, object.instance_index);
  t.equal("ID", seen.instance_id, object.instance_id);
  t.equal("geometry", seen.geometry, object.geometry);
  t.equal("primitive", seen.primitive, object.primitive);
  t.equal("kind", seen.hit_kind, object.hit_kind);
  t.equal("flags", seen.flags, object.flags);
  t.equal("t", seen.t, object.t);
  t.equal("barycentrics", seen.barycentrics[0], object.attributes[0]);
  t.equal("constant of the record", seen.record, object.constants[0]);
  t.equal("end of the miss", found[1].seen.end, kMissRan);
  t.equal("record of the miss", found[1].seen.record, 1003u);
  t.equal("flags of the miss", found[1].seen.flags, 0x80u);
  t.equal("RayTCurrent of the miss", found[1].seen.t, 55.0f);
}

void invoke_of_nothing(Context& t) {
  Objects program(t);
  program.scene = t.scene({triangle(5)});
  program.record("");  // a NULL record
  const auto found =
      program.outcomes({object_ray(kTraced, kInvoke), object_ray(kMakeNop, kInvoke),
                        object_ray(kNoValue, kInvoke), object_ray(kOfQuery, kInvoke)});
  for (size_t i = 0; i < found.size(); ++i) {
    t.equal("shaders that ran for " + std::to_string(i), found[i].seen.end, 0u);
    t.equal("payload of " + std::to_string(i), found[i].seen.record, 0xFFFFFFFFu);
  }
  t.equal("the hit is one", found[0].object.is_hit, 1u);
  t.equal("the query's hit is one", found[3].object.is_hit, 1u);
}

void invoke_twice(Context& t) {
  Moved program(t);
  const auto found = program.outcomes({object_ray(kTraced, kInvokeTwice), object_ray(kTraced)});
  t.equal("closest-hit shaders", found[0].seen.closest_hits, 2u);
  t.holds("the object is as it was",
          std::memcmp(&found[0].object, &found[1].object, sizeof(Object)) == 0);
}

void skip_closest_hit_skips_in_invoke(Context& t) {
  Moved program(t);
  Ray hit = object_ray(kTraced, kInvoke);
  hit.flags = 0x8;
  Ray miss = object_ray(kTraced, kInvoke, 0, 100);
  miss.flags = 0x8;
  const auto found = program.outcomes({hit, miss});
  t.equal("the object is a hit", found[0].object.is_hit, 1u);
  t.equal("its flags", found[0].object.flags, 8u);
  t.equal("end of the hit", found[0].seen.end, kNothingRan);
  t.equal("end of the miss", found[1].seen.end, kMissRan);
}

void set_index(Context& t) {
  Moved program(t, "Rebound");
  // Bit 28 and above do not count; bit 16 and above do not for a miss.
  const auto found = program.outcomes(
      {object_ray(kTraced, kKeep, 0xF0000003), object_ray(kMakeMiss, kKeep, 0x10002),
       object_ray(kMakeNop, kKeep, 5), object_ray(kOfQuery, kKeep, 2)});
  t.equal("index of a hit", found[0].object.record, 3u);
  t.equal("record of a hit", found[0].seen.record, 3u);
  t.equal("constant of a hit", found[0].object.constants[0], 3u);
  t.equal("index of a miss", found[1].object.record, 2u);
  t.equal("record of a miss", found[1].seen.record, 1002u);
  t.equal("index of a NOP", found[2].object.record, 0u);
  t.equal("a NOP stays one", found[2].object.is_nop, 1u);
  t.equal("end of a NOP", found[2].seen.end, kNothingRan);
  t.equal("index of what was bound", found[3].object.record, 2u);
  t.equal("end of what was bound", found[3].seen.end, kClosestHitRan);
  t.equal("record of what was bound", found[3].seen.record, 2u);
}

void constants_of_records(Context& t) {
  Objects program(t);
  program.scene = t.scene({triangle(5), triangle(5, 10)});
  program.record("Plain", 2.5f);
  program.record("");  // a NULL identifier does not hide what follows it
  const auto found = program.outcomes({object_ray(kTraced), object_ray(kOfQuery)});
  t.equal("DWORD at 0", found[0].object.constants[0], 0u);
  t.equal("DWORD at 4", found[0].object.constants[1], 0x40200000u);
  t.equal("of an object that is not bound", found[1].object.constants[1], 0u);
}

void from_ray_query(Context& t) {
  Objects program(t);
  program.scene = t.scene({triangle(5)}, 3);
  program.record("Plain");
  Ray ray = object_ray(kOfQuery);
  ray.t_min = 0.5f;
  ray.flags = 0x10;
  Ray typed = ray;
  typed.extra[0] = kOfQueryKind;
  const auto found =
      program.outcomes({ray, typed, object_ray(kOfQuery, kKeep, 0, 100), object_ray(kTraced)});
  for (int i = 0; i < 2; ++i) {
    const Object& object = found[static_cast<size_t>(i)].object;
    t.equal("IsHit", object.is_hit, 1u);
    t.equal("kind", object.hit_kind, 254u);
    t.equal("barycentrics", object.attributes[0], found[3].object.attributes[0]);
    t.equal("flags", object.flags, 0x10u);
    t.equal("TMin", object.t_min, 0.5f);
    t.distance("TCurrent", object.t, 5);
    t.equal("world origin", object.world_origin[0], 0.1f);
    t.equal("record", object.record, 0u);
  }
  expect_nop(t, found[2].object, "nothing committed");
}

void from_ray_query_of_boxes(Context& t) {
  Objects program(t);
  program.scene = t.scene({box(5)});
  program.record("Box");
  const auto found = program.outcomes({object_ray(kOfQuery), object_ray(kOfQueryKind)});
  t.equal("kind without one", found[0].object.hit_kind, 0u);
  t.equal("attributes without any", found[0].object.attributes[1], 0.0f);
  t.equal("kind", found[1].object.hit_kind, 17u);
  t.equal("first attribute", found[1].object.attributes[0], 0.25f);
  t.equal("second attribute", found[1].object.attributes[1], 0.75f);
  t.equal("t", found[1].object.t, 5.0f);
}

void several_objects_live(Context& t) {
  Moved program(t, "Together");
  Ray miss = object_ray(kTraced, kKeep, 0, 100);
  miss.miss = 1;
  Ray second = object_ray(kTraced, kKeep, 0, 40);
  second.multiplier = 1;
  const auto found = program.outcomes({object_ray(kTraced), second, miss}, 1);
  t.equal("record of the first", found[0].seen.record, 0u);
  t.equal("record of the second", found[1].seen.record, 3u);
  t.equal("record of the third", found[2].seen.record, 1001u);
  t.equal("instance of the second", found[1].object.instance_index, 1u);
  t.distance("t of the first", found[0].object.t, 5);
  t.distance("t of the second", found[1].object.t, 10);
  t.equal("barycentrics of the first", found[0].seen.barycentrics[0],
          found[0].object.attributes[0]);
}

void objects_are_values(Context& t) {
  Moved program(t, "Values");
  program.create();
  program.raygen("Values");
  program.miss_records(1);
  Ray ray = ray_at(20);  // the second instance: record 2
  program.prepare({ray});
  const auto words = program.run(1);
  t.equal("the original", words[0], 2u);
  t.equal("a member", words[1], 2u);
  t.equal("an out parameter", words[2], 2u);
  t.equal("an inout parameter", words[3], 3u);
  t.equal("another member", words[4], 7u);
  t.equal("without a value", words[5], 1u);
  t.equal("shaders of a temporary", words[6], 0u);
}

uint32_t depth_of(Context& t, uint32_t kind, uint32_t declared, std::string& removal) {
  Context fresh(t.target().device_desc(), t.target());
  Objects program(fresh);
  for (StateSubobject& each : program.desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingPipelineConfig1>(&each)) {
      config->MaxTraceRecursionDepth = declared;
    }
  }
  program.scene = fresh.scene({triangle(5)});
  program.record(kind == 0 ? "Plain" : "Nested");
  Ray ray = object_ray(kTraced, kInvoke);
  ray.extra[0] = kind == 0 ? uint32_t{kTraced} : kind;
  // Nested reads what it does from extra[0], which the ray generation shader takes as the source:
  // 1 to 3 would make a miss there.
  try {
    program.create();
    program.raygen("Trace");
    program.miss_records(1);
    program.prepare({ray});
    return seen_of(program.run(1), 1)[0].end;
  } catch (const ResultError& error) {
    removal = error.error().message;
    return 99;
  }
}

void recursion(Context& t) {
  std::string removal;
  t.equal("TraceRay and Invoke at depth 1", depth_of(t, 0, 1, removal), kClosestHitRan);
  t.equal("of a closest-hit shader at depth 2", depth_of(t, 2, 2, removal), kClosestHitRan);
  for (const uint32_t kind : {1u, 3u}) {
    removal.clear();
    depth_of(t, kind, 1, removal);
    t.holds("depth 1, closest-hit shader that does " + std::to_string(kind) + ": removed",
            removal.find("recursion") != std::string::npos ||
                removal.find("Recursion") != std::string::npos);
  }
}

void stack_sizes(Context& t) {
  Standard classic(t);
  classic.create();
  t.trace_through_hit_objects(true);
  Standard objects(t);
  objects.create();
  t.trace_through_hit_objects(false);
  t.equal("closest-hit", objects.pipeline.GetShaderStackSize("Plain::closesthit"),
          classic.pipeline.GetShaderStackSize("Plain::closesthit"));
  t.equal("miss", objects.pipeline.GetShaderStackSize("Miss"),
          classic.pipeline.GetShaderStackSize("Miss"));
  t.holds("the pipeline has room for the ray generation shader",
          objects.pipeline.GetPipelineStackSize() >= objects.pipeline.GetShaderStackSize("Trace"));
}

void reordering_changes_nothing(Context& t) {
  Objects program(t, "Reordered");
  program.scene = t.scene({triangle(5)});
  program.record("Plain");
  program.create();
  program.raygen("Reordered");
  program.miss_records(1);
  program.prepare({ray_at(0), ray_at(100)});
  const auto words = program.run(64);
  for (uint32_t i = 0; i < 64; ++i) {
    uint32_t expected = 800;
    for (uint32_t bounce = 0; bounce < 8; ++bounce) {
      if ((i + bounce) % 3 != 0 && (i & 1) != 0) expected += kMissRan;
    }
    t.equal("thread " + std::to_string(i), words[i], expected);
  }
}

// Objects with a record that their table does not have.
void invalid_records_of_reordering(Context& t) {
  struct Case {
    const char* what;
    Ray ray;
    bool is_invalid;
  };
  for (const Case& each :
       {Case{"the hit's own record", object_ray(kTraced), false},
        {"the last record of the table", object_ray(kTraced, kSetIndex, 1), false},
        {"a record past its end", object_ray(kTraced, kSetIndex, 2), true},
        {"a miss's own record", object_ray(kMakeMiss), false},
        {"a record past the miss table's end", object_ray(kMakeMiss, kSetIndex, 4), true},
        {"a NOP", object_ray(kMakeNop, kSetIndex, 5), false},
        {"an object that is bound to none", object_ray(kOfQuery), false}}) {
    Checked c(t);
    Objects program(c, "OnlyReordered");
    program.scene = c.scene({triangle(5)});
    program.record("Plain");
    program.record("Plain");
    program.outcome(each.ray);
    if (each.is_invalid) {
      c.told(each.what, "KA0895");
    } else {
      c.not_told(each.what, "KA0895");
    }
  }
}

void barriers_of_reordering(Context& t) {
  Objects program(t, "WritesAndMoves");
  program.create();
  program.raygen("WritesAndMoves");
  const Buffer moved = t.zeros(256);
  program.bind = [&](CommandList& list) {
    list.SetComputeRootUnorderedAccessView(3, moved.GetGPUVirtualAddress());
  };
  program.rays = t.upload(std::vector<Ray>{Ray{}});
  DispatchRaysDesc desc = program.tables_without_miss();
  desc.Width = 32;
  const auto words = program.run(desc);
  for (uint32_t i = 0; i < 32; ++i) t.equal("thread " + std::to_string(i), words[i], i + 11);
}

}  // namespace

std::vector<RuleTest> ser_tests() {
  return {{"SER-10", trace_runs_no_closest_hit_or_miss},
          {"SER-04, SER-15", nops},
          {"SER-22", getters_of_a_hit},
          {"SER-14, SER-22", getters_of_a_miss},
          {"SER-14", flags_are_the_defined_ones, "*"},
          {"SER-20", record_is_the_full_sum},
          {"SER-23", kinds_and_attributes},
          {"SER-11", sections_through_hit_objects, "*"},
          {"SER-12", payloads_of_two_types},
          {"SER-13", qualifiers_of_the_halves},
          {"SER-24", invoke_sees_the_object},
          {"SER-25", invoke_of_nothing},
          {"SER-26", invoke_twice},
          {"SER-27", skip_closest_hit_skips_in_invoke},
          {"SER-19", set_index},
          {"SER-21", constants_of_records},
          {"SER-16, SER-18", from_ray_query},
          {"SER-17", from_ray_query_of_boxes},
          {"SER-30", several_objects_live},
          {"SER-02, SER-05", objects_are_values},
          {"SER-28", recursion, "*"},
          {"SER-29", stack_sizes},
          {"SER-32", invalid_records_of_reordering, "*"},
          {"SER-34, SER-35, SER-37, SER-41", reordering_changes_nothing},
          {"SER-38", barriers_of_reordering}};
}

}  // namespace kaamos::conformance
