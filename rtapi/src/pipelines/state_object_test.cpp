// SPDX-License-Identifier: MIT
//
// Composition, hit groups, configs, identifiers. Associations are in associations_test.cpp,
// collections and additions in collections_test.cpp.
#include <cstring>

#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {
namespace {

constexpr auto kCollection = StateObjectType::kCollection;
constexpr auto kAdditions = StateObjectFlags::kAllowStateObjectAdditions;

TEST_F(StateObjectTest, MinimalPipelineLinks) {
  auto so = Make(Base());
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(null_log().last_raytracing->max_payload_bytes, 16u);
  EXPECT_EQ(null_log().last_raytracing->max_recursion_depth, 1u);
  EXPECT_EQ(so->GetIdentifiableExports(), (std::vector<std::string>{"RayGen", "Miss", "Call"}));
}

TEST_F(StateObjectTest, EmptyDescriptionIsAPipelineWithoutExports) {
  EXPECT_OK(Make({}));
}

TEST_F(StateObjectTest, SO_01_CollectionsDoNotNest) {
  auto inner = Make(Base(kCollection));
  ASSERT_TRUE(inner.ok()) << MessageOf(inner);
  StateObjectDesc outer{.Type = kCollection};
  outer.Add(ExistingCollectionDesc::Of(*inner));
  EXPECT_ERROR(Make(outer), "KA0501", "subobject 0");
}

TEST_F(StateObjectTest, SO_01_PipelinesAreNoCollections) {
  StateObjectDesc outer;
  outer.Add(ExistingCollectionDesc::Of(Make(Base()).value()));
  EXPECT_ERROR(Make(outer), "KA0501", "AddToStateObject");
}

TEST_F(StateObjectTest, SO_01_OtherTypesAreRefused) {
  EXPECT_ERROR(Make({.Type = static_cast<StateObjectType>(1)}), "KA0500", "type 1");
}

TEST_F(StateObjectTest, EmptyHandlesAndForeignObjectsAreErrors) {
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{});
  EXPECT_ERROR(Make(desc), "KA0904");
  desc = {};
  desc.Add(ExistingCollectionDesc{});
  EXPECT_ERROR(Make(desc), "KA0904");
  desc = {};
  desc.Add(GlobalRootSignature{});
  EXPECT_ERROR(Make(desc), "KA0904");
  desc = {};
  desc.Add(GlobalRootSignature{CreateNullDevice().CreateRootSignature("").value()});
  EXPECT_ERROR(Make(desc), "KA0903");
  EXPECT_ERROR(Device().CreateStateObject({}), "KA0904");
}

TEST_F(StateObjectTest, SO_02_RefusalsAreInvalidArguments) {
  StateObjectDesc desc = Base();
  desc.Add(Triangles("group", "Nope"));
  auto so = Make(desc);
  ASSERT_FALSE(so.ok());
  EXPECT_EQ(so.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(so.error().id.text(), "KA0518");  // SO-30: a pipeline leaves nothing unresolved
}

TEST_F(StateObjectTest, SO_03_LibraryTargetIsLib63OrLater) {
  for (const char* target : {"lib_6_2", "lib_5_0", "cs_6_0", "", "lib_"}) {
    LibraryBuilder old("old.hlsl", target);
    old.Export("RayGen", Stage::kRayGeneration);
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{old.Build()});
    EXPECT_ERROR(Make(desc), "KA0502", "lib_6_3", "old.hlsl");
  }
}

TEST_F(StateObjectTest, SO_04_ExportListLimitsWhatIsVisible) {
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"RayGen"}};
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_NE(so->GetShaderIdentifier("RayGen"), nullptr);
  EXPECT_EQ(so->GetShaderIdentifier("Miss"), nullptr);
  desc.Add(Triangles("group"));
  EXPECT_ERROR(Make(desc), "KA0518", "\"group\"", "\"Hit\"");
}

