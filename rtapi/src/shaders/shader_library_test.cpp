// SPDX-License-Identifier: MIT
//
// Loading libraries, and compute pipelines made of them.
#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/library_builder.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

using testing::LibraryBuilder;

namespace sh = kaamos::shader;

TEST(ShaderLibraryTest, ReflectsExports) {
  LibraryBuilder b("a.hlsl", "lib_6_5");
  const uint32_t t = b.Binding("albedo", sh::BindingType::kTexture, 0);
  auto& hit = b.Export("Hit", sh::Stage::kClosestHit, {t});
  hit.payload_bytes = 12;
  hit.attribute_bytes = 8;
  b.Export("Kernel", sh::Stage::kCompute);
  const ShaderLibrary library = b.Build();
  EXPECT_EQ(library.name(), "a.hlsl");
  EXPECT_EQ(library.target(), "lib_6_5");
  ASSERT_EQ(library.GetExports().size(), 2u);
  const ShaderExportInfo* info = library.FindExport("Hit");
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(info->Stage, ShaderStage::kClosestHit);
  EXPECT_EQ(info->PayloadSizeInBytes, 12u);
  EXPECT_EQ(info->AttributeSizeInBytes, 8u);
  EXPECT_EQ(info->Resources, std::vector<std::string>{"albedo"});
  EXPECT_EQ(library.FindExport("\x01?Hit@@YAXXZ"), info);
  EXPECT_EQ(library.FindExport("Kernel")->ThreadGroup[0], 8u);
  EXPECT_EQ(library.FindExport("nope"), nullptr);
}

TEST(ShaderLibraryTest, BrokenTablesAreRefused) {
  EXPECT_ERROR(LoadShaderLibrary(nullptr), "KA0910");
  LibraryBuilder b;
  const uint32_t t = b.Binding("t", sh::BindingType::kTexture, 0);
  b.Export("M", sh::Stage::kMiss, {t});
  sh::LibraryDesc good = b.Desc();
  EXPECT_OK(LoadShaderLibrary(&good));
  sh::LibraryDesc d = good;
  d.abi_version += 1;
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910", "ABI version");
  d = good;
  d.struct_bytes = 4;
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910");
  d = good;
  d.exports = nullptr;
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910", "missing");
  d = good;
  d.binding_count = 0;
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910", "binding 0");
  sh::ExportDesc e = good.exports[0];
  d = good;
  d.exports = &e;
  e.entry = nullptr;
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910", "no code");
  e.stage = static_cast<sh::Stage>(99);
  EXPECT_ERROR(LoadShaderLibrary(&d), "KA0910", "export 0");
}

TEST(ShaderLibraryTest, FilesThatAreNoLibraries) {
  EXPECT_ERROR(LoadShaderLibraryFromFile("no/such/file.so"), "KA0910", "no/such/file.so");
  EXPECT_ERROR(LoadShaderLibraryFromFile(""), "KA0910");
  EXPECT_ERROR(LoadShaderLibraryFromFile(KAAMOS_SOURCE_DIR "/CMakeLists.txt"), "KA0910");
}

class ComputePipelineTest : public ::testing::Test {
 protected:
  ComputePipelineTest() {
    const uint32_t u =
        builder_.Binding("out_buffer", sh::BindingType::kRawBuffer, 0, 0, 1, 0, true);
    builder_.Export("One", sh::Stage::kCompute, {u});
    builder_.Export("Two", sh::Stage::kCompute);
    builder_.Export("Miss", sh::Stage::kMiss);
    library_ = builder_.Build();
  }
  Device device_ = testing::CreateNullDevice();
  LibraryBuilder builder_{"kernels.hlsl"};
  ShaderLibrary library_;
  RootSignature signature_ = device_.CreateRootSignature("CBV(b0), UAV(u0)").value();
};

TEST_F(ComputePipelineTest, LinksTheNamedKernel) {
  auto pso = device_.CreateComputePipelineState(
      {.pRootSignature = signature_, .CS = library_, .EntryPoint = "One"});
  ASSERT_TRUE(pso.ok()) << testing::MessageOf(pso);
  EXPECT_EQ(pso->name(), "One");
  const auto& linked = testing::null_log().last_compute->shader;
  EXPECT_EQ(linked.slots.at(0).source, sh::SlotSource::kRootDescriptor);
  EXPECT_EQ(linked.slots.at(0).argument_offset, 8u);
}

TEST_F(ComputePipelineTest, Errors) {
  auto make = [&](ComputePipelineStateDesc d) { return device_.CreateComputePipelineState(d); };
  EXPECT_ERROR(make({.CS = library_, .EntryPoint = "One"}), "KA0904", "pRootSignature");
  EXPECT_ERROR(make({.pRootSignature = signature_}), "KA0904", "CS");
  EXPECT_ERROR(make({.pRootSignature = signature_, .CS = library_}), "KA0537", "several");
  EXPECT_ERROR(make({.pRootSignature = signature_, .CS = library_, .EntryPoint = "Miss"}), "KA0537",
               "\"One\", \"Two\"");
  EXPECT_ERROR(make({.pRootSignature = device_.CreateRootSignature("").value(),
                     .CS = library_,
                     .EntryPoint = "One"}),
               "KA0528", "\"out_buffer\" (u0)");
  EXPECT_ERROR(make({.pRootSignature =
                         device_.CreateRootSignature("RootFlags(LOCAL_ROOT_SIGNATURE)").value(),
                     .CS = library_,
                     .EntryPoint = "Two"}),
               "KA0536");
}

}  // namespace
}  // namespace rtapi
