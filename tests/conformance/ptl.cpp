// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: partitioned top levels.
#include "tests/conformance/ptl.h"

#include <rtapi/table_description.h>
#include <shaders/values.h>

#include <bit>
#include <cstring>
#include <limits>
#include <random>

#include "tests/conformance/rq.h"
#include "tests/conformance/structures.h"

namespace kaamos::conformance {

namespace ptl {

namespace {

// ObjectToWorld3x4()[0][3] of what a ray along z hits.
float world_x(Context& t, const Buffer& top, float x) {
  Standard program(t, kaamos_shaders_values(), {"ClosestRay"});
  program.group("Ray", "ClosestRay");
  program.hit("Ray");
  program.scene = top;
  program.prepare({ray_at(x)});
  constexpr uint32_t kRows = 24000 + 24;  // kObjectWords of values.hlsl
  return std::bit_cast<float>(program.run()[kRows / 4 + 3]);
}

void sources(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const Buffer a = build_new(
      t, inputs, {{write(bottom, 1, 0), write(bottom, 3, 10, 1), write(bottom, 6, 20, kGlobal)}});
  const std::vector<float> places = {0, 10, 20, 30, 40};
  t.equal("three of eight", slots_at(t, a, places), Slots({1, 3, 6, -1, -1}));
  const Buffer b = build_new(t, inputs, {{write(bottom, 0, 30)}}, a);
  const Buffer c = build_new(t, inputs, {{write(bottom, 1, 40)}}, a);
  t.equal("a", slots_at(t, a, places), Slots({1, 3, 6, -1, -1}));
  t.equal("b", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
  t.equal("c", slots_at(t, c, places), Slots({-1, 3, 6, -1, 1}));
  t.accepted("in place", run(t, inputs, in_memory(t, {{write(bottom, 3, 30)}}), a, a));
  t.equal("a, changed", slots_at(t, a, places), Slots({1, -1, 6, 3, -1}));
  t.equal("b, as it was", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
  own.noted("all of it", "");
  t.accepted("no partitioned top level as the source",
             run(t, inputs, {}, b, t.top_level({conformance::instance(bottom)})));
  own.noted("no partitioned top level as the source", "there is no partitioned top level");
  t.equal("b, still as it was", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
}

void whole_records(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer other = t.bottom_level({triangle(7)});
  auto one = write(bottom, 5, 0);
  one.InstanceID = 0xDEADBEEF;
  one.InstanceContributionToHitGroupIndex = 2;
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{one, write(bottom, 2, 10)}});
  auto seen = look(t, top, {0, 10});
  t.equal("InstanceID", seen[0].instance_id, 0xDEADBEEFu);
  t.equal("InstanceIndex", seen[0].instance_index, 5u);
  t.equal("record", seen[0].record, 2u);
  t.equal("InstanceIndex of the other", seen[1].instance_index, 2u);
  TableDescriptionDesc tables;
  Standard program(t);
  program.records("Plain", 4);
  program.prepare({ray_at(0)});
  tables.Dispatch = program.tables();
  tables.TopLevel = top.GetGPUVirtualAddress();
  tables.RayTypes = {{"ray", 0, 0, 0}};
  const TableDescription described =
      DescribeShaderTables(t.device(), program.pipeline, tables).value();
  uint32_t reaches = 0;
  for (const DescribedTable& table : described.Tables) {
    for (const TableRecord& record : table.Records) {
      for (const TableReach& reach : record.ReachedBy) {
        reaches += reach.InstanceIndex == 5 && reach.InstanceID == 0xDEADBEEF;
      }
    }
  }
  t.equal("descriptions of tables that name it", reaches, 1u);
  const Asked asked = ask(t, top, ray_at(0));
  t.equal("InstanceID of a query", asked.instance_id, 0xDEADBEEFu);
  t.accepted("an update",
             run(t, inputs, in_memory(t, {{}, {{5, 3, other.GetGPUVirtualAddress()}}}), top, top));
  seen = look(t, top, {0});
  t.equal("InstanceID after it", seen[0].instance_id, 0xDEADBEEFu);
  t.equal("record after it", seen[0].record, 3u);
  t.distance("bottom level after it", seen[0].t, 7);
  t.accepted("a write", run(t, inputs, in_memory(t, {{write(bottom, 5, 0, 3)}}), top, top));
  seen = look(t, top, {0});
  t.equal("InstanceID, written anew", seen[0].instance_id, 105u);
  t.equal("record, written anew", seen[0].record, 0u);
  own.noted("all of it", "");
}

void instance_flags(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5, 0, RaytracingGeometryFlags::kNone)});
  for (uint32_t flags = 0; flags < 16; ++flags) {
    if ((flags & 12) == 12) continue;  // exclude each other
    auto args = write(bottom, 0, 0);
    args.InstanceFlags = static_cast<InstanceFlags>(flags);
    const Buffer partitioned = build_new(t, small_inputs(), {{args}});
    const Buffer classic = t.top_level({conformance::instance(bottom, 0, 0, flags)});
    for (const uint32_t ray_flags : {0x0u, 0x1u, 0x2u, 0x10u, 0x20u, 0x40u, 0x80u}) {
      Ray ray = ray_at(0);
      ray.flags = ray_flags;
      const auto trace = [&](const Buffer& top) {
        Standard program(t);
        program.records("Counted", 1);
        program.scene = top;
        return program.trace(ray);
      };
      const Seen a = trace(partitioned), b = trace(classic);
      const std::string what =
          "instance flags " + std::to_string(flags) + ", ray flags " + std::to_string(ray_flags);
      t.equal(what + ", end", a.end, b.end);
      t.equal(what + ", any-hit shaders", a.any_hits, b.any_hits);
      t.equal(what + ", HitKind", a.hit_kind, b.hit_kind);
    }
  }
}

void inactive(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  std::vector<WriteArgs> all;
  for (uint32_t i = 0; i < 6; ++i) all.push_back(write(bottom, i, 10.f * static_cast<float>(i)));
  all[1].InstanceMask = 0;
  all[2].AccelerationStructure = 0;
  all[3].Transform[1][3] = std::numeric_limits<float>::quiet_NaN();
  for (auto& row : all[4].Transform) row[0] = row[1] = row[2] = 0;
  // Those that are degenerate do not count for the limit.
  auto inputs = small_inputs();
  inputs.MaxInstancePerPartitionCount = 4;
  const Buffer top = build_new(t, inputs, {all});
  own.noted("four of six", "");
  t.equal("what is hit", slots_at(t, top, {0, 10, 20, 30, 40, 50}), Slots({0, -1, -1, -1, -1, 5}));
  inputs.MaxInstancePerPartitionCount = 3;
  build_new(t, inputs, {all});
  own.noted("a limit", "partition 0 has 4 instances");
  inputs = small_inputs();
  inputs.MaxInstanceInGlobalPartitionCount = 0;
  build_new(t, inputs, {{write(bottom, 0, 0, kGlobal)}});
  own.noted("the global partition's", "the global partition has 1 instances");
}

void full_partitions(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  inputs.MaxInstancePerPartitionCount = 1;
  const Buffer top = build_new(t, inputs, {{write(bottom, 0, 0, 0), write(bottom, 1, 10, 1)}});
  t.accepted(
      "they change places",
      run(t, inputs, in_memory(t, {{write(bottom, 0, 0, 1), write(bottom, 1, 10, 0)}}), top, top));
  own.noted("only the end counts", "");
  t.equal("what is hit", slots_at(t, top, {0, 10}), Slots({0, 1}));
}

void explicit_boxes(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto args = write({}, 0, 0);
  args.InstanceFlags = InstanceFlags::kEnableExplicitAabb;
  args.ExplicitAABB = {-4, -4, 4, 4, 4, 6};
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{args}});
  t.equal("disabled", slots_at(t, top, {0}), Slots{-1});
  const UpdateArgs enable = {0, 0, bottom.GetGPUVirtualAddress()};
  t.accepted("enabled", run(t, inputs, in_memory(t, {{}, {enable}}), top, top));
  own.noted("enabled", "");
  t.equal("enabled", slots_at(t, top, {0}), Slots{0});
  args.ExplicitAABB.MaxZ = 4.5f;
  args.AccelerationStructure = enable.AccelerationStructure;
  t.accepted("a small box", run(t, inputs, in_memory(t, {{args}}), top, top));
  own.noted("a small box", t.target().checked ? "outside of its ExplicitAABB" : "");
}

