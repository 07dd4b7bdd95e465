// SPDX-License-Identifier: MIT
//
// Flags that must not be combined or that need another tier. Where only the shader knows them,
// normal mode defines the result: a primitive that any of the flags would drop is dropped, an
// instance's FORCE_OPAQUE overrides its FORCE_NON_OPAQUE, and of a ray's conflicting flags one
// wins, the same one for all rays.
#include <bit>

#include "tests/conformance/judge.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

struct Legality {
  Scene scene;
  std::vector<Ray> rays;
  std::vector<Walked> walked;
};

Legality walk(Context& t, const std::vector<uint32_t>& flags, uint32_t instance_flags = 0) {
  Random random(31);
  SceneOptions options;
  options.opaque = true;
  Legality out;
  out.scene = random_scene(random, options);
  for (RaytracingInstanceDesc& each : out.scene.instances) each.Flags |= instance_flags;
  out.rays = random_rays(random, out.scene, 300, kAcceptSome, flags);
  Walker walker(t);
  walker.build(out.scene);
  out.walked = walker.walk(out.rays);
  return out;
}

// Traces rays with these flags and compares with the reference, which follows this definition.
void expect_our_meaning(Context& t, const std::vector<uint32_t>& flags,
                        uint32_t instance_flags = 0) {
  const Legality found = walk(t, flags, instance_flags);
  const Coverage coverage = judge(t, found.scene, found.rays, found.walked);
  t.holds("most rays are certain", 2 * coverage.certain > coverage.rays);
}

// Returns how many rays do not behave as if they had `flags`.
size_t differing(const Legality& found, uint32_t flags) {
  size_t out = 0;
  for (size_t i = 0; i < found.rays.size(); ++i) {
    Coverage coverage;
    Ray ray = found.rays[i];
    ray.flags = flags;
    out += judge_ray(found.scene, ray, found.walked[i], coverage).empty() ? 0 : 1;
  }
  return out;
}

// The legal flags that these amount to if culling is decided after a ray's FORCE flag, not before.
uint32_t with_culling_last(uint32_t flags) {
  if (flags == 0x41 || flags == 0x82) return 0xC0;
  return flags & 0x3;
}

void one_opacity_flag(Context& t) {
  expect_our_meaning(t, {0xC0});
  const Legality both = walk(t, {0x03});
  t.holds("FORCE_OPAQUE and FORCE_NON_OPAQUE: one counts",
          differing(both, 0x01) == 0 || differing(both, 0x02) == 0);
  const Legality found = walk(t, {0x41, 0x81, 0x42, 0x82});
  for (size_t i = 0; i < found.rays.size(); ++i) {
    Coverage coverage;
    Ray last = found.rays[i];
    last.flags = with_culling_last(last.flags);
    const std::string first = judge_ray(found.scene, found.rays[i], found.walked[i], coverage);
    if (first.empty() || judge_ray(found.scene, last, found.walked[i], coverage).empty()) continue;
    t.fail("flags " + std::to_string(found.rays[i].flags) + ": " + first);
  }
}

void one_culled_face(Context& t) {
  expect_our_meaning(t, {0x30, 0x31, 0x34});
}

void skipped_triangles_stand_alone(Context& t) {
  expect_our_meaning(t, {0x110, 0x120, 0x300});
}

void one_instance_opacity_flag(Context& t) {
  expect_our_meaning(t, {0, 0x40, 0x80}, 0xC);
}

void skip_flags_need_tier_1_1(Context& t) {
  DeviceDesc desc;
  desc.Backend = t.target().backend;
  desc.Precision = t.target().precision;
  desc.Tier = RaytracingTier::kTier1_0;
  const Device device = CreateDevice(desc).value();
  Standard program(t);
  for (const auto flags :
       {RaytracingPipelineFlags::kSkipTriangles, RaytracingPipelineFlags::kSkipProceduralPrimitives,
        RaytracingPipelineFlags::kNone}) {
    program.set_pipeline_flags(flags);
    t.refused("a pipeline config 1 on a device of tier 1.0",
              device.CreateStateObject(program.desc));
  }
}

