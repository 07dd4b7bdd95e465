// SPDX-License-Identifier: MIT
//
// Tests which config and root signature an export gets, and which root argument feeds each
// resource.
#include <chrono>

#include "rtapi/testing/state_object_fixture.h"

namespace rtapi::testing {
namespace {

using shader::SlotSource;

class AssociationTest : public StateObjectTest {
 protected:
  AssociationTest() {
    two_.Export("A", Stage::kMiss);
    two_.Export("B", Stage::kMiss);
    two_.Export("H", Stage::kClosestHit);
    two_.Export("Y", Stage::kAnyHit);
  }
  StateObjectDesc Two(StateObjectType type = StateObjectType::kRaytracingPipeline) {
    StateObjectDesc desc{.Type = type};
    library_ = two_.Build();
    desc.Add(DxilLibraryDesc{library_});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{});
    return desc;
  }
  // Bytes of local arguments of an export of the last state object. Signatures differ in it.
  static uint32_t LocalBytes(const char* name) { return Linked(name)->local_argument_bytes; }
  RootSignature Constants(int n) {
    return Local("RootConstants(num32BitConstants=" + std::to_string(n) + ", b0)");
  }
  LibraryBuilder two_{"two.hlsl"};
};

TEST_F(AssociationTest, SO_10_ImplicitAndExplicitDefaults) {
  StateObjectDesc desc = Two();
  const uint32_t lrs = desc.Add(LocalRootSignature{Constants(1)});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 4u);
  EXPECT_EQ(LocalBytes("B"), 4u);
  desc.Associate(lrs, {});  // the call form with an empty export list
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("B"), 4u);
}

TEST_F(AssociationTest, SO_11_CollectionDefaultStaysInside) {
  StateObjectDesc collection = Base(StateObjectType::kCollection);
  collection.Add(LocalRootSignature{Constants(1)});
  StateObjectDesc desc = Two();
  LibraryBuilder base_again;
  desc.Add(
      ExistingCollectionDesc::Of(device_
                                     .CreateStateObject([&] {
                                       StateObjectDesc c{.Type = StateObjectType::kCollection};
                                       base_again.Export("InCollection", Stage::kMiss);
                                       c.Add(DxilLibraryDesc{base_again.Build()});
                                       c.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
                                       c.Add(RaytracingPipelineConfig{});
                                       c.Add(LocalRootSignature{Constants(1)});
                                       return c;
                                     }())
                                     .value()));
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(LocalBytes("A"), 0u);
  EXPECT_EQ(LocalBytes("InCollection"), 4u);
}

TEST_F(AssociationTest, SO_11_ExplicitOnesAreNoDefaultCandidates) {
  StateObjectDesc desc = Two();
  desc.Add(LocalRootSignature{Constants(1)});
  desc.Associate(desc.Add(LocalRootSignature{Constants(2)}), {"B"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 4u);
  EXPECT_EQ(LocalBytes("B"), 8u);
}

TEST_F(AssociationTest, SO_12_UnknownExportsFailInPipelinesOnly) {
  for (auto type : {StateObjectType::kCollection, StateObjectType::kRaytracingPipeline}) {
    StateObjectDesc desc = Two(type);
    desc.Associate(desc.Add(LocalRootSignature{Constants(1)}), {"A", "Nope"});
    if (type == StateObjectType::kCollection) {
      EXPECT_OK(Make(desc));
    } else {
      EXPECT_ERROR(Make(desc), "KA0507", "\"Nope\"", "local root signature");
    }
  }
}

TEST_F(AssociationTest, SO_12_PipelineCompletesACollection) {
  StateObjectDesc collection{.Type = StateObjectType::kCollection};
  collection.Add(DxilLibraryDesc{two_.Build()});
  collection.Add(StateObjectConfig{StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions});
  auto c = Make(collection);
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(c.value()));
  desc.Associate(desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 8}), {"A", "B"});
  desc.Associate(desc.Add(RaytracingPipelineConfig{}), {"A", "B"});
  desc.Associate(desc.Add(LocalRootSignature{Constants(3)}), {"A"});
  auto so = Make(desc);
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(LocalBytes("A"), 12u);
  EXPECT_EQ(LocalBytes("B"), 0u);
}

