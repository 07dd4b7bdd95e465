// SPDX-License-Identifier: MIT
//
// Libraries that call each other's functions. The state object joins them, whichever way they come
// into it. [D3D12: library linkage; DXR: D3D12_STATE_OBJECT_FLAGS]
#include <rtapi/shader_compiler.h>

#include "tests/observed/world.h"

namespace {

using namespace rtapi;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<uint32_t>;

constexpr uint32_t kThreads = 8;
constexpr uint32_t kWordsPerThread = 12;
constexpr auto kCollection = StateObjectType::kCollection;
constexpr auto kNone = StateObjectFlags::kNone;
constexpr auto kOpen = StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions;
constexpr auto kShared = StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions;

// Both libraries have these.
constexpr char kTypes[] = R"(
struct Payload { uint value; uint depth; };
struct Pair { uint2 values; uint sums[3]; };
)";

constexpr char kCaller[] = R"(
RWByteAddressBuffer words : register(u0);
namespace math { uint add(uint a, uint b); }
void split(in uint value, out uint low, inout uint high);
Pair scale(Pair before, uint factors[2]);
void shoot(uint index, inout Payload payload);
static uint calls = 7;
export uint twice(uint x) { ++calls; return 2 * x; }

[shader("raygeneration")]
void RayGen() {
  const uint i = DispatchRaysIndex().x;
  const uint first = math::add(i, 10);
  const uint second = math::add(i, 20);
  uint low = 99, high = 1;
  split(0x304 + i, low, high);
  Pair pair = {uint2(i, 1), {1, 2, 3}};
  const uint factors[2] = {2, 3};
  pair = scale(pair, factors);
  Payload payload = {i, 0};
  shoot(i, payload);
  const uint at = i * 48;
  words.Store4(at, uint4(first, second, low, high));
  words.Store4(at + 16, uint4(pair.values, pair.sums[0], pair.sums[1]));
  words.Store4(at + 32, uint4(pair.sums[2], payload.value, payload.depth, calls));
}

[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {
  payload.value = math::add(payload.value, 1000);
  payload.depth = 1;
}

[shader("raygeneration")]
void Alone() { words.Store(4 * DispatchRaysIndex().x, 5); }
)";

// calls is the library's own, and starts anew in every shader.
constexpr char kCallee[] = R"(
RWByteAddressBuffer results : register(u0);
RaytracingAccelerationStructure scene : register(t0);
cbuffer Constants : register(b0) { uint4 constants; };
static uint calls = 100;
uint twice(uint x);

namespace math {
export uint add(uint a, uint b) { ++calls; return a + b + constants.x + calls; }
}
export void split(in uint value, out uint low, inout uint high) {
  low = value & 0xFF;
  high += value >> 8;
}
export Pair scale(Pair before, uint factors[2]) {
  before.values = before.values * factors[0] + twice(factors[1]);
  for (uint k = 0; k < 3; ++k) before.sums[k] += k + factors[1];
  return before;
}
export void shoot(uint index, inout Payload payload) {
  RayDesc ray = {float3(index < 4 ? 0 : 50, 0, 0), 0, float3(0, 0, 1), 100};
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 1, 0, ray, payload);
  results.Store(512 + 4 * index, payload.value);
  payload.depth += 10;
}
[shader("miss")] void Miss(inout Payload payload) { payload.value += 7; }
)";

class Linking : public kaamos::observed::World {
 protected:
  ShaderLibrary compile(const std::string& file, const std::string& text, bool source = true) {
    ShaderCompileOptions options;
    options.File = file;
    options.Source = text;
    options.Spirv = GetParam() == "vulkan";
    options.Interpret = interprets_;
    options.EmbedSource = source;
    ShaderCompilation made = CompileShaderLibrary(options);
    EXPECT_TRUE(made.Status.ok()) << made.Status.error().message;
    return made.Library;
  }
  ShaderLibrary caller() { return compile("caller.hlsl", std::string(kTypes) + kCaller); }
  ShaderLibrary callee() { return compile("callee.hlsl", std::string(kTypes) + kCallee); }

