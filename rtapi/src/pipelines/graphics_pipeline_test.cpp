// SPDX-License-Identifier: MIT
//
// Descriptions of graphics pipelines: what links to what, and what is refused.
#include "rtapi/testing/graphics_fixture.h"

namespace rtapi::testing {
namespace {

namespace runtime = kaamos::runtime;
using Class = InputClassification;

TEST_F(GraphicsTest, DefaultsAreThoseOfD3D12) {
  EXPECT_OK(Make(Desc()));
  const auto& linked = Linked();
  EXPECT_EQ(linked.name, "vs");
  EXPECT_TRUE(linked.has_pixel());
  EXPECT_EQ(linked.vertex_columns.position, 0u);
  EXPECT_EQ(linked.pixel_columns.targets[0].first_column, 0u);
  EXPECT_EQ(linked.pixel_columns.targets[0].components, 4u);
  EXPECT_EQ(linked.pixel_columns.targets[1].first_column, runtime::kNoColumn);
  EXPECT_EQ(linked.target_count, 1u);
  EXPECT_EQ(linked.rasterizer.CullMode, CullMode::kBack);
  EXPECT_EQ(linked.depth_stencil.DepthFunc, ComparisonFunc::kLess);
}

TEST_F(GraphicsTest, RAS_25_APixelShaderIsOptional) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.PS = {};
  EXPECT_OK(Make(desc));
  EXPECT_FALSE(Linked().has_pixel());
}

TEST_F(GraphicsTest, RAS_16_AppendedElementsFollowInTheirSlot) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({Value("COLOR", 0, 4), Value("COLOR", 1, 4), Value("COLOR", 2, 4),
                            Value("COLOR", 3, 4), Value("POSITION", 0, 2)},
                           {Position()});
  const auto element = [](const char* name, uint32_t index, Format format, uint32_t slot) {
    return InputElementDesc{
        .SemanticName = name, .SemanticIndex = index, .Format = format, .InputSlot = slot};
  };
  desc.InputLayout = {
      element("COLOR", 2, Format::kR8G8B8A8Unorm, 1), element("COLOR", 3, Format::kR16Float, 5),
      element("POSITION", 0, Format::kR32G32Float, 0), element("COLOR", 0, Format::kR8Unorm, 1),
      element("COLOR", 1, Format::kR32G32B32A32Float, 1)};
  EXPECT_OK(Make(desc));
  const auto& elements = Linked().elements;
  ASSERT_EQ(elements.size(), 5u);
  const auto offset = [&](size_t i) {
    return std::pair(elements[i].slot, elements[i].offset_bytes);
  };
  EXPECT_EQ(offset(0), std::pair(1u, 4u));  // COLOR0, a byte behind COLOR2
  EXPECT_EQ(offset(1), std::pair(1u, 8u));  // COLOR1, aligned to 4 behind that
  EXPECT_EQ(offset(2), std::pair(1u, 0u));  // COLOR2
  EXPECT_EQ(offset(3), std::pair(5u, 0u));
  EXPECT_EQ(offset(4), std::pair(0u, 0u));
}

TEST_F(GraphicsTest, RAS_17_SemanticsMatchWithoutRegardToCase) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({Value("COLOR", 2, 3)}, {Position()});
  desc.InputLayout = {
      {.SemanticName = "spare", .Format = Format::kR32Float},
      {.SemanticName = "CoLoR", .SemanticIndex = 2, .Format = Format::kR32G32B32Float}};
  EXPECT_OK(Make(desc));
  ASSERT_EQ(Linked().elements.size(), 1u);
  EXPECT_EQ(Linked().elements[0].offset_bytes, 4u);
  EXPECT_EQ(Linked().elements[0].components, 3u);
  desc.InputLayout[1].SemanticIndex = 1;
  EXPECT_ERROR(Make(desc), "KA0723", "COLOR2 (float3, vs.hlsl:7)", "spare0, CoLoR1");
  desc.InputLayout[1].SemanticIndex = 2;
  desc.InputLayout[0] = desc.InputLayout[1];
  EXPECT_ERROR(Make(desc), "KA0723", "twice");
}