void updates(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{write({}, 0, 0), write(bottom, 1, 10)}});
  const auto left_out = [&](const char* what, const UpdateArgs& args, const char* words) {
    t.accepted(what, run(t, inputs, in_memory(t, {{}, {args}}), top, top));
    own.noted(what, words);
    t.equal(what, slots_at(t, top, {0, 10, 20}), Slots({-1, 1, -1}));
  };
  const uint64_t address = bottom.GetGPUVirtualAddress();
  left_out("without bottom level or box", {0, 0, address}, "without a bottom level");
  left_out("never written", {2, 0, address}, "was never written");
  left_out("no bottom level", {1, 0, 0}, "AccelerationStructure is 0");
  left_out("no such instance", {9, 0, address}, "InstanceIndex is 9");
  t.accepted("no structure there",
             run(t, inputs, in_memory(t, {{}, {{1, 0, top.GetGPUVirtualAddress()}}}), top, top));
  own.noted("no structure there", "there is no bottom level at its address");
  t.equal("no structure there", slots_at(t, top, {10}), Slots{-1});
}

void translations(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs(TlasFlags::kEnablePartitionTranslation);
  const Buffer top =
      build_new(t, inputs,
                {{write(bottom, 0, 0), write(bottom, 1, 10, 1), write(bottom, 2, 20, kGlobal)},
                 {},
                 {translate(0, 1), translate(kGlobal, 0, 0, 3)}});
  t.equal("once", slots_at(t, top, {1, 10, 20}), Slots({0, 1, 2}));
  t.distance("the global one", look(t, top, {20})[0].t, 8);
  t.accepted("again", run(t, inputs, in_memory(t, {{}, {}, {translate(0, 1)}}), top, top));
  t.equal("it replaces", slots_at(t, top, {1, 3, 10}), Slots({0, -1, 1}));
  t.accepted("a later write", run(t, inputs, in_memory(t, {{write(bottom, 3, 30)}}), top, top));
  t.equal("it persists", slots_at(t, top, {31, 29.2f}), Slots({3, -1}));
  t.equal("ObjectToWorld", world_x(t, top, 31), 31.f);
  // 2^24 + 1 is halfway between two floats, and the even one is 2^24.
  t.accepted("far away",
             run(t, inputs, in_memory(t, {{write(bottom, 4, 16777216)}, {}, {translate(0, 1)}}),
                 top, top));
  t.equal("to the nearest even", world_x(t, top, 16777216), 16777216.f);
  own.noted("all of it", "");
  const auto without = small_inputs();
  t.accepted("without the flag", run(t, without, {}, top, top));
  t.equal("dropped", slots_at(t, top, {0, 10}), Slots({0, 1}));
  t.accepted("TRANSLATE without the flag",
             run(t, without, in_memory(t, {{}, {}, {translate(0, 1)}}), top, top));
  own.noted("TRANSLATE without the flag", "needs kEnablePartitionTranslation");
  t.accepted("with it again", run(t, inputs, {}, top, top));
  t.equal("zero again", slots_at(t, top, {0, 10}), Slots({0, 1}));
  t.accepted("no such partition",
             run(t, inputs, in_memory(t, {{}, {}, {translate(4, 1)}}), top, top));
  own.noted("no such partition", "PartitionIndex is 4");
}

