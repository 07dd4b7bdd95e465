// SPDX-License-Identifier: MIT
#include "d3d12/compiler/compile.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "d3d12/com/errors.h"
#include "d3d12/com/report.h"
#include "d3d12/container/shader_bytecode.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kMiss[] = R"(#include "colour.hlsli"
struct Payload { float3 color; };
[shader("miss")] void Sky(inout Payload p) { p.color = COLOUR; }
)";

DxcArguments arguments_of(const char* source) {
  DxcArguments out;
  out.options.File = "shaders/sky.hlsl";
  out.options.Source = source;
  out.options.Target = "lib_6_3";
  out.options.ReadFile = [](const std::string& path) -> std::optional<std::string> {
    if (path != "shaders/colour.hlsli") return std::nullopt;
    return "#define COLOUR float3(1, 2, 3)\n";
  };
  return out;
}

std::string error_of(const std::vector<std::byte>& container) {
  const auto loaded = load_shader(container.data(), container.size(), process_reporter());
  return loaded ? "" : loaded.error().message;
}

TEST(CompileSource, ContainerHoldsWhatALibraryNeeds) {
  const CompiledSource compiled = compile_source(arguments_of(kMiss));
  ASSERT_TRUE(compiled.ok) << compiled.messages;
  EXPECT_THAT(compiled.dependencies, testing::Contains("shaders/colour.hlsli"));
  const auto library =
      load_shader(compiled.container.data(), compiled.container.size(), process_reporter());
  ASSERT_TRUE(library) << library.error().message;
  ASSERT_NE(library->FindExport("Sky"), nullptr);
  EXPECT_EQ(library->FindExport("Sky")->Stage, rtapi::ShaderStage::kMiss);
  EXPECT_EQ(library->FindExport("Sky")->PayloadSizeInBytes, 12u);
  // The same bytes elsewhere are the same library.
  const auto copy = compiled.container;
  const auto again = load_shader(copy.data(), copy.size(), process_reporter());
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *library);
}

TEST(CompileSource, EveryOptionReachesTheContainer) {
  DxcArguments arguments = arguments_of("float4 Main() : SV_Target { return X; }");
  rtapi::ShaderCompileOptions& options = arguments.options;
  options.Target = "ps_6_2";
  options.EntryPoint = "Main";
  options.Defines = {{"X", "1"}, {"Y", ""}};
  options.IncludeDirectories = {"a", "b"};
  options.AutoBindingSpace = 0;
  options.HlslVersion = "2018";
  options.RowMajorMatrices = true;
  options.Native16BitTypes = true;
  options.ExternalLinkage = true;
  options.PayloadQualifiers = false;
  options.Strict = true;
  options.Debug = true;
  options.ReserveUnusedRegisters = true;
  const CompiledSource compiled = compile_source(arguments);
  ASSERT_TRUE(compiled.ok) << compiled.messages;
  const auto source = source_of_container(compiled.container.data(), compiled.container.size());
  ASSERT_TRUE(source) << source.error().message;
  const rtapi::ShaderCompileOptions& read = source->options;
  EXPECT_EQ(read.File, "shaders/sky.hlsl");
  EXPECT_EQ(read.Source, options.Source);
  EXPECT_EQ(read.Target, "ps_6_2");
  EXPECT_EQ(read.EntryPoint, "Main");
  ASSERT_EQ(read.Defines.size(), 2u);
  EXPECT_EQ(read.Defines[1].Name, "Y");
  EXPECT_EQ(read.Defines[1].Value, "");
  EXPECT_THAT(read.IncludeDirectories, ElementsAre("a", "b"));
  EXPECT_EQ(read.AutoBindingSpace, 0u);
  EXPECT_EQ(read.HlslVersion, "2018");
  EXPECT_EQ(read.PayloadQualifiers, false);
  EXPECT_TRUE(read.RowMajorMatrices && read.Native16BitTypes && read.ExternalLinkage &&
              read.Strict && read.Debug && read.ReserveUnusedRegisters);
  EXPECT_FALSE(read.CheckOnly);
}

TEST(CompileSource, PathsForADebuggerAreAbsolute) {
  DxcArguments arguments = arguments_of(kMiss);
  arguments.absolute_paths = true;
  const CompiledSource compiled = compile_source(arguments);
  ASSERT_TRUE(compiled.ok) << compiled.messages;
  auto source = source_of_container(compiled.container.data(), compiled.container.size());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->options.File.front(), '/');
  EXPECT_THAT(source->options.File, testing::EndsWith("/shaders/sky.hlsl"));
  ASSERT_EQ(source->files.size(), 1u);
  EXPECT_THAT(source->files[0].Path, testing::EndsWith("/shaders/colour.hlsli"));
  rtapi::ShaderCompileOptions options = compile_options(*std::move(source));
  options.CheckOnly = true;
  const auto checked = rtapi::CompileShaderLibrary(options);
  EXPECT_TRUE(checked.Status.ok()) << checked.Status.error().message;
}

TEST(CompileSource, ErrorsArePrintedAsDxcDoes) {
  const CompiledSource compiled = compile_source(arguments_of("\nstatic float3 x = y;"));
  EXPECT_FALSE(compiled.ok);
  EXPECT_TRUE(compiled.container.empty());
  EXPECT_THAT(compiled.messages, HasSubstr("shaders/sky.hlsl:2:19: error: "));
}