TEST_F(StateObjectTest, SO_04_ListedExportMustExist) {
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"RayGenn"}};
  EXPECT_ERROR(Make(desc), "KA0503", "\"RayGenn\"", "\"RayGen\"");
}

TEST_F(StateObjectTest, SO_05_OneFunctionUnderTwoNames) {
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {
      {"A", "Miss"}, {"B", "Miss"}, {"RayGen"}};
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_NE(so->GetShaderIdentifier("A"), nullptr);
  EXPECT_NE(so->GetShaderIdentifier("B"), nullptr);
  EXPECT_EQ(so->GetShaderIdentifier("Miss"), nullptr);
}

TEST_F(StateObjectTest, SO_05_RenamedByMangledName) {
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"A", "\x01?Miss@@YAXXZ"}};
  EXPECT_NE(Make(desc).value().GetShaderIdentifier("A"), nullptr);
}

TEST_F(StateObjectTest, SO_05_ExportsHaveNames) {
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"", "Miss"}};
  EXPECT_ERROR(Make(desc), "KA0506");
  desc = Base();
  desc.Add(Triangles(""));
  EXPECT_ERROR(Make(desc), "KA0506", "HitGroupExport");
}

TEST_F(StateObjectTest, SO_06_ClashingExportsAreRefused) {
  StateObjectDesc desc = Base();
  desc.Add(DxilLibraryDesc{library_});
  EXPECT_ERROR(Make(desc), "KA0504", "test.hlsl");
  std::get<DxilLibraryDesc>(desc.Subobjects.back()).Exports = {{"Miss2", "Miss"}};
  EXPECT_OK(Make(desc));
  std::get<DxilLibraryDesc>(desc.Subobjects.back()).Exports = {{"X", "Miss"}, {"X", "RayGen"}};
  EXPECT_ERROR(Make(desc), "KA0504", "\"X\"");
}

TEST_F(StateObjectTest, SO_06_HitGroupNamesClashToo) {
  StateObjectDesc desc = Base();
  desc.Add(Triangles("group"));
  desc.Add(Triangles("group"));
  EXPECT_ERROR(Make(desc), "KA0504", "\"group\"");
  desc = Base();
  desc.Add(Triangles("Miss"));
  EXPECT_ERROR(Make(desc), "KA0504", "\"Miss\"");
}

TEST_F(StateObjectTest, SO_07_OverloadsAreFoundByMangledName) {
  LibraryBuilder b;
  b.Export("M", Stage::kMiss).mangled_name = "M(int)";
  b.Export("M", Stage::kMiss).mangled_name = "M(float)";
  StateObjectDesc desc = Base();
  const ShaderLibrary overloads = b.Build();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).DXILLibrary = overloads;
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(so->GetShaderIdentifier("M"), nullptr);
  ASSERT_NE(so->GetShaderIdentifier("M(int)"), nullptr);
  EXPECT_NE(*so->GetShaderIdentifier("M(int)"), *so->GetShaderIdentifier("M(float)"));
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"N", "M"}};
  EXPECT_ERROR(Make(desc), "KA0505", "2 overloads");
}

// --- hit groups and configs ---

TEST_F(StateObjectTest, SO_20_MatrixOfShadersAndTypes) {
  for (int bits = 0; bits < 8; ++bits) {
    for (auto type : {HitGroupType::kTriangles, HitGroupType::kProceduralPrimitive}) {
      StateObjectDesc desc = Base();
      desc.Add(HitGroupDesc{.HitGroupExport = "group",
                            .Type = type,
                            .AnyHitShaderImport = bits & 1 ? "Any" : "",
                            .ClosestHitShaderImport = bits & 2 ? "Hit" : "",
                            .IntersectionShaderImport = bits & 4 ? "Intersect" : ""});
      const bool legal = (type == HitGroupType::kProceduralPrimitive) == ((bits & 4) != 0);
      auto so = Make(desc);
      if (!legal) {
        EXPECT_ERROR(so, "KA0516", "\"group\"");
        continue;
      }
      ASSERT_TRUE(so.ok()) << MessageOf(so);
      const auto* record = Linked("group");
      ASSERT_NE(record, nullptr);
      EXPECT_EQ(record->any_hit != nullptr, (bits & 1) != 0);
      EXPECT_EQ(record->closest_hit != nullptr, (bits & 2) != 0);
      EXPECT_EQ(record->intersection != nullptr, (bits & 4) != 0);
      EXPECT_EQ(record->hit_group_type, type);
    }
  }
}