  StateObjectDesc configs(StateObjectType type = StateObjectType::kRaytracingPipeline,
                          StateObjectFlags flags = kNone) {
    StateObjectDesc desc{.Type = type};
    desc.Add(StateObjectConfig{flags});
    desc.Add(RaytracingShaderConfig{8, 8});
    desc.Add(RaytracingPipelineConfig{1});
    desc.Add(GlobalRootSignature{root_});
    return desc;
  }
  static HitGroupDesc group() {
    HitGroupDesc out;
    out.HitGroupExport = "Group";
    out.ClosestHitShaderImport = "Hit";
    return out;
  }
  StateObjectDesc of(const std::vector<ShaderLibrary>& libraries) {
    StateObjectDesc desc = configs();
    for (const ShaderLibrary& library : libraries) desc.Add(DxilLibraryDesc{library});
    return desc;
  }
  std::string refusal(const StateObjectDesc& desc) {
    const auto made = device_.CreateStateObject(desc);
    EXPECT_FALSE(made.ok());
    return made.ok() ? "" : made.error().message;
  }
  std::string refusal(const std::string& first, const std::string& second) {
    interprets_ = true;  // what is never run needs no C++ compiler
    return refusal(of({compile("first.hlsl", first), compile("second.hlsl", second)}));
  }

  Words run(const StateObject& pipeline, const char* entry = "RayGen") {
    scene_ = triangle();
    constants_[0] = 5;
    const Tables tables = tables_of(pipeline, entry, "Group");
    CommandList list = device_.CreateCommandList().value();
    bind(list);
    list.SetPipelineState1(pipeline);
    list.DispatchRays(tables.desc(kThreads));
    queue_.ExecuteAndWait(list).value();
    return read(out_);
  }
  void expect_values(const StateObjectDesc& desc) {
    const auto pipeline = device_.CreateStateObject(desc);
    ASSERT_TRUE(pipeline.ok()) << pipeline.error().message;
    expect_values(*pipeline);
  }
  void expect_values(const StateObject& pipeline) {
    const Words words = run(pipeline);
    for (uint32_t i = 0; i < kThreads; ++i) {
      const uint32_t value = i < 4 ? i + 1000 + 5 + 101 : i + 7;
      const Words expected = {
          i + 10 + 5 + 101, i + 20 + 5 + 102, 4 + i,     1 + 3, 2 * i + 6,         2 + 6,
          1 + 0 + 3,        2 + 1 + 3,        3 + 2 + 3, value, i < 4 ? 11u : 10u, 8};
      const auto at = words.begin() + i * kWordsPerThread;
      EXPECT_EQ(Words(at, at + kWordsPerThread), expected) << "thread " << i;
      EXPECT_EQ(words[128 + i], value) << "thread " << i;
    }
  }