void resizes(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  inputs.InstanceCount = 4;
  const Buffer four = build_new(t, inputs, {{write(bottom, 0, 0), write(bottom, 3, 10, 3)}});
  inputs.InstanceCount = 8;
  const Buffer eight = build_new(t, inputs, {{write(bottom, 7, 20)}}, four);
  t.equal("8", slots_at(t, eight, {0, 10, 20}), Slots({0, 3, 7}));
  inputs.InstanceCount = 2;
  const Buffer two = build_new(t, inputs, {}, eight);
  t.equal("2", slots_at(t, two, {0, 10, 20}), Slots({0, -1, -1}));
  own.noted("counts of instances", "");
  inputs.InstanceCount = 8;
  inputs.PartitionCount = 3;
  const Buffer fewer = build_new(t, inputs, {}, eight);
  own.noted("a partition goes", "instance 3 is in partition 3");
  t.equal("its member is disabled", slots_at(t, fewer, {0, 10, 20}), Slots({0, -1, 7}));
  build_new(t, inputs, {{write(bottom, 3, 10, 2)}}, eight);
  own.noted("its member is written", "");
}

void empty_ones(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  t.equal("nothing written", slots_at(t, build_new(t, small_inputs(), {}), {0}), Slots{-1});
  t.equal("no instances", slots_at(t, build_new(t, {TlasFlags::kNone, 0, 0, 4, 0}, {}), {0}),
          Slots{-1});
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer global =
      build_new(t, {TlasFlags::kNone, 2, 0, 0, 2}, {{write(bottom, 1, 0, kGlobal)}});
  t.equal("no partitions", slots_at(t, global, {0}), Slots{1});
  own.noted("all of it", "");
}

