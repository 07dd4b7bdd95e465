// SPDX-License-Identifier: MIT
//
// Tests what the runtime must say about dispatches, their tables, rays and shaders, and when:
// errors of calls, and messages of checked mode.
#include <limits>

#include "tests/conformance/checked.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

void recursion_and_stack(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Nested");
  bool removed = false;
  try {
    s.run();
  } catch (const ResultError&) {
    removed = true;
  }
  c.holds("recursion past the declared depth removes the device", removed);
}

void illegal_rays(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Plain");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto run = [&](const std::string& what, void (*spoil)(Ray&, float), const char* id) {
    Ray ray;
    spoil(ray, nan);
    s.rays = c.upload(std::vector<Ray>{ray});
    s.run();
    if (id != nullptr) {
      c.told(what, id);
    } else {
      c.silent(what);
    }
  };
  run(
      "a sound ray", [](Ray&, float) {}, nullptr);
  run(
      "a ray of no length", [](Ray& ray, float) { ray.t_max = ray.t_min; }, nullptr);
  run(
      "NaN origin", [](Ray& ray, float n) { ray.origin[1] = n; }, "KA0401");
  run(
      "NaN direction", [](Ray& ray, float n) { ray.direction[2] = n; }, "KA0401");
  run(
      "NaN TMax", [](Ray& ray, float n) { ray.t_max = n; }, "KA0401");
  run(
      "negative TMin", [](Ray& ray, float) { ray.t_min = -1; }, "KA0402");
  run(
      "TMin above TMax", [](Ray& ray, float) { ray.t_min = 2000; }, "KA0402");
}

void parameters_of_other_types(Context& t) {
  Checked c(t);
  for (const bool right : {true, false}) {
    CheckedScene s(c);
    s.raygen("One");
    s.miss(right ? "Sky" : "OtherSky");
    s.scene = c.scene({});
    s.run();
    if (right) {
      c.silent("payloads of one type");
    } else {
      c.told("a miss shader with another payload", "KA0407");
    }
  }
  for (const bool right : {true, false}) {
    CheckedScene calls(c);
    calls.raygen("Calls");
    calls.callable(right ? "Takes" : "TakesOne");
    calls.run();
    if (right) {
      c.silent("callable data of one type");
    } else {
      c.told("callable data of another type", "KA0408");
    }
  }
  CheckedScene large(c);
  for (StateSubobject& each : large.desc.Subobjects) {
    if (auto* config = std::get_if<RaytracingShaderConfig>(&each)) {
      config->MaxPayloadSizeInBytes = 12;
    }
  }
  c.refused("a payload of 16 bytes where 12 are declared", large.try_create(), "KA0522");
}

void reported_hits(Context& t) {
  Checked c(t);
  for (const uint32_t kind : {0u, 127u, 128u, 255u}) {
    CheckedScene s(c);
    s.scene = c.scene({box(5)});
    Constants constants;
    constants.reported_kind = kind;
    s.add("Odd", constants);
    s.run();
    if (kind <= 127) {
      c.silent("hit kind " + std::to_string(kind));
    } else {
      c.told("hit kind " + std::to_string(kind), "KA0406");
    }
  }
  CheckedScene s(c);
  s.raygen("Commits");
  s.scene = c.scene({box(5)});
  for (const float at : {5.0f, -1.0f, 2000.0f}) {
    Ray ray;
    std::memcpy(&ray.extra[0], &at, sizeof at);
    s.rays = c.upload(std::vector<Ray>{ray});
    s.run();
    if (at == 5) {
      c.silent("a hit inside of the ray");
    } else {
      c.told("a hit at " + std::to_string(at), "KA0411");
    }
  }
}

// An index times a stride needs 64 bits: in 32 bits, record 2^20 + 1 at stride 4096 would be record
// 1, which exists.
void far_records(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.raygen("One");
  s.miss("Sky");
  for (uint32_t i = 0; i < 2; ++i) {
    s.hit("Plain", {LocalArgument::Constants(Constants{.ordinal = 70 + i})});
  }
  s.scene = c.scene({triangle(5)}, (1u << 20) + 1);
  DispatchRaysDesc desc = s.tables();
  std::vector<uint8_t> wide(2 * 4096);
  const auto narrow = s.shader_tables[2].buffer().data<const uint8_t>();
  for (size_t i = 0; i < 2; ++i) {
    std::memcpy(&wide[i * 4096], &narrow[i * desc.HitGroupTable.StrideInBytes], 48);
  }
  desc.HitGroupTable = {c.upload(wide).GetGPUVirtualAddress(), wide.size(), 4096};
  const Seen seen = seen_of(s.run(desc), 1)[0];
  c.equal("what ran of a record 4 GiB away", seen.end, uint32_t{kNothingRan});
  c.told("record 1048577 of 2, 4294971392 bytes into the table", "KA0430");
}