TEST_F(GraphicsTest, RAS_18_TypesOfElementsFitTheShader) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({Value("A", 0, 1)}, {Position()});
  desc.InputLayout = {{.SemanticName = "A", .Format = Format::kR32Uint}};
  EXPECT_ERROR(Make(desc), "KA0723", "A0 (float", "gives uint");
  for (const Format format : {Format::kR16Float, Format::kR8Unorm, Format::kR16Snorm}) {
    desc.InputLayout[0].Format = format;
    EXPECT_OK(Make(desc));
  }
  desc.VS.Library = Vertex({Value("A", 0, 1, T::kInt)}, {Position()});
  desc.InputLayout[0].Format = Format::kR8Sint;
  EXPECT_OK(Make(desc));
  desc.InputLayout[0].Format = Format::kR8Uint;
  EXPECT_ERROR(Make(desc), "KA0723", "A0 (int");
}

TEST_F(GraphicsTest, ElementsAreChecked) {
  GraphicsPipelineStateDesc desc = Desc();
  const auto with = [&](InputElementDesc element) {
    desc.InputLayout = {std::move(element)};
    return Make(desc);
  };
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kR32Float, .InputSlot = 32}), "KA0723",
               "slot 32");
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kR32Float, .AlignedByteOffset = 2}),
               "KA0723", "multiple of 4");
  EXPECT_OK(with({.SemanticName = "A", .Format = Format::kR8Unorm, .AlignedByteOffset = 3}));
  EXPECT_OK(with({.SemanticName = "A", .Format = Format::kR32Float, .AlignedByteOffset = 2044}));
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kR32Float, .AlignedByteOffset = 2048}),
               "KA0723", "2048");
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kD32Float}), "KA0723", "format 40");
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kR32Typeless}), "KA0723");
  EXPECT_ERROR(with({.SemanticName = "A", .Format = Format::kR32Float, .InstanceDataStepRate = 1}),
               "KA0723", "step rate");
  desc.InputLayout = {{.SemanticName = "A", .Format = Format::kR32Float},
                      {.SemanticName = "B",
                       .Format = Format::kR32Float,
                       .InputSlotClass = Class::kPerInstanceData,
                       .InstanceDataStepRate = 1}};
  EXPECT_ERROR(Make(desc), "KA0723", "slot 0");
  desc.InputLayout.assign(33, {.SemanticName = "A", .Format = Format::kR32Float});
  EXPECT_ERROR(Make(desc), "KA0723", "33 elements");
}

TEST_F(GraphicsTest, RAS_21_StagesLinkBySemantics) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({}, {Value("UV", 0, 2), Position(), Value("COLOR", 1, 4)});
  desc.PS.Library = Pixel({Value("uv", 0, 2), Value("color", 1, 3)}, {Target(0)});
  EXPECT_OK(Make(desc));
  const auto& varyings = Linked().varyings;
  ASSERT_EQ(varyings.size(), 2u);
  EXPECT_EQ(varyings[0].vertex_column, 0u);
  EXPECT_EQ(varyings[1].vertex_column, 6u);
  EXPECT_EQ(varyings[1].pixel_column, 2u);
  EXPECT_EQ(varyings[1].components, 3u);
  EXPECT_EQ(Linked().vertex_columns.position, 2u);
  desc.PS.Library = Pixel({Value("UV", 0, 4)}, {Target(0)});
  EXPECT_ERROR(Make(desc), "KA0724", "UV0 (float4, ps.hlsl:7)", "UV0 (float2, vs.hlsl:7)");
  desc.PS.Library = Pixel({Value("UV", 0, 2, T::kUint)}, {Target(0)});
  EXPECT_ERROR(Make(desc), "KA0724", "uint2");
  desc.PS.Library = Pixel({Value("UV", 1, 2)}, {Target(0)});
  EXPECT_ERROR(Make(desc), "KA0724", "does not write");
}

TEST_F(GraphicsTest, RAS_21_AnotherOrderIsAWarning) {
  std::vector<std::string> messages;
  device_ = CreateNullDevice({.OnMessage = [&](const Message& m) { messages.push_back(m.Text); }});
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({}, {Position(), Value("A", 0, 1), Value("B", 0, 1)});
  desc.PS.Library = Pixel({Value("A", 0, 1), Value("B", 0, 1)}, {Target(0)});
  EXPECT_OK(Make(desc));
  EXPECT_TRUE(messages.empty());
  desc.PS.Library = Pixel({Value("B", 0, 1), Value("A", 0, 1)}, {Target(0)});
  EXPECT_OK(Make(desc));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("KA0728"), std::string::npos);
  EXPECT_NE(messages[0].find("another order"), std::string::npos);
}

