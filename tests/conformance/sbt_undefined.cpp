// SPDX-License-Identifier: MIT
//
// Shader table contents that DXR leaves undefined. Here an invalid record counts as NULL: nothing
// runs, but a hit is still committed.
#include <shaders/calls.h>
#include <shaders/standard.h>

#include <algorithm>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

void records_past_the_end(Context& t) {
  Standard program(t);
  program.records("Plain", 2);
  program.miss_records(2);
  program.scene = t.scene({triangle(5)});
  std::vector<Ray> rays(4);
  rays[0].contribution = 1;
  rays[1].contribution = 2;
  rays[2] = rays[3] = ray_at(50);
  rays[2].miss = 1;
  rays[3].miss = 40;
  const auto seen = program.trace(rays);
  t.equal("end with the last hit record", seen[0].end, kClosestHitRan);
  t.equal("end behind the last hit record", seen[1].end, kNothingRan);
  t.equal("end with the last miss record", seen[2].end, kMissRan);
  t.equal("end behind the last miss record", seen[3].end, kNothingRan);

  Program calls(t, kaamos_shaders_calls());
  calls.local(kRecordSignature, {"CallOne", "Answer", "Forward"});
  calls.raygen("CallOne", {LocalArgument::Constants(Constants{5})});
  calls.callable("Answer", {LocalArgument::Constants(Constants{6})});
  for (const uint32_t index : {1u, 5000u, 0xFFFFFFFFu}) {
    Ray ray;
    ray.contribution = index;
    calls.rays = t.upload(std::vector<Ray>{ray});
    t.equal("parameter after callable " + std::to_string(index), calls.run()[0], 77u);
  }
}

// Records whose bytes never were an identifier, or that hold the identifier of a destroyed
// pipeline.
void stale_records(Context& t) {
  std::vector<std::byte> gone;
  {
    Standard other(t);
    other.desc.Add(NodeMask{});  // keeps the pipeline from being shared, so that it is destroyed
    other.record("Plain");
    other.tables();
    gone = other.shader_tables[2].bytes();
  }
  Standard program(t);
  program.record("Plain");
  program.scene = t.scene({triangle(5)});
  program.prepare({Ray{}});
  DispatchRaysDesc desc = program.tables();
  auto bytes = program.shader_tables[2].bytes();
  t.equal("end with the record as it is", seen_of(program.run(desc), 1)[0].end, kClosestHitRan);
  std::copy(gone.begin(), gone.begin() + 32, bytes.begin());
  desc.HitGroupTable.StartAddress = t.upload(bytes).GetGPUVirtualAddress();
  t.equal("end with an identifier of a state object that is gone",
          seen_of(program.run(desc), 1)[0].end, kNothingRan);
  std::fill(bytes.begin(), bytes.begin() + 32, std::byte{0xCD});
  desc.HitGroupTable.StartAddress = t.upload(bytes).GetGPUVirtualAddress();
  t.equal("end with bytes that are no identifier", seen_of(program.run(desc), 1)[0].end,
          kNothingRan);
}

void records_that_are_none(Context& t) {
  records_past_the_end(t);
  stale_records(t);
}

void identifiers_of_an_addition(Context& t) {
  Standard program(t);
  program.desc.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  program.record("Plain");
  program.prepare({ray_at(50)});
  StateObjectDesc addition = program.desc;
  addition.Subobjects.clear();
  DxilLibraryDesc library = std::get<DxilLibraryDesc>(program.desc.Subobjects[0]);
  library.Exports = {{"LaterMiss", "Miss"}};
  addition.Add(library);
  for (const StateSubobject& each : program.desc.Subobjects) {
    if (std::holds_alternative<RaytracingShaderConfig>(each) ||
        std::holds_alternative<RaytracingPipelineConfig1>(each) ||
        std::holds_alternative<GlobalRootSignature>(each)) {
      addition.Subobjects.push_back(each);
    }
  }
  addition.Add(LocalRootSignature{t.device().CreateRootSignature(kRecordSignature).value()});
  addition.Add(StateObjectConfig{StateObjectFlags::kAllowStateObjectAdditions});
  const StateObject newer = t.device().AddToStateObject(addition, program.pipeline).value();
  DispatchRaysDesc desc = program.tables();
  auto bytes = program.shader_tables[1].bytes();
  std::memcpy(bytes.data(), newer.GetShaderIdentifier("LaterMiss")->data(), 32);
  desc.MissShaderTable.StartAddress = t.upload(bytes).GetGPUVirtualAddress();
  t.equal("end with the older state object", seen_of(program.run(desc), 1)[0].end, kNothingRan);
  program.pipeline = newer;
  t.equal("end with the newer one", seen_of(program.run(desc), 1)[0].end, kMissRan);
}

}  // namespace

std::vector<RuleTest> sbt_undefined_tests() {
  return {{"SBT-23", records_that_are_none, "KA0430, KA0431, KA0432"},
          {"SBT-33", identifiers_of_an_addition, "KA0432"}};
}

}  // namespace kaamos::conformance
