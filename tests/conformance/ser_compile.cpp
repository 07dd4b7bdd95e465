// SPDX-License-Identifier: MIT
//
// Hit objects in the HLSL compiler, and tiers of devices.
#include "tests/conformance/compile.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// A shader of lib_6_9 whose payloads need no qualifiers.
Status compile_69(const std::string& source) {
  return compile(source, "lib_6_9", false);
}

Status of_stage(const std::string& stage, const std::string& statements) {
  return compile_69(shader_of(stage, statements));
}

const std::string kTrace =
    "P q = (P)0;\n  dx::HitObject hit = dx::HitObject::TraceRay(scene, 0, 255, 0, 0, 0, ray, q);\n";

// The compiler must refuse it with this id.
void refused_by_compiler(Context& t, const std::string& what, const Status& status,
                         const char* id) {
  t.refused(what, status);
  if (!status && status.error().message.find(id) == std::string::npos) {
    t.fail(what + ": expected " + id + ", found " + status.error().message);
  }
}

void names_are_in_a_namespace(Context& t) {
  t.accepted("dx::HitObject", of_stage("raygeneration", "dx::HitObject hit;"));
  t.accepted("using namespace dx",
             compile_69("using namespace dx;\n" +
                        shader_of("raygeneration", "HitObject hit; MaybeReorderThread(hit);")));
  t.refused("HitObject without it", of_stage("raygeneration", "HitObject hit;"));
  t.refused("MaybeReorderThread without it",
            of_stage("raygeneration", "MaybeReorderThread(1, 1);"));
}

void places_where_it_is_an_error(Context& t) {
  const std::string body = shader_of("raygeneration", "");
  for (const char* declaration :
       {"cbuffer C { dx::HitObject hit; };", "static dx::HitObject hit;",
        "groupshared dx::HitObject hit;", "StructuredBuffer<dx::HitObject> hits;",
        "RWStructuredBuffer<dx::HitObject> hits;",
        "struct S { dx::HitObject hit; };\n"
        "ConstantBuffer<S> hits;"}) {
    refused_by_compiler(t, declaration, compile_69(std::string(declaration) + "\n" + body),
                        "KA2579");
  }
  refused_by_compiler(t, "Load", of_stage("raygeneration", "words.Load<dx::HitObject>(0);"),
                      "KA2579");
  t.refused("sizeof", of_stage("raygeneration", "uint n = sizeof(dx::HitObject);"));
  const std::string held = "struct H { dx::HitObject hit; };\n";
  t.refused("payload", compile_69(held + "[shader(\"miss\")] void M(inout H h) {}"));
  t.refused("callable data", compile_69(held + "[shader(\"callable\")] void C(inout H h) {}"));
  t.refused("payload of TraceRay",
            compile_69(held + shader_of("raygeneration",
                                        "H h;\n TraceRay(scene, 0, 255, 0, 0, 0, ray, h);")));
  t.refused("a member of the object", of_stage("raygeneration", "dx::HitObject h; h.record = 1;"));
}

void stages_and_model(Context& t) {
  const std::string use = "dx::HitObject hit = dx::HitObject::MakeNop();";
  const std::string reorder = "dx::MaybeReorderThread(1, 1);";
  for (const char* stage : {"raygeneration", "closesthit", "miss"}) {
    t.accepted(std::string("HitObject in ") + stage, of_stage(stage, use));
  }
  for (const char* stage : {"anyhit", "intersection", "callable"}) {
    t.refused(std::string("HitObject in ") + stage, of_stage(stage, use));
  }
  t.accepted("MaybeReorderThread in raygeneration", of_stage("raygeneration", reorder));
  for (const char* stage : {"closesthit", "miss", "anyhit", "intersection", "callable"}) {
    t.refused(std::string("MaybeReorderThread in ") + stage, of_stage(stage, reorder));
  }
  const std::string helper = "void helper() { dx::HitObject h = dx::HitObject::MakeNop(); }\n";
  t.accepted("a helper that nothing calls", compile_69(helper + shader_of("anyhit", "")));
  t.refused("a helper of an any-hit shader", compile_69(helper + shader_of("anyhit", "helper();")));
  t.refused("shader model 6.8", compile(shader_of("raygeneration", use), "lib_6_8", false));
}