TEST_F(GraphicsTest, RAS_23_ClipAndCullDistancesAreAtMostEight) {
  const auto clip = [](uint32_t index, uint8_t n) {
    return LibraryBuilder::Element("SV_ClipDistance", index, n, T::kFloat, V::kClipDistance);
  };
  const auto cull = [](uint32_t index, uint8_t n) {
    return LibraryBuilder::Element("SV_CullDistance", index, n, T::kFloat, V::kCullDistance);
  };
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({}, {Position(), clip(0, 4), cull(0, 4)});
  EXPECT_OK(Make(desc));
  EXPECT_EQ(Linked().vertex_columns.clip_distances, (std::vector<uint32_t>{4, 5, 6, 7}));
  EXPECT_EQ(Linked().vertex_columns.cull_distances, (std::vector<uint32_t>{8, 9, 10, 11}));
  desc.VS.Library = Vertex({}, {Position(), clip(0, 4), clip(1, 1), cull(0, 4)});
  EXPECT_ERROR(Make(desc), "KA0724", "5 clip", "4 cull");
}

TEST_F(GraphicsTest, RAS_24_TheVertexShaderWritesAPosition) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({}, {Value("UV", 0, 2)});
  EXPECT_ERROR(Make(desc), "KA0724", "SV_Position");
}

TEST_F(GraphicsTest, RAS_79_InstanceIdsArePassedOn) {
  const auto id = [](V value) {
    return LibraryBuilder::Element("SV_InstanceID", 0, 1, T::kUint, value);
  };
  GraphicsPipelineStateDesc desc = Desc();
  desc.PS.Library = Pixel({id(V::kNone)}, {Target(0)});
  EXPECT_ERROR(Make(desc), "KA0724", "SV_InstanceID0");
  desc.VS.Library = Vertex({id(V::kInstanceId)}, {Position(), id(V::kNone)});
  EXPECT_OK(Make(desc));
  EXPECT_EQ(Linked().vertex_columns.instance_id, 0u);
  EXPECT_EQ(Linked().varyings.at(0).interpolation, shader::Interpolation::kNoInterpolation);
}

TEST_F(GraphicsTest, RAS_80_ThirtyTwoVectorsAtMost) {
  Elements outputs = {Position()};
  for (uint32_t i = 0; i < 31; ++i) outputs.push_back(Value("T", i, 4));
  GraphicsPipelineStateDesc desc = Desc();
  desc.VS.Library = Vertex({}, outputs);
  EXPECT_OK(Make(desc));
  outputs.push_back(Value("T", 31, 4));
  desc.VS.Library = Vertex({}, outputs);
  EXPECT_ERROR(Make(desc), "KA0724", "33 vectors");
}

TEST_F(GraphicsTest, RAS_112_OutputsThatDoNotFitTheirTargetsAreWarnings) {
  std::vector<std::string> messages;
  device_ = CreateNullDevice({.OnMessage = [&](const Message& m) { messages.push_back(m.Text); }});
  GraphicsPipelineStateDesc desc = Desc();
  desc.RTVFormats = {Format::kR32Uint};
  EXPECT_OK(Make(desc));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("KA0725"), std::string::npos) << messages[0];
  EXPECT_NE(messages[0].find("SV_Target0 (float4"), std::string::npos) << messages[0];
  EXPECT_NE(messages[0].find("takes uint"), std::string::npos) << messages[0];
  desc.PS.Library = Pixel({}, {Target(0, 1, T::kUint)});
  EXPECT_OK(Make(desc));
  EXPECT_EQ(messages.size(), 1u);
  desc.RTVFormats = {Format::kR8G8B8A8UnormSrgb};
  EXPECT_OK(Make(desc));
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_NE(messages[1].find("takes float"), std::string::npos) << messages[1];
}