  bool interprets_ = false;
};
INSTANTIATE_TEST_SUITE_P(Backends, Linking, testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(Linking, LibrariesOfOneStateObjectCallEachOther) {
  StateObjectDesc desc = of({caller(), callee()});
  desc.Add(group());
  expect_values(desc);
}

TEST_P(Linking, InterpretedLibrariesToo) {
  interprets_ = true;
  StateObjectDesc desc = of({callee(), caller()});
  desc.Add(group());
  expect_values(desc);
}

TEST_P(Linking, ShadersThatCallNothingRunAsTheyAre) {
  StateObjectDesc desc = of({caller(), callee()});
  desc.Add(group());
  EXPECT_EQ(run(device_.CreateStateObject(desc).value(), "Alone")[3], 5u);
}

TEST_P(Linking, ACollectionWaitsForItsDefinitions) {
  StateObjectDesc part = configs(kCollection, kOpen | kShared);
  part.Add(DxilLibraryDesc{caller()});
  const auto collection = device_.CreateStateObject(part);
  ASSERT_TRUE(collection.ok()) << collection.error().message;
  EXPECT_EQ(collection->GetShaderIdentifier("RayGen"), nullptr);
  EXPECT_NE(collection->GetShaderIdentifier("Alone"), nullptr);
  StateObjectDesc desc = of({callee()});
  desc.Add(ExistingCollectionDesc::Of(*collection));
  desc.Add(group());
  expect_values(desc);
}

TEST_P(Linking, ACollectionDefinesWhatALibraryCalls) {
  for (const StateObjectFlags flags : {kOpen, kOpen | kShared}) {
    StateObjectDesc part = configs(kCollection, flags);
    part.Add(DxilLibraryDesc{callee()});
    StateObjectDesc desc = of({caller()});
    desc.Add(ExistingCollectionDesc::Of(device_.CreateStateObject(part).value()));
    desc.Add(group());
    if (flags == kOpen) {
      EXPECT_THAT(refusal(desc), AllOf(HasSubstr("KA0562"), HasSubstr("uint math::add(uint, uint)"),
                                       HasSubstr("\"RayGen\" of \"caller.hlsl\"")));
    } else {
      expect_values(desc);
    }
  }
}

TEST_P(Linking, ACollectionThatHasAllIsLinkedByItself) {
  StateObjectDesc part = configs(kCollection);
  part.Add(DxilLibraryDesc{caller()});
  EXPECT_THAT(refusal(part), AllOf(HasSubstr("KA0560"), HasSubstr("collection")));
  part.Add(DxilLibraryDesc{callee()});
  part.Add(group());
  StateObjectDesc desc = configs();
  desc.Add(ExistingCollectionDesc::Of(device_.CreateStateObject(part).value()));
  expect_values(desc);
}

TEST_P(Linking, AnAdditionIsLinkedByItself) {
  interprets_ = true;
  constexpr auto kGrows = StateObjectFlags::kAllowStateObjectAdditions;
  const ShaderLibrary first = caller(), second = callee();
  StateObjectDesc whole = configs(StateObjectType::kRaytracingPipeline, kGrows);
  whole.Add(DxilLibraryDesc{second, {{"Miss"}}});
  const StateObject parent = device_.CreateStateObject(whole).value();
  StateObjectDesc addition = configs(StateObjectType::kRaytracingPipeline, kGrows);
  addition.Add(DxilLibraryDesc{first});
  addition.Add(group());
  const auto alone = device_.AddToStateObject(addition, parent);
  ASSERT_FALSE(alone.ok());
  EXPECT_THAT(alone.error().message, HasSubstr("KA0560"));
  addition.Add(DxilLibraryDesc{second, {{"add"}, {"split"}, {"scale"}, {"shoot"}}});
  auto grown = device_.AddToStateObject(addition, parent);
  ASSERT_TRUE(grown.ok()) << grown.error().message;
  grown->SetPipelineStackSize(4096).value();  // else it is the parent's
  expect_values(*grown);
}

TEST_P(Linking, AnExportIsFoundByItsNewName) {
  const ShaderLibrary first = compile("first.hlsl", R"(
RWByteAddressBuffer words : register(u0);
uint pick(uint x);
[shader("raygeneration")] void RayGen() {
  const uint i = DispatchRaysIndex().x;
  words.Store(4 * i, pick(i));
})");
  const ShaderLibrary second = compile("second.hlsl", R"(
export uint pick(uint x) { return x + 100; }
export uint other(uint x) { return x + 200; }
struct Payload { uint2 values; };
[shader("miss")] void Miss(inout Payload payload) {}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {})");
  for (const bool renames : {false, true}) {
    StateObjectDesc desc = of({first});
    desc.Add(DxilLibraryDesc{second, {{"pick", renames ? "other" : "pick"}, {"Miss"}, {"Hit"}}});
    desc.Add(group());
    const Words words = run(device_.CreateStateObject(desc).value());
    EXPECT_EQ(words[6], renames ? 206u : 106u);
  }
  StateObjectDesc hidden = of({first});
  hidden.Add(DxilLibraryDesc{second, {{"other"}, {"Miss"}}});
  EXPECT_THAT(refusal(hidden), AllOf(HasSubstr("KA0560"), HasSubstr("uint pick(uint)")));
}

constexpr char kCalls[] = R"(
float pick(float x);
RWByteAddressBuffer words : register(u0);
[shader("raygeneration")] void RayGen() { words.Store(0, pick(3)); }
)";

TEST_P(Linking, WhatNobodyDefinesIsNamed) {
  interprets_ = true;
  EXPECT_THAT(refusal(of({compile("first.hlsl", kCalls)})),
              AllOf(HasSubstr("KA0560"), HasSubstr("shader \"RayGen\" of \"first.hlsl\""),
                    HasSubstr("\"float pick(float)\"")));
  // Without `export` it is not seen from outside; another shader's needs count as well.
  EXPECT_THAT(refusal(kCalls, "float pick(float x) { return x; }"), HasSubstr("KA0560"));
  EXPECT_THAT(
      refusal(kCalls, "float more(float x); export float pick(float x) { return more(x); }"),
      AllOf(HasSubstr("KA0560"), HasSubstr("function \"pick\" of \"second.hlsl\""),
            HasSubstr("\"float more(float)\"")));
}

