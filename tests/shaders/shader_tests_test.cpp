// SPDX-License-Identifier: MIT
//
// kaamos-test itself: what it finds in a file, what it says, and that no test takes others with it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "effects/assets/gltf/gltf_write.h"
#include "tests/shaders/report.h"
#include "tests/shaders/scene.h"
#include "tests/shaders/session.h"
#include "tests/shaders/table_records.h"
#include "tests/shaders/test_file.h"

namespace kaamos::shader_tests {
namespace {

using Outcome = TestResult::Outcome;

std::vector<std::string> names(const TestFile& file) {
  std::vector<std::string> out;
  for (const TestRun& run : file.runs) out.push_back(run.name);
  return out;
}

TEST(TestFile, FindsTestsInNamespacesAndTheirCases) {
  const TestFile file = find_tests(
      "#line 1 \"a.hlsl\"\n"
      "void f() { if (true) { } }\n"
      "[test] void One() { [loop] for (;;) {} }\n"
      "namespace a { namespace b {\n"
      "[test] [cases((1, 2.5e-3), (f(3, 4), -1))] void Two(int x, float y) {}\n"
      "} struct S { void g() {} }; [test]\n"
      "[cases(1, 2)] void Three(int x) {} }\n"
      "#line 7 \"b.hlsl\"\n"
      "[numthreads(8, 1, 1)] [shader(\"compute\")] void NoTest() {}\n"
      "[test] [numthreads(4, 2, 1)] [dispatch(2)] void Four(uint3 i : SV_GroupThreadID, uint j : "
      "SV_GroupIndex) {}\n"
      "[test] void Declared();\n",
      "a.hlsl");
  EXPECT_EQ(file.error, "");
  EXPECT_EQ(names(file), (std::vector<std::string>{"One", "a::b::Two/0", "a::b::Two/1",
                                                   "a::Three/0", "a::Three/1", "Four"}));
  EXPECT_EQ(file.runs[1].line, 4u);
  EXPECT_EQ(file.runs[5].file, "b.hlsl");
  EXPECT_EQ(file.runs[5].line, 8u);
  EXPECT_EQ(file.runs[5].size, (std::array<uint32_t, 3>{2, 1, 1}));
  EXPECT_EQ(file.entry_points,
            "[shader(\"compute\")] [numthreads(1, 1, 1)] void kaamos_test_0() { One(); }\n"
            "[shader(\"compute\")] [numthreads(1, 1, 1)] void kaamos_test_1() { a::b::Two(1 , "
            "2.5e-3); }\n"
            "[shader(\"compute\")] [numthreads(1, 1, 1)] void kaamos_test_2() { a::b::Two(f ( 3 , "
            "4 ) , - 1); }\n"
            "[shader(\"compute\")] [numthreads(1, 1, 1)] void kaamos_test_3() { a::Three(1); }\n"
            "[shader(\"compute\")] [numthreads(1, 1, 1)] void kaamos_test_4() { a::Three(2); }\n"
            "[shader(\"compute\")] [numthreads(4 , 2 , 1)] void kaamos_test_5(uint3 i : "
            "SV_GroupThreadID , uint j : SV_GroupIndex) { Four(i, j); }\n");
}

TEST(TestFile, FindsTheRecordsOfTables) {
  const TestFile file = find_tests(
      "[shader(\"miss\")] void M1(inout P p) {}\n[shader(\"miss\")] void M2(inout P p) {}\n"
      "TriangleHitGroup B = {\"\", \"C\"};\nProceduralPrimitiveHitGroup A = {\"\", \"\", \"I\"};\n"
      "[shader(\"callable\")] void C1(inout P p) {}\nRaytracingShaderConfig c = {16, 8};\n"
      "LocalRootSignature L = {\"CBV(b0), \"\n\"UAV(u1)\"};\n"
      "[test(\"raygeneration\")] void R() {}\n[test] [shader(\"raygeneration\")] void Own() {}\n",
      "a.hlsl");
  EXPECT_EQ(file.miss_shaders, (std::vector<std::string>{"M1", "M2"}));
  EXPECT_EQ(file.hit_groups, (std::vector<std::string>{"B", "A"}));
  EXPECT_EQ(file.callable_shaders, std::vector<std::string>{"C1"});
  EXPECT_EQ(file.local_root_signatures, std::vector<std::string>{"CBV(b0), UAV(u1)"});
  EXPECT_TRUE(file.has_shader_config);
  EXPECT_FALSE(file.has_pipeline_config);
  ASSERT_EQ(file.runs.size(), 2u);
  EXPECT_EQ(file.runs[0].stage, TestStage::kRays);
  EXPECT_EQ(file.runs[1].stage, TestStage::kRays);
  EXPECT_EQ(file.runs[1].entry, "Own");
  EXPECT_EQ(file.entry_points, "[shader(\"raygeneration\")] void kaamos_test_0() { R(); }\n");
}

TEST(TestFile, MistakesAreExplained) {
  const auto error = [](const std::string& text) { return find_tests(text, "a.hlsl").error; };
  EXPECT_EQ(error("[test] int f() { return 1; }"),
            "a.hlsl:1: 'f' is a test and returns a value; tests return void");
  EXPECT_EQ(error("\n[test] [shader(\"miss\")] void f(inout P p) {}"),
            "a.hlsl:2: 'f' is a test for stage \"miss\"; tests run in \"compute\", "
            "\"raygeneration\" or \"pixel\"");
  EXPECT_EQ(error("[test] [cases(1)] [numthreads(2, 1, 1)] void f(uint i : SV_GroupIndex) {}"),
            "a.hlsl:1: 'f' has [cases] and [numthreads]; a test takes its arguments from one of "
            "them");
  EXPECT_EQ(error("[test] [cases(1)] [shader(\"raygeneration\")] void f(int i) {}"),
            "a.hlsl:1: 'f' has [shader] and [cases]; write [test(\"raygeneration\")] in place of "
            "[shader]");
  EXPECT_EQ(error("[test(\"pixel\")] [cases(1)] void f(float4 p : SV_Position) {}"),
            "a.hlsl:1: 'f' has [cases] and inputs of a pixel shader; a test takes its arguments "
            "from one of them");
  EXPECT_EQ(error("[test] [dispatch(0, 1, 1)] void f() {}"),
            "a.hlsl:1: [dispatch] takes one to three numbers from 1 on, and here is '0'");
}

TEST(SceneLines, DescribeGeometriesAndInstances) {
  const SceneDescription scene = read_scene(
      "// #pragma kaamos geometry no triangles (1,2,3)\n"
      "#pragma kaamos geometry wall triangles opaque (0,0,0) (1,0,0) (0, 1.5, 0) // a comment\n"
      "#pragma once\n"
      "#pragma kaamos geometry wall boxes no_duplicate_anyhit (0,0,0) (1,1,1)\n"
      "#pragma kaamos instance wall at (1,2,3) scale 2 id 7 mask 0x0F hit_group 3 flags 4\n"
      "#pragma kaamos instance wall transform (1,2,3,4, 5,6,7,8, 9,10,11,12)\n");
  EXPECT_EQ(scene.error, "");
  ASSERT_EQ(scene.geometries.size(), 2u);
  EXPECT_EQ(scene.geometries[0].points, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1.5f, 0}));
  EXPECT_EQ(scene.geometries[0].flags, rtapi::RaytracingGeometryFlags::kOpaque);
  EXPECT_TRUE(scene.geometries[1].is_boxes);
  ASSERT_EQ(scene.instances.size(), 2u);
  const rtapi::RaytracingInstanceDesc& desc = scene.instances[0].desc;
  EXPECT_EQ(desc.Transform[1][1], 2);
  EXPECT_EQ(desc.Transform[1][3], 2);
  EXPECT_EQ(desc.InstanceID, 7u);
  EXPECT_EQ(desc.InstanceMask, 0x0Fu);
  EXPECT_EQ(desc.InstanceContributionToHitGroupIndex, 3u);
  EXPECT_EQ(desc.Flags, 4u);
  EXPECT_EQ(scene.instances[1].desc.Transform[2][3], 12);
  EXPECT_EQ(scene.instances[1].desc.InstanceMask, 0xFFu);
}