// The same picture, also through hit objects.
void as_a_top_level(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level(meadow());
  const auto both = [&] {
    const Buffer partitioned = build_new(t, small_inputs(), {{write(bottom, 0, 0, 2)}});
    RaytracingInstanceDesc same = conformance::instance(bottom);
    same.InstanceID = 100;
    same_picture(t, "the meadow", picture(t, partitioned), picture(t, t.top_level({same})));
  };
  both();
  if (t.target().tier < RaytracingTier::kTier1_2) return;
  t.trace_through_hit_objects(true);
  both();
}

void overlapping_ranges(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const uint64_t bytes = sizes_of(t, inputs).ResultDataMaxSizeInBytes;
  const Buffer memory = t.structure_memory(2 * bytes);
  t.accepted("a source", run(t, inputs, in_memory(t, {{write(bottom, 0, 0)}}), memory));
  auto data = data_of(t, inputs, in_memory(t, {{write(bottom, 1, 10)}}), memory, memory);
  data.DestAccelerationStructureData += 256;
  t.accepted("a destination in the middle of it", run(t, inputs, data));
  own.noted("a destination in the middle of it", "overlap; they must be the same or apart");
  RtasPartitionedTlasOperationData moved = data_of(t, inputs, {}, memory, {});
  moved.SourceAccelerationStructureData = data.DestAccelerationStructureData;
  const Buffer apart = memory_of(t, inputs);
  moved.DestAccelerationStructureData = apart.GetGPUVirtualAddress();
  t.accepted("a copy of the result", run(t, inputs, moved));
  own.noted("a copy of the result", "");
  t.equal("what is hit", slots_at(t, apart, {0, 10}), Slots({0, 1}));
}

// Its PartitionIndex of 0 does not count.
void never_written_ones(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  inputs.MaxInstancePerPartitionCount = 1;
  build_new(t, inputs, {});
  own.noted("none is written", "");
  const Buffer top = build_new(t, inputs, {{write(bottom, 3, 0, 0)}});
  own.noted("one is written", "");
  inputs.InstanceCount = 12;
  t.equal("what is hit", slots_at(t, build_new(t, inputs, {}, top), {0}), Slots{3});
  own.noted("more slots", "");
  build_new(t, inputs, {{write(bottom, 4, 10, 0)}}, top);
  own.noted("two are written", "partition 0 has 2 instances");
}

void any_partitions(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level(meadow());
  std::mt19937 random(3);
  const auto image = [&](bool global) {
    std::vector<WriteArgs> all;
    for (uint32_t i = 0; i < 8; ++i) {
      const uint32_t partition = random() % 5;
      all.push_back(write(bottom, i, 2.f * static_cast<float>(i) - 8,
                          global || partition == 4 ? kGlobal : partition));
    }
    return picture(t, build_new(t, small_inputs(), {all}));
  };
  const auto expected = image(true);
  for (int i = 0; i < 4; ++i) same_picture(t, "other partitions", image(false), expected);
  own.noted("all of it", "");
}

