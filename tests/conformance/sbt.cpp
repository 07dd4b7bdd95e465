// SPDX-License-Identifier: MIT
//
// Shader table indexing.
#include <shaders/calls.h>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;

// Geometries side by side at x = 0, 10, 20, ..., each at t = 5.
std::vector<Geometry> row(uint32_t count) {
  std::vector<Geometry> out;
  for (uint32_t i = 0; i < count; ++i) out.push_back(triangle(5, 10.0f * static_cast<float>(i)));
  return out;
}

Ray ray_to(uint32_t geometry, uint32_t contribution = 0, uint32_t multiplier = 1) {
  Ray ray = ray_at(10.0f * static_cast<float>(geometry));
  ray.contribution = contribution;
  ray.multiplier = multiplier;
  return ray;
}

// `count` hit records, and `geometries` in one instance with this contribution.
struct Row : Standard {
  Row(Context& t, uint32_t geometries, uint32_t count, uint32_t contribution = 0,
      uint32_t flags = 0)
      : Standard(t) {
    scene = t.scene(row(geometries), contribution, flags);
    records("Plain", count);
  }
};

std::vector<uint32_t> records_of(const std::vector<Seen>& seen) {
  std::vector<uint32_t> out;
  for (const Seen& each : seen) out.push_back(each.record);
  return out;
}

// A record written by hand: identifier, then words.
std::vector<uint8_t> raw_record(const StateObject& pipeline, const char* name,
                                const std::vector<uint32_t>& arguments, size_t bytes = 64) {
  std::vector<uint8_t> out(bytes);
  std::memcpy(out.data(), pipeline.GetShaderIdentifier(name)->data(), 32);
  std::memcpy(out.data() + 32, arguments.data(), arguments.size() * 4);
  return out;
}

void local_arguments_start_at_byte_32(Context& t) {
  Standard program(t);
  program.create();
  const Buffer table = t.upload(raw_record(program.pipeline, "WriteOrdinal", {4141, 1, 2, 3}));
  program.prepare({Ray{}});
  DispatchRaysDesc desc = program.tables();
  desc.RayGenerationShaderRecord = {table.GetGPUVirtualAddress(), 64};
  t.equal("DWORD at byte 32, plus one", program.run(desc)[0], 4142u);
}

void hit_record_is_the_sum(Context& t) {
  Row program(t, 4, 15 + 15 * 3 + 7 + 1, 7);
  std::vector<Ray> rays;
  std::vector<uint32_t> expected;
  for (const uint32_t contribution : {0u, 3u, 15u}) {
    for (const uint32_t multiplier : {0u, 1u, 2u, 9u, 15u}) {
      for (uint32_t geometry = 0; geometry < 4; ++geometry) {
        rays.push_back(ray_to(geometry, contribution, multiplier));
        expected.push_back(contribution + multiplier * geometry + 7);
      }
    }
  }
  t.equal("records", records_of(program.trace(rays)), expected);
}

void ray_contribution_has_four_bits(Context& t) {
  Row program(t, 1, 16);
  t.equal("records of 0x13, 0xFFFFFFF3",
          records_of(program.trace({ray_to(0, 0x13), ray_to(0, 0xFFFFFFF3)})), {3u, 3u});
}

void multiplier_has_four_bits(Context& t) {
  Row program(t, 4, 64);
  t.equal("records of multiplier 0x11",
          records_of(program.trace(
              {ray_to(0, 0, 0x11), ray_to(1, 0, 0x11), ray_to(2, 0, 0x11), ray_to(3, 0, 0x11)})),
          {0u, 1u, 2u, 3u});
}

void miss_index_has_sixteen_bits(Context& t) {
  Row program(t, 1, 1);
  program.miss_records(4);
  Ray ray = ray_at(100);
  ray.miss = 0x10002;
  t.equal("record of miss index 0x10002", program.trace(ray).record, 1002u);
}

void instance_flags_do_not_leak(Context& t) {
  Row program(t, 1, 6, 5, 0x7);
  t.equal("record", program.trace(ray_to(0)).record, 5u);
}

void geometry_index_is_the_position(Context& t) {
  Row program(t, 3, 3);
  const auto seen = program.trace({ray_to(0), ray_to(1), ray_to(2)});
  t.equal("records", records_of(seen), {0u, 1u, 2u});
}

