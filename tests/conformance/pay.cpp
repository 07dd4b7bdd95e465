// SPDX-License-Identifier: MIT
//
// Payloads, attributes and callable parameters.
#include <shaders/payload.h>

#include "tests/conformance/compile.h"
#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

void set_config(Program& program, uint32_t payload_bytes, uint32_t attribute_bytes) {
  for (StateSubobject& each : program.desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingShaderConfig>(&each)) {
      *config = {payload_bytes, attribute_bytes};
    }
  }
}

void two_payload_types(Context& t) {
  Standard program(t, kaamos_shaders_payload(), {"TraceTwoTypes", "ClosestSmall", "MissSmall"});
  program.group("Small", "ClosestSmall");
  program.raygen("TraceTwoTypes");
  program.record("Plain");
  program.hit("Small");
  program.miss_records(1);
  program.miss("MissSmall");
  program.scene = t.scene({triangle(5)});
  program.prepare({Ray{}});
  const auto words = program.run();
  t.equal("end with the large payload", words[0], kClosestHitRan);
  t.equal("small payload after a hit", words[1], 41u);
  t.equal("small payload after a miss", words[2], 52u);
}

void payload_size_is_bounded(Context& t) {
  for (const uint32_t bytes : {32u, 36u}) {
    Program program(t, kaamos_shaders_payload(), {"MissNine"});
    set_config(program, bytes, 8);
    if (bytes == 32) {
      t.refused("a payload of 36 bytes with a limit of 32", program.try_create());
    } else {
      t.accepted("a payload of 36 bytes with a limit of 36", program.try_create());
    }
  }
  Program callables(t, kaamos_shaders_payload(), {"CallWide", "Widen", "Increase"});
  set_config(callables, 4, 8);
  t.accepted("callable parameters of 256 bytes with a limit of 4", callables.try_create());
}

void attribute_size_is_bounded(Context& t) {
  Program too_large(t, kaamos_shaders_payload(), {"MissNine"});
  set_config(too_large, 64, 36);
  t.refused("MaxAttributeSizeInBytes of 36", too_large.try_create());
  t.refused("attributes of 36 bytes",
            compile("struct Nine { float values[9]; };\n"
                    "[shader(\"intersection\")]\n"
                    "void Report() { Nine nine = (Nine)0; ReportHit(1, 0, nine); }\n"));
  for (const uint32_t bytes : {12u, 16u}) {
    Program program(t, kaamos_shaders_payload(), {"ReportFour", "ClosestFour"});
    program.group("Group", "ClosestFour", "", "ReportFour");
    set_config(program, 64, bytes);
    if (bytes == 12) {
      t.refused("attributes of 16 bytes with a limit of 12", program.try_create());
    } else {
      t.accepted("attributes of 16 bytes with a limit of 16", program.try_create());
    }
  }
}

void attribute_types_agree(Context& t) {
  Standard program(t, kaamos_shaders_payload(), {"ReportFour"});
  program.group("Mixed", "BoxClosest", "", "ReportFour");
  program.local(kRecordSignature, {"Mixed"});
  t.refused("16 bytes reported, 8 bytes read", program.try_create());
}

void callable_parameters_travel_by_value(Context& t) {
  Program program(t, kaamos_shaders_payload(), {"CallWide", "Widen", "Increase"});
  program.raygen("CallWide");
  program.callable("Widen");
  program.callable("Increase");
  const auto words = program.run();
  for (uint32_t i = 0; i < 64; ++i) {
    t.equal("word " + std::to_string(i), words[i], 3 * i + 1000);
  }
}

void any_hit_changes_are_seen(Context& t) {
  Standard program(t, kaamos_shaders_payload(), {"ClosestOfChain", "MissOfChain"});
  program.group("Chain", "ClosestOfChain");
  program.record("Ignored");
  program.hit("Chain");
  program.miss("MissOfChain");
  const auto once = RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  program.scene = t.top_level(
      {instance(t.bottom_level({triangle(5, 0, once), triangle(6, 0, once), triangle(7, 0, once)})),
       instance(t.bottom_level({triangle(5, 10, once), triangle(6, 10, once)})),
       instance(t.bottom_level({triangle(8, 10)}), 0, 1)});
  const auto seen = program.trace({ray_at(0), ray_at(10)});
  t.equal("end of the first ray", seen[0].end, kMissRan);
  t.equal("any-hit shaders that its miss shader saw", seen[0].record, 3u);
  t.equal("what its caller saw", seen[0].any_hits, 1003u);
  t.equal("end of the second ray", seen[1].end, kClosestHitRan);
  t.equal("any-hit shaders that its closest-hit shader saw", seen[1].record, 2u);
  t.equal("what its caller saw", seen[1].any_hits, 1002u);
}

void each_trace_has_its_payload(Context& t) {
  Standard program(t, kaamos_shaders_payload(), {"Forwards"});
  program.group("Forward", "Forwards");
  program.hit("Forward");
  program.record("Plain");
  program.scene = t.scene({triangle(90, 90), triangle(5), triangle(20)});
  const Seen seen = program.trace(Ray{});
  t.equal("end, written by the inner shader", seen.end, kClosestHitRan);
  t.equal("geometry, written by the inner shader", seen.geometry, 2u);
  t.equal("geometry in the outer shader's copy", seen.any_record, 7u);
  t.equal("end in the outer shader's copy", seen.box_record, kNothingRan);
}

}  // namespace

std::vector<RuleTest> pay_tests() {
  return {{"PAY-01", two_payload_types},
          {"PAY-02", payload_size_is_bounded},
          {"PAY-03", attribute_size_is_bounded},
          {"PAY-04", attribute_types_agree},
          {"PAY-05", callable_parameters_travel_by_value},
          {"PAY-06", any_hit_changes_are_seen},
          {"PAY-07", each_trace_has_its_payload}};
}

}  // namespace kaamos::conformance
