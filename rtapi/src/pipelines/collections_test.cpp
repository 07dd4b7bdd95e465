// SPDX-License-Identifier: MIT
//
// Collections, and additions to state objects.
#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {
namespace {

constexpr auto kCollection = StateObjectType::kCollection;
constexpr auto kExternal = StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions;
constexpr auto kUnresolved = StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions;
constexpr auto kAdditions = StateObjectFlags::kAllowStateObjectAdditions;

TEST_F(StateObjectTest, SO_24_CollectionsAgreeOnTheShaderConfig) {
  StateObjectDesc collection = Base(kCollection);
  std::get<RaytracingShaderConfig>(collection.Subobjects[1]).MaxPayloadSizeInBytes = 32;
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(Make(collection).value()));
  EXPECT_OK(Make(desc));
  LibraryBuilder other("other.hlsl");
  other.Export("Miss2", Stage::kMiss);
  const ShaderLibrary library = other.Build();
  desc.Add(DxilLibraryDesc{library});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  EXPECT_ERROR(Make(desc), "KA0513", "16", "32");
  std::get<RaytracingShaderConfig>(desc.Subobjects[2]).MaxPayloadSizeInBytes = 32;
  EXPECT_OK(Make(desc));
}

TEST_F(StateObjectTest, SO_23_CollectionsAgreeOnThePipelineConfig) {
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(Make(Base(kCollection)).value()));
  LibraryBuilder other;
  other.Export("Miss2", Stage::kMiss);
  const ShaderLibrary library = other.Build();
  desc.Add(DxilLibraryDesc{library});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{.MaxTraceRecursionDepth = 2});
  EXPECT_ERROR(Make(desc), "KA0514", "depth 2");
}

// --- collections ---

TEST_F(StateObjectTest, SO_25_DefaultCollectionResolvesEverything) {
  StateObjectDesc desc = Base(kCollection);
  desc.Add(Triangles("group", "NotHere"));
  EXPECT_ERROR(Make(desc), "KA0518", "\"NotHere\"");
  desc = Base(kCollection);
  desc.Subobjects.erase(desc.Subobjects.begin() + 1);
  EXPECT_ERROR(Make(desc), "KA0511");
  desc = Base(kCollection);
  desc.Subobjects.erase(desc.Subobjects.begin() + 2);
  EXPECT_ERROR(Make(desc), "KA0512");
  LibraryBuilder b;
  b.Export("M", Stage::kMiss, {b.Binding("tex", BindingType::kTexture, 0)});
  const ShaderLibrary library = b.Build();
  desc = Base(kCollection);
  desc.Add(DxilLibraryDesc{library});
  EXPECT_ERROR(Make(desc), "KA0528", "\"tex\" (t0)");
}

TEST_F(StateObjectTest, SO_26_UnresolvedCollectionIsCompletedByThePipeline) {
  LibraryBuilder b;
  b.Export("M", Stage::kMiss, {b.Binding("tex", BindingType::kTexture, 0)});
  const ShaderLibrary library = b.Build();
  StateObjectDesc collection{.Type = kCollection};
  collection.Add(DxilLibraryDesc{library});
  collection.Add(StateObjectConfig{kUnresolved});
  collection.Add(Triangles("group", "Hit"));
  auto c = Make(collection);
  ASSERT_TRUE(c.ok()) << MessageOf(c);
  EXPECT_EQ(c->GetShaderIdentifier("M"), nullptr);
  EXPECT_EQ(c->GetShaderIdentifier("group"), nullptr);
  StateObjectDesc no_config{.Type = kCollection};
  no_config.Add(DxilLibraryDesc{library_, {{"Miss"}}});
  no_config.Add(StateObjectConfig{kUnresolved});
  EXPECT_EQ(Make(no_config).value().GetShaderIdentifier("Miss"), nullptr);

  StateObjectDesc desc = Base();
  desc.Add(ExistingCollectionDesc::Of(*c));
  EXPECT_ERROR(Make(desc), "KA0528");
  desc.Add(GlobalRootSignature{Global("DescriptorTable(SRV(t0))")});
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_NE(so->GetShaderIdentifier("M"), nullptr);
  EXPECT_NE(so->GetShaderIdentifier("group"), nullptr);
}

