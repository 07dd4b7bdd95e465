// SPDX-License-Identifier: MIT
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

using testing::CreateNullDevice;

class RootSignatureTest : public ::testing::Test {
 protected:
  Result<RootSignature> Make(const char* text) { return device_.CreateRootSignature(text); }
  RootSignatureDesc Local(std::vector<RootParameter> parameters) {
    return {.Parameters = std::move(parameters), .Flags = RootSignatureFlags::kLocalRootSignature};
  }
  Device device_ = CreateNullDevice();
};

TEST_F(RootSignatureTest, ROOT_05_WorkedExampleOfRecordLayout) {
  auto s = device_.CreateRootSignature(
      Local({RootParameter::Constants32(1, 0), RootParameter::Srv(0),
             RootParameter::Constants32(3, 1), RootParameter::Table({DescriptorRange{}})}));
  // The range covers t0 as well, so move it away.
  EXPECT_ERROR(s, "KA0604", "t0");
  s = device_.CreateRootSignature(Local(
      {RootParameter::Constants32(1, 0), RootParameter::Srv(0), RootParameter::Constants32(3, 1),
       RootParameter::Table({DescriptorRange{.BaseShaderRegister = 7}})}));
  ASSERT_TRUE(s.ok());
  EXPECT_EQ(s->GetArgumentOffset(0) + 32, 32u);
  EXPECT_EQ(s->GetArgumentOffset(1) + 32, 40u);
  EXPECT_EQ(s->GetArgumentOffset(2) + 32, 48u);
  EXPECT_EQ(s->GetArgumentOffset(3) + 32, 64u);
  EXPECT_EQ(s->GetArgumentBytes() + 32, 72u);
  EXPECT_EQ(s->GetArgumentOffset(4), 0u);
}

TEST_F(RootSignatureTest, ROOT_04_ConstantsStayContiguous) {
  auto s = Make(
      "RootFlags(LOCAL_ROOT_SIGNATURE), RootConstants(num32BitConstants=1, b0), "
      "RootConstants(num32BitConstants=2, b1)");
  ASSERT_TRUE(s.ok());
  EXPECT_EQ(s->GetArgumentOffset(1), 4u);
  EXPECT_EQ(s->GetArgumentBytes(), 12u);
}

TEST_F(RootSignatureTest, ROOT_07_LocalFootprintUpTo4064Bytes) {
  EXPECT_OK(device_.CreateRootSignature(Local({RootParameter::Constants32(1016, 0)})));
  EXPECT_ERROR(device_.CreateRootSignature(Local({RootParameter::Constants32(1017, 0)})), "KA0601",
               "4068", "4064");
}

TEST_F(RootSignatureTest, ROOT_07_LocalFootprintCannotOverflow) {
  EXPECT_ERROR(device_.CreateRootSignature(Local(
                   {RootParameter::Constants32(0xFFFFFFFFu, 0), RootParameter::Constants32(2, 1)})),
               "KA0601");
}

TEST_F(RootSignatureTest, GlobalCostUpTo64Dwords) {
  EXPECT_OK(Make("RootConstants(num32BitConstants=62, b0), SRV(t0)"));
  EXPECT_ERROR(Make("RootConstants(num32BitConstants=62, b0), SRV(t0), DescriptorTable(UAV(u0))"),
               "KA0600", "65", "64");
}

TEST_F(RootSignatureTest, ROOT_08_LocalFlagStandsAlone) {
  RootSignatureDesc desc = Local({});
  desc.Flags |= RootSignatureFlags::kAllowInputAssemblerInputLayout;
  EXPECT_ERROR(device_.CreateRootSignature(desc), "KA0602", "0x81");
  desc.Flags = static_cast<RootSignatureFlags>(0x8000);
  EXPECT_ERROR(device_.CreateRootSignature(desc), "KA0602");
}

TEST_F(RootSignatureTest, ROOT_09_LocalVisibilityIsAll) {
  RootParameter parameter = RootParameter::Srv(0);
  parameter.ShaderVisibility = ShaderVisibility::kPixel;
  EXPECT_ERROR(device_.CreateRootSignature(Local({parameter})), "KA0603", "parameter 0");
  parameter.ShaderVisibility = static_cast<ShaderVisibility>(8);
  EXPECT_ERROR(device_.CreateRootSignature({.Parameters = {parameter}}), "KA0603", "0 to 7");
}