TEST(SceneLines, RecordsHaveConstantsOfEachParameter) {
  const SceneDescription scene =
      read_scene("#pragma kaamos record Glass (0.5, -1, 0x10) (4294967295)\n");
  EXPECT_EQ(scene.error, "");
  ASSERT_EQ(scene.records.size(), 1u);
  EXPECT_EQ(scene.records[0].export_name, "Glass");
  EXPECT_EQ(scene.records[0].constants,
            (std::vector<std::vector<uint32_t>>{{0x3F000000u, 0xFFFFFFFFu, 16}, {0xFFFFFFFFu}}));
}

// Every record of a name stands where the name stands in the file.
TEST(TableRecords, FollowTheFileAndItsLines) {
  TestFile file;
  file.hit_groups = {"A", "B", "C"};
  file.miss_shaders = {"M"};
  const TableRecords records =
      table_records(file, read_scene("#pragma kaamos record B (1)\n#pragma kaamos record B (2)\n"));
  ASSERT_EQ(records.hit_groups.size(), 4u);
  EXPECT_EQ(records.hit_groups[2].constants[0][0], 2u);
  EXPECT_EQ(records.hit_groups[3].export_name, "C");
  std::string defines;
  for (const rtapi::ShaderDefine& one : record_defines(records)) {
    defines += one.Name + "=" + one.Value + " ";
  }
  EXPECT_EQ(defines,
            "KAAMOS_HIT_GROUP_A=0 KAAMOS_HIT_GROUP_B=1 KAAMOS_HIT_GROUP_C=3 KAAMOS_MISS_M=0 "
            "KAAMOS_MISS_none=1 ");
  EXPECT_EQ(table_records(file, read_scene("#pragma kaamos record D (1)\n")).error,
            "'#pragma kaamos record D' names no hit group, miss or callable shader of the file");
}