void tables_of_records(Context& t) {
  Checked c(t);
  {
    CheckedScene s(c);
    s.add("Plain");
    s.run();
    c.silent("sound tables");
    s.scene = c.scene({triangle(6), triangle(5)});
    s.run();
    c.told("record 1 of 1", "KA0430");
    s.scene = c.scene({triangle(5)});
    const Buffer table = c.upload(std::vector<uint32_t>(64, 0xABABABABu));
    DispatchRaysDesc desc = s.tables();
    desc.HitGroupTable = {table.GetGPUVirtualAddress(), 256, 64};
    s.run(desc);
    c.told("no identifier", "KA0431");
    CheckedScene other(c);
    other.add("Plain");
    desc.HitGroupTable = other.tables().HitGroupTable;
    s.run(desc);
    c.told("another pipeline's identifier", "KA0432");
    desc.HitGroupTable = desc.MissShaderTable;
    s.run(desc);
    c.told("a miss shader in the hit group table", "KA0433");
  }
  CheckedScene s(c);
  s.add("Boxes");
  s.run();
  c.told("boxes' group for triangles", "KA0434");
}

void strides_of_records(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Plain");
  DispatchRaysDesc desc = s.tables();
  desc.HitGroupTable.StrideInBytes = 32;
  s.run(desc);
  c.told("32 bytes for 48", "KA0435");
  desc.HitGroupTable.StrideInBytes = 0;
  desc.HitGroupTable.SizeInBytes = 40;
  s.run(desc);
  c.told("a table of 40 bytes", "KA0440");
}

// One dispatch of an ExecuteIndirect writes the table that the next one uses.
void tables_that_change(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Plain");
  const DispatchRaysDesc first = s.tables();
  IndirectArgumentDesc rays;
  rays.Type = IndirectArgumentType::kDispatchRays;
  const CommandSignature signature =
      c.device().CreateCommandSignature({sizeof(first), {rays}}, RootSignature()).value();
  const Buffer words = c.zeros(kWordBytes);
  const auto run = [&](const DispatchRaysDesc& second) {
    CommandList fill = c.list();
    fill.CopyBufferRegion(words, 0, s.shader_tables[1].buffer(), 0, 32);
    c.accepted("filling the table", c.execute(fill));
    CommandList list = c.list();
    list.SetComputeRootSignature(s.global);
    list.SetPipelineState1(s.pipeline);
    list.SetComputeRootShaderResourceView(0, s.scene.GetGPUVirtualAddress());
    list.SetComputeRootShaderResourceView(1, s.rays.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, words.GetGPUVirtualAddress());
    list.ExecuteIndirect(signature, 2, c.upload(std::vector{first, second}), 0);
    c.accepted("two dispatches", c.execute(list));
  };
  run(first);
  c.silent("tables that nothing writes");
  DispatchRaysDesc second = first;
  second.MissShaderTable = {words.GetGPUVirtualAddress(), 32, 32};
  run(second);
  c.told("a table that the dispatch before writes", "KA0441");
}

void other_root_signature(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  const RootSignature other =
      c.device().CreateRootSignature("SRV(t0), SRV(t1), UAV(u0), SRV(t7)").value();
  s.desc.Associate(s.desc.Add(GlobalRootSignature{other}), {"Sky"});
  s.add("Plain");
  s.run();
  c.told("a miss shader with another global root signature", "KA0439");
}

void stack_size(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.create();
  const uint64_t before = s.pipeline.GetPipelineStackSize();
  c.refused("a stack of 2^32 - 1 bytes", s.pipeline.SetPipelineStackSize(0xFFFFFFFFu));
  c.equal("the stack size", s.pipeline.GetPipelineStackSize(), before);
}

void dispatch_calls(Context& t) {
  Checked c(t);
  CheckedScene s(c);
  s.add("Plain");
  CommandList list = c.list();
  list.SetComputeRootSignature(s.global);
  list.DispatchRays(s.tables());
  c.refused("no pipeline", list.Close());
  CommandList large = c.list();
  large.SetComputeRootSignature(s.global);
  large.SetPipelineState1(s.pipeline);
  DispatchRaysDesc desc = s.tables();
  desc.Width = 1u << 16;
  desc.Height = (1u << 14) + 1;
  large.DispatchRays(desc);
  c.refused("2^30 + 2^16 threads", large.Close());
}

void local_root_signatures(Context& t) {
  Checked c(t);
  c.refused("local with another flag",
            c.device().CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE | ALLOW_STREAM_OUTPUT), SRV(t0)"));
  c.refused("more than 4064 bytes",
            c.device().CreateRootSignature(
                "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(b0, num32BitConstants = 1017)"));
}

}  // namespace

std::vector<RuleTest> err_dispatch_tests() {
  return {
      {"ERR-01", recursion_and_stack},
      {"ERR-19", illegal_rays},
      {"ERR-20, SBT-28", tables_of_records},
      {"ERR-20, SBT-07", far_records},
      {"ERR-21, SBT-16", strides_of_records},
      {"SBT-31", tables_that_change},
      {"ERR-22", other_root_signature},
      {"ERR-23", parameters_of_other_types},
      {"ERR-24", reported_hits},
      {"ERR-27", stack_size},
      {"ERR-28", dispatch_calls},
      {"ERR-29", local_root_signatures},
  };
}

}  // namespace kaamos::conformance