TEST_F(RootSignatureTest, StagesMayShareRegisters) {
  EXPECT_OK(
      Make("CBV(b0, visibility=SHADER_VISIBILITY_VERTEX), "
           "CBV(b0, visibility=SHADER_VISIBILITY_PIXEL)"));
  EXPECT_ERROR(Make("CBV(b0, visibility=SHADER_VISIBILITY_VERTEX), CBV(b0)"), "KA0604", "b0");
  EXPECT_OK(
      Make("StaticSampler(s0, visibility=SHADER_VISIBILITY_PIXEL), "
           "StaticSampler(s0, visibility=SHADER_VISIBILITY_VERTEX)"));
}

TEST_F(RootSignatureTest, OverlapsAreFoundBetweenAllKinds) {
  EXPECT_ERROR(Make("CBV(b0), RootConstants(num32BitConstants=1, b0)"), "KA0604", "b0");
  EXPECT_ERROR(Make("SRV(t5), DescriptorTable(SRV(t0, numDescriptors=6))"), "KA0604", "t5");
  EXPECT_ERROR(Make("DescriptorTable(SRV(t0, numDescriptors=unbounded), SRV(t900, offset=0))"),
               "KA0604");
  EXPECT_ERROR(Make("StaticSampler(s1), DescriptorTable(Sampler(s0, numDescriptors=2))"), "KA0604",
               "static sampler");
  EXPECT_OK(Make("SRV(t0), SRV(t0, space=1), UAV(u0), CBV(b0), StaticSampler(s0)"));
}

TEST_F(RootSignatureTest, TablesAreChecked) {
  EXPECT_ERROR(device_.CreateRootSignature({.Parameters = {RootParameter::Table({})}}), "KA0607");
  EXPECT_ERROR(Make("DescriptorTable(SRV(t0, numDescriptors=0))"), "KA0607");
  EXPECT_ERROR(Make("DescriptorTable(SRV(t4294967295, numDescriptors=2))"), "KA0607");
  EXPECT_ERROR(Make("DescriptorTable(SRV(t0, numDescriptors=unbounded), UAV(u0))"), "KA0607",
               "range 1");
  EXPECT_ERROR(Make("DescriptorTable(SRV(t0), Sampler(s0))"), "KA0606");
  EXPECT_ERROR(Make("SRV(t0, space=4294967295)"), "KA0605", "reserved");
}

TEST_F(RootSignatureTest, AppendFollowsTheRangeBefore) {
  auto s = Make(
      "DescriptorTable(SRV(t0, numDescriptors=3), UAV(u0, numDescriptors=2), "
      "CBV(b0, offset=10), SRV(t8))");
  ASSERT_TRUE(s.ok());
  const auto& ranges = s->GetDesc().Parameters[0].DescriptorTable.Ranges;
  EXPECT_EQ(ranges[1].OffsetInDescriptorsFromTableStart, 3u);
  EXPECT_EQ(ranges[2].OffsetInDescriptorsFromTableStart, 10u);
  EXPECT_EQ(ranges[3].OffsetInDescriptorsFromTableStart, 11u);
}

TEST_F(RootSignatureTest, StaticSamplersReachTheBackend) {
  EXPECT_OK(
      Make("StaticSampler(s2, filter=FILTER_MIN_MAG_MIP_POINT, "
           "addressU=TEXTURE_ADDRESS_CLAMP, maxLOD=3.5, "
           "borderColor=STATIC_BORDER_COLOR_OPAQUE_BLACK)"));
  const SamplerDesc& d = testing::null_log().samplers.at(0);
  EXPECT_EQ(d.Filter, Filter::kMinMagMipPoint);
  EXPECT_EQ(d.AddressU, TextureAddressMode::kClamp);
  EXPECT_EQ(d.AddressV, TextureAddressMode::kWrap);
  EXPECT_EQ(d.MaxLOD, 3.5f);
  EXPECT_EQ(d.BorderColor[0], 0.0f);
  EXPECT_EQ(d.BorderColor[3], 1.0f);
}

TEST_F(RootSignatureTest, ConstantsHaveValues) {
  EXPECT_ERROR(Make("RootConstants(num32BitConstants=0, b0)"), "KA0609", "parameter 0");
}

TEST_F(RootSignatureTest, BadEnumsAreErrors) {
  RootParameter p;
  p.ParameterType = static_cast<RootParameterType>(9);
  EXPECT_ERROR(device_.CreateRootSignature({.Parameters = {p}}), "KA0605", "9");
  StaticSamplerDesc s;
  s.AddressU = static_cast<TextureAddressMode>(0);
  EXPECT_ERROR(device_.CreateRootSignature({.StaticSamplers = {s}}), "KA0610");
  s = {};
  s.MipLODBias = std::nanf("");
  EXPECT_ERROR(device_.CreateRootSignature({.StaticSamplers = {s}}), "KA0610", "MipLODBias");
}

// --- the HLSL language ---