TEST(SceneLines, MistakesAreExplained) {
  const auto error = [](const std::string& text) { return read_scene("\n" + text).error; };
  EXPECT_EQ(error("#pragma kaamos geometry w triangles (0,0,0) (1,0,0)"),
            "line 2: 2 points, and a triangle takes 3");
  EXPECT_EQ(error("#pragma kaamos geometry w triangles (0,0) (1,0,0) (0,0,0)"),
            "line 2: '(0,0)' is not three numbers");
  EXPECT_EQ(error("#pragma kaamos geometry w (0,0,0)"), "line 2: a geometry is triangles or boxes");
  EXPECT_EQ(
      error("#pragma kaamos geometry w spheres (0,0,0)"),
      "line 2: 'spheres' is neither triangles, boxes, opaque, no_duplicate_anyhit nor a point");
  EXPECT_EQ(error("#pragma kaamos instance w"), "line 2: there is no geometry 'w' above");
  const std::string wall =
      "#pragma kaamos geometry w boxes (0,0,0) (1,1,1)\n#pragma kaamos instance w ";
  EXPECT_EQ(error(wall + "mask 256"),
            "line 3: 'mask' takes a number from 0 to 255, and here is '256'");
  EXPECT_EQ(error(wall + "id"), "line 3: 'id' has no value");
  EXPECT_EQ(error(wall + "at 3"), "line 3: 'at' takes (x, y, z)");
  EXPECT_EQ(error(wall + "colour 3"),
            "line 3: 'colour' is neither at, scale, transform, id, mask, hit_group nor flags");
  EXPECT_EQ(error("#pragma kaamos scene x"),
            "line 2: '#pragma kaamos scene' is none; write '#pragma kaamos geometry NAME ...', or "
            "gltf, instance or record in place of geometry");
  EXPECT_EQ(error("#pragma kaamos gltf room"), "line 2: 'gltf' takes a name and a file, in quotes");
  EXPECT_NE(error("#pragma kaamos gltf room \"no.glb\"").find("line 2: "), std::string::npos);
  EXPECT_EQ(error("#pragma kaamos record Glass 3"),
            "line 2: '3' is no list of constants; write (0.5, 3) for each parameter of the local "
            "root signature");
  EXPECT_EQ(error("#pragma kaamos record Glass (red)").substr(0, 14), "line 2: 'red' ");
}