void payload_is_that_of_trace_ray(Context& t) {
  t.accepted("a struct", of_stage("raygeneration", kTrace));
  t.accepted("Invoke", of_stage("raygeneration", kTrace + "dx::HitObject::Invoke(hit, q);"));
  t.refused("const",
            of_stage("raygeneration", kTrace + "const P c = q;\n dx::HitObject::Invoke(hit, c);"));
  t.refused("a number",
            of_stage("raygeneration", kTrace + "uint n = 0;\n dx::HitObject::Invoke(hit, n);"));
  t.refused("a value", of_stage("raygeneration", kTrace + "dx::HitObject::Invoke(hit, (P)0);"));
  t.refused("too few arguments", of_stage("raygeneration", "dx::HitObject::Invoke();"));
  t.refused("no hit object", of_stage("raygeneration", "P q;\n dx::HitObject::Invoke(q, q);"));
}

void attributes_are_small_structs(Context& t) {
  const std::string nine = "struct Nine { float v[9]; };\n";
  const std::string eight = "struct Eight { float v[8]; };\n";
  t.accepted("32 bytes", compile_69(eight + shader_of("raygeneration",
                                                      kTrace + "Eight e; hit.GetAttributes(e);")));
  t.refused("36 bytes", compile_69(nine + shader_of("raygeneration",
                                                    kTrace + "Nine e; hit.GetAttributes(e);")));
  t.refused("a number", of_stage("raygeneration", kTrace + "float f; hit.GetAttributes(f);"));
}

void both_spellings_of_attributes(Context& t) {
  t.accepted("an argument", of_stage("raygeneration", kTrace + "A a; hit.GetAttributes(a);"));
  t.accepted("a template", of_stage("raygeneration", kTrace + "A a = hit.GetAttributes<A>();"));
  t.refused("neither", of_stage("raygeneration", kTrace + "hit.GetAttributes();"));
}

void barrier_rules(Context& t) {
  const auto in_ray = [](const std::string& call) { return of_stage("raygeneration", call); };
  t.accepted("UAV_MEMORY", in_ray("Barrier(UAV_MEMORY, REORDER_SCOPE);"));
  t.accepted("a resource", in_ray("Barrier(words, REORDER_SCOPE);"));
  t.accepted("DEVICE_SCOPE", in_ray("Barrier(UAV_MEMORY, DEVICE_SCOPE);"));
  t.refused("group memory", in_ray("Barrier(GROUP_SHARED_MEMORY, REORDER_SCOPE);"));
  t.refused("all memory", in_ray("Barrier(ALL_MEMORY, REORDER_SCOPE);"));
  t.refused("GROUP_SYNC", in_ray("Barrier(UAV_MEMORY, REORDER_SCOPE | GROUP_SYNC);"));
  t.refused("a read-only resource", in_ray("Barrier(scene, REORDER_SCOPE);"));
  t.refused("flags that are not constant",
            in_ray("uint f = words.Load(0);\n Barrier(f, REORDER_SCOPE);"));
  const auto compute = [](const std::string& call) {
    return compile_69(
        "RWByteAddressBuffer words : register(u0);\n"
        "[shader(\"compute\")] [numthreads(8, 1, 1)] void C() { " +
        call + " }");
  };
  t.refused("REORDER_SCOPE in compute", compute("Barrier(UAV_MEMORY, REORDER_SCOPE);"));
  t.accepted("GROUP_SYNC in compute", compute("Barrier(ALL_MEMORY, GROUP_SYNC | GROUP_SCOPE);"));
  t.refused("GROUP_SYNC in ray generation", in_ray("Barrier(UAV_MEMORY, GROUP_SYNC);"));
}