TEST_F(StateObjectTest, SO_20_UndefinedTypeAndWrongStages) {
  StateObjectDesc desc = Base();
  HitGroupDesc group = Triangles("group");
  group.Type = static_cast<HitGroupType>(7);
  desc.Add(group);
  EXPECT_ERROR(Make(desc), "KA0516", "type 7");
  desc = Base();
  desc.Add(Triangles("group", "Any"));
  EXPECT_ERROR(Make(desc), "KA0517", "any-hit", "closest-hit");
  desc = Base();
  desc.Add(Triangles("group", "helper"));
  EXPECT_ERROR(Make(desc), "KA0517", "library function");
}

TEST_F(StateObjectTest, SO_21_HitGroupsDeclaredInHlsl) {
  builder_.Subobject("HlslGroup", 11, {"Any", "Hit", ""}, {0});
  builder_.Subobject("HlslBoxes", 11, {"", "", "Intersect"}, {1});
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).DXILLibrary = builder_.Build();
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_NE(Linked("HlslGroup")->any_hit, nullptr);
  EXPECT_EQ(Linked("HlslBoxes")->closest_hit, nullptr);
  EXPECT_NE(Linked("HlslBoxes")->intersection, nullptr);
}

TEST_F(StateObjectTest, SO_22_RecursionDepthUpTo31) {
  for (uint32_t depth : {0u, 31u, 32u, 0xFFFFFFFFu}) {
    StateObjectDesc desc = Base();
    std::get<RaytracingPipelineConfig>(desc.Subobjects[2]).MaxTraceRecursionDepth = depth;
    if (depth <= 31) {
      EXPECT_OK(Make(desc));
    } else {
      EXPECT_ERROR(Make(desc), "KA0519", std::to_string(depth));
    }
  }
}

TEST_F(StateObjectTest, SO_23_PipelineConfig1NeedsTier11) {
  StateObjectDesc desc = Base();
  desc.Subobjects[2] = RaytracingPipelineConfig1{3, RaytracingPipelineFlags::kSkipTriangles};
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(null_log().last_raytracing->max_recursion_depth, 3u);
  EXPECT_EQ(null_log().last_raytracing->flags, RaytracingPipelineFlags::kSkipTriangles);
  Device old = CreateNullDevice({.Tier = RaytracingTier::kTier1_0});
  EXPECT_ERROR(old.CreateStateObject(desc), "KA0520", "tier 1.0");
}

TEST_F(StateObjectTest, TIER_02_LibrariesOfAHigherShaderModel) {
  Device old =
      CreateNullDevice({.Tier = RaytracingTier::kTier1_1, .ShaderModel = ShaderModel::k6_5});
  const auto make = [&old](const char* target) {
    LibraryBuilder b("lib.hlsl", target);
    b.Export("RayGen", Stage::kRayGeneration);
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{b.Build()});
    desc.Add(RaytracingShaderConfig{});
    desc.Add(RaytracingPipelineConfig{1});
    return old.CreateStateObject(desc);
  };
  EXPECT_OK(make("lib_6_5"));
  EXPECT_ERROR(make("lib_6_6"), "KA0544", "\"lib.hlsl\" was compiled for lib_6_6",
               "shader model 6.5");
}