TEST(RootSignatureText, ReadsEveryClause) {
  auto d = ParseRootSignature(
      "RootFlags( CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED | SAMPLER_HEAP_DIRECTLY_INDEXED ),\n"
      "CBV(b0, space=1, flags=DATA_STATIC), SRV(t3), UAV(u2, visibility=SHADER_VISIBILITY_ALL),\n"
      "RootConstants(b9, num32BitConstants=0x4, space=2),\n"
      "DescriptorTable(CBV(b1), UAV(u0, numDescriptors=4, space=3, offset=7,"
      " flags=DESCRIPTORS_VOLATILE|DATA_VOLATILE), visibility=SHADER_VISIBILITY_ALL,"
      " SRV(t8, numDescriptors=UNBOUNDED, offset=DESCRIPTOR_RANGE_OFFSET_APPEND)),\n"
      "staticsampler(S1, mipLODBias=-0.5f, maxAnisotropy=4, minLOD=1e-2, "
      "comparisonFunc=COMPARISON_NOT_EQUAL)");
  ASSERT_TRUE(d.ok()) << testing::MessageOf(d);
  EXPECT_EQ(static_cast<uint32_t>(d->Flags), 0xC00u);
  ASSERT_EQ(d->Parameters.size(), 5u);
  EXPECT_EQ(d->Parameters[0].Descriptor.RegisterSpace, 1u);
  EXPECT_EQ(d->Parameters[0].Descriptor.Flags, RootDescriptorFlags::kDataStatic);
  EXPECT_EQ(d->Parameters[3].Constants.Num32BitValues, 4u);
  EXPECT_EQ(d->Parameters[3].Constants.ShaderRegister, 9u);
  const auto& ranges = d->Parameters[4].DescriptorTable.Ranges;
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_EQ(ranges[1].OffsetInDescriptorsFromTableStart, 7u);
  EXPECT_EQ(static_cast<uint32_t>(ranges[1].Flags), 3u);
  EXPECT_EQ(ranges[2].NumDescriptors, kUnboundedDescriptors);
  ASSERT_EQ(d->StaticSamplers.size(), 1u);
  EXPECT_EQ(d->StaticSamplers[0].MipLODBias, -0.5f);
  EXPECT_EQ(d->StaticSamplers[0].MinLOD, 0.01f);
  EXPECT_EQ(d->StaticSamplers[0].ComparisonFunc, ComparisonFunc::kNotEqual);
  EXPECT_EQ(d->StaticSamplers[0].BorderColor, StaticBorderColor::kOpaqueWhite);
}

TEST(RootSignatureText, FlagsAndIntegerBordersOfStaticSamplers) {
  const auto d = ParseRootSignature(
      "StaticSampler(s0, borderColor=STATIC_BORDER_COLOR_OPAQUE_WHITE_UINT, "
      "flags=UINT_BORDER_COLOR), StaticSampler(s1, flags=0)");
  ASSERT_TRUE(d.ok()) << testing::MessageOf(d);
  EXPECT_EQ(d->StaticSamplers[0].BorderColor, StaticBorderColor::kOpaqueWhiteUint);
  EXPECT_EQ(d->StaticSamplers[0].Flags, SamplerFlags::kUintBorderColor);
  EXPECT_EQ(d->StaticSamplers[1].Flags, SamplerFlags::kNone);
  RootSignatureDesc unknown = *d;
  EXPECT_OK(CheckRootSignature(unknown));
  unknown.StaticSamplers[1].Flags = static_cast<SamplerFlags>(2);
  EXPECT_ERROR(CheckRootSignature(unknown), "KA0610", "0x2");
}

TEST(RootSignatureText, EmptyAndZeroFlags) {
  EXPECT_OK(ParseRootSignature(""));
  EXPECT_OK(ParseRootSignature("  \n"));
  EXPECT_OK(ParseRootSignature("RootFlags(0)"));
}