TEST_F(StateObjectTest, SO_27_OutsideGroupsNeedTheFlag) {
  for (bool flag : {false, true}) {
    StateObjectDesc desc;
    desc.Add(ExistingCollectionDesc::Of(
        Make(WithFlags(flag ? kExternal : StateObjectFlags::kNone, kCollection)).value()));
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{});
    desc.Add(Triangles("group"));
    if (flag) {
      EXPECT_OK(Make(desc));
    } else {
      EXPECT_ERROR(Make(desc), "KA0525", "0x2");
      desc.Subobjects.pop_back();
      auto so = Make(desc);  // entry points are usable either way
      ASSERT_TRUE(so.ok()) << MessageOf(so);
      EXPECT_NE(so->GetShaderIdentifier("RayGen"), nullptr);
    }
  }
}

TEST_F(StateObjectTest, SO_28_AdditionsFlagOfCollectionAndPipeline) {
  for (bool of_collection : {false, true}) {
    for (bool of_pipeline : {false, true}) {
      const auto none = StateObjectFlags::kNone;
      auto c = Make(WithFlags(of_collection ? kAdditions : none, kCollection));
      StateObjectDesc desc;
      desc.Add(StateObjectConfig{of_pipeline ? kAdditions : none});
      desc.Add(ExistingCollectionDesc::Of(c.value()));
      if (of_pipeline && !of_collection) {
        EXPECT_ERROR(Make(desc), "KA0526", "0x4");
      } else {
        EXPECT_OK(Make(desc));
      }
    }
  }
}

TEST_F(StateObjectTest, SO_29_CollectionFlagsMeanNothingOnPipelines) {
  EXPECT_OK(Make(WithFlags(kUnresolved | kExternal)));
  StateObjectDesc desc = WithFlags(kUnresolved);
  desc.Add(Triangles("group", "NotHere"));
  EXPECT_ERROR(Make(desc), "KA0518");
}

TEST_F(StateObjectTest, SO_04_CollectionExportListsAndRenames) {
  auto c = Make(Base(kCollection));
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(c.value(), {{"Sky", "Miss"}, {"RayGen"}}));
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(*so->GetShaderIdentifier("Sky"), *c->GetShaderIdentifier("Miss"));
  EXPECT_EQ(so->GetShaderIdentifier("Miss"), nullptr);
  EXPECT_EQ(so->GetShaderIdentifier("Call"), nullptr);
  desc = {};
  desc.Add(ExistingCollectionDesc::Of(c.value(), {{"Nope"}}));
  EXPECT_ERROR(Make(desc), "KA0503", "\"Nope\"");
}

TEST_F(StateObjectTest, SO_31_ObjectsKeepWhatTheyUse) {
  Result<StateObject> so = Make({});
  {
    LibraryBuilder b;
    StateObjectDesc desc = Base();
    desc.Add(GlobalRootSignature{Global("StaticSampler(s0)")});
    so = Make(desc);
  }
  ASSERT_TRUE(so.ok());
  EXPECT_EQ(Linked("RayGen")->shader->global_root_signature.GetDesc().StaticSamplers.size(), 1u);
}

TEST_F(StateObjectTest, SO_32_CollectionIdentifiersStay) {
  auto c = Make(Base(kCollection));
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(c.value()));
  auto so = Make(desc);
  for (const char* name : {"RayGen", "Miss", "Call"}) {
    EXPECT_EQ(*so->GetShaderIdentifier(name), *c->GetShaderIdentifier(name)) << name;
  }
  const auto& pipeline = *null_log().last_raytracing;
  EXPECT_EQ(pipeline.identifiers.find(so->GetShaderIdentifier("Miss")->data()), Linked("Miss"));
}

TEST_F(StateObjectTest, SO_15_ConfigOfTheStateObjectOverridesItsLibraries) {
  builder_.Subobject("Config", 0, {}, {4});
  StateObjectDesc desc = Base();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).DXILLibrary = builder_.Build();
  StateObject parent = Make(desc).value();
  StateObjectDesc addition;
  addition.Add(StateObjectConfig{kAdditions});
  EXPECT_OK(device_.AddToStateObject(addition, parent));
  desc.Add(StateObjectConfig{});
  parent = Make(desc).value();
  EXPECT_ERROR(device_.AddToStateObject(addition, parent), "KA0533", "parent lacks");
}