TEST_F(StateObjectTest, FLG_05_ShadersOfTier11) {
  Device old = CreateNullDevice({.Tier = RaytracingTier::kTier1_0});
  LibraryBuilder b;
  auto& export_desc = b.Export("Skips", Stage::kRayGeneration);
  shader::TraceCall call = {};
  call.known = shader::kKnowsMask;
  call.ray_flags = 0x100;
  export_desc.trace_calls = &call;
  export_desc.trace_call_count = 1;
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{b.Build()});
  desc.Add(RaytracingShaderConfig{});
  desc.Add(RaytracingPipelineConfig{});
  EXPECT_OK(old.CreateStateObject(desc));  // the flags are not known to be constant
  call.known = shader::kKnowsRayFlags;
  EXPECT_ERROR(old.CreateStateObject(desc), "KA0542", "\"Skips\"", "0x100");
  call.ray_flags = 0x4;
  EXPECT_OK(old.CreateStateObject(desc));
  LibraryBuilder queries;
  queries.Export("Query", Stage::kCompute).flags = shader::kExportUsesRayQuery;
  EXPECT_ERROR(old.CreateComputePipelineState(
                   {.pRootSignature = old.CreateRootSignature("").value(), .CS = queries.Build()}),
               "KA0542", "RayQuery");
}

TEST_F(StateObjectTest, SO_23_PipelineFlags) {
  StateObjectDesc desc = Base();
  desc.Subobjects[2] = RaytracingPipelineConfig1{1, static_cast<RaytracingPipelineFlags>(0x300)};
  EXPECT_ERROR(Make(desc), "KA0539");
  desc.Subobjects[2] = RaytracingPipelineConfig1{1, static_cast<RaytracingPipelineFlags>(0x800)};
  EXPECT_ERROR(Make(desc), "KA0539", "0x800");
  const Device with_clusters =
      CreateNullDevice({.ShaderModel = ShaderModel::k6_10, .IndirectRtasOperations = true});
  EXPECT_OK(with_clusters.CreateStateObject(desc));  // CLS-46
  desc.Subobjects[2] =
      RaytracingPipelineConfig1{1, RaytracingPipelineFlags::kAllowOpacityMicromaps};
  EXPECT_OK(Make(desc));
}

TEST_F(StateObjectTest, PAY_02_PayloadsFitTheConfig) {
  LibraryBuilder b;
  b.Export("M", Stage::kMiss).payload_bytes = 36;
  auto& callable = b.Export("C", Stage::kCallable);
  callable.callable_data_bytes = 256;  // the config does not limit it
  const ShaderLibrary library = b.Build();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 32});
  desc.Add(RaytracingPipelineConfig{});
  EXPECT_ERROR(Make(desc), "KA0522", "miss shader \"M\"", "36", "32");
  std::get<RaytracingShaderConfig>(desc.Subobjects[1]).MaxPayloadSizeInBytes = 36;
  EXPECT_OK(Make(desc));
}

TEST_F(StateObjectTest, PAY_03_AttributesUpTo32Bytes) {
  StateObjectDesc desc = Base();
  std::get<RaytracingShaderConfig>(desc.Subobjects[1]).MaxAttributeSizeInBytes = 33;
  EXPECT_ERROR(Make(desc), "KA0521", "33", "32");
  desc = Base();
  std::get<RaytracingShaderConfig>(desc.Subobjects[1]).MaxAttributeSizeInBytes = 4;
  desc.Add(Triangles("group"));
  EXPECT_ERROR(Make(desc), "KA0523", "\"Hit\"", "8");
}

TEST_F(StateObjectTest, PAY_04_AttributesAgreeWithinAGroup) {
  LibraryBuilder b;
  b.Export("I", Stage::kIntersection).attribute_bytes = 12;
  b.Export("H", Stage::kClosestHit).attribute_bytes = 16;
  const ShaderLibrary library = b.Build();
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{library});
  desc.Add(RaytracingShaderConfig{16, 32});
  desc.Add(RaytracingPipelineConfig{});
  HitGroupDesc group = Triangles("group", "H");
  desc.Add(group);
  EXPECT_ERROR(Make(desc), "KA0524", "8 bytes");  // SV-13
  group.Type = HitGroupType::kProceduralPrimitive;
  group.IntersectionShaderImport = "I";
  desc.Subobjects.back() = group;
  EXPECT_ERROR(Make(desc), "KA0524", "12", "16");
}