void multiplier_zero_drops_geometry(Context& t) {
  Row program(t, 3, 3);
  const auto seen = program.trace({ray_to(0, 0, 0), ray_to(1, 0, 0), ray_to(2, 0, 0)});
  t.equal("records", records_of(seen), {0u, 0u, 0u});
  t.equal("GeometryIndex() of the last", seen[2].geometry, 2u);
}

void multiplier_interleaves_ray_types(Context& t) {
  Row program(t, 3, 6);
  std::vector<Ray> rays;
  for (uint32_t geometry = 0; geometry < 3; ++geometry) {
    for (uint32_t type = 0; type < 2; ++type) rays.push_back(ray_to(geometry, type, 2));
  }
  t.equal("records", records_of(program.trace(rays)), {0u, 1u, 2u, 3u, 4u, 5u});
}

void miss_record_takes_no_hit_term(Context& t) {
  Row program(t, 1, 1, 9);
  program.miss_records(12);
  Ray ray = ray_at(100);
  ray.miss = 3;
  ray.contribution = 7;
  ray.multiplier = 4;
  const Seen seen = program.trace(ray);
  t.equal("end", seen.end, kMissRan);
  t.equal("record", seen.record, 1003u);
}

struct Calls : Program {
  explicit Calls(Context& t) : Program(t, kaamos_shaders_calls()) {
    local(kRecordSignature, {"CallOne", "Answer", "Forward"});
    raygen("CallOne", {LocalArgument::Constants(Constants{5})});
  }
  uint32_t answer(Context& t, uint32_t index) {
    Ray ray;
    ray.contribution = index;
    rays = t.upload(std::vector<Ray>{ray});
    return run()[0];
  }
};

void callable_index_is_not_masked(Context& t) {
  Calls program(t);
  program.callable("Answer", {LocalArgument::Constants(Constants{0})});
  for (uint32_t i = 1; i < 70000; ++i) program.shader_tables[3].AddNullRecord();
  program.callable("Answer", {LocalArgument::Constants(Constants{4242})});
  t.equal("answer of callable 70000", program.answer(t, 70000), 4242u);
  t.equal("answer of callable 0", program.answer(t, 0), 0u);
}

void raygen_is_the_record_named(Context& t) {
  Standard program(t);
  for (const uint32_t ordinal : {40u, 50u}) {
    program.raygen("WriteOrdinal", {LocalArgument::Constants(Constants{ordinal})});
  }
  program.prepare({Ray{}});
  DispatchRaysDesc desc = program.tables();
  t.equal("record 0", program.run(desc)[0], 41u);
  desc.RayGenerationShaderRecord = program.shader_tables[0].GetRecord(1);
  t.equal("record 1", program.run(desc)[0], 51u);
}

Status record_dispatch(Context& t, Standard& program, const DispatchRaysDesc& desc) {
  CommandList list = t.device().CreateCommandList().value();
  list.SetComputeRootSignature(program.global);
  list.SetPipelineState1(program.pipeline);
  list.DispatchRays(desc);
  return list.Close();
}

void strides_are_multiples_of_32(Context& t) {
  Row program(t, 1, 200);
  program.prepare({Ray{}});
  DispatchRaysDesc desc = program.tables();
  for (const uint64_t stride : {16u, 48u, 4128u}) {
    desc.HitGroupTable.StrideInBytes = stride;
    t.refused("stride " + std::to_string(stride), record_dispatch(t, program, desc), "KA0813");
  }
  for (const uint64_t stride : {0u, 32u, 4096u}) {
    desc.HitGroupTable.StrideInBytes = stride;
    t.accepted("stride " + std::to_string(stride), record_dispatch(t, program, desc));
  }
}

void stride_zero_is_the_first_record(Context& t) {
  Row program(t, 4, 4);
  const std::vector<Ray> rays = {ray_to(0), ray_to(1), ray_to(2), ray_to(3)};
  program.prepare(rays);
  DispatchRaysDesc desc = program.tables();
  desc.Width = 4;
  desc.HitGroupTable.StrideInBytes = 0;
  t.equal("records", records_of(seen_of(program.run(desc), 4)), {0u, 0u, 0u, 0u});
}

void starts_are_multiples_of_64(Context& t) {
  Row program(t, 1, 4);
  program.prepare({Ray{}});
  const DispatchRaysDesc good = program.tables();
  DispatchRaysDesc desc = good;
  desc.HitGroupTable.StartAddress += 32;
  desc.HitGroupTable.SizeInBytes -= 32;
  t.refused("hit group table + 32", record_dispatch(t, program, desc), "KA0813");
  desc = good;
  desc.MissShaderTable.StartAddress += 32;
  t.refused("miss table + 32", record_dispatch(t, program, desc), "KA0813");
  desc = good;
  desc.RayGenerationShaderRecord.StartAddress += 32;
  t.refused("ray generation record + 32", record_dispatch(t, program, desc), "KA0813");
}