TEST(RootSignatureText, ArgumentsInAnyOrderAndSigns) {
  const auto d = ParseRootSignature(
      "RootConstants(space=+2, visibility=SHADER_VISIBILITY_ALL, num32BitConstants=+61, b3),"
      "SRV(flags=DATA_VOLATILE, space=1, t4), DescriptorTable(visibility=SHADER_VISIBILITY_ALL,"
      "UAV(numDescriptors=+5, offset=+7, u6)),"
      "StaticSampler(filter=FILTER_ANISOTROPIC, maxAnisotropy=+4, mipLODBias=+1.5, s8, minLOD=-1)");
  ASSERT_EQ(testing::MessageOf(d), "ok");
  ASSERT_EQ(d->Parameters.size(), 3u);
  EXPECT_EQ(d->Parameters[0].Constants.Num32BitValues, 61u);
  EXPECT_EQ(d->Parameters[0].Constants.ShaderRegister, 3u);
  EXPECT_EQ(d->Parameters[0].Constants.RegisterSpace, 2u);
  EXPECT_EQ(d->Parameters[1].Descriptor.ShaderRegister, 4u);
  EXPECT_EQ(d->Parameters[1].Descriptor.RegisterSpace, 1u);
  const DescriptorRange& range = d->Parameters[2].DescriptorTable.Ranges.at(0);
  EXPECT_EQ(range.BaseShaderRegister, 6u);
  EXPECT_EQ(range.NumDescriptors, 5u);
  EXPECT_EQ(range.OffsetInDescriptorsFromTableStart, 7u);
  ASSERT_EQ(d->StaticSamplers.size(), 1u);
  EXPECT_EQ(d->StaticSamplers[0].ShaderRegister, 8u);
  EXPECT_EQ(d->StaticSamplers[0].MaxAnisotropy, 4u);
  EXPECT_EQ(d->StaticSamplers[0].MipLODBias, 1.5f);
  EXPECT_EQ(d->StaticSamplers[0].MinLOD, -1.0f);
}

struct BadText {
  const char* text;
  const char* column;
};
class RootSignatureBadText : public ::testing::TestWithParam<BadText> {};
TEST_P(RootSignatureBadText, NamesTheColumn) {
  EXPECT_ERROR(ParseRootSignature(GetParam().text), "KA0608",
               std::string("column ") + GetParam().column + ":");
}
INSTANTIATE_TEST_SUITE_P(
    All, RootSignatureBadText,
    ::testing::Values(BadText{"Foo(b0)", "1"}, BadText{"CBV(b0", "7"}, BadText{"CBV(t0)", "5"},
                      BadText{"CBV(b)", "5"}, BadText{"CBV(b0) SRV(t0)", "9"},
                      BadText{"CBV(b0),", "9"}, BadText{"CBV(b0, spice=1)", "9"},
                      BadText{"CBV(b0, space=x)", "15"}, BadText{"CBV(b0, space=1, space=2)", "18"},
                      BadText{"CBV(b99999999999)", "6"}, BadText{"RootFlags(NOT_A_FLAG)", "11"},
                      BadText{"RootFlags(0), RootFlags(0)", "24"},
                      BadText{"RootConstants(b0)", "17"}, BadText{"CBV(space=1)", "12"},
                      BadText{"CBV(b0, b1)", "9"}, BadText{"CBV(b0, space=+)", "16"},
                      BadText{"CBV(b0, space=+ 1)", "16"}, BadText{"CBV(b0, space=-1)", "15"},
                      BadText{"RootConstants(b0, num32BitConstants=1, num32BitConstants=2)", "40"},
                      BadText{"SRV(u0)", "5"}, BadText{"StaticSampler(filter)", "15"},
                      BadText{"RootConstants(num32BitConstants=1)", "34"},
                      BadText{"DescriptorTable(Foo(b0))", "17"}, BadText{"DescriptorTable()", "17"},
                      BadText{"StaticSampler(s0, filter=LINEAR)", "26"},
                      BadText{"StaticSampler(s0, minLOD=x)", "26"},
                      BadText{"StaticSampler(s0, minLOD=inf)", "26"},
                      BadText{"SRV(t0, flags=DESCRIPTORS_VOLATILE)", "36"}));

TEST(RootSignatureText, EveryPrefixIsAnErrorOrReadsWithoutCrash) {
  const std::string text =
      "RootFlags(LOCAL_ROOT_SIGNATURE|0),DescriptorTable(SRV(t0,numDescriptors=unbounded,space=1)),"
      "StaticSampler(s0,filter=FILTER_ANISOTROPIC,maxLOD=1.5e3f),RootConstants(num32BitConstants=1,"
      "b0)";
  int readable = 0;
  for (size_t n = 0; n <= text.size(); ++n) {
    readable += ParseRootSignature(std::string_view(text).substr(0, n)).ok();
  }
  EXPECT_EQ(readable, 5);  // the empty text, and the text after each of the four clauses
}

TEST_F(RootSignatureTest, DescriptionsAreCheckedWithoutADevice) {
  EXPECT_OK(CheckRootSignature(Local({RootParameter::Constants32(1016, 0)})));
  EXPECT_ERROR(CheckRootSignature(Local({RootParameter::Constants32(1017, 0)})), "KA0601", "4068");
  EXPECT_ERROR(CheckRootSignature({.Parameters = {RootParameter::Srv(0), RootParameter::Srv(0)}}),
               "KA0604", "t0");
}

}  // namespace
}  // namespace rtapi