TEST_F(GraphicsTest, RAS_122_WithoutIndependentBlendingTargetZeroDecides) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.RTVFormats = {Format::kR8Unorm, Format::kR8Unorm};
  desc.BlendState.RenderTarget[0].RenderTargetWriteMask = ColorWriteEnable::kRed;
  desc.BlendState.RenderTarget[1].RenderTargetWriteMask = ColorWriteEnable::kBlue;
  EXPECT_OK(Make(desc));
  EXPECT_EQ(Linked().blend[1].RenderTargetWriteMask, ColorWriteEnable::kRed);
  desc.BlendState.IndependentBlendEnable = true;
  EXPECT_OK(Make(desc));
  EXPECT_EQ(Linked().blend[1].RenderTargetWriteMask, ColorWriteEnable::kBlue);
}

TEST_F(GraphicsTest, RAS_123_IntegersDoNotBlend) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.PS.Library = Pixel({}, {Target(0, 4, T::kUint)});
  desc.RTVFormats = {Format::kR8G8B8A8Uint};
  EXPECT_OK(Make(desc));
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  EXPECT_ERROR(Make(desc), "KA0726", "RTVFormats[0]", "integers");
}

TEST_F(GraphicsTest, RAS_125_WhatABackendCannotBlendIsNamed) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.RTVFormats = {Format::kR8G8B8A8Snorm};
  EXPECT_OK(Make(desc));
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  EXPECT_ERROR(Make(desc), "KA0726", "cannot blend");
  desc.RTVFormats = {Format::kR9G9B9E5Sharedexp};
  EXPECT_ERROR(Make(desc), "KA0726", "cannot draw to");
}

TEST_F(GraphicsTest, RAS_142_RootSignaturesSayWhatAStageMayUse) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.pRootSignature = Global("RootFlags(0)");
  EXPECT_OK(Make(desc));
  desc.InputLayout = {{.SemanticName = "A", .Format = Format::kR32Float}};
  EXPECT_ERROR(Make(desc), "KA0727", "kAllowInputAssemblerInputLayout");
  LibraryBuilder b("ps.hlsl", "ps_6_6");
  const uint32_t image = b.Binding("image", shader::BindingType::kTexture, 0);
  b.GraphicsExport("ps", shader::Stage::kPixel, {}, {Target(0)}, {image});
  desc = Desc();
  desc.PS.Library = b.Build();
  desc.pRootSignature = Global(
      "RootFlags(DENY_PIXEL_SHADER_ROOT_ACCESS), "
      "DescriptorTable(SRV(t0))");
  EXPECT_ERROR(Make(desc), "KA0727", "kDenyPixelShaderRootAccess");
  desc.pRootSignature = Global("DescriptorTable(SRV(t0), visibility=SHADER_VISIBILITY_VERTEX)");
  EXPECT_ERROR(Make(desc), "KA0528", "image");
  desc.pRootSignature = Global("DescriptorTable(SRV(t0), visibility=SHADER_VISIBILITY_PIXEL)");
  EXPECT_OK(Make(desc));
}