TEST_F(AssociationTest, SO_12_BadSubobjectsCannotBeAssociated) {
  StateObjectDesc desc = Two();
  desc.Associate(99, {"A"});
  EXPECT_ERROR(Make(desc), "KA0508", "99");
  desc = Two();
  desc.Associate(0, {"A"});  // associates the subobject that the library declares
  EXPECT_ERROR(Make(desc), "KA0508", "type 5");
  desc = Two();
  desc.Add(DxilSubobjectToExportsAssociation{"NotThere", {"A"}});
  EXPECT_ERROR(Make(desc), "KA0508", "\"NotThere\"");
}

TEST_F(AssociationTest, SO_13_OneSubobjectInManyAssociations) {
  StateObjectDesc desc = Two();
  const uint32_t lrs = desc.Add(LocalRootSignature{Constants(1)});
  desc.Associate(lrs, {"A"});
  desc.Associate(lrs, {"B"});
  desc.Associate(lrs, {"A", "B"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("B"), 4u);
}

TEST_F(AssociationTest, SO_14_TwoExplicitDefinitionsConflict) {
  StateObjectDesc desc = Two();
  desc.Associate(desc.Add(LocalRootSignature{Constants(1)}), {"A"});
  const uint32_t second = desc.Add(LocalRootSignature{Constants(2)});
  desc.Associate(second, {"A"});
  EXPECT_ERROR(Make(desc), "KA0509", "\"A\"", "subobject 3", "subobject 5");
  desc.Subobjects[second] = LocalRootSignature{Constants(1)};  // equal: no conflict
  EXPECT_OK(Make(desc));
}

TEST_F(AssociationTest, SO_15_StateObjectOverridesItsLibraries) {
  two_.Subobject("InHlsl", 2, {"RootConstants(num32BitConstants=7, b0)"});
  two_.Subobject("Link", 8, {"InHlsl", "A"});
  StateObjectDesc desc = Two();
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 28u);
  EXPECT_EQ(LocalBytes("B"), 0u);
  const uint32_t lrs = desc.Add(LocalRootSignature{Constants(1)});  // a default overrides (SO-19)
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 4u);
  desc.Associate(lrs, {"B"});  // no longer a default
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 28u);
  EXPECT_EQ(LocalBytes("B"), 4u);
  desc.Associate(lrs, {"A"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 4u);
}

TEST_F(AssociationTest, SO_15_CollectionsAreNotOverridden) {
  StateObjectDesc collection = Two(StateObjectType::kCollection);
  collection.Add(LocalRootSignature{Constants(1)});
  StateObjectDesc desc;
  desc.Add(ExistingCollectionDesc::Of(Make(collection).value()));
  const uint32_t lrs = desc.Add(LocalRootSignature{Constants(2)});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 4u);
  desc.Associate(lrs, {"A"});
  EXPECT_ERROR(Make(desc), "KA0509", "collection");
}

