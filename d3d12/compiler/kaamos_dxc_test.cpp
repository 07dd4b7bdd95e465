// SPDX-License-Identifier: MIT
//
// kaamos-dxc as a build calls it.
#include <gmock/gmock.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "d3d12/container/shader_bytecode.h"

namespace kaamos::d3d12 {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class KaamosDxc : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("kaamos_dxc_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "include");
    write("library.hlsl", R"(#include "colour.hlsli"
struct Payload { float3 color; };
RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> image : register(u0);
[shader("raygeneration")] void Trace() {
  Payload p; p.color = 0;
  RayDesc ray = {float3(0, 0, 0), 0, float3(0, 0, 1), 1};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray, p);
  image[DispatchRaysIndex().xy] = float4(p.color, 1);
}
[shader("miss")] void Sky(inout Payload p) { p.color = COLOUR; }
)");
    write("include/colour.hlsli", "#define COLOUR float3(RED, 0, 0)\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream out;
    out << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return out.str();
  }
  // Runs it in the folder; its output is in out.txt and err.txt.
  int run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" KAAMOS_DXC "' " + arguments + " > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path folder_;
};

TEST_F(KaamosDxc, LibraryCanBeLoaded) {
  ASSERT_EQ(run("-T lib_6_3 -I include -D RED=1 -Fo library.cso library.hlsl"), 0)
      << read("err.txt");
  // The sources are no longer needed.
  fs::remove(folder_ / "library.hlsl");
  fs::remove_all(folder_ / "include");
  const std::string bytes = read("library.cso");
  const auto library = load_shader(bytes.data(), bytes.size(), process_reporter());
  ASSERT_TRUE(library) << library.error().message;
  ASSERT_EQ(library->GetExports().size(), 2u);
  EXPECT_NE(library->FindExport("Trace"), nullptr);
  EXPECT_NE(library->FindExport("Sky"), nullptr);
}

TEST_F(KaamosDxc, HeaderIsACArray) {
  ASSERT_EQ(run("/T lib_6_3 /I include /DRED=1 /Fh library.h /Vn g_Library /Fo library.cso "
                "library.hlsl"),
            0)
      << read("err.txt");
  write("array.c",
        "#include <stdio.h>\n#include \"library.h\"\n"
        "int main(void) { return fwrite(g_Library, sizeof(g_Library), 1, stdout) == 1 ? 0 : 1; }");
  const std::string build =
      "cd '" + folder_.string() + "' && cc array.c -o array && ./array > array.bin";
  ASSERT_EQ(std::system(build.c_str()), 0);
  EXPECT_EQ(read("array.bin"), read("library.cso"));
  ASSERT_EQ(run("-T lib_6_3 -I include -D RED=1 -Fh plain.h library.hlsl"), 0);
  EXPECT_THAT(read("plain.h"),
              HasSubstr("const unsigned char g_main[] = {\n  0x44, 0x58, 0x42, 0x43"));
}

TEST_F(KaamosDxc, ErrorsGoToTheErrorStreamAndEndWithOne) {
  EXPECT_EQ(run("-T lib_6_3 -I include -Fo library.cso -Fe errors.txt library.hlsl"), 1);
  EXPECT_THAT(read("err.txt"), HasSubstr("error: "));
  EXPECT_THAT(read("err.txt"), HasSubstr("RED"));
  EXPECT_EQ(read("errors.txt"), read("err.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "library.cso"));
  EXPECT_EQ(run("-T lib_6_3 missing.hlsl"), 1);
  EXPECT_THAT(read("err.txt"), HasSubstr("missing.hlsl"));
  EXPECT_EQ(run("library.hlsl"), 1);
  EXPECT_THAT(read("err.txt"), HasSubstr("-T"));
  EXPECT_EQ(run("-T lib_6_3 -D RED=1 -I include -Fo no/such/folder library.hlsl"), 1);
  EXPECT_THAT(read("err.txt"), HasSubstr("no/such/folder"));
}

TEST_F(KaamosDxc, WithoutAFileTheListingIsPrinted) {
  ASSERT_EQ(run("-T lib_6_3 -I include -D RED=1 library.hlsl"), 0);
  EXPECT_THAT(read("out.txt"), HasSubstr("Trace"));
  EXPECT_THAT(read("out.txt"), testing::ContainsRegex("image +u0 +0 +1"));
}

TEST_F(KaamosDxc, DependenciesAreAMakeRule) {
  ASSERT_EQ(run("-T lib_6_3 -I include -D RED=1 -Fo library.cso -MF library.d library.hlsl"), 0);
  EXPECT_EQ(read("library.d"), "library.cso: \\\n  library.hlsl \\\n  include/colour.hlsli\n");
}

TEST_F(KaamosDxc, BlanksInPathsAreEscapedInTheRule) {
  fs::create_directories(folder_ / "a b");
  ASSERT_EQ(run("-T lib_6_3 -I include -D RED=1 -Fo 'a b/library.cso' -M library.hlsl"), 0);
  EXPECT_THAT(read("out.txt"), testing::StartsWith("a\\ b/library.cso: \\\n  library.hlsl"));
}

TEST_F(KaamosDxc, WhatCannotBeWrittenStays) {
  fs::create_directories(folder_ / "out");  // an empty folder, which remove() would take
  EXPECT_EQ(run("-T lib_6_3 -I include -D RED=1 -Fo out library.hlsl"), 1);
  EXPECT_THAT(read("err.txt"), HasSubstr("cannot write out: Is a directory"));
  EXPECT_TRUE(fs::is_directory(folder_ / "out"));
}

TEST_F(KaamosDxc, PreprocessedSourceCompiles) {
  ASSERT_EQ(run("-P -I include -D RED=7 -Fi flat.hlsl library.hlsl"), 0) << read("err.txt");
  EXPECT_THAT(read("flat.hlsl"), HasSubstr("float3 ( 7 , 0 , 0 )"));
  EXPECT_EQ(run("-T lib_6_3 -Fo flat.cso flat.hlsl"), 0) << read("err.txt");
}

TEST_F(KaamosDxc, HelpListsTheOptions) {
  EXPECT_EQ(run("-help"), 0);
  EXPECT_THAT(read("out.txt"), HasSubstr("-Qembed_debug"));
}

}  // namespace
}  // namespace kaamos::d3d12