TEST(CompileSource, WarningsAreErrorsOnRequest) {
  DxcArguments arguments = arguments_of(
      "struct P { float3 x; };\n[shader(\"miss\")] void Sky(inout P p) { p.x = float4(1, 2, 3, 4); "
      "}");
  EXPECT_THAT(compile_source(arguments).messages, HasSubstr("warning: "));
  EXPECT_TRUE(compile_source(arguments).ok);
  arguments.warnings_as_errors = true;
  EXPECT_FALSE(compile_source(arguments).ok);
  arguments.warnings_as_errors = false;
  arguments.options.NoWarnings = true;
  EXPECT_EQ(compile_source(arguments).messages, "");
}

TEST(CompileSource, HashIsOfTheContent) {
  const CompiledSource one = compile_source(arguments_of(kMiss));
  const CompiledSource same = compile_source(arguments_of(kMiss));
  DxcArguments other = arguments_of(kMiss);
  other.options.RowMajorMatrices = true;
  EXPECT_EQ(one.hash.digest, same.hash.digest);
  EXPECT_EQ(one.container, same.container);
  EXPECT_NE(one.hash.digest, compile_source(other).hash.digest);
}

// A compiler that fails, and then none at all.
TEST(LoadShader, IsInterpretedWhereItCannotBeBuiltAndSaysSoOnce) {
  std::string folder = (fs::temp_directory_path() / "kaamos-load-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const fs::path broken = fs::path(folder) / "broken-c++";
  std::ofstream(broken) << "#!/bin/sh\necho 'In file included from x:1:' >&2\n"
                           "echo \"error: unrecognized option '-std=c++20'\" >&2\nexit 1\n";
  fs::permissions(broken, fs::perms::owner_all);
  int warnings = 0;
  const uint64_t sink = process_reporter().add_sink([&](D3D12_MESSAGE_SEVERITY severity,
                                                        const rtapi::Error& error) {
    if (severity == D3D12_MESSAGE_SEVERITY_WARNING && error.id == public_id(ErrorId::kInterpreted))
      ++warnings;
  });
  const auto loaded = [&](const char* compiler, const std::string& colour) {
    setenv("KAAMOS_CXX", compiler, 1);
    const CompiledSource compiled = compile_source(
        arguments_of(("struct Payload { float3 color; };\n[shader(\"miss\")] void Sky("
                      "inout Payload p) { p.color = " +
                      colour + "; }\n")
                         .c_str()));
    testing::internal::CaptureStderr();
    const auto library =
        load_shader(compiled.container.data(), compiled.container.size(), process_reporter());
    const std::string said = testing::internal::GetCapturedStderr();
    unsetenv("KAAMOS_CXX");
    EXPECT_TRUE(library) << library.error().message;
    return said;
  };
  EXPECT_THAT(loaded(broken.c_str(), "11"),
              testing::AllOf(testing::StartsWith("D3D12 WARNING: KA4025 shader is interpreted: "
                                                 "\"shaders/sky.hlsl\""),
                             HasSubstr("KA2751"), HasSubstr(broken.string() + " failed"),
                             HasSubstr("\nerror: unrecognized option"), HasSubstr("$KAAMOS_CXX"),
                             testing::Not(HasSubstr("In file included"))));
  EXPECT_EQ(loaded("no-such-compiler", "12"), "");
  process_reporter().remove_sink(sink);
  EXPECT_EQ(warnings, 2);
  fs::remove_all(folder);
}

TEST(LoadShader, DxilSaysWhatToDo) {
  const std::string bitcode = "BC";
  const Part part = {fourcc("DXIL"), std::as_bytes(std::span(bitcode))};
  EXPECT_THAT(error_of(write_container({&part, 1})),
              testing::AllOf(HasSubstr("KA4020"), HasSubstr("DXIL"), HasSubstr("kaamos-dxc")));
  const Part old = {fourcc("SHEX"), std::as_bytes(std::span(bitcode))};
  EXPECT_THAT(error_of(write_container({&old, 1})), HasSubstr("DXBC, which"));
  const Part other = {fourcc("RTS0"), std::as_bytes(std::span(bitcode))};
  EXPECT_THAT(error_of(write_container({&other, 1})), HasSubstr("no part KAAM"));
}

TEST(LoadShader, NullAndTextAreNone) {
  EXPECT_FALSE(load_shader(nullptr, 0, process_reporter()));
  EXPECT_FALSE(load_shader(nullptr, 100, process_reporter()));
  EXPECT_THAT(error_of(std::vector<std::byte>(100, std::byte{'x'})), HasSubstr("\"xxxx\""));
}

TEST(LoadShader, DamagedSourceIsRefused) {
  const CompiledSource compiled = compile_source(arguments_of(kMiss));
  const auto parts = read_container(compiled.container.data(), compiled.container.size());
  ASSERT_TRUE(parts);
  const std::span<const std::byte> whole = parts->front().bytes;
  for (size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size));
    EXPECT_FALSE(read_source(cut)) << size << " bytes";
  }
  std::vector<std::byte> newer(whole.begin(), whole.end());
  newer[0] = std::byte{2};
  const auto read = read_source(newer);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("format 2"));
}

}  // namespace
}  // namespace kaamos::d3d12
