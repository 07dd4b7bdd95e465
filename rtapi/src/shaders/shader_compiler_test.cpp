// SPDX-License-Identifier: MIT
//
// The options of kaamos-hlsl in ShaderCompileOptions, each with and without.
#include <kaamos/shader/abi.h>
#include <rtapi/error_ids.h>
#include <rtapi/shader_compiler.h>

#include <algorithm>

#include "rtapi/src/shaders/shader_library_impl.h"
#include "rtapi/testing/expect_error.h"
#include "rtapi/testing/null_backend.h"

namespace rtapi {
namespace {

namespace sh = kaamos::shader;

ShaderCompileOptions options_of(const char* source) {
  ShaderCompileOptions options;
  options.File = "options.hlsl";
  options.Source = source;
  options.Interpret = true;
  options.Spirv = false;
  return options;
}

const sh::LibraryDesc& table_of(const ShaderCompilation& compiled) {
  return *compiled.Library.impl()->desc;
}

bool says(const ShaderCompilation& compiled, ErrorId id) {
  return std::any_of(compiled.Diagnostics.begin(), compiled.Diagnostics.end(),
                     [id](const ShaderDiagnostic& one) { return one.Id == id; });
}

constexpr char kMiss[] = R"(struct P { float3 x; };
float3 twice(float3 v) { return v + v; }
[shader("miss")] void Dark(inout P p) { p.x = twice(float4(1, 2, 3, 4)); }
)";

TEST(ShaderCompilerOptions, Native16BitTypes) {
  auto options = options_of(R"(struct P { float16_t2 x; };
[shader("miss")] void Dark(inout P p) { p.x = 1; })");
  const auto without = CompileShaderLibrary(options);
  EXPECT_ERROR(without.Status, "KA2752", "KA2422");
  options.Native16BitTypes = true;
  const auto with = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(with.Status), "ok");
  EXPECT_EQ(table_of(with).exports[0].payload_storage_bytes, 4u);
}

TEST(ShaderCompilerOptions, ExternalLinkage) {
  auto options = options_of(kMiss);
  EXPECT_EQ(CompileShaderLibrary(options).Library.FindExport("twice"), nullptr);
  options.ExternalLinkage = true;
  const auto with = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(with.Status), "ok");
  ASSERT_NE(with.Library.FindExport("twice"), nullptr);
  EXPECT_EQ(with.Library.FindExport("twice")->Stage, ShaderStage::kLibrary);
}

TEST(ShaderCompilerOptions, CheckAccessAndEmbedSource) {
  auto options = options_of(kMiss);
  const auto plain = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(plain.Status), "ok");
  EXPECT_EQ(table_of(plain).flags & sh::kLibraryChecked, 0u);
  EXPECT_NE(table_of(plain).source, nullptr);
  options.CheckAccess = true;
  options.EmbedSource = false;
  const auto checked = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(checked.Status), "ok");
  EXPECT_NE(table_of(checked).flags & sh::kLibraryChecked, 0u);
  EXPECT_EQ(table_of(checked).source, nullptr);
}

TEST(ShaderCompilerOptions, NoWarnings) {
  auto options = options_of(kMiss);
  EXPECT_TRUE(
      says(CompileShaderLibrary(options), error_ids::compiler::kTruncation));  // float4 to float3
  options.NoWarnings = true;
  const auto quiet = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(quiet.Status), "ok");
  EXPECT_TRUE(quiet.Diagnostics.empty());
  options.Source = "[shader(\"miss\")] void Dark() {}";
  const auto wrong = CompileShaderLibrary(options);
  EXPECT_FALSE(wrong.Status.ok());
  EXPECT_FALSE(wrong.Diagnostics.empty());
}

TEST(ShaderCompilerOptions, CheckOnly) {
  auto options = options_of(kMiss);
  options.Interpret = false;
  options.CxxCompiler = "/no/such/compiler";
  options.CheckOnly = true;
  const auto checked = CompileShaderLibrary(options);
  EXPECT_OK(checked.Status);
  EXPECT_FALSE(checked.Library);
  EXPECT_TRUE(says(checked, error_ids::compiler::kTruncation));
  options.Source = "float x";
  EXPECT_ERROR(CompileShaderLibrary(options).Status, "KA2752", "KA2201");
}

TEST(ShaderCompilerOptions, WideThreads) {
  auto options = options_of(R"(RWByteAddressBuffer o : register(u0);
[shader("raygeneration")] void Main() { o.Store(4 * DispatchRaysIndex().x, 1); })");
  options.Interpret = false;
  const auto wide = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(wide.Status), "ok");
  EXPECT_NE(table_of(wide).exports[0].row, nullptr);
  options.WideThreads = false;
  const auto narrow = CompileShaderLibrary(options);
  ASSERT_EQ(testing::MessageOf(narrow.Status), "ok");
  EXPECT_EQ(table_of(narrow).exports[0].row, nullptr);
}

constexpr char kRootSignatures[] = R"hlsl(
#define TEXT "UAV(u0), " "RootConstants(b3, num32BitConstants=+61)"
LocalRootSignature Record = {"SRV(t2)"};
RWByteAddressBuffer o : register(u0);
[RootSignature(TEXT)] [shader("compute")] [numthreads(1, 1, 1)] void Main() { o.Store(0, 1); }
[shader("compute")] [numthreads(1, 1, 1)] void Other() { o.Store(0, 2); }
)hlsl";

TEST(ShaderCompilerOptions, RootSignaturesOfTheSourceCanBeCreated) {
  const auto compiled = CompileShaderLibrary(options_of(kRootSignatures));
  ASSERT_EQ(testing::MessageOf(compiled.Status), "ok");
  const Device device = testing::CreateNullDevice();
  const auto root = device.CreateRootSignature(compiled.Library);
  ASSERT_EQ(testing::MessageOf(root), "ok");
  ASSERT_EQ(root->GetDesc().Parameters.size(), 2u);
  EXPECT_EQ(root->GetDesc().Parameters[1].Constants.Num32BitValues, 61u);
  const auto record = device.CreateRootSignature(compiled.Library, "Record");
  ASSERT_EQ(testing::MessageOf(record), "ok");
  EXPECT_TRUE(record->is_local());
  EXPECT_ERROR(device.CreateRootSignature(compiled.Library, "Other"), "KA0633",
               "\"Record\" (local), \"Main\"");
}

}  // namespace
}  // namespace rtapi