void null_miss_runs_nothing(Context& t) {
  Row program(t, 1, 1);
  program.miss("");
  const Seen seen = program.trace(ray_at(100));
  t.equal("end", seen.end, kNothingRan);
  t.equal("record", seen.record, 0xFFFFFFFFu);
}

void null_hit_group_is_opaque(Context& t) {
  Standard program(t);
  program.record("");
  program.record("Plain");
  Ray ray;
  ray.multiplier = 1;
  program.scene = t.scene({triangle(5, 0, kNonOpaque), triangle(10)});
  Seen seen = program.trace(ray);
  t.equal("end behind a NULL record", seen.end, kNothingRan);
  // The nearer hit limits the ray, whichever of the two is met first.
  program.scene = t.scene({triangle(10, 0, kNonOpaque), triangle(5)});
  seen = program.trace(ray);
  t.equal("end before a NULL record", seen.end, kClosestHitRan);
  t.equal("record before a NULL record", seen.record, 1u);
}

void null_hit_group_runs_no_intersection(Context& t) {
  Standard program(t);
  program.record("");
  t.equal("end", program.trace(t.scene({box(5)})).end, kMissRan);
  t.equal("intersection shaders", program.intersections(), 0u);
}

void group_without_any_hit_is_opaque(Context& t) {
  Standard program(t);
  program.records("Plain", 1);
  const Seen seen = program.trace(t.scene({triangle(5, 0, kNonOpaque)}));
  t.equal("end", seen.end, kClosestHitRan);
  t.equal("any-hit shaders", seen.any_hits, 0u);
}

void null_callable_and_raygen_run_nothing(Context& t) {
  Calls program(t);
  program.callable("");
  t.equal("parameter after a NULL callable", program.answer(t, 0), 77u);
  Standard nothing(t);
  nothing.raygen("");
  nothing.prepare({Ray{}});
  t.equal("words after a NULL ray generation record", nothing.run()[0], 0u);
}

void unreached_records_may_be_garbage(Context& t) {
  Row program(t, 4, 4);
  program.prepare({ray_to(2)});
  DispatchRaysDesc desc = program.tables();
  auto bytes = program.shader_tables[2].bytes();
  const uint32_t stride = program.shader_tables[2].stride_bytes();
  for (size_t i = 0; i < bytes.size(); ++i) {
    if (i / stride != 2) bytes[i] = std::byte{0xCD};
  }
  desc.HitGroupTable.StartAddress = t.upload(bytes).GetGPUVirtualAddress();
  t.equal("record", seen_of(program.run(desc), 1)[0].record, 2u);
}

void unread_argument_may_be_junk(Context& t) {
  Standard program(t);
  program.group("Junk", "ClosestJunk");
  DxilLibraryDesc again = std::get<DxilLibraryDesc>(program.desc.Subobjects[0]);
  again.Exports = {{"ClosestJunk", "Closest"}};
  program.desc.Add(again);
  program.local(
      "RootFlags(LOCAL_ROOT_SIGNATURE), DescriptorTable(SRV(t5, space = 1)), SRV(t6, space = 1),"
      "RootConstants(b0, space = 1, num32BitConstants = 4)",
      {"Junk"});
  program.create();
  program.hit("Junk", {LocalArgument::Table({0xDEADBEEFDEADBEE0}),
                       LocalArgument::Address(GpuVirtualAddress{0xDEADBEE0}),
                       LocalArgument::Constants(Constants{31})});
  t.equal("record", program.trace(t.scene({triangle(5)})).record, 31u);
}

void one_record_for_the_whole_group(Context& t) {
  Standard program(t);
  program.records("Plain", 3);
  program.record("BoxCounted");
  const Seen seen = program.trace(t.scene({box(5, 0, kNonOpaque)}, 3));
  t.equal("records of closest hit, any hit, intersection",
          std::vector<uint32_t>{seen.record, seen.any_record, seen.box_record}, {3u, 3u, 3u});
}