TEST_F(AssociationTest, SO_16_GroupAssociationReachesItsShaders) {
  StateObjectDesc desc = Two();
  desc.Add(Triangles("group", "H", "Y"));
  desc.Associate(desc.Add(LocalRootSignature{Constants(2)}), {"group"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("group"), 8u);
  EXPECT_EQ(Linked("group")->closest_hit->local_argument_bytes, 8u);
  EXPECT_EQ(Linked("group")->any_hit->local_argument_bytes, 8u);
}

TEST_F(AssociationTest, SO_16_GroupAndShaderAgree) {
  StateObjectDesc desc = Two();
  desc.Add(Triangles("group", "H", "Y"));
  desc.Associate(desc.Add(LocalRootSignature{Constants(2)}), {"group"});
  desc.Associate(desc.Add(LocalRootSignature{Constants(1)}), {"H"});
  EXPECT_ERROR(Make(desc), "KA0510", "\"group\"", "\"H\"");
}

TEST_F(AssociationTest, SO_16_ShadersOfAGroupAgree) {
  StateObjectDesc desc = Two();
  desc.Add(Triangles("group", "H", "Y"));
  desc.Associate(desc.Add(LocalRootSignature{Constants(2)}), {"Y"});
  desc.Associate(desc.Add(LocalRootSignature{Constants(1)}), {"H"});
  EXPECT_ERROR(Make(desc), "KA0510", "\"Y\"", "\"H\"");
}

TEST_F(AssociationTest, SO_17_ConfigsReachEveryExport) {
  StateObjectDesc desc = Two();
  desc.Associate(1, {"A"});  // the shader config: no longer a default
  EXPECT_ERROR(Make(desc), "KA0511", "\"B\"");
  desc = Two();
  desc.Associate(2, {"A"});
  EXPECT_ERROR(Make(desc), "KA0512", "\"B\"");
  desc.Associate(desc.Add(RaytracingPipelineConfig{5}), {"B"});
  EXPECT_ERROR(Make(desc), "KA0514");
}

TEST_F(AssociationTest, SO_18_EqualDuplicatesAreFine) {
  StateObjectDesc desc = Two();
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  EXPECT_OK(Make(desc));
}

TEST_F(AssociationTest, SO_18_DifferentDefaultsFailUnlessOneIsPicked) {
  StateObjectDesc desc = Two();
  const uint32_t other = desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 24});
  EXPECT_ERROR(Make(desc), "KA0515", "subobject 1", "subobject 3");
  desc.Associate(other, {});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(null_log().last_raytracing->max_payload_bytes, 24u);
}

TEST_F(AssociationTest, SO_18_SeveralLocalDefaultsMeanNone) {
  StateObjectDesc desc = Two();
  desc.Add(LocalRootSignature{Constants(1)});
  desc.Add(LocalRootSignature{Constants(2)});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 0u);
}

TEST_F(AssociationTest, SO_19_MissingConfigsFail) {
  StateObjectDesc desc = Two();
  desc.Subobjects.erase(desc.Subobjects.begin() + 1);
  EXPECT_ERROR(Make(desc), "KA0511", "\"A\"");
  desc = Two();
  desc.Subobjects.pop_back();
  EXPECT_ERROR(Make(desc), "KA0512", "\"A\"");
}

TEST_F(AssociationTest, SO_19_HlslSubobjectsAreVisibleOnlyIfExported) {
  two_.Subobject("Shader", 9, {}, {16, 8});
  two_.Subobject("Pipeline", 10, {}, {3});
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{two_.Build()});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(null_log().last_raytracing->max_recursion_depth, 3u);
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"A"}, {"Shader"}};
  EXPECT_ERROR(Make(desc), "KA0512");
  std::get<DxilLibraryDesc>(desc.Subobjects[0]).Exports = {{"A"}, {"Shader"}, {"Pipeline"}};
  EXPECT_OK(Make(desc));
}

TEST_F(AssociationTest, SO_19_BrokenHlslSubobjects) {
  LibraryBuilder b("broken.hlsl");
  b.Subobject("Bad", 1, {"CBV(x0)"});
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{b.Build()});
  EXPECT_ERROR(Make(desc), "KA0538", "\"Bad\" of \"broken.hlsl\"", "column 5");
  LibraryBuilder c("broken.hlsl");
  c.Subobject("Odd", 77, {});
  desc.Subobjects[0] = DxilLibraryDesc{c.Build()};
  EXPECT_ERROR(Make(desc), "KA0538", "type 77");
}

TEST_F(AssociationTest, DxilSubobjectAssociationFromTheApi) {
  two_.Subobject("Lrs", 2, {"RootConstants(num32BitConstants=3, b0)"});
  StateObjectDesc desc = Two();
  desc.Add(DxilSubobjectToExportsAssociation{"Lrs", {"B"}});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(LocalBytes("A"), 0u);
  EXPECT_EQ(LocalBytes("B"), 12u);
}