// A file in a folder of its own, and what running it gives.
class Session : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "kaamos-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  SessionResult run(const std::string& body, double timeout_seconds = 20,
                    const std::string& executor = "interpreter") {
    std::ofstream(folder_ / "a.hlsl") << "#include <kaamos/test.hlsli>\n" << body;
    SourceOptions options;
    options.path = (folder_ / "a.hlsl").string();
    source_ = read_source(options);
    if (!source_.error.empty()) return {{}, source_.error};
    std::vector<const TestRun*> runs;
    for (const TestRun& one : source_.tests.runs) runs.push_back(&one);
    return run_tests(source_, runs, executor, timeout_seconds);
  }
  // Without the folder.
  std::string failure(const TestResult& result, size_t index = 0) const {
    if (index >= result.failures.size()) return "";
    std::string text = result.failures[index];
    const size_t at = text.find(folder_.string());
    return at == std::string::npos ? text : text.erase(at, folder_.string().size() + 1);
  }

  std::filesystem::path folder_;
  Source source_;
};

TEST_F(Session, EveryCheckPassesAndFails) {
  const char* kChecks[][3] = {
      {"EQ(i + 1, 2u)", "EQ(float2(1, 2), float2(1, 3))", "actual (1, 2), expected (1, 3)"},
      {"NE(i, 2)", "NE(float2(1, 2), float2(1, 2))", "both (1, 2)"},
      {"LT(float3(1, 2, 3), 4)", "LT(i, 1)", "actual 1, limit 1"},
      {"LE(i, 1)", "LE(float2(1, 3), float2(2, 2))", "actual (1, 3), limit (2, 2)"},
      {"NEAR(0.1 * i, 0.1001, 1e-3)", "NEAR(0.5, 0.25, 0.125)",
       "actual 0.5, expected 0.25, tolerance 0.125"},
      {"NEAR(1 / float(i - 1), 1.0 / 0.0, 1)", "NEAR(sqrt(-float(i)), 0, 1)",
       "actual nan, expected 0, tolerance 1"},
      {"NEAR_ULP(asfloat(0x3F800001u), 1, 1)", "NEAR_ULP(asfloat(0x3F800002u), 1, 1)",
       "actual 1.0000002, expected 1, 2 steps of floats apart"},
      {"NEAR_ULP(asfloat(0x80000001u), asfloat(1u), 2)", "NEAR_ULP(-1.0 * i, 1, 100)",
       "actual -1, expected 1, 2130706432 steps of floats apart"},
      {"TRUE(bool2(true, i == 1))", "TRUE(bool2(true, false))", "actual (true, false)"},
      {"FALSE(i == 2)", "FALSE(bool2(true, false))", "actual (true, false)"},
      {"NAN(sqrt(-float(i)))", "NAN(1.0)", "actual 1"},
      {"EQ(float2x2(1, 2, 3, i + 3), float2x2(1, 2, 3, 4))",
       "EQ(float2x2(1, 2, 3, 4), float2x2(1, 2, 3, 5))",
       "actual ((1, 2), (3, 4)), expected ((1, 2), (3, 5))"},
  };
  std::string body;
  for (const auto& check : kChecks) {
    for (int i = 0; i < 2; ++i) {
      body += "[test] [numthreads(1, 1, 1)] void f" + std::to_string(body.size()) +
              "(uint zero : SV_GroupIndex) { const uint i = zero + 1; EXPECT_" + check[i] +
              "; EXPECT_EQ(i, 1); }\n";
    }
  }
  const SessionResult ran = run(body);
  ASSERT_EQ(ran.error, "");
  ASSERT_EQ(ran.results.size(), 2 * std::size(kChecks));
  for (size_t i = 0; i < std::size(kChecks); ++i) {
    EXPECT_EQ(ran.results[2 * i].outcome, Outcome::kPassed) << failure(ran.results[2 * i]);
    const std::string line = std::to_string(2 * i + 3);
    EXPECT_EQ(failure(ran.results[2 * i + 1]),
              "a.hlsl:" + line + ": EXPECT_" + kChecks[i][1] + "\n  " + kChecks[i][2]);
    EXPECT_EQ(ran.results[2 * i + 1].failures.size(), 1u);
  }
}