void queries_have_no_closest_hit_shader(Context& t) {
  Walker walker(t);
  walker.record("Plain");
  walker.raygen("QueryWithSkip");
  walker.scene = t.scene({triangle(5)});
  walker.prepare({Ray{}});
  const auto words = walker.run();
  // The flag has no effect: the hit is committed and kept.
  t.equal("CommittedStatus() with the flag as template argument", words[0], 1u);
  t.equal("CommittedStatus() with the flag as argument", words[1], 1u);
}

void later_tiers_are_refused(Context& t) {
  const Geometry geometry = triangle(5);
  RaytracingGeometryDesc desc;
  desc.Triangles.VertexFormat = Format::kR32G32B32Float;
  desc.Triangles.VertexCount = 3;
  desc.Triangles.VertexBuffer = {t.upload(geometry.vertices).GetGPUVirtualAddress(), 12};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &desc;
  DeviceDesc tier_1_1 = t.target().device_desc();
  tier_1_1.Tier = RaytracingTier::kTier1_1;
  tier_1_1.ShaderModel = kHighestShaderModel;
  const Device old = CreateDevice(tier_1_1).value();
  const auto sizes_of = [&](const BuildRaytracingAccelerationStructureInputs& each) {
    return old.GetRaytracingAccelerationStructurePrebuildInfo(each);
  };
  t.accepted("sizes of what tier 1.1 knows", sizes_of(inputs));
  for (const uint32_t flag : {0x40u, 0x80u, 0x100u}) {
    auto later = inputs;
    later.Flags = static_cast<RaytracingAccelerationStructureBuildFlags>(flag);
    t.refused("build flag " + std::to_string(flag), sizes_of(later));
  }
  auto later = inputs;
  later.Type = static_cast<RaytracingAccelerationStructureType>(2);
  t.refused("type 2 of a structure", sizes_of(later));
  desc.Type = static_cast<RaytracingGeometryType>(2);
  t.refused("type 2 of a geometry", sizes_of(inputs));
  Standard program(t);
  program.set_pipeline_flags(static_cast<RaytracingPipelineFlags>(0x800));
  t.refused("pipeline flag 0x800", program.try_create());
  // Flags of micromaps have no effect where there are none.
  program.set_pipeline_flags(RaytracingPipelineFlags::kNone);
  program.record("Plain");
  program.scene = t.scene({geometry}, 0, 0x30);
  Ray ray;
  ray.flags = 0x400;
  const Seen seen = program.trace(ray);
  t.equal("end with ray flag 0x400, instance flags 0x30", seen.end, kClosestHitRan);
  t.equal("RayFlags()", seen.flags, 0x400u);
}

void pipeline_flags_and_queries(Context& t) {
  Walker walker(t);
  walker.set_pipeline_flags(RaytracingPipelineFlags::kSkipTriangles);
  walker.record("Plain");
  walker.raygen("QueryAndTrace");
  walker.scene = t.scene({triangle(5)});
  walker.prepare({Ray{}});
  const auto words = walker.run();
  t.equal("CommittedStatus()", words[0], 1u);
  t.close("CommittedRayT()", std::bit_cast<float>(words[1]), 5, 1e-5f);
  t.equal("end of TraceRay", words[2], kMissRan);
}

}  // namespace

std::vector<RuleTest> flg_legality_tests() {
  return {{"FLG-02", one_opacity_flag, "KA0403"},
          {"FLG-03", one_culled_face, "KA0403"},
          {"FLG-04", skipped_triangles_stand_alone, "KA0403"},
          {"FLG-05", skip_flags_need_tier_1_1},
          {"FLG-06", one_instance_opacity_flag, "KA0474"},
          {"FLG-07", queries_have_no_closest_hit_shader, "KA0404"},
          {"FLG-08", later_tiers_are_refused, "KA0403"},
          {"FLG-28", pipeline_flags_and_queries}};
}

}  // namespace kaamos::conformance