void tiers(Context& t) {
  for (const auto& [tier, model] : {std::pair(RaytracingTier::kNotSupported, ShaderModel::k6_0),
                                    std::pair(RaytracingTier::kTier1_0, ShaderModel::k6_3),
                                    std::pair(RaytracingTier::kTier1_1, ShaderModel::k6_5),
                                    std::pair(RaytracingTier::kTier1_1, kHighestShaderModel),
                                    std::pair(RaytracingTier::kTier1_2, kHighestShaderModel)}) {
    DeviceDesc desc = t.target().device_desc();
    desc.Tier = tier;
    desc.ShaderModel = model;
    const Device device = CreateDevice(desc).value();
    t.equal("tier", static_cast<uint32_t>(device.GetDesc().Tier), static_cast<uint32_t>(tier));
    t.equal("shader model", static_cast<uint32_t>(device.GetDesc().ShaderModel),
            static_cast<uint32_t>(model));
  }
  DeviceDesc low = t.target().device_desc();
  low.Tier = RaytracingTier::kTier1_2;
  low.ShaderModel = ShaderModel::k6_8;
  t.refused("tier 1.2 without shader model 6.9", CreateDevice(low), "KA0914");
  low.Tier = RaytracingTier::kTier1_1;
  low.ShaderModel = ShaderModel::k6_4;
  t.refused("tier 1.1 without shader model 6.5", CreateDevice(low), "KA0914");
}

void lower_tiers_refuse(Context& t) {
  DeviceDesc desc = t.target().device_desc();
  desc.Tier = RaytracingTier::kNotSupported;
  const Device none = CreateDevice(desc).value();
  t.refused("a structure without ray tracing",
            none.GetRaytracingAccelerationStructurePrebuildInfo({}), "KA0545");
  t.refused("a pipeline without ray tracing", none.CreateStateObject({}), "KA0545");
  desc.Tier = RaytracingTier::kTier1_0;
  const Device first = CreateDevice(desc).value();
  CommandSignatureDesc rays;
  rays.ByteStride = sizeof(DispatchRaysDesc);
  rays.ArgumentDescs = {{.Type = IndirectArgumentType::kDispatchRays}};
  t.refused("indirect rays on 1.0", first.CreateCommandSignature(rays), "KA0541");
}

void prebuild_looks_for_null_alone(Context& t) {
  RaytracingGeometryDesc geometry;
  geometry.Triangles.VertexFormat = Format::kR32G32B32Float;
  geometry.Triangles.VertexCount = 300;
  geometry.Triangles.VertexBuffer = {t.zeros(3600).GetGPUVirtualAddress(), 12};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kBottomLevel;
  inputs.NumDescs = 1;
  inputs.pGeometryDescs = &geometry;
  const auto size = [&] {
    return t.device()
        .GetRaytracingAccelerationStructurePrebuildInfo(inputs)
        .value()
        .ResultDataMaxSizeInBytes;
  };
  const uint64_t real = size();
  geometry.Triangles.VertexBuffer.StartAddress = 1;
  t.equal("bytes with the address 1", size(), real);
}

}  // namespace

std::vector<RuleTest> ser_compile_tests() {
  return {{"SER-01", names_are_in_a_namespace},
          {"SER-03, SER-31", places_where_it_is_an_error},
          {"SER-06", stages_and_model},
          {"SER-07", payload_is_that_of_trace_ray},
          {"SER-08", attributes_are_small_structs},
          {"SER-09", both_spellings_of_attributes},
          {"SER-39", barrier_rules},
          {"TIER-01, TIER-02", tiers},
          {"TIER-08", lower_tiers_refuse},
          {"TIER-09", prebuild_looks_for_null_alone}};
}

}  // namespace kaamos::conformance