// A hit shader of triangles may serve boxes, too, if it reads no attributes.
TEST_F(StateObjectTest, PAY_04_UnreadAttributesOfAnotherSizeAreAWarning) {
  std::vector<Message> messages;
  const Device device =
      CreateNullDevice({.OnMessage = [&](const Message& m) { messages.push_back(m); }});
  const auto make = [&](uint32_t flags, HitGroupType type = HitGroupType::kProceduralPrimitive) {
    messages.clear();
    LibraryBuilder b;
    b.Export("I", Stage::kIntersection).attribute_bytes = 12;
    auto& hit = b.Export("H", Stage::kClosestHit);
    hit.attribute_bytes = 8;
    hit.flags = flags;
    auto& any = b.Export("A", Stage::kAnyHit);
    any.attribute_bytes = 12;
    any.flags = shader::kExportIgnoresAttributes;
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{b.Build()});
    desc.Add(RaytracingShaderConfig{16, 32});
    desc.Add(RaytracingPipelineConfig{});
    HitGroupDesc group = Triangles("group", "H", "A");
    group.Type = type;
    if (type != HitGroupType::kTriangles) group.IntersectionShaderImport = "I";
    desc.Add(group);
    return device.CreateStateObject(desc);
  };
  EXPECT_OK(make(shader::kExportIgnoresAttributes));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].Severity, MessageSeverity::kWarning);
  EXPECT_EQ(messages[0].Id.text(), "KA0553");
  for (const char* part : {"\"group\"", "\"H\" declares 8", "\"I\" has 12"}) {
    EXPECT_THAT(messages[0].Text, ::testing::HasSubstr(part));
  }
  EXPECT_ERROR(make(0), "KA0524", "\"H\"", "8", "12");
  EXPECT_TRUE(messages.empty());
  // Triangles have only one struct, read or not.
  EXPECT_ERROR(make(shader::kExportIgnoresAttributes, HitGroupType::kTriangles), "KA0524",
               "\"A\" takes 12");
}

TEST_F(StateObjectTest, UndefinedStateObjectFlags) {
  EXPECT_ERROR(Make(WithFlags(static_cast<StateObjectFlags>(8))), "KA0539", "0x8");
  StateObjectDesc desc = WithFlags(kAdditions);
  desc.Add(StateObjectConfig{});
  EXPECT_ERROR(Make(desc), "KA0509");
}

// --- identifiers and stack ---

TEST_F(StateObjectTest, SO_40_OnlyEntriesAndGroupsHaveIdentifiers) {
  StateObjectDesc desc = Base();
  desc.Add(Triangles("group", "Hit", "Any"));
  auto so = Make(desc).value();
  for (const char* name : {"RayGen", "Miss", "Call", "group", "\x01?Miss@@YAXXZ"}) {
    EXPECT_NE(so.GetShaderIdentifier(name), nullptr) << name;
  }
  for (const char* name : {"Hit", "Any", "Intersect", "helper", "", "Nope", "group::closesthit"}) {
    EXPECT_EQ(so.GetShaderIdentifier(name), nullptr) << name;
  }
  EXPECT_EQ(StateObject().GetShaderIdentifier("RayGen"), nullptr);
}