TEST_F(GraphicsTest, ZeroedDescriptionsAreNoticed) {
  GraphicsPipelineStateDesc desc = Desc();
  desc.RasterizerState.FillMode = FillMode{};
  EXPECT_ERROR(Make(desc), "KA0720", "zeroed");
  desc = Desc();
  desc.RasterizerState.CullMode = CullMode{};
  EXPECT_ERROR(Make(desc), "KA0720", "CullMode");
  desc = Desc();
  desc.DepthStencilState.DepthFunc = ComparisonFunc{};
  EXPECT_ERROR(Make(desc), "KA0720", "DepthFunc");
  desc.DepthStencilState.DepthEnable = false;
  EXPECT_OK(Make(desc));
  desc = Desc();
  desc.DepthStencilState.BackFace.StencilFailOp = StencilOp{};
  desc.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc{9};
  EXPECT_OK(Make(desc));
  desc.DepthStencilState.StencilEnable = true;
  EXPECT_ERROR(Make(desc), "KA0720", "FrontFace.StencilFunc is 9", "1 to 8");
  desc.DepthStencilState.FrontFace.StencilFunc = ComparisonFunc::kAlways;
  EXPECT_ERROR(Make(desc), "KA0720", "BackFace.StencilFailOp is 0", "1 to 8");
  desc.DepthStencilState.BackFace.StencilFailOp = StencilOp::kDecr;
  EXPECT_OK(Make(desc));
  desc.DepthStencilState.BackFace.StencilDepthFailOp = StencilOp{9};
  EXPECT_ERROR(Make(desc), "KA0720", "BackFace.StencilDepthFailOp is 9");
  desc = Desc();
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].SrcBlend = Blend{};
  EXPECT_ERROR(Make(desc), "KA0720", "SrcBlend");
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kOne;
  desc.BlendState.RenderTarget[0].SrcBlendAlpha = Blend::kSrcColor;
  EXPECT_ERROR(Make(desc), "KA0720", "SrcBlendAlpha");
  desc = Desc();
  desc.PrimitiveTopologyType = PrimitiveTopologyType::kUndefined;
  EXPECT_ERROR(Make(desc), "KA0720", "PrimitiveTopologyType");
  desc = Desc();
  desc.RTVFormats.assign(9, Format::kR8Unorm);
  EXPECT_ERROR(Make(desc), "KA0720", "9 formats");
  desc = Desc();
  desc.DSVFormat = Format::kR32Float;
  EXPECT_ERROR(Make(desc), "KA0726", "depth format");
}

TEST_F(GraphicsTest, WhatIsNotOfferedIsNamed) {
  const auto without = [&](auto change, const char* what) {
    GraphicsPipelineStateDesc desc = Desc();
    change(desc);
    EXPECT_ERROR(Make(desc), "KA0721", what);
  };
  without([](auto& d) { d.PrimitiveTopologyType = PrimitiveTopologyType::kPatch; }, "kPatch");
}

TEST_F(GraphicsTest, SecondSourcesAndLogicOperations) {
  GraphicsPipelineStateDesc desc = Desc();
  RenderTargetBlendDesc& target = desc.BlendState.RenderTarget[0];
  target.BlendEnable = true;
  target.SrcBlend = Blend::kSrc1Color;
  EXPECT_OK(Make(desc));
  desc.RTVFormats.push_back(Format::kR8Unorm);
  EXPECT_OK(Make(desc));  // nothing writes it
  desc = Desc();
  target.LogicOpEnable = true;
  EXPECT_ERROR(Make(desc), "KA0726", "logic operations");
  target.LogicOp = static_cast<LogicOp>(16);
  EXPECT_ERROR(Make(desc), "KA0720", "LogicOp is 16");
  target.BlendEnable = true;
  EXPECT_ERROR(Make(desc), "KA0720", "BlendEnable");
}

TEST_F(GraphicsTest, ShadersAreFoundByStageAndName) {
  GraphicsPipelineStateDesc desc = Desc();
  std::swap(desc.VS.Library, desc.PS.Library);
  EXPECT_ERROR(Make(desc), "KA0722", "no vertex shader", "none");
  LibraryBuilder b("both.hlsl");
  b.GraphicsExport("a", shader::Stage::kVertex, {}, {Position()});
  b.GraphicsExport("b", shader::Stage::kVertex, {}, {Position()});
  desc = Desc();
  desc.VS.Library = b.Build();
  EXPECT_ERROR(Make(desc), "KA0722", "several");
  desc.VS.EntryPoint = "b";
  EXPECT_OK(Make(desc));
  desc.VS.EntryPoint = "c";
  EXPECT_ERROR(Make(desc), "KA0722", "\"a\", \"b\"");
  desc.VS = {};
  EXPECT_ERROR(Make(desc), "KA0904", "VS.Library");
}

TEST_F(GraphicsTest, RAS_127_AnEmptySampleMaskIsAWarning) {
  std::string text;
  device_ = CreateNullDevice({.OnMessage = [&](const Message& m) { text = m.Text; }});
  GraphicsPipelineStateDesc desc = Desc();
  desc.SampleMask = 0xFFFFFFFE;
  EXPECT_OK(Make(desc));
  EXPECT_NE(text.find("KA0728"), std::string::npos);
  EXPECT_NE(text.find("0xFFFFFFFF"), std::string::npos);
}

}  // namespace
}  // namespace rtapi::testing