TEST_F(AssociationTest, ROOT_08_KindsOfRootSignature) {
  StateObjectDesc desc = Two();
  desc.Add(LocalRootSignature{Global("CBV(b0)")});
  EXPECT_ERROR(Make(desc), "KA0536", "local");
  desc = Two();
  desc.Add(GlobalRootSignature{Constants(1)});
  EXPECT_ERROR(Make(desc), "KA0536", "global");
}

TEST_F(AssociationTest, LargePipelinesLinkQuickly) {
  LibraryBuilder big("big.hlsl");
  std::vector<std::string> names;
  for (int i = 0; i < 3000; ++i) {
    names.push_back("Miss" + std::to_string(i));
    big.Export(names.back(), Stage::kMiss);
  }
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{big.Build()});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  for (int i = 0; i < 8; ++i) {  // 8 x 3,000 names: quadratic work would take minutes
    desc.Associate(desc.Add(LocalRootSignature{Constants(2)}), names);
  }
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_EQ(LocalBytes("Miss2999"), 8u);
}

// --- bindings ---

class BindingTest : public StateObjectTest {
 protected:
  // Links one miss shader that uses every binding of `builder_`.
  Result<StateObject> LinkMiss(LibraryBuilder& b, std::vector<uint32_t> used,
                               const std::string& global, const std::string& local = "") {
    b.Export("M", Stage::kMiss, std::move(used));
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{b.Build()});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{});
    if (!global.empty()) desc.Add(GlobalRootSignature{Global(global)});
    if (!local.empty()) desc.Add(LocalRootSignature{Local(local)});
    return Make(desc);
  }
  static const shader::BindingSlot& Slot(uint32_t i) { return Linked("M")->shader->slots.at(i); }
};

TEST_F(BindingTest, ROOT_11_EverySourceOfArguments) {
  LibraryBuilder b;
  const uint32_t constants = b.Binding("c", BindingType::kConstantBuffer, 0, 0, 1, 8);
  const uint32_t structured = b.Binding("s", BindingType::kStructuredBuffer, 1, 0, 1, 20);
  const uint32_t raw = b.Binding("r", BindingType::kRawBuffer, 0, 0, 1, 0, true);
  const uint32_t textures = b.Binding("t", BindingType::kTexture, 4, 2, shader::kUnbounded);
  const uint32_t sampler = b.Binding("smp", BindingType::kSampler, 3);
  const uint32_t dynamic = b.Binding("dyn", BindingType::kSampler, 1);
  const uint32_t unused = b.Binding("nope", BindingType::kTexture, 99);
  auto so = LinkMiss(b, {constants, structured, raw, textures, sampler, dynamic},
                     "DescriptorTable(UAV(u7), SRV(t2, space=2, numDescriptors=unbounded)), "
                     "UAV(u0), StaticSampler(s3), DescriptorTable(Sampler(s0, numDescriptors=2))",
                     "RootConstants(num32BitConstants=2, b0), SRV(t1)");
  ASSERT_TRUE(so.ok()) << MessageOf(so);
  EXPECT_EQ(Slot(constants).source, SlotSource::kRootConstants);
  EXPECT_TRUE(Slot(constants).local);
  EXPECT_EQ(Slot(constants).argument_offset, 0u);
  EXPECT_EQ(Slot(constants).size_bytes, 8u);
  EXPECT_EQ(Slot(structured).source, SlotSource::kRootDescriptor);
  EXPECT_TRUE(Slot(structured).local);
  EXPECT_EQ(Slot(structured).argument_offset, 8u);
  EXPECT_EQ(Slot(structured).stride_bytes, 20u);
  EXPECT_EQ(Slot(structured).kind, shader::DescriptorKind::kStructuredBuffer);
  EXPECT_EQ(Slot(raw).source, SlotSource::kRootDescriptor);
  EXPECT_FALSE(Slot(raw).local);
  EXPECT_EQ(Slot(raw).argument_offset, 8u);
  EXPECT_EQ(Slot(raw).access, shader::DescriptorAccess::kUnorderedAccess);
  EXPECT_EQ(Slot(textures).source, SlotSource::kDescriptorTable);
  EXPECT_EQ(Slot(textures).argument_offset, 0u);
  EXPECT_EQ(Slot(textures).descriptor_index, 3u);  // after u7, t2 and t3
  EXPECT_EQ(Slot(textures).descriptor_count, shader::kUnbounded);
  EXPECT_EQ(Slot(sampler).source, SlotSource::kStaticSampler);
  EXPECT_NE(Slot(sampler).static_sampler, nullptr);
  EXPECT_EQ(Slot(dynamic).source, SlotSource::kDescriptorTable);
  EXPECT_EQ(Slot(dynamic).argument_offset, 16u);
  EXPECT_EQ(Slot(dynamic).descriptor_index, 1u);
  EXPECT_EQ(Slot(unused).source, SlotSource::kUnbound);
}