TEST_P(Linking, OtherSignaturesAreNamedBoth) {
  EXPECT_THAT(refusal(kCalls, "export float pick(int x) { return x; }"),
              AllOf(HasSubstr("KA0561"), HasSubstr("\"float pick(float)\""),
                    HasSubstr("\"float pick(int)\""), HasSubstr("second.hlsl")));
  EXPECT_THAT(refusal(kCalls, "export uint pick(float x) { return x; }"),
              AllOf(HasSubstr("KA0561"), HasSubstr("\"uint pick(float)\"")));
  constexpr char kPassed[] = R"(
struct S { float a; };
void change(inout S s);
[shader("raygeneration")] void RayGen() { S s = {1}; change(s); }
)";
  EXPECT_THAT(refusal(kPassed, "struct S { uint a; }; export void change(inout S s) { s.a = 2; }"),
              AllOf(HasSubstr("KA0564"), HasSubstr("KA2703"), HasSubstr("first.hlsl"),
                    HasSubstr("second.hlsl"), HasSubstr("parameter 1 'S' has other members")));
  EXPECT_THAT(refusal(kPassed, "struct S { float a; }; export void change(S s) { s.a = 2; }"),
              AllOf(HasSubstr("KA2703"), HasSubstr("only one passes parameter 1 back")));
}

TEST_P(Linking, RulesHoldAcrossLibraries) {
  EXPECT_THAT(refusal("float back(float x); export float pick(float x) { return back(x); }" +
                          std::string(kCalls).substr(std::string("\nfloat pick(float x);").size()),
                      "float pick(float x); export float back(float x) { return pick(x); }"),
              AllOf(HasSubstr("KA0564"), HasSubstr("KA2505")));
  EXPECT_THAT(refusal(R"(
struct Payload { float x; };
void shoot(inout Payload payload);
[shader("anyhit")]
void Any(inout Payload payload, BuiltInTriangleIntersectionAttributes a) { shoot(payload); }
)",
                      R"(
struct Payload { float x; };
RaytracingAccelerationStructure scene : register(t0);
export void shoot(inout Payload payload) {
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 1};
  TraceRay(scene, 0, 1, 0, 1, 0, ray, payload);
})"),
              AllOf(HasSubstr("KA0564"), HasSubstr("TraceRay"), HasSubstr("any hit shader 'Any'")));
}

TEST_P(Linking, ALibraryWithoutSourceCannotBeLinked) {
  interprets_ = true;
  EXPECT_THAT(
      refusal(of({compile("first.hlsl", kCalls),
                  compile("second.hlsl", "export float pick(float x) { return x; }", false)})),
      AllOf(HasSubstr("KA0563"), HasSubstr("second.hlsl")));
}

TEST_P(Linking, AComputePipelineLinksNothing) {
  interprets_ = true;
  const ShaderLibrary library = compile("first.hlsl", R"(
float pick(float x);
RWByteAddressBuffer words : register(u0);
[shader("compute")] [numthreads(8, 1, 1)] void Kernel() { words.Store(0, pick(3)); }
)");
  const auto pipeline = device_.CreateComputePipelineState({root_, library, "Kernel", "Kernel"});
  ASSERT_FALSE(pipeline.ok());
  EXPECT_THAT(pipeline.error().message,
              AllOf(HasSubstr("KA0566"), HasSubstr("\"float pick(float)\"")));
}

TEST_P(Linking, CheckedModeSeesIntoLinkedFunctions) {
  open(true);
  const ShaderLibrary first = compile("first.hlsl", R"(
void put(uint at, uint value);
[shader("raygeneration")] void RayGen() { put(DispatchRaysIndex().x, 3); }
)");
  const ShaderLibrary second = compile("second.hlsl", R"(RWByteAddressBuffer words : register(u0);
export void put(uint at, uint value) {
  words.Store(at == 2 ? 4096 : 4 * at, value);
}
struct Payload { uint2 values; };
[shader("miss")] void Miss(inout Payload payload) {}
[shader("closesthit")]
void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes attributes) {})");
  StateObjectDesc desc = of({first, second});
  desc.Add(group());
  const Words words = run(device_.CreateStateObject(desc).value());
  EXPECT_EQ(Words(words.begin(), words.begin() + 4), (Words{3, 3, 0, 3}));
  std::string all;
  for (const Message& message : messages_) all += message.Text + "\n";
  EXPECT_THAT(all, AllOf(HasSubstr("second.hlsl:3"), HasSubstr("words"), HasSubstr("4096")));
}

}  // namespace