// --- AddToStateObject ---

class AddToStateObjectTest : public StateObjectTest {
 protected:
  AddToStateObjectTest() {
    more_.Export("Miss2", Stage::kMiss);
    more_library_ = more_.Build();
    parent_ = Make(WithFlags(kAdditions)).value();
  }
  StateObjectDesc Addition(StateObjectFlags flags = kAdditions) {
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{more_library_});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{});
    desc.Add(StateObjectConfig{flags});
    return desc;
  }
  LibraryBuilder more_{"more.hlsl"};
  ShaderLibrary more_library_;
  StateObject parent_;
};

TEST_F(AddToStateObjectTest, SO_60_BothCarryTheFlagAndAreNoCollections) {
  EXPECT_OK(device_.AddToStateObject(Addition(), parent_));
  EXPECT_ERROR(device_.AddToStateObject(Addition(StateObjectFlags::kNone), parent_), "KA0533");
  EXPECT_ERROR(device_.AddToStateObject(Addition(), Make(Base()).value()), "KA0533", "parent");
  EXPECT_ERROR(
      device_.AddToStateObject(Addition(), Make(WithFlags(kAdditions, kCollection)).value()),
      "KA0533", "collection");
  EXPECT_ERROR(device_.AddToStateObject(Addition(), StateObject()), "KA0904");
}

TEST_F(AddToStateObjectTest, SO_61_AdditionSeesNothingOfItsParent) {
  StateObjectDesc desc = Addition();
  desc.Add(Triangles("group", "Hit"));
  EXPECT_ERROR(device_.AddToStateObject(desc, parent_), "KA0518");
}

TEST_F(AddToStateObjectTest, SO_62_ConfigsEqualTheParents) {
  StateObjectDesc desc = Addition();
  std::get<RaytracingPipelineConfig>(desc.Subobjects[2]).MaxTraceRecursionDepth = 2;
  EXPECT_ERROR(device_.AddToStateObject(desc, parent_), "KA0534",
               "recursion 2, but the parent has");
}

TEST_F(AddToStateObjectTest, SO_63_NewEntryNamesOnly) {
  StateObjectDesc desc = Addition();
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"Miss", "Miss2"}};
  EXPECT_ERROR(device_.AddToStateObject(desc, parent_), "KA0535", "\"Miss\"");
  std::get<DxilLibraryDesc>(desc.Subobjects[0]) = {library_, {{"Hit"}}};
  EXPECT_ERROR(device_.AddToStateObject(desc, parent_), "KA0535", "\"Hit\"");
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"Hit2", "Hit"}, {"helper"}};
  EXPECT_OK(device_.AddToStateObject(desc, parent_));
}

TEST_F(AddToStateObjectTest, SO_64_65_67_ChildHasBothAndTheParentsIdentifiersAndStack) {
  ASSERT_TRUE(parent_.SetPipelineStackSize(777).ok());
  const ShaderIdentifier miss = *parent_.GetShaderIdentifier("Miss");
  auto child = device_.AddToStateObject(Addition(), parent_);
  ASSERT_TRUE(child.ok()) << MessageOf(child);
  parent_ = {};
  EXPECT_EQ(*child->GetShaderIdentifier("Miss"), miss);
  EXPECT_NE(child->GetShaderIdentifier("Miss2"), nullptr);
  EXPECT_EQ(child->GetPipelineStackSize(), 777u);
  EXPECT_EQ(Linked("Miss2")->kind, kaamos::runtime::RecordKind::kMiss);
}

TEST_F(AddToStateObjectTest, SO_64_SiblingsAreNotVisible) {
  auto one = device_.AddToStateObject(Addition(), parent_);
  StateObjectDesc other = Addition();
  std::get<DxilLibraryDesc>(other.Subobjects[0]).Exports = {{"Miss3", "Miss2"}};
  auto two = device_.AddToStateObject(other, parent_);
  EXPECT_EQ(two->GetShaderIdentifier("Miss2"), nullptr);
  EXPECT_NE(two->GetShaderIdentifier("Miss3"), nullptr);
  EXPECT_EQ(one->GetShaderIdentifier("Miss3"), nullptr);
}

}  // namespace
}  // namespace rtapi::testing