TEST_F(BindingTest, ROOT_11_MissingBindingsFail) {
  LibraryBuilder b;
  const uint32_t t = b.Binding("albedo", BindingType::kTexture, 3, 1);
  EXPECT_ERROR(LinkMiss(b, {t}, ""), "KA0528", "\"albedo\" (t3, space1)", "miss shader \"M\"");
  LibraryBuilder c;
  const uint32_t u = c.Binding("albedo", BindingType::kTexture, 3, 1);
  EXPECT_ERROR(LinkMiss(c, {u}, "DescriptorTable(SRV(t0, numDescriptors=9))"), "KA0528");
}

TEST_F(BindingTest, ROOT_11_LocalAndGlobalDoNotOverlap) {
  LibraryBuilder b;
  EXPECT_ERROR(LinkMiss(b, {}, "DescriptorTable(SRV(t0, numDescriptors=unbounded))", "SRV(t5)"),
               "KA0527", "t5", "parameter 0");
}

TEST_F(BindingTest, RootDescriptorsFeedBuffersOnly) {
  LibraryBuilder b;
  EXPECT_ERROR(LinkMiss(b, {b.Binding("tex", BindingType::kTexture, 0)}, "SRV(t0)"), "KA0529",
               "\"tex\"", "texture");
  LibraryBuilder c;
  EXPECT_ERROR(LinkMiss(c, {c.Binding("typed", BindingType::kTypedBuffer, 0)}, "SRV(t0)"),
               "KA0529");
  LibraryBuilder d;
  EXPECT_ERROR(LinkMiss(d, {d.Binding("array", BindingType::kRawBuffer, 0, 0, 2)}, "SRV(t0)"),
               "KA0529", "array");
  LibraryBuilder e;
  EXPECT_OK(LinkMiss(e, {e.Binding("scene", BindingType::kAccelerationStructure, 0)}, "SRV(t0)"));
}

TEST_F(BindingTest, ArraysMustFitTheirRange) {
  LibraryBuilder b;
  const uint32_t t = b.Binding("array", BindingType::kTexture, 1, 0, 4);
  EXPECT_ERROR(LinkMiss(b, {t}, "DescriptorTable(SRV(t0, numDescriptors=4))"), "KA0529", "4", "3");
  LibraryBuilder c;
  const uint32_t u = c.Binding("array", BindingType::kTexture, 1, 0, shader::kUnbounded);
  ASSERT_TRUE(LinkMiss(c, {u}, "DescriptorTable(SRV(t0, numDescriptors=4))").ok());
  EXPECT_EQ(Slot(u).descriptor_count, 3u);
}