// Instances that are written, updated and translated again and again, in place and from another
// source, against a top level that is built of the same ones. More of them than a list holds.
void changed_again_and_again(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  constexpr uint32_t kCount = 40, kPartitions = 5;
  const RtasPartitionedTlasInputsDesc inputs = {TlasFlags::kEnablePartitionTranslation, kCount,
                                                kCount, kPartitions, kCount};
  const Buffer bottoms[] = {t.bottom_level(meadow()), t.bottom_level({triangle(5)})};
  std::mt19937 random(4);
  const auto place = [&] { return static_cast<float>(random() % 1000) / 50 - 10; };
  std::vector<WriteArgs> state;
  float moved[kPartitions + 1] = {};
  const auto partition_of = [](uint32_t i) { return i == kPartitions ? kGlobal : i; };
  const auto rewrite = [&](uint32_t i) {
    state[i] = write(bottoms[random() % 2], i, place(), partition_of(random() % (kPartitions + 1)));
    state[i].Transform[2][3] = place() / 4;
  };
  Operations all;
  for (uint32_t i = 0; i < kCount; ++i) {
    state.emplace_back();
    rewrite(i);
  }
  all.writes = state;
  Buffer top = build_new(t, inputs, all);
  for (int round = 0; round < 8; ++round) {
    Operations change;
    for (uint32_t i = random() % 9; i < kCount; i += 1 + random() % 9) {
      if (random() % 2 == 0) {
        rewrite(i);
        change.writes.push_back(state[i]);
      } else {
        state[i].AccelerationStructure = bottoms[random() % 2].GetGPUVirtualAddress();
        change.updates.push_back({i, 0, state[i].AccelerationStructure});
      }
    }
    const uint32_t partition = random() % (kPartitions + 1);
    moved[partition] = place() / 2;
    change.translations = {translate(partition_of(partition), moved[partition])};
    if (round % 3 == 2) {
      top = build_new(t, inputs, change, top);
    } else {
      t.accepted("a change", run(t, inputs, in_memory(t, change), top, top));
    }
    std::vector<RaytracingInstanceDesc> descs;
    for (const WriteArgs& args : state) {
      RaytracingInstanceDesc desc;
      std::memcpy(desc.Transform, args.Transform, sizeof(desc.Transform));
      desc.Transform[0][3] +=
          moved[args.PartitionIndex == kGlobal ? kPartitions : args.PartitionIndex];
      desc.InstanceID = args.InstanceID;
      desc.AccelerationStructure = args.AccelerationStructure;
      descs.push_back(desc);
    }
    same_picture(t, "round " + std::to_string(round), picture(t, top),
                 picture(t, t.top_level(descs)));
  }
  own.noted("all of it", "");
}

void many(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  constexpr uint32_t kCount = 100'000, kPartitions = 300;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const RtasPartitionedTlasInputsDesc inputs = {TlasFlags::kNone, kCount, 400, kPartitions, 0};
  std::vector<WriteArgs> all;
  for (uint32_t i = 0; i < kCount; ++i) {
    all.push_back(write(bottom, i, 3.f * static_cast<float>(i), i % kPartitions));
  }
  const Buffer top = build_new(t, inputs, {all});
  t.accepted("one more write", run(t, inputs, in_memory(t, {{write(bottom, 7, -10)}}), top, top));
  own.noted("all of it", "");
  t.equal("what is hit", slots_at(t, top, {0, 21, -10, 3.f * 54321, 3.f * 99999}),
          Slots({0, -1, 7, 54321, 99999}));
}

std::vector<RuleTest> instance_tests() {
  return {{"PTL-02, PTL-03", sources},
          {"PTL-11, PTL-18, PTL-20", whole_records},
          {"PTL-13", instance_flags},
          {"PTL-14, PTL-15", inactive},
          {"PTL-15", full_partitions},
          {"PTL-16", explicit_boxes},
          {"PTL-17", updates},
          {"PTL-21, PTL-22, PTL-23, PTL-24", translations},
          {"PTL-25", resizes},
          {"PTL-28", as_a_top_level},
          {"PTL-04", overlapping_ranges},
          {"PTL-26", never_written_ones},
          {"PTL-27", any_partitions},
          {"PTL-03, PTL-11, PTL-17, PTL-22", changed_again_and_again},
          {"PTL-30", empty_ones},
          {"PTL-32", many}};
}

}  // namespace

}  // namespace ptl

std::vector<RuleTest> ptl_tests() {
  std::vector<RuleTest> all = ptl::instance_tests();
  for (const RuleTest& test : ptl::memory_tests()) all.push_back(test);
  return all;
}

}  // namespace kaamos::conformance