TEST_F(StateObjectTest, SBT_29_IdentifiersAreUniqueAndNeverNull) {
  auto a = Make(Base()).value();
  auto b = Make(Base()).value();
  EXPECT_NE(*a.GetShaderIdentifier("Miss"), *b.GetShaderIdentifier("Miss"));
  EXPECT_NE(*a.GetShaderIdentifier("Miss"), *a.GetShaderIdentifier("RayGen"));
  EXPECT_FALSE(kaamos::runtime::is_null_identifier(a.GetShaderIdentifier("Miss")->data()));
  const auto& pipeline = *null_log().last_raytracing;
  EXPECT_EQ(pipeline.identifiers.find(a.GetShaderIdentifier("Miss")->data()), nullptr);
  ShaderIdentifier forged = *b.GetShaderIdentifier("Miss");
  EXPECT_NE(pipeline.identifiers.find(forged.data()), nullptr);
  forged[31] ^= 1;
  EXPECT_EQ(pipeline.identifiers.find(forged.data()), nullptr);
  forged.fill(0);
  EXPECT_EQ(pipeline.identifiers.find(forged.data()), nullptr);
  forged.fill(0xFF);
  EXPECT_EQ(pipeline.identifiers.find(forged.data()), nullptr);
}

TEST_F(StateObjectTest, SO_41_StackSizes) {
  StateObjectDesc desc = Base();
  desc.Add(Triangles("group", "Hit"));
  auto so = Make(desc).value();
  EXPECT_EQ(so.GetShaderStackSize("RayGen"), 100u);
  EXPECT_EQ(so.GetShaderStackSize("group::closesthit"), 100u);
  for (const char* name : {"group", "group::anyhit", "group::ClosestHit", "group::intersection",
                           "Hit", "Nope", "", "::", "Miss::closesthit", "group::"}) {
    EXPECT_EQ(so.GetShaderStackSize(name), 0xFFFFFFFFu) << name;
  }
}

TEST_F(StateObjectTest, SO_42_StackSizesAreTheSameInEveryPipeline) {
  StateObjectDesc desc = Base();
  desc.Add(Triangles("group"));
  auto one = Make(desc).value();
  desc.Subobjects[2] = RaytracingPipelineConfig{7};
  desc.Add(GlobalRootSignature{Global("CBV(b0)")});
  auto two = Make(desc).value();
  for (const char* name : {"RayGen", "Miss", "Call", "group::closesthit"}) {
    EXPECT_EQ(one.GetShaderStackSize(name), two.GetShaderStackSize(name)) << name;
  }
}

TEST_F(StateObjectTest, SO_43_DefaultStackSize) {
  LibraryBuilder b;
  b.Export("R", Stage::kRayGeneration).stack_bytes = 1;
  b.Export("M", Stage::kMiss).stack_bytes = 10;
  auto& hit = b.Export("H", Stage::kClosestHit);
  hit.stack_bytes = 100;
  b.Export("A", Stage::kAnyHit).stack_bytes = 1000;
  b.Export("I", Stage::kIntersection).stack_bytes = 10000;
  b.Export("C", Stage::kCallable).stack_bytes = 100000;
  const ShaderLibrary library = b.Build();
  for (auto [depth, expected] : {std::pair<uint32_t, uint64_t>{0, 200001},
                                 {1, 200001 + 11000},
                                 {5, 200001 + 11000 + 4 * 100}}) {
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{library});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{depth});
    desc.Add(HitGroupDesc{"group", HitGroupType::kProceduralPrimitive, "A", "H", "I"});
    EXPECT_EQ(Make(desc).value().GetPipelineStackSize(), expected) << depth;
  }
}

TEST_F(StateObjectTest, SO_44_BadStackSizesAreDropped) {
  auto so = Make(Base()).value();
  const uint64_t before = so.GetPipelineStackSize();
  EXPECT_ERROR(so.SetPipelineStackSize(0xFFFFFFFFu), "KA0532");
  EXPECT_EQ(so.GetPipelineStackSize(), before);
  EXPECT_OK(so.SetPipelineStackSize(4096));
  EXPECT_EQ(so.GetPipelineStackSize(), 4096u);
  auto c = Make(Base(kCollection)).value();
  EXPECT_ERROR(c.SetPipelineStackSize(4096), "KA0532", "collection");
  EXPECT_EQ(c.GetPipelineStackSize(), 0u);
  StateObject empty;
  EXPECT_ERROR(empty.SetPipelineStackSize(1), "KA0904");
}

}  // namespace
}  // namespace rtapi::testing