TEST_F(Session, AssertionsEndTheTest) {
  const SessionResult ran =
      run("[test] void f() { ASSERT_EQ(1, 2); ADD_FAILURE(\"not reached\"); }\n"
          "[test] void g() { EXPECT_EQ(1, 2); ADD_FAILURE(\"reached\"); }\n"
          "[test] void h() { SKIP(\"no time\"); ADD_FAILURE(\"not reached\"); }\n"
          "[test] [skip(\"slow\")] void i() { ADD_FAILURE(\"not reached\"); }\n");
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].failures.size(), 1u);
  ASSERT_EQ(ran.results[1].failures.size(), 2u);
  EXPECT_EQ(failure(ran.results[1], 1), "a.hlsl:3: reached");
  EXPECT_EQ(ran.results[2].outcome, Outcome::kSkipped);
  EXPECT_EQ(ran.results[2].skipped, "no time");
  EXPECT_EQ(ran.results[3].outcome, Outcome::kSkipped);
  EXPECT_EQ(ran.results[3].skipped, "slow");
  EXPECT_EQ(summary(ran.results), "4 tests: 0 passed, 2 failed, 2 skipped");
}

// The process of an endless loop is ended; the tests behind it run in the next one.
TEST_F(Session, EndlessLoopsAreTheirTestsFailure) {
  const SessionResult ran =
      run("[test] void f() { printf(\"before\"); }\n"
          "[test] void g() { uint i = 1; [loop] while (i != 0) i = i * 3 | 1; EXPECT_EQ(i, 0); }\n"
          "[test] void h() { EXPECT_EQ(1, 1); }\n",
          1);
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].outcome, Outcome::kPassed);
  EXPECT_EQ(ran.results[0].output, std::vector<std::string>{"(0,0,0): before"});
  EXPECT_EQ(failure(ran.results[1]), "a.hlsl:3: it ran for more than 1 s");
  EXPECT_EQ(ran.results[2].outcome, Outcome::kPassed);
}

// What removes the device is a failure with its message; the next test gets a new one.
TEST_F(Session, FaultsAreTheirTestsFailure) {
  const SessionResult ran = run(
      "struct P { uint depth; };\n"
      "[shader(\"miss\")] void Again(inout P p) { ++p.depth; RayDesc r = {float3(0, 0, 0), 0, "
      "float3(0, 0, 1), 1}; TraceRay(TestScene, 0, 0xFF, 0, 0, 0, r, p); }\n"
      "[test(\"raygeneration\")] void f() { P p = {0}; RayDesc r = {float3(0, 0, 0), 0, float3(0, "
      "0, 1), 1}; TraceRay(TestScene, 0, 0xFF, 0, 0, 0, r, p); }\n"
      "[test] void g() { EXPECT_EQ(1, 1); }\n");
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].outcome, Outcome::kFailed);
  EXPECT_NE(failure(ran.results[0]).find("KA0890"), std::string::npos) << failure(ran.results[0]);
  EXPECT_EQ(ran.results[1].outcome, Outcome::kPassed) << failure(ran.results[1]);
}

// Which 4 bits would take for another one.
TEST_F(Session, HitGroupsPast15AreNotCalledAlone) {
  const SessionResult ran =
      run("struct P { uint hits; };\n"
          "[shader(\"closesthit\")] void Hit(inout P p, BuiltInTriangleIntersectionAttributes a) "
          "{ ++p.hits; }\nTriangleHitGroup G = {\"\", \"Hit\"};\n"
          "[test(\"raygeneration\")] [cases(0u, 16u)] void f(uint group) { P p = {0}; "
          "CallHitGroup(group, float2(0.25, 0.25), p); EXPECT_EQ(p.hits, 1); }\n");
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].outcome, Outcome::kPassed) << failure(ran.results[0]);
  ASSERT_EQ(ran.results[1].failures.size(), 1u);
  EXPECT_EQ(failure(ran.results[1]), "hit group 16 is called alone, and only 0 to 15 can be");
}

TEST_F(Session, WhatCannotRunIsSaid) {
  EXPECT_NE(run("[test] void f() { undeclared(); }").error.find("a.hlsl:2:19: error"),
            std::string::npos);
  EXPECT_NE(run("[test] [cases(1)] void f(int a, int b) {}").error.find("error"),
            std::string::npos);
  EXPECT_NE(run("Texture2D t; [test] void f() { EXPECT_EQ(t.Load(0), 0); }")
                .error.find("\"t\" cannot be bound"),
            std::string::npos);
  EXPECT_NE(run("#include \"nowhere.hlsli\"\n").error.find("nowhere.hlsli"), std::string::npos);
  EXPECT_NE(run("#pragma kaamos geometry w boxes (0,0,0)\n").error.find("line 2: 1 points"),
            std::string::npos);
}