TEST_F(BindingTest, HeapAccessNeedsTheFlag) {
  LibraryBuilder b;
  b.Export("X", Stage::kMiss).flags = shader::kExportUsesViewHeap;
  EXPECT_ERROR(LinkMiss(b, {}, "CBV(b0)"), "KA0528", "ResourceDescriptorHeap");
  LibraryBuilder c;
  c.Export("X", Stage::kMiss).flags = shader::kExportUsesViewHeap;
  EXPECT_OK(LinkMiss(c, {}, "RootFlags(CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED)"));
}

TEST_F(BindingTest, ROOT_14_DifferentGlobalSignaturesInOnePipeline) {
  LibraryBuilder b;
  const uint32_t t = b.Binding("t", BindingType::kRawBuffer, 0);
  b.Export("A", Stage::kRayGeneration, {t});
  b.Export("B", Stage::kRayGeneration, {t});
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{b.Build()});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  desc.Associate(desc.Add(GlobalRootSignature{Global("SRV(t0)")}), {"A"});
  desc.Associate(desc.Add(GlobalRootSignature{Global("CBV(b0), SRV(t0)")}), {"B"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(Linked("A")->shader->slots[t].argument_offset, 0u);
  EXPECT_EQ(Linked("B")->shader->slots[t].argument_offset, 8u);
}

TEST_F(BindingTest, ROOT_15_StaticSamplersOfLocalSignaturesAgree) {
  LibraryBuilder b;
  b.Export("A", Stage::kMiss);
  b.Export("B", Stage::kMiss);
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{b.Build()});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  desc.Associate(desc.Add(LocalRootSignature{Local("StaticSampler(s0)")}), {"A"});
  const uint32_t other =
      desc.Add(LocalRootSignature{Local("CBV(b0), StaticSampler(s0, maxAnisotropy=2)")});
  desc.Associate(other, {"B"});
  EXPECT_ERROR(Make(desc), "KA0530", "s0");
  desc.Subobjects[other] = LocalRootSignature{Local("CBV(b0), StaticSampler(s0)")};
  EXPECT_OK(Make(desc));
}

TEST_F(BindingTest, ROOT_15_StaticSamplersUpTo2032) {
  auto link = [&](uint32_t count) {
    LibraryBuilder b;
    b.Export("A", Stage::kMiss);
    RootSignatureDesc many;
    for (uint32_t i = 0; i < count; ++i) {
      many.StaticSamplers.push_back({.ShaderRegister = i});
    }
    StateObjectDesc desc;
    desc.Add(DxilLibraryDesc{b.Build()});
    desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
    desc.Add(RaytracingPipelineConfig{});
    desc.Add(GlobalRootSignature{device_.CreateRootSignature(many).value()});
    return IdOf(Make(desc));
  };
  EXPECT_EQ(link(2032), "ok");
  EXPECT_EQ(link(2033), "KA0531");
}

TEST_F(BindingTest, SBT_29_OneFunctionWithTwoLocalSignaturesIsNotAliased) {
  LibraryBuilder b;
  const uint32_t c = b.Binding("c", BindingType::kConstantBuffer, 0, 0, 1, 4);
  b.Export("H", Stage::kClosestHit, {c});
  StateObjectDesc desc;
  desc.Add(DxilLibraryDesc{b.Build()});
  desc.Add(RaytracingShaderConfig{.MaxPayloadSizeInBytes = 16});
  desc.Add(RaytracingPipelineConfig{});
  desc.Add(Triangles("one", "H"));
  desc.Add(Triangles("two", "H"));
  desc.Associate(desc.Add(LocalRootSignature{Local("RootConstants(num32BitConstants=1, b0)")}),
                 {"one"});
  desc.Associate(
      desc.Add(LocalRootSignature{Local("SRV(t0), RootConstants(num32BitConstants=1, b0)")}),
      {"two"});
  ASSERT_TRUE(Make(desc).ok());
  EXPECT_EQ(Linked("one")->closest_hit->slots[c].argument_offset, 0u);
  EXPECT_EQ(Linked("two")->closest_hit->slots[c].argument_offset, 8u);
}

}  // namespace
}  // namespace rtapi::testing