void closest_hit_uses_the_committed_record(Context& t) {
  Standard program(t);
  for (const char* group : {"Ignored", "Plain", "Ignored", "Ignored"}) program.record(group);
  Ray ray;
  ray.multiplier = 1;
  const Seen seen =
      program.trace(t.scene({triangle(3, 0, kNonOpaque), triangle(5), triangle(10, 0, kNonOpaque),
                             triangle(4, 0, kNonOpaque)}),
                    ray);
  t.equal("record", seen.record, 1u);
  t.distance("t", seen.t, 5.0f);
}

void identifiers_never_alias(Context& t) {
  Standard program(t);
  DxilLibraryDesc again = std::get<DxilLibraryDesc>(program.desc.Subobjects[0]);
  again.Exports = {{"ClosestB", "Closest"}};
  program.desc.Add(again);
  program.group("PlainB", "ClosestB");
  program.local(
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b1, space = 1, num32BitConstants = 1),"
      "RootConstants(b0, space = 1, num32BitConstants = 4)",
      {"PlainB"});
  program.create();
  program.hit("Plain", {LocalArgument::Constants(Constants{61})});
  const uint32_t pad = 0xFFFF;
  program.hit("PlainB", {LocalArgument::Constants(pad), LocalArgument::Constants(Constants{62})});
  for (const std::string& name : program.pipeline.GetIdentifiableExports()) {
    const auto* identifier = program.pipeline.GetShaderIdentifier(name);
    t.holds("identifier of " + name + " is not NULL",
            identifier != nullptr && *identifier != ShaderIdentifier{});
  }
  program.scene = t.scene(row(2));
  t.equal("arguments of one function under two names",
          records_of(program.trace({ray_to(0), ray_to(1)})), {61u, 62u});
}

void tables_are_read_at_execution(Context& t) {
  Standard program(t);
  program.raygen("WriteOrdinal", {LocalArgument::Constants(Constants{1})});
  program.prepare({Ray{}});
  const DispatchRaysDesc desc = program.tables();
  const Buffer words = t.zeros(kWordBytes);
  CommandList list = t.device().CreateCommandList().value();
  list.SetComputeRootSignature(program.global);
  list.SetPipelineState1(program.pipeline);
  list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
  list.DispatchRays(desc);
  list.Close().value();
  program.shader_tables[0].buffer().data<uint32_t>()[8] = 500;
  t.queue().ExecuteAndWait(list).value();
  t.equal("argument written after recording, plus one", t.read(words)[0], 501u);
}

void empty_tables_where_nothing_is_reached(Context& t) {
  Standard program(t);
  program.prepare({Ray{}});
  DispatchRaysDesc desc = program.tables();
  desc.HitGroupTable = {};
  desc.CallableShaderTable = {};
  t.equal("end", seen_of(program.run(desc), 1)[0].end, kMissRan);
}

}  // namespace

std::vector<RuleTest> sbt_tests() {
  return {{"SBT-01", local_arguments_start_at_byte_32},
          {"SBT-02", hit_record_is_the_sum},
          {"SBT-03", ray_contribution_has_four_bits},
          {"SBT-04", multiplier_has_four_bits},
          {"SBT-05", miss_index_has_sixteen_bits},
          {"SBT-06", instance_flags_do_not_leak},
          {"SBT-08", geometry_index_is_the_position},
          {"SBT-09", multiplier_zero_drops_geometry},
          {"SBT-10", multiplier_interleaves_ray_types},
          {"SBT-11", miss_record_takes_no_hit_term},
          {"SBT-12", callable_index_is_not_masked},
          {"SBT-13", raygen_is_the_record_named},
          {"SBT-14", strides_are_multiples_of_32},
          {"SBT-15", stride_zero_is_the_first_record},
          {"SBT-17", starts_are_multiples_of_64},
          {"SBT-18", null_miss_runs_nothing},
          {"SBT-19", null_hit_group_is_opaque},
          {"SBT-20", null_hit_group_runs_no_intersection},
          {"SBT-21", group_without_any_hit_is_opaque},
          {"SBT-22", null_callable_and_raygen_run_nothing},
          {"SBT-24", unreached_records_may_be_garbage},
          {"SBT-25", unread_argument_may_be_junk},
          {"SBT-26", one_record_for_the_whole_group},
          {"SBT-27", closest_hit_uses_the_committed_record},
          {"SBT-29", identifiers_never_alias},
          {"SBT-30", tables_are_read_at_execution},
          {"SBT-32", empty_tables_where_nothing_is_reached}};
}

}  // namespace kaamos::conformance