// Buffers are zeros, and a test's own.
TEST_F(Session, BuffersAreThere) {
  const SessionResult ran =
      run("RWByteAddressBuffer a : register(u0);\nRWStructuredBuffer<float4> b : register(u3, "
          "space2);\n"
          "cbuffer C { float4 c; };\nStructuredBuffer<uint> d;\n"
          "[test] void f() { EXPECT_EQ(a.Load(0), 0); a.Store(0, 5); EXPECT_EQ(a.Load(0), 5); "
          "b[7] = 1; EXPECT_EQ(b[7] + c + d[3], 1); }\n"
          "[test] void g() { EXPECT_EQ(a.Load(0), 0); EXPECT_EQ(b[7], 0); }\n");
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].outcome, Outcome::kPassed) << failure(ran.results[0]);
  EXPECT_EQ(ran.results[1].outcome, Outcome::kPassed) << failure(ran.results[1]);
}

// A cube of a file: every ray down its axis meets it, and only its own geometry counts.
TEST_F(Session, TracesGltfFiles) {
  effects::Scene scene;
  effects::Mesh mesh;
  const effects::Vertex corners[3] = {
      {{-1, -1, 0}, {0, 0, 1}}, {{1, -1, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 1}}};
  const uint32_t indices[3] = {0, 1, 2};
  mesh.add_geometry(corners, indices, 0, false);
  mesh.add_geometry(corners, indices, 0, true);
  scene.meshes.push_back(mesh);
  scene.materials.emplace_back();
  scene.samplers.emplace_back();
  scene.cameras.emplace_back();
  effects::Instance instance;
  instance.transform[3] = glm::dvec4(0, 0, 4, 1);
  scene.instances.push_back(instance);
  const effects::Status written = effects::write_glb((folder_ / "wall.glb").string(), scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const SessionResult ran =
      run("#pragma kaamos gltf wall \"wall.glb\"\n#pragma kaamos instance wall at (0,0,1)\n"
          "[test] void f() { RayQuery<RAY_FLAG_NONE> q; RayDesc r = {float3(0, 0, 0), 0, "
          "float3(0, 0, 1), 9}; q.TraceRayInline(TestScene, 0, 0xFF, r); uint open = 0; "
          "while (q.Proceed()) ++open; EXPECT_NEAR(q.CommittedRayT(), 5, 1e-5); "
          "EXPECT_EQ(q.CommittedGeometryIndex(), 0); EXPECT_LE(open, 1); }\n");
  ASSERT_EQ(ran.error, "");
  EXPECT_EQ(ran.results[0].outcome, Outcome::kPassed) << failure(ran.results[0]);
  EXPECT_EQ(source_.dependencies.back(), (folder_ / "wall.glb").string());
}

TEST_F(Session, ReportsAreWhatServersRead) {
  const SessionResult ran =
      run("[test] void f() { printf(\"a < b && \\\"c\\\"\"); }\n[test] void g() { EXPECT_TRUE(1 < "
          "0); }\n"
          "[test] [skip(\"later\")] void h() {}\n");
  ASSERT_EQ(ran.error, "");
  const std::string xml = to_junit("a.hlsl", ran.results);
  EXPECT_NE(xml.find("tests=\"3\" failures=\"1\" skipped=\"1\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("a &lt; b &amp;&amp; &quot;c&quot;"), std::string::npos) << xml;
  EXPECT_NE(xml.find("EXPECT_TRUE(1 &lt; 0)"), std::string::npos) << xml;
  EXPECT_NE(xml.find("<skipped message=\"later\"/>"), std::string::npos) << xml;
  const std::string tap = to_text(ran.results, Format::kTap, false);
  EXPECT_TRUE(
      tap.starts_with("TAP version 13\n1..3\nok 1 - f (interpreter)\nnot ok 2 - g "
                      "(interpreter)\n# "))
      << tap;
  EXPECT_NE(tap.find("ok 3 - h (interpreter) # SKIP later\n"), std::string::npos) << tap;
}

}  // namespace
}  // namespace kaamos::shader_tests
